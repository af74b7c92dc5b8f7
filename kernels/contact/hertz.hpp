// SPDX-License-Identifier: MIT
// Hertz contact of two spheres.
#pragma once

#include "kernels/contact/normal_response.hpp"

namespace arenite {

/// F = 4/3 E* a^3 / R*, a = sqrt(R* overlap), for overlap > 0 (Hertz 1882; physics.md section 1).
KOKKOS_FUNCTION inline NormalResponse hertz_response(Real overlap, Real effective_radius, Real effective_youngs_modulus)
{
    Real const radius = Kokkos::sqrt(effective_radius * overlap);
    return {Real(4) / 3 * effective_youngs_modulus * radius * overlap, radius, 0, true};
}

struct HertzNormal {
    static constexpr bool adheres = false;

    KOKKOS_FUNCTION NormalResponse operator()(Real overlap, ContactScale const& scale, PairConstants const& pair,
                                              std::uint8_t&) const
    {
        if (overlap <= 0) return {};
        return hertz_response(overlap, scale.effective_radius, pair.effective_youngs_modulus);
    }
};

} // namespace arenite
