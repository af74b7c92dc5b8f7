// SPDX-License-Identifier: MIT
// Drag laws of a particle among others, as functions of numbers (core/lanes.hpp). Each law gives the linearised coefficient
// beta [N s/m] of ONE original particle: drag = beta (u - v), u the fluid's interstitial velocity and v the
// particle's. It is the drag of model A, without the pressure gradient and stress on the particle, which
// exchange.hpp adds: in a bed at rest the drag is the share n of the whole seepage force.
//
// Laws of C_d(Re) are written as the finite product C_d |u - v|, so that a particle at rest in the fluid has
// its Stokes limit and no floor is needed anywhere.
#pragma once

#include "core/error.hpp"
#include "core/lanes.hpp"
#include "core/scene.hpp"

#include <numbers>
#include <type_traits>
#include <variant>

namespace arenite {

/// What a law may look at, in numbers N: Real, or a grain a lane.
template <class N> struct DragPoint {
    N diameter = 0;   // m, of the original particle
    N porosity = 1;   // n, in (0, 1]
    N slip_speed = 0; // |u - v|, m/s, interstitial
};

/// A fluid without drag.
struct NoDrag {
    template <class N> KOKKOS_FUNCTION N operator()(DragPoint<N> const&) const { return 0; }
};

/// beta given by the scene, for tests and for linear response.
struct ConstantDrag {
    Real coefficient = 0; // N s/m
    template <class N> KOKKOS_FUNCTION N operator()(DragPoint<N> const&) const { return coefficient; }
};

/// Creeping flow round a lone sphere (Stokes 1851). The porosity is not used.
struct StokesDrag {
    Real density = 0, viscosity = 0; // kg/m3, Pa s
    template <class N> KOKKOS_FUNCTION N operator()(DragPoint<N> const& at) const
    {
        return 3 * std::numbers::pi_v<Real> * viscosity * at.diameter;
    }
};

/// A lone sphere, C_d = 24/Re (1 + 0.15 Re^0.687) up to Re = 1000 and 0.44 from there (Schiller & Naumann
/// 1935), Re = rho |u - v| d / mu. The porosity is not used.
struct SchillerNaumannDrag {
    Real density = 0, viscosity = 0; // kg/m3, Pa s
    template <class N> KOKKOS_FUNCTION N operator()(DragPoint<N> const& at) const
    {
        constexpr Real pi = std::numbers::pi_v<Real>;
        N const reynolds = density * at.slip_speed * at.diameter / viscosity;
        N const constant = Real(0.44) * pi / 8 * density * at.diameter * at.diameter * at.slip_speed;
        N const viscous = 3 * pi * viscosity * at.diameter * (1 + Real(0.15) * power(reynolds, N(0.687)));
        return select(reynolds >= N(1000), constant, viscous);
    }
};

/// chi = 3.7 - 0.65 exp(-(1.5 - log10 Re)^2 / 2), Di Felice 1994 (paper eq 10); 3.7 at Re = 0, where the
/// logarithm is -inf and the exponential 0.
template <class N> KOKKOS_FUNCTION N porosity_exponent(N const& reynolds)
{
    N const distance = Real(1.5) - std::numbers::log10e_v<Real> * logarithm(reynolds);
    return Real(3.7) - Real(0.65) * exponential(-distance * distance / 2);
}

/// C_d U = (0.63 sqrt(U) + 4.8 sqrt(mu/(rho d)))^2 [m/s] with C_d = (0.63 + 4.8/sqrt(Re))^2, Dallavalle 1948.
template <class N> KOKKOS_FUNCTION N dallavalle_speed(N const& speed, N const& viscous_speed)
{
    N const root = Real(0.63) * square_root(speed) + Real(4.8) * square_root(viscous_speed);
    return root * root;
}

/// Di Felice 1994: f = C_d rho pi/8 d^2 U^2 n^-chi. His velocity and Reynolds number are superficial,
/// U = n |u - v|, Re = rho U d / mu (Zhou et al. 2010): so beta has the factor n^(2 - chi) on |u - v|.
struct DiFeliceDrag {
    Real density = 0, viscosity = 0; // kg/m3, Pa s
    template <class N> KOKKOS_FUNCTION N operator()(DragPoint<N> const& at) const
    {
        N const superficial = at.porosity * at.slip_speed;
        N const viscous_speed = viscosity / (density * at.diameter);
        N const chi = porosity_exponent(superficial / viscous_speed);
        return std::numbers::pi_v<Real> / 8 * density * at.diameter * at.diameter * at.porosity *
               dallavalle_speed(superficial, viscous_speed) * power(at.porosity, -chi);
    }
};

/// Paper eqs 8-11 read as printed: n^-chi on the interstitial |u - v|, Re = rho |u - v| d / mu. In its bed it
/// resists 2.4 times as much as Di Felice's law; kept to compare with.
struct LiteralDiFeliceDrag {
    Real density = 0, viscosity = 0; // kg/m3, Pa s
    template <class N> KOKKOS_FUNCTION N operator()(DragPoint<N> const& at) const
    {
        N const viscous_speed = viscosity / (density * at.diameter);
        N const chi = porosity_exponent(at.slip_speed / viscous_speed);
        return std::numbers::pi_v<Real> / 8 * density * at.diameter * at.diameter *
               dallavalle_speed(at.slip_speed, viscous_speed) * power(at.porosity, -chi);
    }
};

/// Gidaspow 1994: Ergun 1952 below n = 0.8, Wen & Yu 1966 from there, both on Re = rho n |u - v| d / mu.
/// His exchange coefficient per volume is that of n grad p (model A) on the interstitial u - v; a particle
/// has the share V_p/(1 - n) of it. The jump at n = 0.8 is the original's.
struct GidaspowDrag {
    Real density = 0, viscosity = 0; // kg/m3, Pa s
    template <class N> KOKKOS_FUNCTION N operator()(DragPoint<N> const& at) const
    {
        constexpr Real pi = std::numbers::pi_v<Real>;
        N const d = at.diameter, n = at.porosity;
        N const ergun = pi / 6 * d * (150 * (1 - n) / n * viscosity + Real(1.75) * density * at.slip_speed * d);
        MaskOf<N> const dense = n < N(0.8);
        if (all(dense)) return ergun;
        N const lone = SchillerNaumannDrag{density, viscosity}(DragPoint<N>{d, n, n * at.slip_speed});
        return select(dense, ergun, lone * power(n, N(-2.65)));
    }
};

/// Beetstra, van der Hoef & Kuipers 2007, lattice-Boltzmann fit: drag = 3 pi mu d U F(n, Re), superficial
/// U = n |u - v| and Re = rho U d / mu. Their drag leaves the pressure gradient out, as model A does. The
/// inertial term is multiplied out by Re^((1 + 4 phi)/2) so that it is 0 at Re = 0.
struct BeetstraDrag {
    Real density = 0, viscosity = 0; // kg/m3, Pa s
    template <class N> KOKKOS_FUNCTION N operator()(DragPoint<N> const& at) const
    {
        N const n = at.porosity, solid = 1 - n;
        N const reynolds = density * n * at.slip_speed * at.diameter / viscosity;
        N const creeping = 10 * solid / (n * n) + n * n * (1 + Real(1.5) * square_root(solid));
        N const factor = power(reynolds, (1 + 4 * solid) / 2);
        N const slope = (1 / n + 3 * n * solid) * reynolds + Real(8.4) * power(reynolds, N(0.657));
        N const inertial = Real(0.413) / (24 * n * n) * slope * factor / (factor + power(N(10), 3 * solid));
        return 3 * std::numbers::pi_v<Real> * viscosity * at.diameter * n * (creeping + inertial);
    }
};

/// A grain of diameter d_g stands for k^3 particles of d_g/k and feels their drag (physics.md section 2): with
/// the grain's own diameter in the law a pack would be k^2 times too permeable.
template <class Law, class N>
KOKKOS_FUNCTION N grain_drag_coefficient(Law const& law, DragPoint<N> grain, Real coarse_grain_factor)
{
    grain.diameter /= coarse_grain_factor;
    return coarse_grain_factor * coarse_grain_factor * coarse_grain_factor * law(grain);
}

/// The menu. The choice is made once, outside the kernels: std::visit.
using AnyDragLaw = std::variant<NoDrag, ConstantDrag, StokesDrag, SchillerNaumannDrag, DiFeliceDrag, LiteralDiFeliceDrag,
                                GidaspowDrag, BeetstraDrag>;
static_assert(std::is_trivially_copyable_v<AnyDragLaw>);

inline AnyDragLaw make_drag_law(FluidSettings const& fluid)
{
    Real const rho = fluid.density, mu = fluid.viscosity;
    switch (fluid.drag) {
    case DragLaw::none:
        return NoDrag{};
    case DragLaw::constant:
        return ConstantDrag{fluid.drag_constant};
    case DragLaw::stokes:
        return StokesDrag{rho, mu};
    case DragLaw::schiller_naumann:
        return SchillerNaumannDrag{rho, mu};
    case DragLaw::di_felice:
        return DiFeliceDrag{rho, mu};
    case DragLaw::di_felice_literal:
        return LiteralDiFeliceDrag{rho, mu};
    case DragLaw::gidaspow:
        return GidaspowDrag{rho, mu};
    case DragLaw::beetstra:
        return BeetstraDrag{rho, mu};
    }
    throw InputError("fluid.drag is not one of the drag laws");
}

} // namespace arenite
