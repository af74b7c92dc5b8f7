// SPDX-License-Identifier: MIT
#include "core/material.hpp"

#include "core/error.hpp"
#include "core/jkr_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arenite {
namespace {

constexpr Real pi = std::numbers::pi_v<Real>;

Real shear_modulus(MaterialSettings const& m) { return m.youngs_modulus / (2 * (1 + m.poissons_ratio)); }

Real normal_compliance(MaterialSettings const& m)
{
    return m.rigid ? 0 : (1 - m.poissons_ratio * m.poissons_ratio) / m.youngs_modulus;
}
Real shear_compliance(MaterialSettings const& m) { return m.rigid ? 0 : (2 - m.poissons_ratio) / shear_modulus(m); }

Real break_overlap_of(BreakPoint point)
{
    switch (point) {
    case BreakPoint::A:
        return 0;
    case BreakPoint::C:
        return jkr_points::overlap_C;
    case BreakPoint::S:
        return jkr_points::overlap_S;
    }
    return 0;
}

} // namespace

Real damping_ratio(Real restitution)
{
    if (restitution >= 1) return 0;
    Real const log_e = std::log(restitution);
    return -log_e / std::sqrt(log_e * log_e + pi * pi);
}

Real rayleigh_time(MaterialSettings const& material, Real radius)
{
    // The paper prints G = E/(2(1-nu)) after eq 37; its "4.4 % of Rayleigh" follows only from 1+nu.
    return pi * radius * std::sqrt(material.density / shear_modulus(material)) /
           (Real(0.163) * material.poissons_ratio + Real(0.8766));
}

PairConstants make_pair(MaterialSettings const& a, MaterialSettings const& b, ContactSettings const& contact)
{
    PairConstants pair;
    Real const normal = normal_compliance(a) + normal_compliance(b);
    Real const shear = shear_compliance(a) + shear_compliance(b);
    pair.effective_youngs_modulus = normal > 0 ? 1 / normal : 0;
    pair.effective_shear_modulus = shear > 0 ? 1 / shear : 0;
    if (normal > 0 && shear > 0)
        pair.tangential_damping_ratio = 2 * std::sqrt(pair.effective_shear_modulus / pair.effective_youngs_modulus);
    // Both restitutions agree or an interaction names the pair: the reader has made sure of it.
    if (contact.damping != DampingLaw::none) pair.damping_factor = 2 * std::sqrt(Real(5) / 6) * damping_ratio(a.restitution);
    pair.clip_attraction = contact.damping == DampingLaw::restitution_clipped;
    pair.tangential = contact.tangential;
    pair.friction = contact.tangential == TangentialLaw::none ? 0 : a.friction;
    pair.friction_limit = contact.friction_limit;
    if (contact.normal == NormalLaw::hertz || !(a.surface_energy > 0)) return pair;
    pair.surface_energy = a.surface_energy;
    pair.radius_factor = std::cbrt(pi * a.surface_energy / pair.effective_youngs_modulus);
    pair.length_factor = pair.radius_factor * pair.radius_factor;
    pair.inverse_length_factor = 1 / pair.length_factor;
    pair.break_overlap = break_overlap_of(contact.break_point);
    pair.forms_on_touch = contact.normal == NormalLaw::jkr;
    return pair;
}

std::vector<MaterialSettings> stage_materials(Scene const& scene, StageSettings const& stage)
{
    std::vector<MaterialSettings> materials = scene.materials;
    for (MaterialSettings& material : materials) {
        auto const override_ = stage.materials.find(material.name);
        if (override_ != stage.materials.end()) material = override_->second;
        // gamma_g = k gamma keeps cohesive stresses equal between scales (paper eq 29).
        material.surface_energy *= scene.coarse_graining.factor;
    }
    return materials;
}

std::vector<PairConstants> make_pair_constants(Scene const& scene, StageSettings const& stage,
                                               ContactSettings const& contact)
{
    std::vector<MaterialSettings> const materials = stage_materials(scene, stage);
    std::size_t const n = materials.size();
    std::vector<PairConstants> pairs(n * n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            MaterialSettings a = materials[i], b = materials[j];
            if (a.surface_energy != b.surface_energy) a.surface_energy = b.surface_energy = 0;
            ContactSettings law = contact;
            auto const is_meant = [&](InteractionSettings const& named) { return named.is_between(a.name, b.name); };
            auto const apply = [&](InteractionSettings const& named) {
                if (!is_meant(named)) return;
                if (named.restitution) a.restitution = b.restitution = *named.restitution;
                if (named.friction) a.friction = b.friction = *named.friction;
                if (named.surface_energy)
                    a.surface_energy = b.surface_energy = *named.surface_energy * scene.coarse_graining.factor;
                if (named.contact) law = *named.contact;
            };
            // A stage's entry is complete: the scene's for the same pair does not show through.
            bool const replaced = std::any_of(stage.interactions.begin(), stage.interactions.end(), is_meant);
            for (InteractionSettings const& named : replaced ? stage.interactions : scene.interactions) apply(named);
            pairs[i * n + j] = make_pair(a, b, law);
        }
    return pairs;
}

PairTable upload(std::vector<PairConstants> const& pairs, int grain_material)
{
    int const n = static_cast<int>(std::lround(std::sqrt(static_cast<double>(pairs.size()))));
    ARENITE_REQUIRE(static_cast<std::size_t>(n) * n == pairs.size(), "the pair table is not square");
    PairTable table;
    table.materials = n;
    if (n == 1) grain_material = 0;
    if (grain_material >= 0) table.shared = table.index(grain_material, grain_material);
    table.pairs = Kokkos::View<PairConstants*, MemorySpace>("pair_constants", pairs.size());
    Kokkos::View<PairConstants const*, HostSpace, Kokkos::MemoryUnmanaged> const host(pairs.data(), pairs.size());
    Kokkos::deep_copy(table.pairs, host);
    return table;
}

} // namespace arenite
