// SPDX-License-Identifier: MIT
// What a pair of materials is made of in a stage: constants derived once on the host, so that kernels
// never combine moduli. Sources: physics.md section 1 (paper eqs 4, 5, 12, 13, 32, 33, 35, 37).
#pragma once

#include "core/scene.hpp"
#include "core/types.hpp"

#include <limits>
#include <vector>

namespace arenite {

/// Constants of a contact between two materials; multiply with the pair's R*, m* where a law needs them.
struct PairConstants {
    Real effective_youngs_modulus = 0; // E*, Pa: 1/E* = (1-nu_i^2)/E_i + (1-nu_j^2)/E_j
    Real effective_shear_modulus = 0;  // G*, Pa: 1/G* = (2-nu_i)/G_i + (2-nu_j)/G_j, G = E/(2(1+nu))
    Real damping_factor = 0;           // 2 sqrt(5/6) beta, -: F_d = damping_factor sqrt(S m*) v
    Real tangential_damping_ratio = 0; // sqrt(S_t / S_n) = 2 sqrt(G*/E*), -: tangential over normal dashpot
    Real friction = 0;                 // mu, -
    // JKR, 0 where the pair does not adhere. gamma of paper eq 12: the work of adhesion is 2 gamma.
    Real surface_energy = 0;        // gamma, J/m2
    Real length_factor = 0;         // L / R*^(1/3) = (pi gamma / E*)^(2/3), m^(2/3)
    Real radius_factor = 0;         // (pi gamma / E*)^(1/3), m^(1/3): a = radius_factor R*^(2/3) s
    Real inverse_length_factor = 0; // 1 / length_factor, m^(-2/3)
    // overlap / L below which the contact snaps: 0 at A, delta_C/L, delta_S/L; no bond of a pair that does not adhere holds
    Real break_overlap = std::numeric_limits<Real>::infinity();
    bool forms_on_touch = false;  // full JKR: every touch makes a bond; modified JKR: never again
    bool bonds_at_start = false;  // modified JKR: what touches when the stage begins is bonded
    bool clip_attraction = false; // damping may not make a Hertz contact attract
    FrictionLimit friction_limit = FrictionLimit::thornton;
    TangentialLaw tangential = TangentialLaw::secant;
};

/// [material][material], row-major.
struct PairTable {
    Kokkos::View<PairConstants*, MemorySpace> pairs;
    int materials = 0;
    int shared = -1; // index of the pair that all contacts between grains are of; -1: there are several

    KOKKOS_FUNCTION int index(int i, int j) const { return i * materials + j; }
    KOKKOS_FUNCTION PairConstants const& operator()(int index) const { return pairs(index); }
    KOKKOS_FUNCTION PairConstants const& operator()(int i, int j) const { return pairs(index(i, j)); }
};

/// The materials as a stage sees them: overrides applied, surface energy times k (physics.md section 2).
std::vector<MaterialSettings> stage_materials(Scene const& scene, StageSettings const& stage);

/// Constants of every pair under the stage's laws; contact is the stage's contact or wall_contact.
std::vector<PairConstants> make_pair_constants(Scene const& scene, StageSettings const& stage,
                                               ContactSettings const& contact);

/// Constants of one pair. Throws nothing; a rigid material contributes no compliance.
PairConstants make_pair(MaterialSettings const& a, MaterialSettings const& b, ContactSettings const& contact);

/// grain_material: of all grains, or -1 where they differ.
PairTable upload(std::vector<PairConstants> const& pairs, int grain_material = -1);

/// beta of paper eq 33 with the square that its print lost: -ln e / sqrt(ln^2 e + pi^2).
Real damping_ratio(Real restitution);

/// pi R sqrt(rho/G) / (0.163 nu + 0.8766), s (paper eqs 37, 38 with G = E/(2(1+nu))).
Real rayleigh_time(MaterialSettings const& material, Real radius);

} // namespace arenite
