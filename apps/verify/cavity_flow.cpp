// SPDX-License-Identifier: MIT
#include "apps/verify/cavity_flow.hpp"

#include "apps/verify/anderson_mixing.hpp"
#include "apps/verify/fluid_case.hpp"

#include <optional>

namespace arenite {
namespace {

constexpr int longest = 200; // units of time: a flow that is not steady by then is not going to be

/// The centre lines of the flow as it is.
Cavity center_lines(FluidCase const& c, int n)
{
    HostField const u = host_copy(c.flow.velocity[0]), v = host_copy(c.flow.velocity[1]);
    Cavity cavity{{{0}, {0}}, {{0}, {0}}};
    for (int i = 0; i < n; ++i) {
        cavity.u.at.push_back((i + Real(0.5)) / n);
        cavity.u.value.push_back(value_of(u, n / 2, i, 0));
        cavity.v.value.push_back(value_of(v, i, n / 2, 0));
    }
    cavity.v.at = cavity.u.at;
    for (Profile* profile : {&cavity.u, &cavity.v}) profile->at.push_back(1);
    cavity.u.value.push_back(1);
    cavity.v.value.push_back(0);
    return cavity;
}

FluidCase make_cavity(int n, Real reynolds)
{
    FluidSettings settings = box_settings({n, n, 1}, {1, 1, 1.0 / n});
    add_periodic_axis(settings, 2);
    settings.patches.push_back(face_patch(Face::y_upper, PatchKind::wall, {1, 0, 0}));
    settings.density = 1;
    settings.viscosity = 1 / reynolds;
    settings.convection = ConvectionScheme::central;
    // Both of each step's change, which goes to 0: the steady state does not depend on them.
    settings.pressure_tolerance = 1e-2;
    FluidCase c = make_fluid_case(settings, false);
    c.solver.velocity_limits.relative = 1e-2;
    return c;
}

/// Bilinear, which leaves a divergence to the first step's correction.
void interpolate_velocity(FluidCase const& coarse, FluidCase const& fine)
{
    Grid const& grid = coarse.flow.grid;
    for (int axis = 0; axis < 2; ++axis) {
        HostField const from = host_copy(coarse.flow.velocity[axis]);
        set_field(fine.flow.grid, fine.flow.velocity[axis], axis, [&](Vec3 x) {
            Real const s[2] = {x.x / grid.spacing.x - (axis == 0 ? Real(0) : Real(0.5)),
                               x.y / grid.spacing.y - (axis == 1 ? Real(0) : Real(0.5))};
            int low[2];
            for (int d = 0; d < 2; ++d) low[d] = std::clamp(static_cast<int>(std::floor(s[d])), -Grid::halo, grid.cells[d]);
            Real const a = s[0] - low[0], b = s[1] - low[1];
            auto const row = [&](int j) {
                return (1 - a) * value_of(from, low[0], j, 0) + a * value_of(from, low[0] + 1, j, 0);
            };
            return (1 - b) * row(low[1]) + b * row(low[1] + 1);
        });
    }
}

/// Velocity along x, y and pressure, halos included.
std::array<FieldView, 3> state_fields(Flow const& flow) { return {flow.velocity[0], flow.velocity[1], flow.pressure}; }

std::vector<Real> state_of(FluidCase const& c)
{
    std::vector<Real> state;
    for (FieldView const& field : state_fields(c.flow)) {
        HostField const host = host_copy(field);
        state.insert(state.end(), host.data(), host.data() + host.size());
    }
    return state;
}

/// As if the flow had been in this state a step before too.
void set_state(FluidCase const& c, std::vector<Real> const& state)
{
    Real const* from = state.data();
    for (FieldView const& field : state_fields(c.flow)) {
        HostField const host = host_copy(field);
        std::copy_n(from, host.size(), host.data());
        Kokkos::deep_copy(field, host);
        from += host.size();
    }
    for (int axis = 0; axis < 3; ++axis)
        Kokkos::deep_copy(c.solver.previous_velocity.component[axis], c.flow.velocity[axis]);
}

/// Steps in a unit of time: at the lid a Courant number of at most 1, and at most 12.5 viscous times nu / U^2. From
/// rest explicit convection by the central scheme blows up at a Courant number of 1.5 (Re 400, 32^2) and at 31 viscous
/// times (Re 1000, 32^2).
int steps_in_a_unit(int n, Real reynolds) { return std::max(n, static_cast<int>(std::ceil(reynolds / Real(12.5)))); }

/// The map of Anderson's mixing is a unit of time, so the steady state is its fixed point. At Re 1000 the slowest
/// change falls by 6 % in a unit: 120 units by itself, some 35 so.
Cavity march_to_steady_state(FluidCase& c, int n, Real reynolds, Real still)
{
    int const steps = steps_in_a_unit(n, reynolds);
    AndersonMixing mixing;
    for (int units = 1;; ++units) {
        std::vector<Real> const before = state_of(c);
        FlowReport const report = c.steps(steps, Real(1) / steps);
        std::vector<Real> const after = state_of(c);
        Cavity cavity = center_lines(c, n);
        cavity.converged = report.converged();
        cavity.leak = report.inflow + report.outflow;
        cavity.duration = units;
        std::size_t const velocities = 2 * c.flow.velocity[0].size();
        for (std::size_t i = 0; i < velocities; ++i)
            cavity.change = std::fmax(cavity.change, std::fabs(after[i] - before[i]));
        if (cavity.change < still || units == longest) return cavity;
        set_state(c, mixing.next_point(before, after));
    }
}

} // namespace

Real Profile::operator()(Real s) const
{
    int const count = static_cast<int>(at.size());
    int const above = static_cast<int>(std::lower_bound(at.begin(), at.end(), s) - at.begin());
    int const first = std::clamp(above - 2, 0, count - 4);
    Real sum = 0;
    for (int i = first; i < first + 4; ++i) {
        Real weight = 1;
        for (int j = first; j < first + 4; ++j)
            if (j != i) weight *= (s - at[j]) / (at[i] - at[j]);
        sum += weight * value[i];
    }
    return sum;
}

std::array<Real, 3> Cavity::extrema() const
{
    std::array<Real, 3> found{};
    for (int n = 0; n <= 4000; ++n) {
        Real const s = n / Real(4000);
        found[0] = std::min(found[0], u(s));
        found[1] = std::max(found[1], v(s));
        found[2] = std::min(found[2], v(s));
    }
    return found;
}

std::vector<Cavity> steady_cavities(Real reynolds, std::vector<int> const& cells, Real still)
{
    std::vector<Cavity> cavities;
    std::optional<FluidCase> coarser;
    for (int const n : cells) {
        FluidCase c = make_cavity(n, reynolds);
        if (coarser) interpolate_velocity(*coarser, c);
        cavities.push_back(march_to_steady_state(c, n, reynolds, still));
        coarser = c;
    }
    return cavities;
}

} // namespace arenite
