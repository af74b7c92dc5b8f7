// SPDX-License-Identifier: MIT
#include "fluid/momentum.hpp"

#include "fluid/convection.hpp"
#include "fluid/momentum_system.hpp"

#include <KokkosBlas1_mult.hpp>

namespace arenite {
namespace {

using UnmanagedField = Kokkos::View<Real***, Kokkos::LayoutLeft, MemorySpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;

/// One component of a vector of the velocity system, seen as a field.
FieldView component_of(View1<Real> const& vector, Grid const& grid, int component)
{
    std::size_t const nodes = std::size_t(grid.allocated(0)) * grid.allocated(1) * grid.allocated(2);
    return UnmanagedField(vector.data() + component * nodes, grid.allocated(0), grid.allocated(1), grid.allocated(2));
}

FaceField face_field_of(View1<Real> const& vector, Grid const& grid)
{
    return {{component_of(vector, grid, 0), component_of(vector, grid, 1), component_of(vector, grid, 2)}};
}

void extrapolate_velocity(Flow const& flow_now, FlowSolver const& solver, Real omega)
{
    Flow const flow = flow_now;
    FaceField const previous = solver.previous_velocity, extrapolated = solver.extrapolated;
    for_each_node(
        "extrapolate_velocity", flow.grid, KOKKOS_LAMBDA(Node const& node) {
            for (int c = 0; c < 3; ++c) {
                Real const now = at(flow.velocity[c], node);
                at(extrapolated.component[c], node) = now + omega * (now - at(previous.component[c], node));
            }
        });
}

void evaluate_convection(Flow const& flow_now, FlowSolver const& solver)
{
    Flow const flow = flow_now;
    FaceField const u = solver.extrapolated, convective = solver.convective;
    ConvectionScheme const scheme = solver.convection;
    for_each_face(
        "evaluate_convection", flow.grid, KOKKOS_LAMBDA(int component, Node const& face) {
            bool const inside = boundary_side(flow.grid, component, face) == 0;
            at(convective.component[component], face) =
                inside ? flow.density * convection_at_face(flow.grid, scheme, flow.porosity, u, component, face) : 0;
        });
}

struct OldLevels { // momentum of the steps before
    FaceField velocity_older;
    FieldView porosity_old, porosity_older;
};

KOKKOS_INLINE_FUNCTION Real history_at_face(MomentumSystem const& s, OldLevels const& levels, int component,
                                            Node const& face)
{
    Real const old = mean_at_face(levels.porosity_old, component, face) * at(s.flow.velocity[component], face);
    Real const older =
        mean_at_face(levels.porosity_older, component, face) * at(levels.velocity_older.component[component], face);
    return s.flow.density * (s.time.old * old - s.time.older * older);
}

struct RowFields { // what a row reads beside the system
    FaceField extrapolated, convective, history;
};

KOKKOS_INLINE_FUNCTION Real right_hand_side(MomentumSystem const& s, RowFields const& fields, int component,
                                            Node const& face)
{
    Flow const& flow = s.flow;
    Real const n = mean_at_face(flow.porosity, component, face);
    Real const open = open_share(flow.grid, s.boundary, component, face);
    Real force = flow.body_force[component] - pressure_gradient_at_face(s, component, face);
    force += drag_velocity_at_face(flow, component, face) / n;
    force += (at(fields.history.component[component], face) - at(fields.convective.component[component], face)) / (n * open);
    if (boundary_side(flow.grid, component, face) == 0)
        force += flow.viscosity / 3 * mixed_derivative_at_face(flow.grid, fields.extrapolated, component, face);
    else // the drag acts on what moves through the open share, not on the prescribed flux beside it
        force += drag_at_face(flow, component, face) * prescribed_flux(s, component, face) / (n * n * open);
    return row_weight(s, component, face) * force;
}

/// Residual of the rows at the present velocity, the inverse diagonal and the history.
void build_velocity_system(MomentumSystem const& system, FlowSolver const& solver)
{
    MomentumSystem const s = system;
    Grid const grid = s.flow.grid;
    FaceField const residual = face_field_of(solver.velocity_system.residual, grid);
    FaceField const diagonal = face_field_of(solver.velocity_diagonal, grid);
    OldLevels const levels{solver.previous_velocity, s.flow.porosity_previous, solver.porosity_oldest};
    RowFields const fields{solver.extrapolated, solver.convective, solver.history};
    for_each_face(
        "build_velocity_system", grid, KOKKOS_LAMBDA(int component, Node const& face) {
            if (!(face_weight(grid, s.boundary, component, face) > 0)) return; // prescribed: the entries stay 0
            at(fields.history.component[component], face) = history_at_face(s, levels, component, face);
            FieldView const& u = s.flow.velocity[component];
            Real const own = momentum_diagonal(s, component, face);
            Real const n = mean_at_face(s.flow.porosity, component, face);
            Real const scaled = row_weight(s, component, face) * inertia_and_drag(s, component, face) /
                                (n * open_share(grid, s.boundary, component, face));
            at(diagonal.component[component], face) = 1 / own;
            at(residual.component[component], face) = right_hand_side(s, fields, component, face) - scaled * at(u, face) +
                                                      diffusion_at_face(s, u, component, face, 1);
        });
}

void apply_velocity_system(MomentumSystem const& system, View1<Real> const& vector, View1<Real> const& image)
{
    MomentumSystem const s = system;
    Grid const grid = s.flow.grid;
    FaceField const u = face_field_of(vector, grid), result = face_field_of(image, grid);
    for_each_face(
        "apply_velocity_system", grid, KOKKOS_LAMBDA(int component, Node const& face) {
            if (!(face_weight(grid, s.boundary, component, face) > 0)) return;
            Real const n = mean_at_face(s.flow.porosity, component, face);
            Real const scaled = row_weight(s, component, face) * inertia_and_drag(s, component, face) /
                                (n * open_share(grid, s.boundary, component, face));
            at(result.component[component], face) =
                scaled * at(u.component[component], face) - diffusion_at_face(s, u.component[component], component, face, 0);
        });
}

void keep_velocity(Flow const& flow, FlowSolver const& solver)
{
    for (int c = 0; c < 3; ++c) Kokkos::deep_copy(ExecutionSpace(), solver.previous_velocity.component[c], flow.velocity[c]);
}

void add_velocity(Flow const& flow_now, View1<Real> const& vector)
{
    Flow const flow = flow_now;
    FaceField const change = face_field_of(vector, flow.grid);
    for_each_face(
        "add_velocity", flow.grid, KOKKOS_LAMBDA(int component, Node const& face) {
            at(flow.velocity[component], face) += at(change.component[component], face);
        });
}

} // namespace

void set_boundary_velocity(Flow const& flow_now, FlowBoundary const& boundary)
{
    MomentumSystem const s{flow_now, boundary, {}};
    for_each_face(
        "set_boundary_velocity", flow_now.grid, KOKKOS_LAMBDA(int component, Node const& face) {
            if (face_weight(s.flow.grid, s.boundary, component, face) > 0) return;
            at(s.flow.velocity[component], face) =
                prescribed_flux(s, component, face) / mean_at_face(s.flow.porosity, component, face);
        });
}

bool predict_velocity(Flow& flow, FlowBoundary const& boundary, FlowSolver& solver, TimeDerivative const& time)
{
    Phase const phase("momentum");
    MomentumSystem const system{flow, boundary, time};
    extrapolate_velocity(flow, solver, time.extrapolation);
    if (solver.convection != ConvectionScheme::none) evaluate_convection(flow, solver);
    set_boundary_velocity(flow, boundary);
    build_velocity_system(system, solver);
    keep_velocity(flow, solver);

    KrylovVectors const& v = solver.velocity_system;
    Kokkos::deep_copy(ExecutionSpace(), v.solution, Real(0));
    auto const matrix = [&](View1<Real> const& x, View1<Real> const& y) { apply_velocity_system(system, x, y); };
    auto const jacobi = [&](View1<Real> const& r, View1<Real> const& z) {
        KokkosBlas::mult(Real(0), z, Real(1), solver.velocity_diagonal, r);
    };
    KrylovReport const report = solve_by_conjugate_gradients(v, solver.velocity_limits, solver.sums, matrix, jacobi);
    add_velocity(flow, v.solution);
    return report.converged;
}

void evaluate_face_force(Flow const& flow_now, FlowBoundary const& boundary, FlowSolver const& solver,
                         TimeDerivative const& time)
{
    MomentumSystem const s{flow_now, boundary, time};
    Grid const grid = flow_now.grid;
    FaceField const history = solver.history, convective = solver.convective, force = solver.face_force;
    for_each_face(
        "evaluate_face_force", grid, KOKKOS_LAMBDA(int component, Node const& face) {
            Flow const& flow = s.flow;
            Real const n = mean_at_face(flow.porosity, component, face), u = at(flow.velocity[component], face);
            Real sum = drag_at_face(flow, component, face) * u - drag_velocity_at_face(flow, component, face);
            if (face_weight(grid, s.boundary, component, face) > 0) // elsewhere n u is prescribed and constant
                sum += s.time.now * flow.density * n * u - at(history.component[component], face) +
                       at(convective.component[component], face);
            at(force.component[component], face) = sum / n - flow.body_force[component];
        });
}

} // namespace arenite
