// SPDX-License-Identifier: MIT
#include "apps/verify/cavity_flow.hpp"

#include "apps/verify/fluid_case.hpp"

#include <optional>

namespace arenite
{
namespace
{

constexpr Real longest = 200; // units of time: a flow that is not steady by then is not going to be

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

Real largest_difference(Profile const& a, Profile const& b)
{
    Real worst = 0;
    for (std::size_t i = 0; i < a.value.size(); ++i) worst = std::fmax(worst, std::fabs(a.value[i] - b.value[i]));
    return worst;
}

FluidCase make_cavity(int n, Real reynolds)
{
    FluidSettings settings = box_settings({n, n, 1}, {1, 1, 1.0 / n});
    add_periodic_axis(settings, 2);
    settings.patches.push_back(face_patch(Face::y_upper, PatchKind::wall, {1, 0, 0}));
    settings.density = 1;
    settings.viscosity = 1 / reynolds;
    settings.convection = ConvectionScheme::central;
    settings.pressure_tolerance = 1e-2; // of each step's correction, which goes to 0: the steady state does not depend on it
    return make_fluid_case(settings, false);
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

Cavity march_to_steady_state(FluidCase& c, int n, Real still)
{
    Cavity cavity, before = center_lines(c, n);
    int const steps = n; // in a unit of time: Courant number 1 at the lid; at 1.5 the explicit convection blows up
    do {
        FlowReport const report = c.steps(steps, Real(1) / steps);
        Real const duration = before.duration + 1;
        cavity = center_lines(c, n);
        cavity.converged = report.converged;
        cavity.leak = report.inflow + report.outflow;
        cavity.change = std::fmax(largest_difference(cavity.u, before.u), largest_difference(cavity.v, before.v));
        cavity.duration = duration;
        before = cavity;
    } while (cavity.change > still && cavity.duration < longest);
    return cavity;
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
        cavities.push_back(march_to_steady_state(c, n, still));
        coarser = c;
    }
    return cavities;
}

} // namespace arenite
