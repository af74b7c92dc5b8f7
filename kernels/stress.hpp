// SPDX-License-Identifier: MIT
// Mean stress of the grains from their contacts (Love's formula, without the kinetic part).
#pragma once

#include "core/contact_list.hpp"
#include "core/particles.hpp"
#include "core/reproducible_sum.hpp"

namespace arenite {

/// Diagonal of sum over contacts of force times branch vector over the box's volume, Pa, compression positive.
Vec3 mean_stress(Particles const& particles, PeriodicBox const& box, ContactList const& contacts, SumWorkspace& workspace);

} // namespace arenite
