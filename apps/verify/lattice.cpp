// SPDX-License-Identifier: MIT
#include "apps/verify/lattice.hpp"

#include "kernels/contact/hertz.hpp"
#include "kernels/contact/jkr.hpp"

namespace arenite {
namespace {

MaterialSettings lattice_sand(Lattice const& lattice)
{
    MaterialSettings material = with(sand(), 1, 1e9); // never slides
    material.surface_energy *= lattice.factor;
    return material;
}

} // namespace

SystemSettings make_lattice(Lattice const& lattice, Real spacing, Real stretch_z)
{
    SystemSettings settings;
    settings.materials = {lattice_sand(lattice)};
    settings.contact = contact_settings(lattice.law, DampingLaw::none, TangentialLaw::secant);
    Real const edge = lattice.edge(spacing);
    std::vector<Vec3> sites{{0, 0, 0}};
    if (lattice.face_centred) sites = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
    int const cells = lattice.cells;
    for (int cell = 0; cell < cells * cells * cells; ++cell)
        for (Vec3 const& site : sites) {
            Vec3 place{Real(cell % cells), Real(cell / cells % cells), Real(cell / (cells * cells))};
            place = edge * (place + site + Vec3{0.25, 0.25, 0.25});
            place.z *= stretch_z;
            settings.grains.push_back(make_grain(static_cast<GrainId>(settings.grains.size()), place, lattice.diameter()));
        }
    settings.box.upper = {cells * edge, cells * edge, cells * edge * stretch_z};
    for (bool& axis : settings.box.periodic) axis = true;
    settings.skin = 0.05 * lattice.diameter();
    settings.start_bonded = lattice.law != NormalLaw::hertz;
    return settings;
}

Real overlap_under(Real force, Lattice const& lattice)
{
    MaterialSettings const material = lattice_sand(lattice);
    PairConstants const pair = make_pair(material, material, contact_settings(lattice.law));
    ContactScale<> const scale = contact_scale(material, lattice.diameter() / 2, lattice.diameter() / 2);
    Real low = 0, high = 0.1 * scale.effective_radius;
    for (int n = 0; n < 100; ++n) {
        Real const middle = (low + high) / 2;
        Real const found = pair.surface_energy > 0 && lattice.law != NormalLaw::hertz
                               ? jkr_response(middle, scale, pair).force
                               : hertz_response(middle, scale.effective_radius, pair.effective_youngs_modulus).force;
        (found < force ? low : high) = middle;
    }
    return (low + high) / 2;
}

} // namespace arenite
