// SPDX-License-Identifier: MIT
// The menu: every contact law that a stage can run. A new law is one file and one line here.
// What differs within a law (break point, friction limit, tangential variant, moduli) is data per pair of
// materials, so a stage that mixes dry and cemented pairs runs the adhesive law with dry rows in its table.
#pragma once

#include "core/contact_list.hpp"
#include "kernels/contact/contact_law.hpp"

#include <algorithm>
#include <variant>
#include <vector>

namespace arenite {

using SmoothSand = ContactLaw<HertzNormal, NoTangential>;
using DrySand = ContactLaw<HertzNormal, CoulombSpring>;
using SmoothCementedSand = ContactLaw<JkrNormal, NoTangential>;
using CementedSand = ContactLaw<JkrNormal, CoulombSpring>;

using AnyContactLaw = std::variant<SmoothSand, DrySand, SmoothCementedSand, CementedSand>;

/// The cheapest law that all pairs of the table can run under. grain_material: of all grains, or -1 where they differ.
inline AnyContactLaw make_contact_law(std::vector<PairConstants> const& pairs, int grain_material = -1)
{
    bool const adhesive = std::any_of(pairs.begin(), pairs.end(), [](auto const& p) { return p.surface_energy > 0; });
    bool const rough = std::any_of(pairs.begin(), pairs.end(), [](auto const& p) { return p.friction > 0; });
    PairTable const table = upload(pairs, grain_material);
    if (adhesive && rough) return CementedSand{table};
    if (adhesive) return SmoothCementedSand{table};
    if (rough) return DrySand{table};
    return SmoothSand{table};
}

inline PairTable const& pair_table(AnyContactLaw const& law)
{
    return std::visit([](auto const& chosen) -> PairTable const& { return chosen.pairs; }, law);
}

/// What the law wants remembered of its contacts. A law that did not keep the contact radius in an earlier stage begins
/// with contacts whose radius is not known: their springs follow it from their second step on. keeps_balance: of energies,
/// whose sheet takes the radius in place of running the normal law a second time.
inline ContactNeeds contact_needs(AnyContactLaw const& law, std::vector<PairConstants> const& pairs,
                                  bool keeps_balance = false)
{
    return std::visit(
        [&](auto const& chosen) {
            using Law = std::decay_t<decltype(chosen)>;
            bool const follows =
                std::any_of(pairs.begin(), pairs.end(), [](auto const& p) { return p.tangential != TangentialLaw::secant; });
            return ContactNeeds{Law::has_history, Law::adheres, Law::has_history && (follows || keeps_balance)};
        },
        law);
}

} // namespace arenite
