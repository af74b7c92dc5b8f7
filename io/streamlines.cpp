// SPDX-License-Identifier: MIT
#include "io/streamlines.hpp"

#include "io/field_output.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arenite {
namespace {

constexpr Real rest = 1e-9; // of the largest speed: slower than this is at rest

void add_line(std::vector<Vec3>& seeds, Region const& line, int count)
{
    for (int i = 0; i < count; ++i) {
        Real const s = count > 1 ? Real(i) / (count - 1) : Real(0.5);
        seeds.push_back(line.lower + s * (line.upper - line.lower));
    }
}

void add_disc(std::vector<Vec3>& seeds, StreamlineSettings const& settings, int count)
{
    Vec3 const normal = normalized(settings.disc_normal.value_or(Vec3{0, 0, 1}));
    Vec3 const other = std::abs(normal.x) < Real(0.9) ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    Vec3 const u = normalized(cross(normal, other)), v = cross(normal, u);
    Real const golden_angle = std::numbers::pi_v<Real> * (3 - std::sqrt(Real(5)));
    for (int i = 0; i < count; ++i) {
        Real const radius = settings.disc_radius * std::sqrt((i + Real(0.5)) / count);
        seeds.push_back(*settings.disc_center + radius * (std::cos(i * golden_angle) * u + std::sin(i * golden_angle) * v));
    }
}

TraceRequest request_of(FluidSnapshot const& fluid, StreamlineSettings const& settings, Real largest_speed)
{
    Vec3 const size{fluid.cells[0] * fluid.spacing.x, fluid.cells[1] * fluid.spacing.y, fluid.cells[2] * fluid.spacing.z};
    TraceRequest request;
    for (Vec3 const& seed : streamline_seeds(settings)) request.seeds.insert(request.seeds.end(), {seed.x, seed.y, seed.z});
    request.max_length = settings.max_length > 0 ? settings.max_length : 4 * norm(size);
    request.terminal_speed = rest * largest_speed;
    return request;
}

/// Exactly two arrays whatever VTK adds, also where there are no lines.
void keep_velocity_and_speed(PolyPiece& lines)
{
    std::vector<Real> velocity;
    for (DataArray& entry : lines.point_data)
        if (entry.name == "velocity") velocity = std::move(std::get<std::vector<Real>>(entry.values));
    auto speed = speeds(velocity);
    lines.point_data = {{"velocity", 3, std::move(velocity)}, {"speed", 1, std::move(speed)}};
}

} // namespace

std::vector<Vec3> streamline_seeds(StreamlineSettings const& settings)
{
    std::vector<Vec3> seeds = settings.points;
    int const count = std::max(settings.count, 1);
    if (settings.line) add_line(seeds, *settings.line, count);
    if (settings.disc_center) add_disc(seeds, settings, count);
    return seeds;
}

PolyPiece trace_streamlines(FluidSnapshot const& fluid, StreamlineSettings const& settings, TraceDirection direction)
{
    auto const speed = speeds(fluid.velocity);
    Real const largest = speed.empty() ? 0 : *std::max_element(speed.begin(), speed.end());
    TraceRequest request = request_of(fluid, settings, largest);
    request.direction = direction;
    PolyPiece lines;
    lines.kind = CellKind::lines;
    lines.time = fluid.time;
    if (largest > 0 && !request.seeds.empty()) lines = trace(fluid_piece(fluid, {"velocity"}), request);
    keep_velocity_and_speed(lines);
    return lines;
}

} // namespace arenite
