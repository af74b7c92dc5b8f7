// SPDX-License-Identifier: MIT
// A small driver for wall tests: grains, walls and one material, stepped as the stage loop does it.
#pragma once

#include "core/wall_motion.hpp"
#include "kernels/contact/contact_laws.hpp"
#include "kernels/contact_search.hpp"
#include "kernels/evaluate_forces.hpp"
#include "kernels/integrate.hpp"
#include "kernels/wall_contacts.hpp"
#include "kernels/wall_reactions.hpp"

#include <algorithm>

namespace arenite::test {

inline MaterialSettings sand(Real friction = 0.2, Real restitution = 0.8, Real youngs_modulus = 2e7)
{
    MaterialSettings material;
    material.name = "sand";
    material.density = 2605;
    material.youngs_modulus = youngs_modulus;
    material.poissons_ratio = 0.3;
    material.restitution = restitution;
    material.friction = friction;
    return material;
}

inline WallSettings plane(Vec3 const& point, Vec3 const& normal, std::string const& name = "plane")
{
    WallSettings wall;
    wall.name = name;
    wall.material = "sand";
    wall.point = point;
    wall.normal = normal;
    return wall;
}

inline WallSettings box_wall(Vec3 const& lower, Vec3 const& upper, bool inside, std::string const& name = "box")
{
    WallSettings wall;
    wall.name = name;
    wall.material = "sand";
    wall.shape = WallShape::box;
    wall.inside = inside;
    wall.box = {lower, upper};
    return wall;
}

inline Grain grain(Vec3 const& position, Real diameter, Vec3 const& velocity = {})
{
    Grain g;
    g.position = position;
    g.diameter = diameter;
    g.velocity = velocity;
    return g;
}

struct WallScene {
    Particles particles;
    Walls walls;
    AnyContactLaw law;
    PeriodicBox box;
    StepSettings settings;
    Integrator integrator;
    ContactList contacts;
    WallContacts wall_contacts;
    Real skin = 0, time = 0;
    int searches = 0;
    ContactNeeds needs{true, false};
    std::vector<WallReaction> reactions; // at the last servo look

    WallScene(std::vector<Grain> const& grains, std::vector<WallSettings> const& wall_settings,
              MaterialSettings const& material, std::map<std::string, std::vector<Triangle>> const& meshes = {},
              ContactSettings const& contact = {})
    {
        particles = make_particles(grains, {material.density});
        Real smallest = 1, extent = 1;
        for (Grain const& g : grains) smallest = std::min(smallest, g.diameter / 2);
        box.lower = {-extent, -extent, -extent};
        box.upper = {extent, extent, extent};
        walls = make_walls(wall_settings, {{"sand"}, box.lower, box.upper, meshes});
        PairConstants pair = make_pair(material, material, contact);
        pair.bonds_at_start = contact.normal == NormalLaw::modified_jkr;
        law = make_contact_law({pair});
        needs.bonds = pair.surface_energy > 0;
        skin = smallest / 4;
    }

    void search()
    {
        search_contacts(particles, box, {skin, needs, {}}, contacts);
        search_wall_contacts(particles, walls, skin, needs, wall_contacts);
        ++searches;
    }

    void start(Real dt, Vec3 const& gravity, std::vector<WallAction> const& actions = {})
    {
        settings.dt = dt;
        settings.gravity = gravity;
        settings.allowed_move = skin / 4;
        begin_stage(walls, actions);
        search();
        evaluate();
    }

    void evaluate()
    {
        evaluate_contacts(law, particles, box, contacts, settings.dt);
        evaluate_wall_contacts(law, particles, box, walls, wall_contacts, settings.dt);
    }

    void step()
    {
        if (first) kick_half();
        drift(integrator, settings, particles, contacts);
        move_walls(walls, settings.dt);
        bool const stale = take_stale(integrator) >= 0 || wall_displacement(walls, wall_contacts.reference_pose) > skin / 2;
        if (stale) search();
        evaluate();
        kick(integrator, settings, particles, contacts, force_rows(wall_contacts));
        if (servo_is_due(walls)) {
            reactions = measure_walls(particles, walls, wall_contacts);
            update_servos(walls, reactions, settings.dt);
        }
        time += settings.dt;
    }
    void run(int steps)
    {
        for (int n = 0; n < steps; ++n) step();
    }

    Grain grain_of(GrainId id) const
    {
        for (Grain const& g : download(particles))
            if (g.id == id) return g;
        return {};
    }
    Real kinetic_energy(Real density) const
    {
        Real sum = 0;
        for (Grain const& g : download(particles)) {
            Real const mass = density * 3.14159265358979 / 6 * g.diameter * g.diameter * g.diameter;
            sum += mass / 2 * dot(g.velocity, g.velocity) + mass * g.diameter * g.diameter / 20 * dot(g.spin, g.spin);
        }
        return sum;
    }

private:
    bool first = true;
    /// Forces before the first step: kick would also move the velocity, so it is undone by a step of no length.
    void kick_half()
    {
        StepSettings still = settings;
        still.dt = 0;
        kick(integrator, still, particles, contacts, force_rows(wall_contacts));
        first = false;
    }
};

} // namespace arenite::test
