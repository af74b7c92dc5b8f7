// SPDX-License-Identifier: MIT
#include "fluid/halos.hpp"

#include "fluid/operators.hpp"

namespace arenite {
namespace {

KOKKOS_INLINE_FUNCTION int source_index(Grid const& grid, int axis, int index)
{
    int const n = grid.cells[axis], cell = index - Grid::halo;
    if (grid.periodic[axis]) return ((cell % n) + n) % n + Grid::halo;
    return (cell < 0 ? 0 : (cell >= n ? n - 1 : cell)) + Grid::halo;
}

struct CellFields {
    FieldView field[7];
    int count = 0;
};

CellFields cell_fields_of(Flow const& flow)
{
    CellFields fields{{flow.porosity, flow.porosity_previous, flow.pressure}, 3};
    if (!flow.has_drag()) return fields;
    fields.field[fields.count++] = flow.drag;
    for (int axis = 0; axis < 3; ++axis) fields.field[fields.count++] = flow.drag_velocity[axis];
    return fields;
}

/// One layer (1 or 2) beyond a boundary of `axis`; face is the component's node there.
KOKKOS_INLINE_FUNCTION Real halo_velocity(Flow const& flow, FlowBoundary const& boundary, int axis, int component,
                                          Node const& face)
{
    Grid const& grid = flow.grid;
    FieldView const& u = flow.velocity[component];
    int const n = grid.cells[axis], index = face[axis] - Grid::halo;
    Node inside = face;
    if (grid.periodic[axis]) {
        inside[axis] = ((index % n) + n) % n + Grid::halo;
        return at(u, inside);
    }
    if (axis == component) {
        int const end = index < 0 ? 0 : n, inward = index < 0 ? 1 : -1;
        inside[axis] = end + Grid::halo;
        Real const on_boundary = at(u, inside);
        return on_boundary + (index < 0 ? -index : index - n) * (on_boundary - at(u, shifted(inside, axis, inward)));
    }
    inside[axis] = (index < 0 ? 0 : n - 1) + Grid::halo;
    Node record = inside; // the boundary is known along the cells, not beyond the box's edges
    for (int other = 0; other < 3; ++other)
        if (other != axis && other != component) record[other] = source_index(grid, other, record[other]);
    Real const porosity = inside[component] > 0 ? mean_at_face(flow.porosity, component, inside) : at(flow.porosity, inside);
    EdgeCondition const edge = edge_condition(grid, boundary, axis, index < 0 ? -1 : 1, component, record, porosity);
    return (1 - 2 * edge.stick) * at(u, inside) + 2 * edge.stick_velocity;
}

} // namespace

void fill_cell_halos(Flow const& flow)
{
    CellFields const fields = cell_fields_of(flow);
    Grid const grid = flow.grid;
    for_each_node(
        "fill_cell_halos", grid, KOKKOS_LAMBDA(Node const& node) {
            Node const source{source_index(grid, 0, node.i), source_index(grid, 1, node.j), source_index(grid, 2, node.k)};
            if (source.i == node.i && source.j == node.j && source.k == node.k) return;
            for (int f = 0; f < fields.count; ++f) at(fields.field[f], node) = at(fields.field[f], source);
        });
}

void fill_velocity_halos(Flow const& flow_now, FlowBoundary const& boundary_now)
{
    Flow const flow = flow_now;
    FlowBoundary const boundary = boundary_now;
    // Axis by axis, each over the whole extent of the others: the edges and corners come out of the last passes.
    for (int axis = 0; axis < 3; ++axis) {
        int const a = first_transverse(axis), b = second_transverse(axis);
        int const na = flow.grid.allocated(a), nb = flow.grid.allocated(b), n = flow.grid.cells[axis];
        constexpr int layers = 2 * Grid::halo + 1; // below, above, and the last face or the cell beyond
        Kokkos::parallel_for(
            "fill_velocity_halos", RangePolicy(0, na * nb * layers), KOKKOS_LAMBDA(int t) {
                int const layer = t / (na * nb);
                Node node;
                node[a] = t % na;
                node[b] = t / na % nb;
                node[axis] = layer < Grid::halo ? layer : n + layer;
                for (int component = 0; component < 3; ++component) {
                    bool const last_face = node[axis] == n + Grid::halo && component == axis && !flow.grid.periodic[axis];
                    if (!last_face)
                        at(flow.velocity[component], node) = halo_velocity(flow, boundary, axis, component, node);
                }
            });
    }
}

void fill_halos(Flow const& flow, FlowBoundary const& boundary)
{
    fill_cell_halos(flow);
    fill_velocity_halos(flow, boundary);
}

} // namespace arenite
