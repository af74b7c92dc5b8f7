// SPDX-License-Identifier: MIT
// Free grains in a column: a bed that the flow expands, and a suspension that settles in a closed box, both above a
// floor of held grains below the fluid. Within the kernel's radius of a free surface grains feel the porosity that
// the kernel mixes from the bed and the clear fluid: there an expanded bed is not uniform.
#include "apps/verify/beds.hpp"
#include "apps/verify/coupling_checks.hpp"

#include <fmt/format.h>

namespace arenite {
namespace {

struct Expanded {
    Real porosity = 0;      // of a uniform bed whose grains lie as high on average
    Real pressure_drop = 0; // Pa, without the hydrostatic part
    bool converged = false;
};

/// From a lattice of `start` to the bed under `superficial`; means over the last quarter of the time.
Expanded expand(Real start, Real superficial, Real time)
{
    BedSettings settings;
    settings.porosity = start;
    settings.superficial = superficial;
    settings.held = false;
    settings.gravity = true;
    settings.cells = {2, 2, 8};
    settings.freeboard = 6;
    settings.grains_per_edge = 4;
    settings.grain_step = 6e-5;
    Bed bed = make_bed(settings);
    constexpr Real dt = 3e-4; // s, under half of the grains' own drag time
    int const steps = static_cast<int>(time / dt);
    Expanded mean;
    int samples = 0;
    for (int n = 0; n < steps; ++n) {
        bed.run.step(dt);
        if (n < 3 * steps / 4) continue;
        Real height = 0;
        for (Grain const& grain : grains_by_id(bed.run.grains))
            if (grain.motion == Motion::free) height += 2 * grain.position.z / bed.grains;
        mean.porosity += 1 - bed.solid_volume / (bed.area * height);
        HostField const p = host_copy(bed.run.fluid.flow.pressure);
        Grid const& grid = bed.run.fluid.flow.grid;
        for (int c = 0; c < 4; ++c) { // at the inlet: from the two lowest cells
            Real const low = value_of(p, c % 2, c / 2, 0), next = value_of(p, c % 2, c / 2, 1);
            mean.pressure_drop += ((3 * low - next) / 2 - 101325 - 998.2 * 9.81 * grid.cells[2] * grid.spacing.z) / 4;
        }
        ++samples;
    }
    mean.porosity /= samples;
    mean.pressure_drop /= samples * (2605 - 998.2) * 9.81 * bed.solid_volume / bed.area;
    mean.converged = bed.run.converged;
    return mean;
}

} // namespace

std::vector<VerifyCase> check_bed_expansion()
{
    std::vector<VerifyCase> rows;
    struct Case {
        Real start, superficial, porosity, time;
    };
    for (Case const& c : {Case{0.50, 2e-3, 0.5179615721, 1.0}, Case{0.62, 5e-3, 0.6386822563, 0.6}}) {
        Expanded const found = expand(c.start, c.superficial, c.time);
        std::string const name = fmt::format("C5b bed of 0.23 mm, U {:g} m/s, from n {}", c.superficial, c.start);
        VerifyCase row = compare({name, "n from the grains' mean height (error: absolute)", "Di Felice 1994"},
                                 found.porosity, c.porosity, 1);
        row.error *= c.porosity;
        row.limit = 0.01;
        row.pass = row.error <= row.limit && found.converged;
        rows.push_back(row);
        rows.push_back(compare({name, "C5 pressure drop / weight in water", "closed form: 1 above U_mf"},
                               found.pressure_drop, 1, 5e-3));
    }
    return rows;
}

namespace {

BedSettings suspension(Real porosity)
{
    BedSettings settings;
    settings.porosity = porosity;
    settings.held = false;
    settings.closed = true;
    settings.gravity = true;
    settings.cells = {2, 2, 14};
    settings.grains_per_edge = 3;
    settings.grain_step = 5e-5;
    return settings;
}

/// Height [m] where the porosity is half way between the suspension's and 1.
Real front(Bed const& bed)
{
    HostField const porosity = host_copy(bed.run.fluid.flow.porosity);
    Grid const& grid = bed.run.fluid.flow.grid;
    auto const layer = [&](int k) {
        return (value_of(porosity, 0, 0, k) + value_of(porosity, 1, 0, k) + value_of(porosity, 0, 1, k) +
                value_of(porosity, 1, 1, k)) /
               4;
    };
    Real const mark = (1 + bed.settings.porosity) / 2;
    int k = grid.cells[2] - 1;
    while (k > 0 && layer(k) > mark) --k;
    return (k + Real(0.5) + (mark - layer(k)) / (layer(k + 1) - layer(k))) * grid.spacing.z;
}

} // namespace

std::vector<VerifyCase> check_batch_settling()
{
    struct Case {
        Real porosity, speed;
    };
    std::vector<VerifyCase> rows;
    for (Case const& c : {Case{0.95, 0.022950819}, Case{0.90, 0.018994436}, Case{0.80, 0.012334079}}) {
        Bed bed = make_bed(suspension(c.porosity));
        constexpr Real dt = 4e-4; // s, under a quarter of the grains' own drag time
        Real const cell = bed.run.fluid.flow.grid.spacing.z;
        auto const run_for = [&](Real distance) {
            int const steps = static_cast<int>(distance / c.speed / dt);
            for (int n = 0; n < steps; ++n) bed.run.step(dt);
            return steps * dt;
        };
        run_for(3 * cell); // the kernel's width: the front has its own shape
        Real const start = front(bed), time = run_for(3 * cell);
        rows.push_back(compare({fmt::format("C7 suspension of 0.23 mm in a closed column, n {}", c.porosity),
                                "speed of the front [m/s]", "Di Felice 1994, zero net flux"},
                               (start - front(bed)) / time, c.speed, 3e-2));
        rows.push_back(expect_true({fmt::format("C7 suspension of 0.23 mm in a closed column, n {}", c.porosity),
                                    "every solve converged", "solver"},
                                   bed.run.converged));
    }
    return rows;
}

} // namespace arenite
