// SPDX-License-Identifier: MIT
// The fluid alone: steps of a cube of n^3 cells whose void fraction varies from 0.35 in a bed to 1 in a cavity along
// its axis, driven by a pressure difference. Prints one CSV row; perf/fluid/run.py runs it.
//
//   bench_projection CELLS_PER_EDGE REPEATS [FOLDER]
//
// FOLDER: the pressure's linear system goes there as arrays of doubles, for another solver: conductance_x, _y, _z (one
// more face than cells along their axis) and right_hand_side, x fastest.
#include "apps/bench_limits.hpp"
#include "apps/seconds_of.hpp"
#include "fluid/advance_flow.hpp"
#include "fluid/halos.hpp"
#include "fluid/momentum.hpp"
#include "fluid/pressure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace {

using namespace arenite;

constexpr Real edge = 18e-3; // m, the paper's sample
constexpr Real step = 1e-5;  // s

FluidSettings settings_of(int cells)
{
    FluidSettings settings;
    settings.cells = {cells, cells, cells};
    settings.gravity = false;
    for (Face const face : {Face::z_lower, Face::z_upper}) {
        PatchSettings patch;
        patch.face = face;
        patch.kind = PatchKind::pressure;
        patch.pressure = face == Face::z_lower ? 2e4 : 0;
        settings.patches.push_back(patch);
    }
    return settings;
}

/// Void fraction of a bed with ripples as wide as a few grains, and of the cavity in it.
KOKKOS_FUNCTION Real porosity_at(Vec3 const& x)
{
    constexpr Real wave = 2 * 3.14159265358979324 / 1.2e-3;
    Real const ripple = Real(0.05) * Kokkos::sin(wave * x.x) * Kokkos::sin(wave * x.y) * Kokkos::sin(wave * x.z);
    Real const off_axis = Kokkos::hypot(x.x - edge / 2, x.y - edge / 2);
    return off_axis < 2e-3 && x.z > edge / 4 ? Real(1) : Real(0.4) + ripple;
}

/// The bed, with its Ergun drag at rest: 150 mu (1 - n)^2 / (n d^2), d = 0.46 mm, for the superficial velocity.
void lay_bed(Flow const& flow_now)
{
    Flow const flow = flow_now;
    for_each_cell(
        "lay_bed", flow.grid, KOKKOS_LAMBDA(Node const& cell) {
            Real const n = porosity_at(flow.grid.center(cell.i - Grid::halo, cell.j - Grid::halo, cell.k - Grid::halo));
            at(flow.porosity, cell) = at(flow.porosity_previous, cell) = n;
            at(flow.drag, cell) = 150 * flow.viscosity * (1 - n) * (1 - n) / (n * Real(0.46e-3) * Real(0.46e-3));
        });
}

template <class Work> double median_seconds(int repeats, Work const& work)
{
    std::vector<double> seconds;
    for (int n = 0; n < repeats; ++n) seconds.push_back(seconds_of(work));
    std::nth_element(seconds.begin(), seconds.begin() + repeats / 2, seconds.end());
    return seconds[repeats / 2];
}

void write(std::string const& path, View1<Real> const& view)
{
    auto const host = Kokkos::create_mirror_view_and_copy(HostSpace(), view);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<char const*>(host.data()), static_cast<std::streamsize>(host.size() * sizeof(Real)));
}

void write_system(std::string const& folder, Flow const& flow, FlowBoundary const& boundary, FlowSolver& solver,
                  TimeDerivative const& time)
{
    int const iterations = std::exchange(solver.pressure_limits.iterations, 0);
    solve_pressure(flow, boundary, solver, time); // assembles, and leaves the right-hand side as the residual
    solver.pressure_limits.iterations = iterations;
    for (int axis = 0; axis < 3; ++axis) write(folder + "/conductance_" + "xyz"[axis], solver.levels[0].conductance[axis]);
    write(folder + "/right_hand_side", solver.pressure_system.residual);
}

// Traffic of the pressure solve in bytes per cell and iteration, each array of a kernel counted once. V-cycle, finest
// level: smooth_from_zero 48 (b, diagonal, 3 conductances, x), restrict_residual 41 (x, b, conductances, an eighth of
// b), prolong_and_smooth 65 (x, b, conductances, diagonal, correction, result, an eighth), smooth_again 56 (correction,
// conductances, diagonal, result twice): 210, and 8/7 of it for all levels. Conjugate gradients: three dot products 40,
// three updates 72, the matrix 40.
constexpr double bytes_per_iteration = 210 * 8.0 / 7 + 152;

void run(int cells, int repeats, std::string const& folder)
{
    FluidSettings const settings = settings_of(cells);
    Flow flow = make_flow(settings, Region{{}, {edge, edge, edge}}, true, {});
    FlowBoundary const boundary = make_boundary(settings, flow.grid);
    FlowSolver solver = make_flow_solver(settings, flow);
    lay_bed(flow);
    fill_halos(flow, boundary);
    FlowReport report;
    double const whole = median_seconds(repeats, [&] { report = advance_flow(flow, boundary, solver, step); });
    TimeDerivative const time = time_derivative(solver, step);
    // Leaves what a step's pressure has to correct; a solve does not change it.
    predict_velocity(flow, boundary, solver, time);
    KrylovReport pressure;
    double const solve = median_seconds(repeats, [&] { pressure = solve_pressure(flow, boundary, solver, time); });
    if (!folder.empty()) write_system(folder, flow, boundary, solver, time);
    double const count = flow.grid.cell_count(), copied = copy_bandwidth(1 << 29); // beyond any cache
    double const moved = bytes_per_iteration * count * std::max(pressure.iterations, 1) / solve;
    std::fputs(fmt::format("{},{},{},{:.3f},{},{:.3f},{:.4g},{:.4g},{:.4g},{:.3f}\n", cells, ExecutionSpace::name(),
                           ExecutionSpace().concurrency(), 1e3 * whole, pressure.iterations, 1e3 * solve,
                           1e-6 * count / whole, 1e-9 * moved, 1e-9 * copied, moved / copied)
                   .c_str(),
               stdout);
}

} // namespace

int main(int argc, char** argv)
{
    Kokkos::ScopeGuard const kokkos(argc, argv);
    if (argc < 3) {
        std::fputs("bench_projection CELLS_PER_EDGE REPEATS [FOLDER]\n", stderr);
        return 2;
    }
    run(std::atoi(argv[1]), std::atoi(argv[2]), argc > 3 ? argv[3] : "");
}
