// SPDX-License-Identifier: MIT
// Grains under one contact law, driven by the kernels in the order of a run's step: drift, search if the
// list is stale, contacts, kick. No walls, no fluid, no output.
#pragma once

#include "apps/verify/materials.hpp"
#include "kernels/contact/contact_laws.hpp"
#include "kernels/contact_search.hpp"
#include "kernels/integrate.hpp"

#include <array>
#include <vector>

namespace arenite {

struct SystemSettings {
    std::vector<Grain> grains;
    std::vector<MaterialSettings> materials;
    ContactSettings contact;
    PeriodicBox box;
    Real skin = 0;             // m
    Real dt = 0;               // s
    Vec3 gravity;              // m/s2
    bool start_bonded = false; // contacts that exist at the start are bonds
    bool fused = false;        // kick and drift of neighbouring steps as one kernel
    int rebuild_interval = 0;  // steps; 0: only when the list is stale
    int tile_grains = 0;       // SearchSettings'
};

inline Grain make_grain(GrainId id, Vec3 const& position, Real diameter, Vec3 const& velocity = {}, Vec3 const& spin = {})
{
    Grain grain;
    grain.id = id;
    grain.position = position;
    grain.diameter = diameter;
    grain.velocity = velocity;
    grain.spin = spin;
    return grain;
}

struct GrainSystem {
    SystemSettings settings;
    std::vector<PairConstants> pairs;
    AnyContactLaw law = SmoothSand{};
    Particles particles;
    ContactList contacts;
    Integrator integrator;
    long long steps = 0, rebuilds = 0;
};

GrainSystem make_system(SystemSettings const& settings);

/// Time steps; positions, velocities and forces are of one time afterwards.
void advance(GrainSystem& system, int steps);

/// Rebuilds the list of contacts as it would be when it is stale; contacts keep their forces.
void rebuild(GrainSystem& system);

/// Puts a grain somewhere in some motion; the list stays as it is.
void place(GrainSystem& system, GrainId id, Vec3 const& position, Vec3 const& velocity, Vec3 const& spin);

/// Contact forces and the springs' next state at the present positions, as if a step of dt had led here.
void evaluate(GrainSystem& system);
void evaluate(GrainSystem& system, ContactPass const& pass); // of its contacts alone

std::vector<Grain> grains_by_id(GrainSystem const& system);
Vec3 force_on(GrainSystem const& system, GrainId id);

struct Totals {
    Vec3 momentum, angular_momentum;
    Real momentum_scale = 0, angular_scale = 0; // sums of sizes, to make errors relative
    Real kinetic_energy = 0;
};
Totals totals(GrainSystem const& system);

/// Elastic energy [J] of Hertz contacts: 8/15 E* sqrt(R*) overlap^(5/2) each; one material.
Real hertz_energy(GrainSystem const& system);

/// Hash of every bit of the grains' and contacts' state, by id: rows and lists may differ.
std::uint64_t state_hash(GrainSystem const& system);

/// A pair as the list names it, on the host.
struct ListedPair {
    GrainId first, second;
    int image;
    Real spring[3];
    int touching, adhering;
    std::array<Real, 8> force = {}; // as ContactList::force
};
std::vector<ListedPair> listed_pairs(GrainSystem const& system); // by (first, second)

} // namespace arenite
