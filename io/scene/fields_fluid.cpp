// SPDX-License-Identifier: MIT
#include "io/scene/schema.hpp"

namespace arenite::scene {
namespace {

Fields patch_fields(PatchSettings& p)
{
    auto const disc = [&p] { return p.shape == PatchShape::disc; };
    auto const rectangle = [&p] { return p.shape == PatchShape::rectangle; };
    auto const moves = [&p] { return p.kind == PatchKind::velocity || p.kind == PatchKind::wall; };
    auto const pressure = [&p] { return p.kind == PatchKind::pressure; };
    return {
        required({"face", choice(p.face, {"x_lower", "x_upper", "y_lower", "y_upper", "z_lower", "z_upper"}), "",
                  "face of the fluid's box"}),
        required({"type", choice(p.kind, {"wall", "slip", "velocity", "pressure", "periodic"}), "",
                  "no-slip wall, frictionless wall, given velocity, given pressure, or joined to the opposite face"}),
        {"shape", choice(p.shape, {"face", "disc", "rectangle"}), "", "the whole face or a part of it"},
        required(only_when(disc, "shape = \"disc\"", {"center", &p.center, "m", "of the disc"})),
        required(only_when(disc, "shape = \"disc\"", {"diameter", &p.diameter, "m", "of the disc", positive()})),
        required(only_when(rectangle, "shape = \"rectangle\"", {"lower", &p.rectangle.lower, "m", "lower corner"})),
        required(only_when(rectangle, "shape = \"rectangle\"", {"upper", &p.rectangle.upper, "m", "upper corner"})),
        only_when(moves, "type = \"velocity\" or \"wall\"",
                  {"velocity", &p.velocity, "m/s", "superficial (porosity times fluid velocity); of a wall: its own"}),
        required(only_when(pressure, "type = \"pressure\"", {"pressure", &p.pressure, "Pa", "on the patch"})),
    };
}

Fields fluid_flow_fields(FluidSettings& f)
{
    auto const constant = [&f] { return f.drag == DragLaw::constant; };
    return {
        {"convection", choice(f.convection, {"none", "central", "limited", "upwind"}), "", "scheme of div(n u u)"},
        {"drag",
         choice(f.drag, {"none", "di_felice", "di_felice_literal", "gidaspow", "beetstra", "stokes", "schiller_naumann",
                         "constant"}),
         "", "drag law of the grains; di_felice_literal is the paper's eq 8 as printed"},
        required(only_when(constant, "drag = \"constant\"",
                           {"drag_constant", &f.drag_constant, "N s/m", "drag force over slip velocity", not_negative()})),
        {"void_fraction", choice(f.void_fraction, {"kernel"}), "", "how grains are spread over cells"},
        standing_for("1.5 cells",
                     {"smoothing_length", &f.smoothing_length, "m", "radius over which a grain is spread", not_negative()}),
        {"minimum_porosity", &f.minimum_porosity, "", "cells below are limited, counted and reported", between_open(0, 1)},
        {"pressure_tolerance", &f.pressure_tolerance, "", "relative residual of the pressure solver", between_open(0, 1)},
        {"gravity", &f.gravity, "", "gravity acts on the fluid too"},
        {"body_force", &f.body_force, "Pa/m", "on the fluid, beside gravity"},
        {"initial_velocity", &f.initial_velocity, "m/s", "everywhere at the start"},
        {"initial_pressure", &f.initial_pressure, "Pa", "everywhere at the start"},
        {"porosity", &f.porosity, "", "where there are no grains (a fluid alone)", above_up_to(0, 1)},
        {"patches", list_of(f.patches, patch_fields), "",
         "boundary conditions; later ones lie over earlier ones; what none covers is a no-slip wall"},
    };
}

} // namespace

Fields fluid_fields(FluidSettings& f)
{
    Fields fields{
        required({"cells", &f.cells, "", "along x, y, z", between(1, 100000)}),
        standing_for("the domain", {"box", optional_table_of(f.box, region_fields), "", "of the fluid"}),
        {"fit_wall", &f.fit_wall, "", "plane wall whose position ends the box along its normal when the fluid starts"},
        {"density", &f.density, "kg/m3", "of the fluid", positive()},
        {"viscosity", &f.viscosity, "Pa s", "dynamic viscosity", not_negative()},
        standing_for("coupling_interval",
                     {"time_step", &f.time_step, "s", "a whole number of grain steps; or", not_negative()}),
        standing_for("time_step",
                     {"coupling_interval", &f.coupling_interval, "", "grain steps per fluid step", not_negative()}),
    };
    for (Field& field : fluid_flow_fields(f)) fields.push_back(std::move(field));
    return fields;
}

} // namespace arenite::scene
