// SPDX-License-Identifier: MIT
#include "apps/make_state.hpp"

#include "apps/given_grains.hpp"
#include "apps/sample.hpp"
#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/build_info.hpp"
#include "io/scene_reader.hpp"
#include "io/stl.hpp"
#include "kernels/packing.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace arenite {
namespace {

std::vector<Real> densities_of(Scene const& scene)
{
    std::vector<Real> densities;
    for (MaterialSettings const& material : scene.materials) densities.push_back(material.density);
    return densities;
}

Walls walls_of(Scene const& scene)
{
    WallContext context;
    for (MaterialSettings const& material : scene.materials) context.materials.push_back(material.name);
    context.lower = scene.domain.lower;
    context.upper = scene.domain.upper;
    for (WallSettings const& wall : scene.walls)
        if (wall.shape == WallShape::mesh) context.meshes[wall.name] = read_stl(path_of(scene, wall.file));
    return make_walls(scene.walls, context);
}

Region fluid_box(Scene const& scene, RunState const& state)
{
    Region box = scene.fluid->box.value_or(Region{scene.domain.lower, scene.domain.upper});
    for (int axis = 0; axis < 3; ++axis)
        if (state.box.periodic[axis]) { // the grains' box may have been strained
            box.lower[axis] = state.box.lower[axis];
            box.upper[axis] = state.box.upper[axis];
        }
    if (scene.fluid->fit_wall.empty()) return box;
    int const wall = state.walls.find(scene.fluid->fit_wall);
    Vec3 const normal = axis_of(state.walls, wall);
    for (int axis = 0; axis < 3; ++axis) {
        if (normal[axis] < Real(-0.5)) box.upper[axis] = state.walls.state[wall].position[axis];
        if (normal[axis] > Real(0.5)) box.lower[axis] = state.walls.state[wall].position[axis];
    }
    return box;
}

/// Whoever takes more memory than there is gets killed without a word.
void require_memory_for(FluidSettings const& settings)
{
    constexpr double least_bytes_a_cell = 400; // some fifty numbers
    double const needed = least_bytes_a_cell * settings.cells[0] * settings.cells[1] * settings.cells[2],
                 there = static_cast<double>(hardware().memory);
    if (on_host && there > 0 && needed > there)
        throw InputError(fmt::format("fluid.cells: {} x {} x {} cells need at least {:.3g} GB, this machine has {:.3g} GB",
                                     settings.cells[0], settings.cells[1], settings.cells[2], 1e-9 * needed, 1e-9 * there));
}

} // namespace

std::uint64_t hash_of_inputs(Scene const& scene)
{
    std::string content;
    if (has_given_grains(scene)) content += read_file(path_of(scene, scene.particles.file));
    for (WallSettings const& wall : scene.walls)
        if (wall.shape == WallShape::mesh) content += read_file(path_of(scene, wall.file));
    return hash_of(content);
}

void set_particles(Scene const& scene, std::vector<Grain> grains, RunState& state)
{
    state.groups = choose_groups(scene, grains);
    state.particles = make_particles(grains, densities_of(scene));
}

RunState make_run_state(Scene const& scene)
{
    RunState state;
    state.inputs = hash_of_inputs(scene);
    state.box.lower = scene.domain.lower;
    state.box.upper = scene.domain.upper;
    for (int axis = 0; axis < 3; ++axis) state.box.periodic[axis] = scene.domain.periodic[axis];
    state.walls = walls_of(scene);
    state.particles = make_particles({}, densities_of(scene));
    if (has_given_grains(scene)) set_particles(scene, given_grains(scene), state);
    return state;
}

void generate_particles(Scene const& scene, RunState& state)
{
    DistributionSettings const& distribution = scene.particles.distribution;
    Region const region = generation_region(scene);
    auto const classes = make_size_classes(distribution, scene.coarse_graining, volume_of(region));
    int const material = material_row(scene, scene.particles.material);
    set_particles(scene,
                  pack_at_random(classes, region, material, scene.random_seed,
                                 [&](Vec3 const& x, Real radius) { return stands_clear(state.walls, x, radius); }),
                  state);
}

void prepare_fluid(Scene const& scene, PlannedStage const& planned, RunState& state, std::optional<KnownFluid> const& known)
{
    if (!planned.settings.fluid || !scene.fluid) {
        state.fluid.reset();
        state.particles.fluid_force = state.particles.coasting = state.particles.pressure_force = RecordView();
        return;
    }
    FluidSettings const& settings = *scene.fluid;
    Vec3 const gravity = planned.settings.gravity.value_or(scene.domain.gravity);
    if (state.fluid) { // it goes on from the stage before
        state.fluid->flow.body_force = body_force(settings, gravity);
        return;
    }
    bool const with_grains = known ? known->with_grains : state.particles.count > 0;
    require_memory_for(settings);
    state.fluid = std::make_unique<FluidState>();
    FluidState& fluid = *state.fluid;
    fluid.box = known ? known->box : fluid_box(scene, state);
    fluid.flow = make_flow(settings, fluid.box, with_grains, gravity);
    fluid.boundary = make_boundary(settings, fluid.flow.grid);
    fluid.solver = make_flow_solver(settings, fluid.flow);
    if (with_grains) fluid.exchange = make_exchange(fluid.flow, state.particles, settings, scene.coarse_graining.factor);
    if (with_grains && scene.output.energies)
        state.particles.pressure_force = RecordView("pressure_force", state.particles.position.extent(0));
}

Real smallest_grain_diameter(Particles const& particles)
{
    if (particles.count == 0) return 1;
    Real smallest = 0;
    RecordView const position = particles.position;
    Kokkos::parallel_reduce(
        "smallest_radius", RangePolicy(0, particles.count),
        KOKKOS_LAMBDA(int i, Real& least) { least = Kokkos::fmin(least, position(i, 3)); }, Kokkos::Min<Real>(smallest));
    return 2 * smallest;
}

} // namespace arenite
