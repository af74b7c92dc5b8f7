// SPDX-License-Identifier: MIT
// Hertz contact of two spheres.
#pragma once

#include "kernels/contact/normal_response.hpp"

namespace arenite {

/// F = 4/3 E* a^3 / R*, a = sqrt(R* overlap), for overlap > 0 (Hertz 1882; physics.md section 1).
template <class N>
KOKKOS_FORCEINLINE_FUNCTION NormalResponse<N> hertz_response(N const& overlap, N const& effective_radius,
                                                             Real effective_youngs_modulus)
{
    N const radius = square_root(effective_radius * overlap);
    return {Real(4) / 3 * effective_youngs_modulus * radius * overlap, radius, 0, MaskOf<N>(true)};
}

struct HertzNormal {
    static constexpr bool adheres = false, radius_is_late = false;

    template <class N>
    KOKKOS_FORCEINLINE_FUNCTION NormalResponse<N> operator()(N const& overlap, ContactScale<N> const& scale,
                                                             PairConstants const& pair, MaskOf<N>&) const
    {
        NormalResponse<N> response =
            hertz_response(larger(overlap, N(0)), scale.effective_radius, pair.effective_youngs_modulus);
        response.touches = overlap > N(0);
        response.impedance = square_root(2 * pair.effective_youngs_modulus * scale.effective_mass * response.contact_radius);
        return response;
    }

    /// Of a contact of known radius, N: 4/3 E* a^3 / R*.
    template <class N>
    KOKKOS_FORCEINLINE_FUNCTION static N force_at_radius(N const& contact_radius, N const& effective_radius,
                                                         PairConstants const& pair, MaskOf<N>)
    {
        N const square = contact_radius * contact_radius;
        return Real(4) / 3 * pair.effective_youngs_modulus * square * contact_radius / effective_radius;
    }
};

} // namespace arenite
