// SPDX-License-Identifier: MIT
// Hard cases of grains (H1-H4, H10, H11, H13-H16): each ends sound, or stops with one message that says who, when and why.
#include "core/random.hpp"
#include "tests/stability/hard_scene.hpp"

#include <algorithm>
#include <functional>
#include <sstream>

namespace {

using namespace arenite;
using namespace arenite::test;

/// Lines "x, y, z, diameter, vx, vy, vz" of a simple cubic lattice of n^3 places; shake: largest speed, m/s.
std::string lattice(int n, double pitch, double diameter, double shake, std::function<double(int)> const& size = {})
{
    std::ostringstream csv;
    csv.precision(17);
    csv << "x, y, z, diameter, vx, vy, vz\n";
    int id = 0;
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i, ++id) {
                double v[3];
                for (int axis = 0; axis < 3; ++axis) v[axis] = shake * (2 * random_uniform(5, id, axis) - 1);
                csv << (i + 0.5) * pitch << ", " << (j + 0.5) * pitch << ", " << (k + 0.5) * pitch << ", "
                    << (size ? size(id) : diameter) << ", " << v[0] << ", " << v[1] << ", " << v[2] << "\n";
            }
    return csv.str();
}

std::string stage_of(std::string const& duration, std::string const& step, std::string const& contact)
{
    return "[[stages]]\nname = \"run\"\nduration = " + duration + "\n" + step + "\ncontact = { " + contact + " }\n";
}

std::string const balanced = "[output]\nenergies = true\n";

// H1: diameters 0.05 and 0.5 mm, masses 1 : 1000, no loss: the energy that swings between motion and contacts stays.
TEST(Stability, MassRatioOfAThousand)
{
    auto const size = [](int id) { return id % 2 == 0 ? 0.5e-3 : 0.05e-3; };
    HardRun const run = run_hard(
        box_of(5.4e-3, true) + sand_of("restitution = 1\nfriction = 0") + grains_from_file +
            stage_of("4e-4", "time_step_fraction = 0.05", "law = \"hertz\", damping = \"none\", tangential = \"none\"") +
            balanced,
        lattice(10, 0.54e-3, 0, 1.0, size));
    expect_sound(run, 1e-4);
    EXPECT_NEAR(number(run.end(), "momentum_x"), number(run.history.front(), "momentum_x"),
                1e-12 * 1e-4); // kg m/s of some 1e-4
    EXPECT_LE(std::fabs(number(run.end(), "loss_damping")), 1e-12 * number(run.end(), "kinetic_energy")); // none
}

// H2: Young's moduli 2e10 and 2e6 in one pack.
TEST(Stability, StiffnessRatioOfTenThousand)
{
    std::string csv = lattice(8, 0.24e-3, 0.23e-3, 0.5), mixed;
    std::istringstream lines(csv);
    int n = 0;
    for (std::string line; std::getline(lines, line); ++n)
        mixed += line + (n == 0 ? ", material" : (n % 2 ? ", sand" : ", rubber")) + "\n";
    HardRun const run =
        run_hard(box_of(8 * 0.24e-3, true) + sand_of("restitution = 0.8\nfriction = 0.2") +
                     "[materials.rubber]\ndensity = 1000\nyoungs_modulus = 2e6\npoissons_ratio = "
                     "0.45\nrestitution = 0.8\nfriction = 0.2\n" +
                     grains_from_file + stage_of("4e-4", "time_step_fraction = 0.1", "law = \"hertz\"") + balanced,
                 mixed);
    expect_sound(run, 1e-3);
}

// H3: overlaps of 5, 20 and 50 % of a diameter at the start fly apart, and the run says so.
TEST(Stability, GrainsThatStartInsideEachOther)
{
    for (double const overlap : {0.05, 0.2, 0.5}) {
        SCOPED_TRACE(overlap);
        double const d = 0.23e-3;
        HardRun const run = run_hard("[domain]\nlower = [-0.05, -0.05, -0.05]\nupper = [0.05, 0.05, 0.05]\n" +
                                         sand_of("restitution = 0.8\nfriction = 0.2") + grains_from_file +
                                         stage_of("2e-5", "time_step_fraction = 0.02", "law = \"hertz\"") + balanced,
                                     lattice(3, (1 - overlap) * d, d, 0));
        expect_sound(run, 1e-3);
        EXPECT_EQ(number(run.end(), "contacts"), 0);
        EXPECT_NEAR(std::stod(run.history.front().at("max_overlap_ratio")), 2 * overlap, 1e-9);
        EXPECT_EQ(run.messages.find("beyond what the contact laws hold for") != std::string::npos,
                  std::stod(run.history.front().at("max_overlap_ratio")) > 0.1)
            << run.messages;
    }
}

// H4: a plate at 1, 10 and 50 m/s into a bonded block: what the block gains in momentum is the plate's impulse.
TEST(Stability, FastPlateIntoABondedBlock)
{
    for (double const speed : {1., 10., 50.}) {
        SCOPED_TRACE(speed);
        double const d = 0.23e-3, pitch = d - 0.2332409e-6; // bonds at rest
        std::string const velocity = "[0, 0, " + std::to_string(-speed) + "]";
        HardRun const run = run_hard(
            "[domain]\nlower = [-0.02, -0.02, -0.05]\nupper = [0.02, 0.02, 0.02]\n" +
                sand_of("restitution = 0.8\nfriction = 0.2\nsurface_energy = 30") + grains_from_file +
                "[[walls]]\nname = \"plate\"\ntype = \"plane\"\nmaterial = \"sand\"\npoint = [0, 0, " +
                std::to_string(5.05 * d) + "]\nnormal = [0, 0, -1]\n" +
                stage_of("2e-5", "time_step = 5e-9", "law = \"modified_jkr\"") +
                "[[stages.walls]]\nwall = \"plate\"\nvelocity = " + velocity + "\n" + balanced + "history_interval = 5e-9\n",
            lattice(5, pitch, d, 0));
        expect_sound(run, 5e-3);
        double impulse = 0; // velocity Verlet gives every step the mean of its two forces
        for (std::size_t n = 1; n < run.history.size(); ++n)
            impulse += 2.5e-9 * (number(run.history[n - 1], "force_plate_z") + number(run.history[n], "force_plate_z"));
        double const momentum = number(run.end(), "momentum_z");
        EXPECT_LT(momentum, 0);
        EXPECT_NEAR(-impulse / momentum, 1, 1e-9); // force_plate is on the plate
        if (speed > 9) { EXPECT_LT(number(run.end(), "bonds"), number(run.history.front(), "bonds")); }
    }
}

// H10: a gas of grains for which adhesion is everything: they stick, and their clusters keep the momentum.
TEST(Stability, StickyGasKeepsItsMomentum)
{
    HardRun const run =
        run_hard(box_of(8 * 0.4e-3, true) + sand_of("restitution = 0.8\nfriction = 0.2\nsurface_energy = 300") +
                     grains_from_file + stage_of("2e-3", "time_step_fraction = 0.1", "law = \"jkr\"") + balanced,
                 lattice(8, 0.4e-3, 0.23e-3, 0.5));
    expect_sound(run, 5e-3);
    EXPECT_GT(number(run.end(), "bonds"), 100);
    for (char const* name : {"momentum_x", "momentum_y", "momentum_z"}) // 512 grains of 1.7e-8 kg at some 0.3 m/s
        EXPECT_NEAR(number(run.end(), name), number(run.history.front(), name), 1e-12 * 2.5e-6);
}

/// Grains of a lattice under periodic stretch along z, their lines in an order of the caller's; id column given.
std::string numbered_lattice(int n, double pitch, double diameter, bool backwards)
{
    std::vector<std::string> lines;
    std::istringstream csv(lattice(n, pitch, diameter, 0));
    std::string line, header;
    std::getline(csv, header);
    for (int id = 0; std::getline(csv, line); ++id) lines.push_back(line + ", " + std::to_string(id));
    if (backwards) std::reverse(lines.begin(), lines.end());
    std::string text = header + ", id\n";
    for (std::string const& l : lines) text += l + "\n";
    return text;
}

// H11: 10 648 bonds reach their strength in one step; neither the order of the grains nor the threads can matter.
TEST(Stability, TenThousandBondsBreakInOneStep)
{
    constexpr int n = 22, count = n * n * n;
    double const d = 0.23e-3, pitch = d - 0.2332409e-6, edge = n * pitch;
    std::ostringstream domain;
    domain.precision(17);
    domain << "[domain]\nlower = [0, 0, 0]\nupper = [" << edge << ", " << edge << ", " << edge
           << "]\nperiodic = [true, true, true]\n";
    std::string const scene = domain.str() + sand_of("restitution = 0.8\nfriction = 0.2\nsurface_energy = 30") +
                              grains_from_file + stage_of("2.0e-6", "time_step = 1e-8", "law = \"modified_jkr\"") +
                              "box = { z = { strain_rate = 1000 } }\n" + balanced + "history_interval = 1e-8\n";
    HardRun const forth = run_hard(scene, numbered_lattice(n, pitch, d, false)),
                  back = run_hard(scene, numbered_lattice(n, pitch, d, true));
    expect_sound(forth, 1e-2);
    std::size_t broke = 0;
    for (std::size_t row = 1; row < forth.history.size(); ++row)
        if (number(forth.history[row], "bonds") < number(forth.history[row - 1], "bonds")) {
            ++broke;
            EXPECT_EQ(number(forth.history[row - 1], "bonds") - number(forth.history[row], "bonds"), count);
        }
    EXPECT_EQ(broke, 1u) << "all bonds along z break in one step";
    ASSERT_EQ(forth.history.size(), back.history.size());
    for (std::size_t row = 0; row < forth.history.size(); ++row)
        EXPECT_EQ(forth.history[row], back.history[row]) << "row " << row;
    // Released = taken up: the potential that a bond at C held, -1.368 pi gamma R* L each, stands in the sheet.
    double const radius = 0.0575e-3, modulus = 2e10 / (2 * (1 - 0.09)), pi = 3.14159265358979;
    double const unit = pi * 30 * radius * std::cbrt(pi * pi * 900 * radius / (modulus * modulus));
    auto const potential = [](double s) { return 8. / 15 * std::pow(s, 5) - 8. / 3 * std::pow(s, 3.5) + 2 * s * s; };
    EXPECT_NEAR(number(forth.end(), "loss_adhesion") / (count * potential(std::cbrt(2.25)) * unit), 1,
                0.02); // one step beyond C
}

// Grains of a checkpoint are of the materials that they were of, wherever the scene that takes them has those.
TEST(Stability, GrainsOfACheckpointKeepTheirMaterials)
{
    if (!can_write_checkpoints()) GTEST_SKIP() << "a build without HDF5";
    auto const material = [](char const* name, char const* density) {
        return std::string("[materials.") + name + "]\ndensity = " + density +
               "\nyoungs_modulus = 2e10\npoissons_ratio = 0.3\nrestitution = 0.8\nfriction = 0.2\n";
    };
    std::string const light = material("light", "1000"), heavy = material("heavy", "8000"),
                      stage = stage_of("1e-6", "time_step = 1e-8", "law = \"hertz\"");
    HardRun const first =
        run_hard(box_of(0.01, false) + light + heavy + "[particles]\nsource = \"file\"\nfile = \"grains.csv\"\n" + stage,
                 "x, y, z, diameter, material\n2e-3, 5e-3, 5e-3, 2e-4, light\n8e-3, 5e-3, 5e-3, 2e-4, heavy\n");
    ASSERT_EQ(first.exit_code, 0) << first.messages;
    std::string const file = list_checkpoints(first.folder / "out").back().string(),
                      taken = "[particles]\nsource = \"checkpoint\"\nfile = \"" + file + "\"\n" + stage +
                              "gravity = [0, 0, -1e4]\n";
    auto const heavy_grain_in = [&](std::string const& materials) {
        HardRun const run =
            run_hard(box_of(0.01, false) + materials + taken +
                     "[[stages.walls]]\nwall = \"floor\"\n[[walls]]\nname = \"floor\"\ntype = \"plane\"\nmaterial "
                     "= \"light\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n");
        EXPECT_EQ(run.exit_code, 0) << run.messages;
        return number(run.end(), "kinetic_energy");
    };
    double const energy = heavy_grain_in(light + heavy);
    double const volume = 3.14159265358979 / 6 * 8e-12, speed = 1e4 * 1e-6;
    EXPECT_NEAR(energy, 9000 * volume * speed * speed / 2, 1e-9 * energy);
    EXPECT_EQ(heavy_grain_in(heavy + light), energy);
    EXPECT_NE(run_hard(box_of(0.01, false) + light + taken).messages.find("is of material heavy"), std::string::npos);
}

// H13: a force that is no number stops the run with one message; what was saved stays.
TEST(Stability, ForceBeyondAllNumbersStopsTheRun)
{
    std::string const scene =
        box_of(0.01, false) + sand_of("restitution = 0.8\nfriction = 0.2") + grains_from_file +
        "[[groups]]\nname = \"pushed\"\nids = [7]\nforce = [1e200, 0, 0]\nstages = [\"second\"]\n" +
        "[[stages]]\nname = \"first\"\nduration = 1e-6\ntime_step = 1e-8\n[[stages]]\nname = \"second\"\nduration = "
        "1e-6\ntime_step = 1e-8\n";
    HardRun const run = run_hard(scene, lattice(3, 0.3e-3, 0.23e-3, 0));
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.messages.find("grain 7"), std::string::npos) << run.messages;
    EXPECT_NE(run.messages.find("stage \"second\", step "), std::string::npos) << run.messages;
    if (!can_write_checkpoints()) return; // a build without HDF5
    auto const checkpoints = list_checkpoints(run.folder / "out");
    ASSERT_FALSE(checkpoints.empty());
    EXPECT_EQ(CheckpointReader(checkpoints.back()).stamp().step, 100);
    EXPECT_GE(run.history.size(), 2u) << "the rows before are what one wants to see";
    EXPECT_EQ(run.end().at("stage"), "second");
}

// H14: two bonded grains fall through a hole: each is counted once, and the mass that is missing is in the ledger.
TEST(Stability, BondedPairLeavesOnce)
{
    std::string const scene =
        "[domain]\nlower = [-2e-3, -2e-3, -4e-3]\nupper = [2e-3, 2e-3, 4e-3]\ngravity = [0, 0, -9.81]\n" +
        sand_of("restitution = 0.8\nfriction = 0.2\nsurface_energy = 30") + grains_from_file +
        "[[walls]]\nname = \"plate\"\ntype = \"plane\"\nmaterial = \"sand\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
        "[[walls.holes]]\nname = \"hole\"\ncenter = [0, 0, 0]\ndiameter = 1e-3\n" +
        stage_of("0.02", "time_step = 2e-8", "law = \"modified_jkr\"") +
        "outlet_wall = \"plate\"\n[[stages.walls]]\nwall = \"plate\"\nopen = [\"hole\"]\n" + balanced +
        "history_interval = 1e-4\n";
    HardRun const run = run_hard(
        scene, "x, y, z, diameter\n0, 0, 0.4e-3, 0.23e-3\n0, 0, 0.6297668e-3, 0.23e-3\n0.05e-3, 1.5e-3, 0.2e-3, 0.23e-3\n");
    expect_sound(run, 2e-3);
    ASSERT_EQ(run.produced.size(), 2u);
    EXPECT_NE(run.produced[0].at("id"), run.produced[1].at("id"));
    EXPECT_EQ(number(run.end(), "grains"), 1);
    double const mass = 2605 * 3.14159265358979 / 6 * std::pow(0.23e-3, 3);
    EXPECT_NEAR(number(run.end(), "produced_mass") / (2 * mass), 1, 1e-12);
    EXPECT_GT(number(run.history.front(), "bonds"), 0);
}

// H15: nothing, one grain, two grains, one bond.
TEST(Stability, HardlyAnyGrains)
{
    std::string const rest = sand_of("restitution = 0.8\nfriction = 0.2\nsurface_energy = 30") + grains_from_file +
                             stage_of("1e-6", "time_step = 1e-8", "law = \"modified_jkr\"") + balanced;
    expect_sound(run_hard(box_of(0.01, false) + rest, "x, y, z, diameter\n5e-3, 5e-3, 5e-3, 0.23e-3\n"), 1e-12);
    HardRun const bond = run_hard(box_of(0.01, true) + rest,
                                  "x, y, z, diameter\n5e-3, 5e-3, 5e-3, 0.23e-3\n5e-3, 5e-3, 5.2298e-3, 0.23e-3\n");
    expect_sound(bond, 1e-5); // a bond that swings: (omega dt)^2 / 8 is 1.3e-4 of the swing's energy
    EXPECT_EQ(number(bond.end(), "bonds"), 1);
    HardRun const none = run_hard(box_of(0.01, false) + rest, "x, y, z, diameter\n");
    EXPECT_TRUE(none.exit_code == 0 || none.messages.find("grains.csv") != std::string::npos) << none.messages;
}

// H16: a pair that slides on each other while it crosses faces of a periodic box, upwards and downwards along two axes at
// once, moves as it does in the middle of an open box.
TEST(Stability, SlidingPairAcrossPeriodicFaces)
{
    double const edge = 1e-3;
    auto const pair_of = [&](double start, double speed, bool periodic) {
        std::ostringstream csv;
        csv.precision(17);
        csv << "x, y, z, diameter, vx, vy, vz, wx, wy, wz, id\n"
            << start << ", " << start << ", 0.5e-3, 0.23e-3, " << speed << ", " << speed + 0.1 << ", 0.02, 0, 0, 300, 0\n"
            << start + 0.2301e-3 << ", " << start << ", 0.51e-3, 0.23e-3, " << speed - 0.1 << ", " << speed
            << ", 0, 0, 100, 0, 1\n";
        std::string const open_box = "[domain]\nlower = [-0.01, -0.01, -0.01]\nupper = [0.01, 0.01, 0.01]\n";
        return run_hard((periodic ? box_of(edge, true) : open_box) +
                            "[materials.sand]\ndensity = 2605\nyoungs_modulus = 1e7\npoissons_ratio = 0.3\n"
                            "restitution = 0.8\nfriction = 0.2\n" +
                            grains_from_file + stage_of("1e-4", "time_step = 5e-8", "law = \"hertz\"") + balanced +
                            "history_interval = 1e-6\nprobes = [{name = \"a\", grain = 0}, {name = \"b\", grain = 1}]\n",
                        csv.str());
    };
    for (double const speed : {5., -5.}) {
        SCOPED_TRACE(speed);
        double const start = speed > 0 ? 0.6e-3 : 0.2e-3; // the contact lasts 6e-5 s, 0.3 mm
        HardRun const wrapped = pair_of(start, speed, true), open = pair_of(start, speed, false);
        expect_sound(wrapped, 1e-3);
        EXPECT_GT(number(open.end(), "loss_tangential"), 0);
        for (char const* name : {"probe-a.csv", "probe-b.csv"}) {
            auto const inside = read_table(wrapped.folder / "out" / name), outside = read_table(open.folder / "out" / name);
            ASSERT_EQ(inside.size(), outside.size());
            ASSERT_GT(inside.size(), 90u);
            EXPECT_GT(std::fabs(number(inside.back(), "x") - number(outside.back(), "x")), edge / 2) << "it did not cross";
            EXPECT_GT(std::fabs(number(inside.back(), "y") - number(outside.back(), "y")), edge / 2) << "it did not cross";
            for (std::size_t n = 0; n < inside.size(); ++n) {
                for (char const* axis : {"x", "y", "z"})
                    EXPECT_NEAR(std::remainder(number(inside[n], axis) - number(outside[n], axis), edge), 0, 1e-12 * edge);
                for (char const* velocity : {"vx", "vy", "vz"})
                    EXPECT_NEAR(number(inside[n], velocity), number(outside[n], velocity), 1e-12 * 5);
                for (char const* spin : {"wx", "wy", "wz"})
                    EXPECT_NEAR(number(inside[n], spin), number(outside[n], spin), 1e-12 * 5e3);
            }
        }
    }
}

} // namespace
