// SPDX-License-Identifier: MIT
#include "apps/verify/beds.hpp"

#include "core/coarse_graining.hpp"
#include "core/random.hpp"

namespace arenite {
namespace {

/// One diameter for each site, m.
std::vector<Real> site_diameters(BedSettings const& settings, int sites)
{
    if (!settings.paper_sizes) return std::vector<Real>(sites, settings.factor * settings.diameter);
    DistributionSettings sand = paper_sand();
    sand.count = sites;
    CoarseGrainingSettings coarse;
    coarse.factor = settings.factor;
    std::vector<Real> diameters;
    for (SizeClass const& size : make_size_classes(sand, coarse, 0))
        diameters.insert(diameters.end(), size.count, size.diameter);
    for (std::size_t i = diameters.size(); i > 1; --i) std::swap(diameters[i - 1], diameters[random_bits(11, i, 0) % i]);
    return diameters;
}

/// Soft, strongly damped spheres in a periodic box push each other apart, blown up by 8 %: so pressed, they
/// even out what the sites with large and with small grains differ by. Lengths and times scale with the factor.
void relax(std::vector<Grain>& grains, Vec3 const& box, Real factor)
{
    SystemSettings system;
    system.grains = grains;
    for (Grain& grain : system.grains) {
        grain.motion = Motion::free;
        grain.diameter *= Real(1.08);
    }
    system.materials = {with(make_material(2605, 1e6, 0.3), 0.1, 0)};
    system.contact = contact_settings(NormalLaw::hertz, DampingLaw::restitution);
    system.box.upper = box;
    for (bool& axis : system.box.periodic) axis = true;
    system.skin = factor * 3e-5;
    system.dt = factor * 2e-6;
    GrainSystem pack = make_system(system);
    advance(pack, 1500);
    std::vector<Grain> const moved = grains_by_id(pack);
    for (std::size_t g = 0; g < grains.size(); ++g)
        for (int axis = 0; axis < 3; ++axis)
            grains[g].position[axis] = moved[g].position[axis] - box[axis] * std::floor(moved[g].position[axis] / box[axis]);
}

void add_floor(std::vector<Grain>& grains, Real width_x, Real width_y, Real diameter)
{
    int const nx = static_cast<int>(std::ceil(width_x / diameter)), ny = static_cast<int>(std::ceil(width_y / diameter));
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            Vec3 const place{(i + 0.5) * width_x / nx, (j + 0.5) * width_y / ny, -0.5 * diameter};
            grains.push_back(make_grain(static_cast<GrainId>(grains.size()), place, diameter));
            grains.back().motion = Motion::held;
        }
}

FluidSettings column_fluid(BedSettings const& settings, Vec3 const& size)
{
    FluidSettings fluid;
    fluid.cells = {settings.cells[0], settings.cells[1], settings.cells[2] + settings.freeboard};
    fluid.box = Region{{0, 0, 0}, size};
    fluid.drag = settings.drag;
    fluid.density = settings.density;
    fluid.viscosity = settings.viscosity;
    fluid.gravity = settings.gravity;
    fluid.smoothing_length = settings.smoothing_length;
    add_periodic_axis(fluid, 0);
    add_periodic_axis(fluid, 1);
    if (settings.push > 0) {
        add_periodic_axis(fluid, 2);
        fluid.body_force = {0, 0, settings.push};
    }
    if (settings.closed || settings.push > 0) return fluid;
    fluid.patches.push_back(face_patch(Face::z_lower, PatchKind::velocity, {0, 0, settings.superficial}));
    fluid.patches.push_back(face_patch(Face::z_upper, PatchKind::pressure, {}, 101325));
    fluid.initial_pressure = 101325;
    return fluid;
}

} // namespace

Bed make_bed(BedSettings const& settings)
{
    Bed bed;
    bed.settings = settings;
    int along[3];
    for (int axis = 0; axis < 3; ++axis)
        along[axis] = static_cast<int>(std::lround(settings.cells[axis] * settings.grains_per_edge / settings.factor));
    bed.grains = along[0] * along[1] * along[2];
    std::vector<Real> const diameters = site_diameters(settings, bed.grains);
    for (Real const d : diameters) bed.solid_volume += sphere_volume_of(d);
    bed.pitch = std::cbrt(bed.solid_volume / bed.grains / (1 - settings.porosity));
    std::vector<Grain> grains;
    for (int g = 0; g < bed.grains; ++g) {
        Vec3 const site{g % along[0] + Real(0.5), g / along[0] % along[1] + Real(0.5),
                        g / (along[0] * along[1]) + Real(0.5)};
        grains.push_back(make_grain(g, bed.pitch * site, diameters[g]));
        if (settings.held) grains.back().motion = Motion::held;
    }
    Vec3 const width{along[0] * bed.pitch, along[1] * bed.pitch, along[2] * bed.pitch};
    bed.area = width.x * width.y;
    bed.height = width.z;
    if (settings.relaxed) relax(grains, width, settings.factor);
    if (!settings.held) add_floor(grains, width.x, width.y, settings.factor * settings.diameter);

    CoupledSettings coupled;
    Vec3 size = width;
    size.z *= 1 + Real(settings.freeboard) / settings.cells[2];
    coupled.fluid = column_fluid(settings, size);
    coupled.coarse_grain_factor = settings.factor;
    coupled.grains.grains = grains;
    // Soft, so that a contact lasts several grain steps; nothing here depends on the stiffness.
    coupled.grains.materials = {with(make_material(settings.grain_density, 1e5, 0.3), 0.8, 0.2)};
    coupled.grains.contact = contact_settings(NormalLaw::hertz, DampingLaw::restitution, TangentialLaw::secant);
    coupled.grains.box.lower = {0, 0, -1e-3};
    coupled.grains.box.upper = size;
    coupled.grains.box.periodic[0] = coupled.grains.box.periodic[1] = true;
    if (settings.push > 0) {
        coupled.grains.box.lower.z = 0;
        coupled.grains.box.periodic[2] = true;
    }
    coupled.grains.skin = settings.held ? 1e-6 : 0.2 * settings.factor * settings.diameter;
    coupled.grains.dt = settings.grain_step;
    bed.run = make_coupled_case(coupled);
    return bed;
}

Real pressure_gradient(Bed const& bed)
{
    HostField const p = host_copy(bed.run.fluid.flow.pressure);
    int const cells = bed.settings.cells[2];
    return (value_of(p, 0, 0, 2) - value_of(p, 0, 0, cells - 3)) / ((cells - 5) * bed.run.fluid.flow.grid.spacing.z);
}

Real superficial_velocity(Bed const& bed)
{
    Grid const& grid = bed.run.fluid.flow.grid;
    HostField const n = host_copy(bed.run.fluid.flow.porosity), w = host_copy(bed.run.fluid.flow.velocity[2]);
    Real sum = 0;
    for (int j = 0; j < grid.cells[1]; ++j)
        for (int i = 0; i < grid.cells[0]; ++i)
            sum += (value_of(n, i, j, 0) + value_of(n, i, j, 1)) / 2 * value_of(w, i, j, 1);
    return sum / (grid.cells[0] * grid.cells[1]);
}

Real carried_weight(Bed const& bed)
{
    return total_fluid_force(bed.run.grains.particles).z / (bed.settings.grain_density * bed.solid_volume * 9.81);
}

} // namespace arenite
