// SPDX-License-Identifier: MIT
// The study in memory: plain structs that say what a scene file says, in SI units, with the defaults.
// io/scene_reader fills and validates them; the driver turns them into particles, walls, contact laws
// and a flow. Nothing here parses, allocates on a device or computes.
#pragma once

#include "core/vec3.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace arenite {

// ---------------------------------------------------------------- materials and contact laws

struct MaterialSettings {
    std::string name;
    Real density = 0;        // kg/m3
    Real youngs_modulus = 0; // Pa
    Real poissons_ratio = 0; // in (-1, 0.5)
    Real restitution = 1;    // in (0, 1]
    Real friction = 0;       // >= 0
    Real surface_energy = 0; // J/m2 at k = 1, gamma of paper eq 12 (the work of adhesion is 2 gamma)
    bool rigid = false;      // a wall that does not deform: 1/E = 0
    bool operator==(MaterialSettings const&) const = default;
};

enum class NormalLaw { hertz, jkr, modified_jkr };
enum class BreakPoint { A, C, S };            // overlap 0, delta_C, delta_S of the JKR curve
enum class FrictionLimit { paper, thornton }; // mu |F_n|, or mu (F_n + 2 F_C) while adhering and mu F_n after
enum class TangentialLaw { none, secant, rescaled, incremental, dissipative };
enum class DampingLaw {
    none,
    restitution,
    restitution_clipped
}; // clipped: no attraction from damping (force >= 0 for Hertz)

/// What happens between two materials in a stage.
struct ContactSettings {
    NormalLaw normal = NormalLaw::hertz;
    BreakPoint break_point = BreakPoint::C; // jkr: S unless named; modified_jkr: C unless named
    FrictionLimit friction_limit = FrictionLimit::thornton;
    TangentialLaw tangential = TangentialLaw::secant;
    DampingLaw damping = DampingLaw::restitution;
    bool operator==(ContactSettings const&) const = default;
};

/// Values of a material pair that do not follow from its two materials.
struct InteractionSettings {
    std::array<std::string, 2> materials;
    std::optional<Real> restitution, friction, surface_energy;
    std::optional<ContactSettings> contact; // instead of the stage's law

    bool is_between(std::string const& a, std::string const& b) const
    {
        return (materials[0] == a && materials[1] == b) || (materials[0] == b && materials[1] == a);
    }
    bool operator==(InteractionSettings const&) const = default;
};

// ---------------------------------------------------------------- grains

enum class CoarseGraining { none, ssw, ssp };

struct CoarseGrainingSettings {
    CoarseGraining scheme = CoarseGraining::none;
    Real factor = 1; // k = grain diameter / original diameter
    bool operator==(CoarseGrainingSettings const&) const = default;
};

struct Region {        // axis-parallel box
    Vec3 lower, upper; // m
    bool operator==(Region const&) const = default;
};

enum class ParticleSource { none, distribution, file, checkpoint };

/// Diameters whose logarithms are normally distributed, cut at both ends.
struct LognormalSettings {
    Real median = 0;               // m
    Real sigma = 0;                // standard deviation of ln(diameter)
    Real minimum = 0, maximum = 0; // m
    int classes = 10;              // of equal width in ln(diameter)
    bool operator==(LognormalSettings const&) const = default;
};

struct DistributionSettings {
    bool by_mass = true;                        // fractions by mass, else by number
    std::vector<Real> diameters;                // m, of the original grains (k = 1), ascending
    std::vector<Real> fractions;                // sum 1
    std::optional<LognormalSettings> lognormal; // only while reading: the reader makes the classes and drops it
    // How many: exactly one of the three is positive.
    int count = 0;                // grains (after coarse graining)
    Real solid_volume = 0;        // m3 of grains
    Real solid_fraction = 0;      // of the region's volume
    std::optional<Region> region; // where the grains are put; the domain unless named
    bool operator==(DistributionSettings const&) const = default;
};

struct ParticlesSettings {
    ParticleSource source = ParticleSource::none;
    std::string material; // name
    DistributionSettings distribution;
    std::string file;  // CSV of grains, or a checkpoint
    bool held = false; // every grain is frozen in place
    bool operator==(ParticlesSettings const&) const = default;
};

/// Something done to chosen grains, for the whole run or in the named stages.
struct GrainGroupSettings {
    std::string name;
    std::vector<long long> ids;      // chosen by id,
    std::vector<int> classes;        // or by size class,
    std::optional<Region> region;    // or by where they are at the start (the three are or-ed)
    Vec3 force;                      // N on each grain
    bool held = false;               // neither moves nor turns
    std::optional<Vec3> velocity;    // m/s: moves so whatever the forces
    std::optional<Vec3> spin;        // rad/s, with velocity
    std::vector<std::string> stages; // only in these; empty: in all
    bool operator==(GrainGroupSettings const&) const = default;
};

// ---------------------------------------------------------------- walls

enum class WallShape { plane, cylinder, box, mesh };

struct HoleSettings {
    std::string name;
    Vec3 center;       // m, projected on the plane
    Real diameter = 0; // m
    bool operator==(HoleSettings const&) const = default;
};

struct WallSettings {
    std::string name;
    WallShape shape = WallShape::plane;
    std::string material;
    // plane: through point; grains are on the side that normal points to
    Vec3 point, normal{0, 0, 1};
    std::vector<HoleSettings> holes; // of a plane; closed until a stage opens them
    // cylinder: from base along axis (its length is the height), grains outside a rod or inside a tube
    Vec3 base, axis;
    Real diameter = 0;
    bool inside = false; // cylinder and box: grains are inside
    // box
    Region box;
    // mesh: STL file, grains on the side that the facets' normals point to
    std::string file;
    Real scale = 1;
    Vec3 offset;
    bool present = true; // at the start of the run; stages add and remove
    bool operator==(WallSettings const&) const = default;
};

/// Drives a wall along its axis so that the force on it meets a target (compression positive).
struct ServoSettings {
    Real stress = 0;    // Pa: force is stress * area; or
    Real force = 0;     // N
    Real area = 0;      // m2; 0: of the domain's cross-section normal to the axis
    Vec3 axis;          // unit; direction in which the wall moves to press
    Real max_speed = 0; // m/s
    bool operator==(ServoSettings const&) const = default;
};

/// What a stage does with a wall; a wall that a stage does not name stays as it is, at rest.
struct WallAction {
    std::string wall;
    std::optional<bool> present;          // add or remove
    std::optional<Vec3> velocity;         // m/s
    std::optional<Vec3> angular_velocity; // rad/s about the wall's point, base, box centre or offset
    std::optional<ServoSettings> servo;
    std::vector<std::string> open, close; // holes by name
    std::optional<Real> travel;           // m: goes this far along velocity ...
    bool and_back = false;                // ... and returns at the same speed
    std::optional<Real> ramp_time;        // s over which velocity is reached and left
    bool operator==(WallAction const&) const = default;
};

// ---------------------------------------------------------------- fluid

enum class DragLaw { none, di_felice, di_felice_literal, gidaspow, beetstra, stokes, schiller_naumann, constant };
enum class ConvectionScheme { none, central, limited, upwind };
enum class VoidFractionMethod { kernel }; // conservative kernel deposit of a length of its own
enum class Face { x_lower, x_upper, y_lower, y_upper, z_lower, z_upper };
enum class PatchKind { wall, slip, velocity, pressure, periodic };
enum class PatchShape { face, disc, rectangle };

/// A boundary condition on a face or on a patch of it. Later patches lie over earlier ones; what no
/// patch covers is a no-slip wall.
struct PatchSettings {
    Face face = Face::x_lower;
    PatchKind kind = PatchKind::wall;
    PatchShape shape = PatchShape::face;
    Vec3 center;       // disc, m (the component along the face's normal is not used)
    Real diameter = 0; // disc, m
    Region rectangle;  // m
    Vec3 velocity;     // velocity and moving walls, m/s, superficial (n u) for kind velocity
    Real pressure = 0; // Pa
    bool operator==(PatchSettings const&) const = default;
};

struct FluidSettings {
    std::array<int, 3> cells{1, 1, 1};
    std::optional<Region> box; // the domain unless named
    std::string fit_wall;      // name of a plane wall whose position ends the box along its normal; "" none
    Real density = 998.2;      // kg/m3
    Real viscosity = 1e-3;     // Pa s
    Real time_step = 0;        // s, a whole number of grain steps; or
    int coupling_interval = 0; // grain steps per fluid step
    ConvectionScheme convection = ConvectionScheme::limited;
    DragLaw drag = DragLaw::di_felice;
    Real drag_constant = 0; // N s/m, for DragLaw::constant: f = constant * slip velocity
    VoidFractionMethod void_fraction = VoidFractionMethod::kernel;
    Real smoothing_length = 0;      // m, support radius of the deposit kernel; 0: 1.5 cells
    Real pressure_tolerance = 1e-8; // relative residual of the pressure solve
    Real minimum_porosity = 0.2;    // below: counted, reported, limited
    bool gravity = true;
    Vec3 body_force;           // Pa/m beside gravity
    Vec3 initial_velocity;     // m/s
    Real initial_pressure = 0; // Pa
    std::vector<PatchSettings> patches;
    Real porosity = 1; // of the fluid alone, where no grains are
    bool operator==(FluidSettings const&) const = default;
};

// ---------------------------------------------------------------- stages

/// The stage ends when all of the named conditions hold at once.
struct EndSettings {
    std::optional<Real> kinetic_energy_ratio; // kinetic energy / elastic contact energy below
    std::optional<Real> kinetic_energy;       // J, below
    std::string stress_wall;                  // name; "" none
    Real stress = 0, stress_tolerance = 0.01; // Pa on that wall, relative tolerance
    Real stress_area = 0;                     // m2; 0: the domain's cross-section
    std::optional<Real> porosity;             // at or below
    std::string position_wall;                // name; "" none
    int position_axis = 2;
    Real position = 0;                        // m, reached from where the wall started the stage
    bool wall_travel_done = false;            // every wall with a travel has made it
    std::optional<Real> box_stress_tolerance; // every axis of the box that holds a stress has it, relative
    bool any() const
    {
        return kinetic_energy_ratio || kinetic_energy || !stress_wall.empty() || porosity || !position_wall.empty() ||
               wall_travel_done || box_stress_tolerance;
    }
    bool operator==(EndSettings const&) const = default;
};

/// How the driver makes the grains or brings them to a state by a path faster than the real one.
enum class StageKind {
    dynamics,    // Newton's equations with the stage's laws: what everything else is shown against
    generation,  // put the grains into the region at random, without overlap
    compression, // fast path to a stress on a servo wall: densify, press, relax (docs/physics.md)
};

/// A deforming periodic box: per axis a strain rate or a target stress.
struct BoxSettings {
    std::array<std::optional<Real>, 3> strain_rate; // 1/s, positive stretches
    std::array<std::optional<Real>, 3> stress;      // Pa, compression positive
    Real max_strain_rate = 0;                       // 1/s, for the axes under stress
    bool holds_stress() const { return stress[0] || stress[1] || stress[2]; }
    bool operator==(BoxSettings const&) const = default;
};

struct StageSettings {
    std::string name;
    StageKind kind = StageKind::dynamics;
    Real duration = 0; // s; with end conditions: the most it may take
    EndSettings end;
    Real time_step = 0;          // s; or
    Real time_step_fraction = 0; // of the critical step
    ContactSettings contact;
    ContactSettings wall_contact;                      // grain-wall pairs: Hertz unless named
    std::map<std::string, MaterialSettings> materials; // overrides for this stage, complete, by name
    std::vector<InteractionSettings> interactions;     // instead of the scene's entries of the same pairs, complete
    std::optional<Vec3> gravity;                       // instead of the domain's
    std::vector<WallAction> walls;
    std::string outlet_wall; // grains that are through an open hole of this wall leave; "" none
    bool fluid = false;
    Real local_damping = 0; // 0..1: fraction of the unbalanced force that opposes motion (quasi-static only)
    std::optional<BoxSettings> box;
    std::optional<Real> history_interval, field_interval, checkpoint_interval; // s, instead of the output's
    std::optional<bool> form_bonds; // modified_jkr: touching contacts become bonds at the start; unless named:
                                    // if the stage before ran under another law
    std::string carrier;            // name of a plane wall: grains ride on the homogeneous strain that its motion
                                    // along its normal means for the domain (fast, even compression); "" none
    Real target_porosity = 0;       // with a servo: friction falls from the stage's value until the porosity
                                    // under the servo's stress is this; 0: it stays
    bool operator==(StageSettings const&) const = default;
};

// ---------------------------------------------------------------- output

struct ProbeSettings {
    std::string name;
    std::optional<long long> grain; // id; or
    std::optional<Vec3> point;      // m, the cell that holds it
    bool operator==(ProbeSettings const&) const = default;
};

struct StreamlineSettings {
    std::vector<Vec3> points;   // seeds, m
    std::optional<Region> line; // from lower to upper
    int count = 0;              // seeds on the line, or on the disc
    std::optional<Vec3> disc_center, disc_normal;
    Real disc_radius = 0;
    Real max_length = 0; // m; 0: four box diagonals
    bool operator==(StreamlineSettings const&) const = default;
};

struct OutputSettings {
    Real history_interval = 0;    // s; 0: 100 rows a stage
    Real field_interval = 0;      // s; 0: first and last state of every stage
    Real checkpoint_interval = 0; // s; 0: at the end of every stage
    bool energies = false;        // the balance sheet
    // What the files of grains and of the fluid hold beside positions.
    std::vector<std::string> grain_fields{"id",    "diameter", "class",       "material",     "velocity", "spin",
                                          "force", "torque",   "fluid_force", "coordination", "bonds"};
    std::vector<std::string> fluid_fields{"velocity", "speed", "pressure", "porosity"};
    std::vector<ProbeSettings> probes;
    StreamlineSettings streamlines;
    bool operator==(OutputSettings const&) const = default;
};

// ---------------------------------------------------------------- the whole

struct DomainSettings {
    Vec3 lower, upper; // m
    std::array<bool, 3> periodic{false, false, false};
    Vec3 gravity; // m/s2
    bool operator==(DomainSettings const&) const = default;
};

struct Scene {
    std::string path; // of the file, for messages and for relative files
    std::string title;
    unsigned long long random_seed = 1;
    DomainSettings domain;
    std::vector<MaterialSettings> materials;
    std::vector<InteractionSettings> interactions;
    CoarseGrainingSettings coarse_graining;
    ParticlesSettings particles;
    std::vector<GrainGroupSettings> groups;
    std::vector<WallSettings> walls;
    std::optional<FluidSettings> fluid;
    std::vector<StageSettings> stages;
    OutputSettings output;
    std::string resolved;        // the scene with every default filled in, as TOML
    unsigned long long hash = 0; // of resolved
    bool operator==(Scene const&) const = default;
};

} // namespace arenite
