// SPDX-License-Identifier: MIT
#include "fluid/exchange.hpp"

#include "core/error.hpp"
#include "core/work_array.hpp"
#include "fluid/flow_balance.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace arenite {
namespace {

/// row: [entry] of position, or empty where position is by entry itself.
void evaluate_volume(RecordView const& position, View1<int> const& row, int entries, TableView const& volume)
{
    bool const by_entry = !row.is_allocated();
    Kokkos::parallel_for(
        "evaluate_volume", RangePolicy(0, entries),
        KOKKOS_LAMBDA(int entry) { volume(entry, 0) = sphere_volume(position(by_entry ? entry : row(entry), 3)); });
}

/// Number of cells that were too full and the lowest porosity before the limit.
void write_porosity(Flow const& flow, Exchange const& exchange, ExchangeReport& report)
{
    Grid const grid = flow.grid;
    auto const porosity = flow.porosity;
    auto const solid = exchange.cell_sum;
    Real const minimum = exchange.minimum_porosity, volume = grid.cell_volume();
    Kokkos::parallel_reduce(
        "write_porosity", RangePolicy(0, grid.cell_count()),
        KOKKOS_LAMBDA(int number, int& limited, Real& lowest) {
            Real const n = 1 - solid(number, 0) / volume;
            lowest = Kokkos::min(lowest, n);
            if (n < minimum) ++limited;
            at(porosity, cell_of_number(grid, number)) = Kokkos::max(n, minimum);
        },
        report.limited_cells, Kokkos::Min<Real>(report.lowest_porosity));
}

/// Summed on the host in cell order, so that it does not depend on threads; it is not on the usual path.
Real limited_volume(Exchange const& exchange)
{
    auto const solid = Kokkos::create_mirror_view_and_copy(HostSpace(), exchange.cell_sum);
    Real const volume = exchange.stencil.grid.cell_volume();
    Real sum = 0;
    for (int number = 0; number < exchange.stencil.grid.cell_count(); ++number)
        sum += std::max(Real(0), solid(number, 0) - (1 - exchange.minimum_porosity) * volume);
    return sum;
}

/// porosity_previous += sign * volume of these grains where they are in the set.
void add_to_previous(Flow const& flow, Exchange const& exchange, CoupledSet const& grains, Real sign)
{
    if (grains.count == 0) return;
    GrainWeights const weights = make_grain_weights(exchange.stencil, grains.position, grains.id, grains.count);
    TableView const volume("crossing_volume", weights.entries, 1);
    evaluate_volume(grains.position, weights.bins.item, weights.entries, volume);
    deposit(weights, volume, exchange.cell_sum, 1);
    Grid const grid = flow.grid;
    auto const previous = flow.porosity_previous;
    auto const solid = exchange.cell_sum;
    Real const scale = sign / grid.cell_volume(), least = exchange.minimum_porosity; // as the porosity itself
    Kokkos::parallel_for(
        "add_to_previous", RangePolicy(0, grid.cell_count()), KOKKOS_LAMBDA(int number) {
            Real& n = at(previous, cell_of_number(grid, number));
            n = Kokkos::max(least, Kokkos::min(n + scale * solid(number, 0), Real(1)));
        });
}

/// [cell](u, v, w, n): what the drag is evaluated with.
void gather_flow(Flow const& flow, TableView const& value)
{
    for_each_cell(
        "gather_flow", flow.grid, KOKKOS_LAMBDA(Node const& cell) {
            int const number = cell_number(flow.grid, cell);
            Vec3 const velocity = velocity_at_cell(flow, cell);
            for (int axis = 0; axis < 3; ++axis) value(number, axis) = velocity[axis];
            value(number, 3) = at(flow.porosity, cell);
        });
}

/// The drag that the coming step will hold, as beta' (u - v'): with f = beta (u - v_new) and the grain's own
/// m (v_new - v) / dt = f + F, v_new is eliminated:
///     beta' = beta / (1 + beta dt / m),   v' = v + dt F / m.
/// So the held force never takes a grain past the fluid's velocity, however long the step. F, the mean of what else acted
/// (contacts, weight), is read off the grain's motion in the step before: dt F / m = (v - v_before) - dt f / m. A grain that
/// rests on others has F = -f and feels the whole beta (u - v).
template <class Law> void evaluate_drag(Law const& law, Exchange const& exchange, Particles const& particles)
{
    GrainWeights const weights = exchange.weights;
    auto const value = exchange.cell_value, drag = exchange.drag;
    RecordView const at = exchange.coupled.position, velocity = particles.velocity, coasting = particles.coasting;
    auto const motion = particles.motion;
    Real const factor = exchange.coarse_grain_factor, dt = exchange.time_step;
    bool const has_history = coasting.extent(0) == velocity.extent(0);
    Kokkos::parallel_for(
        "evaluate_drag", RangePolicy(0, weights.entry_groups()), KOKKOS_LAMBDA(int group) {
            int entry[lane_count], row[lane_count];
            std::uint8_t is_free[lane_count];
            weights.entries_of(group, entry, row);
            for (int n = 0; n < lane_count; ++n) {
                int const later = weights.later_row(entry[n]);
                prefetch(&velocity(later, 0));
                prefetch(&motion(later));
                if (has_history) prefetch(&coasting(later, 0));
                is_free[n] = motion(row[n]) == Motion::free;
            }
            Lanes fluid[4];
            interpolate_at(weights, entry, value, fluid);
            LaneRecords const own = load_records(velocity.data(), row), place = load_records(at.data(), entry);
            LaneMask const free = load_flags(is_free);
            Lanes const slip_speed = norm(Vector<Lanes>{fluid[0], fluid[1], fluid[2]} - own.xyz);
            DragPoint<Lanes> const point{2 * place.w, fluid[3], slip_speed};
            Lanes beta = grain_drag_coefficient(law, point, factor);
            beta = select(free, beta / (1 + beta * dt / own.w), beta);
            Vector<Lanes> predicted = own.xyz;
            if (has_history) {
                LaneRecords const before = load_records(coasting.data(), row);
                predicted = select(free && before.w > Lanes(0), 2 * own.xyz - before.xyz, own.xyz);
            }
            store_records({beta * predicted, beta}, drag.data(), entry);
        });
}

void write_drag(Flow const& flow, TableView const& cell_sum)
{
    Real const per_volume = 1 / flow.grid.cell_volume();
    for_each_cell(
        "write_drag", flow.grid, KOKKOS_LAMBDA(Node const& cell) {
            int const number = cell_number(flow.grid, cell);
            for (int axis = 0; axis < 3; ++axis) at(flow.drag_velocity[axis], cell) = cell_sum(number, axis) * per_volume;
            at(flow.drag, cell) = cell_sum(number, 3) * per_volume;
        });
}

/// [cell](u, v, w, -grad p + div tau): what a grain's force is made of.
void gather_step(Flow const& flow, FlowSolver const& solver, TableView const& value)
{
    FaceField const face_force = solver.face_force;
    for_each_cell(
        "gather_step", flow.grid, KOKKOS_LAMBDA(Node const& cell) {
            int const number = cell_number(flow.grid, cell);
            Vec3 const velocity = velocity_at_cell(flow, cell), force = stress_force_at_cell(flow.grid, face_force, cell);
            for (int axis = 0; axis < 3; ++axis) value(number, axis) = velocity[axis], value(number, 3 + axis) = force[axis];
        });
}

/// pressure_force: the part that is not drag, or an empty view.
void write_fluid_force(Exchange const& exchange, Particles const& particles)
{
    RecordView const fluid_force = particles.fluid_force, pressure_force = particles.pressure_force,
                     coasting = particles.coasting, velocity = particles.velocity;
    Real const dt = exchange.time_step;
    bool const apart = pressure_force.is_allocated();
    GrainWeights const weights = exchange.weights;
    auto const value = exchange.cell_value, drag = exchange.drag, volume = exchange.volume;
    if (weights.entries < particles.rows()) { // grains outside the box
        for (RecordView const& view : {fluid_force, coasting}) Kokkos::deep_copy(ExecutionSpace(), view, Real(0));
        if (apart) Kokkos::deep_copy(ExecutionSpace(), pressure_force, Real(0));
    }
    Kokkos::parallel_for(
        "write_fluid_force", RangePolicy(0, weights.entry_groups()), KOKKOS_LAMBDA(int group) {
            int entry[lane_count], row[lane_count];
            weights.entries_of(group, entry, row);
            for (int n = 0; n < lane_count; ++n) {
                int const later = weights.later_row(entry[n]);
                prefetch(&velocity(later, 0));
                prefetch(&fluid_force(later, 0));
                prefetch(&coasting(later, 0));
            }
            Lanes fluid[6];
            interpolate_at(weights, entry, value, fluid);
            LaneRecords const held = load_records(drag.data(), entry), own = load_records(velocity.data(), row);
            Vector<Lanes> const drag_force = held.w * Vector<Lanes>{fluid[0], fluid[1], fluid[2]} - held.xyz;
            Lanes const grain_volume = make_lanes([&](int n) { return volume(entry[n], 0); });
            Vector<Lanes> const pressure = grain_volume * Vector<Lanes>{fluid[3], fluid[4], fluid[5]};
            store_records({drag_force + pressure, held.w}, fluid_force.data(), row);
            store_records({own.xyz + dt / own.w * drag_force, 1}, coasting.data(), row);
            if (apart) store_records({pressure, 0}, pressure_force.data(), row);
        });
}

/// Largest grain diameter, m.
Real largest_diameter(GrainWeights const& weights, RecordView const& position)
{
    Real largest = 0;
    Kokkos::parallel_reduce(
        "largest_diameter", RangePolicy(0, weights.entries),
        KOKKOS_LAMBDA(int entry, Real& most) { most = Kokkos::max(most, 2 * position(weights.bins.item(entry), 3)); },
        Kokkos::Max<Real>(largest));
    return std::max(largest, Real(0)); // the reduction of nothing is -inf
}

} // namespace

Exchange make_exchange(Flow const& flow, Particles& particles, FluidSettings const& settings, Real coarse_grain_factor)
{
    ARENITE_REQUIRE(coarse_grain_factor > 0, "the coarse grain factor is a ratio of diameters");
    Exchange exchange;
    exchange.drag_law = make_drag_law(settings);
    exchange.stencil = make_deposit_stencil(flow.grid, settings.smoothing_length);
    exchange.coarse_grain_factor = coarse_grain_factor;
    exchange.minimum_porosity = settings.minimum_porosity;
    int const cells = flow.grid.cell_count();
    fit(exchange.cell_sum, "exchange_cell_sum", cells, 4);
    exchange.cell_value = make_interpolated("exchange_cell_value", flow.grid, 6);
    ARENITE_REQUIRE(flow.has_drag(), "the flow was made without grains");
    if (!particles.fluid_force.is_allocated())
        particles.fluid_force = RecordView("fluid_force", particles.position.extent(0));
    if (!particles.coasting.is_allocated()) particles.coasting = RecordView("coasting", particles.position.extent(0));
    return exchange;
}

void deposit_porosity(Flow& flow, Exchange& exchange, Particles const& particles)
{
    Phase const phase("deposit");
    ExchangeReport report;
    exchange.weights =
        make_grain_weights(exchange.stencil, particles.position, particles.id, particles.count, exchange.weights);
    GrainWeights const& weights = exchange.weights;
    report.coupled = weights.entries;
    fit(exchange.volume, "grain_volume", weights.entries, 1);
    fit(exchange.drag, "grain_drag", weights.entries, 4);

    CoupledSet const now = coupled_set(weights, particles, exchange.spare), before = exchange.coupled;
    bool const first = before.count < 0;
    Kokkos::deep_copy(flow.porosity_previous, flow.porosity);
    if (!first && (now.digest != before.digest || now.count != before.count)) {
        CoupledSet const entered = difference(now, before), left = difference(before, now);
        report.entered = entered.count;
        report.left = left.count;
        add_to_previous(flow, exchange, left, 1);
        add_to_previous(flow, exchange, entered, -1);
    }
    exchange.spare = before;
    exchange.coupled = now;

    evaluate_volume(now.position, {}, now.count, exchange.volume);
    deposit(weights, exchange.volume, exchange.cell_sum, 1);
    write_porosity(flow, exchange, report);
    if (report.limited_cells > 0) report.limited_volume = limited_volume(exchange);
    if (first) Kokkos::deep_copy(flow.porosity_previous, flow.porosity);
    exchange.report = report;
}

void deposit_drag(Flow& flow, Exchange& exchange, Particles const& particles, Real dt)
{
    Phase const phase("drag to fluid");
    exchange.time_step = dt;
    gather_flow(flow, exchange.cell_value);
    std::visit([&](auto const& law) { evaluate_drag(law, exchange, particles); }, exchange.drag_law);
    deposit(exchange.weights, exchange.drag, exchange.cell_sum, 4);
    write_drag(flow, exchange.cell_sum);
}

void evaluate_fluid_force(Flow const& flow, FlowSolver const& solver, Exchange const& exchange, Particles& particles)
{
    Phase const phase("drag to grains");
    auto const fit_rows = [&](RecordView& view, std::string const& label) {
        if (view.extent(0) != particles.position.extent(0)) view = RecordView(label, particles.position.extent(0));
    };
    fit_rows(particles.fluid_force, "fluid_force");
    fit_rows(particles.coasting, "coasting");
    if (particles.pressure_force.is_allocated()) fit_rows(particles.pressure_force, "pressure_force");
    gather_step(flow, solver, exchange.cell_value);
    write_fluid_force(exchange, particles);
}

Real drag_stiffness(Exchange const& exchange, Particles const& particles)
{
    Real const dt = exchange.time_step;
    auto const row = exchange.weights.bins.item;
    auto const drag = exchange.drag;
    auto const velocity = particles.velocity;
    auto const motion = particles.motion;
    Real stiffness = 0;
    Kokkos::parallel_reduce(
        "drag_stiffness", RangePolicy(0, exchange.weights.entries),
        KOKKOS_LAMBDA(int entry, Real& most) {
            if (motion(row(entry)) != Motion::free) return;
            Real const share = dt * drag(entry, 3) / velocity(row(entry), 3); // r / (1 + r), r = dt beta / m
            most = Kokkos::max(most, share / (1 - share));
        },
        Kokkos::Max<Real>(stiffness));
    return std::max(stiffness, Real(0));
}

std::vector<std::string> check_exchange(Exchange const& exchange, Particles const& particles)
{
    std::vector<std::string> remarks;
    Grid const& grid = exchange.stencil.grid;
    Real const diameter = largest_diameter(exchange.weights, particles.position);
    Real const radius = exchange.stencil.support_radius;
    if (radius < diameter)
        remarks.push_back(fmt::format("fluid.smoothing_length {:.3g} m is less than the largest grain's diameter, {:.3g} m: "
                                      "a cell inside a grain may fall below the least porosity",
                                      radius, diameter));
    Real const edge = std::max({grid.spacing.x, grid.spacing.y, grid.spacing.z, radius});
    if (edge < 3 * diameter)
        remarks.push_back(fmt::format("cells and smoothing length of {:.3g} m average over {:.2f} diameters of the largest "
                                      "grain; the averaged equations want 3",
                                      edge, edge / diameter));
    Real const stiffness = drag_stiffness(exchange, particles);
    if (stiffness > Real(0.5))
        remarks.push_back(
            fmt::format("the fluid step of {:.3g} s is {:.2f} relaxation times m/beta of a grain: its drag is stable, but "
                        "motion that is quicker than the step is not resolved",
                        exchange.time_step, stiffness));
    ExchangeReport const& report = exchange.report;
    if (report.limited_cells > 0)
        remarks.push_back(
            fmt::format("{} cells are below the least porosity {}: {:.3g} m3 of grains are hidden from the fluid "
                        "(lowest {:.3f})",
                        report.limited_cells, exchange.minimum_porosity, report.limited_volume, report.lowest_porosity));
    return remarks;
}

} // namespace arenite
