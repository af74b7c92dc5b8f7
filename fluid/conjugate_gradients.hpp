// SPDX-License-Identifier: MIT
// Preconditioned conjugate gradients on device vectors, with sums that do not depend on the number of
// threads. The matrix and the preconditioner, both symmetric and positive (semi-)definite, are functions.
#pragma once

#include "core/reproducible_sum.hpp"

#include <cmath>

namespace arenite {

struct KrylovVectors {
    View1<Real> solution, residual, preconditioned, direction, image;
    View1<Real> scalars; // work space of the solver
};

inline KrylovVectors make_krylov_vectors(int size)
{
    return {View1<Real>("solution", size),  View1<Real>("residual", size), View1<Real>("preconditioned", size),
            View1<Real>("direction", size), View1<Real>("image", size),    View1<Real>("krylov_scalars", 3)};
}

struct KrylovLimits {
    Real relative = 1e-8; // of the first residual's norm
    Real absolute = 0;    // norm below which the residual is rounding
    int iterations = 500;
};

struct KrylovReport {
    int iterations = 0;
    Real residual = 0; // over the first residual's norm
    bool converged = true;
};

namespace krylov_detail {

/// Places in KrylovVectors::scalars: r z of an iteration, and d A d.
KOKKOS_INLINE_FUNCTION int product_of(int iteration) { return iteration % 2; }
inline constexpr int curvature = 2;

/// d = z + beta d.
struct UpdateDirection {
    KrylovVectors v;
    int iteration;

    KOKKOS_FUNCTION void operator()(int i) const
    {
        Real const kept =
            iteration == 0 ? 0 : v.scalars(product_of(iteration)) / v.scalars(product_of(iteration + 1)) * v.direction(i);
        v.direction(i) = v.preconditioned(i) + kept;
    }
};

/// x += alpha d, r -= alpha A d; the square of r.
struct UpdateSolution {
    KrylovVectors v;
    int iteration;

    KOKKOS_FUNCTION Terms<1> operator()(int i) const
    {
        Real const alpha = v.scalars(product_of(iteration)) / v.scalars(curvature);
        v.solution(i) += alpha * v.direction(i);
        Real const residual = v.residual(i) - alpha * v.image(i);
        v.residual(i) = residual;
        return {residual * residual};
    }
};

} // namespace krylov_detail

/// Solves matrix(solution) = right-hand side. On entry solution is 0 and residual the right-hand side. The host waits once
/// an iteration, for the residual's norm: the other two sums stay where the vectors are.
template <class Matrix, class Preconditioner>
KrylovReport solve_by_conjugate_gradients(KrylovVectors const& v, KrylovLimits const& limits, SumWorkspace& sums,
                                          Matrix const& matrix, Preconditioner const& precondition)
{
    using namespace krylov_detail;
    auto const first = std::sqrt(reproducible_dot(sums, v.residual, v.residual));
    Real const target = std::fmax(limits.relative * first, limits.absolute);
    KrylovReport report;
    if (first <= target) return report;
    int const size = v.solution.extent_int(0);
    Real norm = first;
    for (int& iteration = report.iterations; norm > target && iteration < limits.iterations; ++iteration) {
        precondition(v.residual, v.preconditioned);
        reproducible_dot_to(v.scalars.data() + product_of(iteration), sums, v.residual, v.preconditioned);
        Kokkos::parallel_for("update_direction", RangePolicy(0, size), UpdateDirection{v, iteration});
        matrix(v.direction, v.image);
        reproducible_dot_to(v.scalars.data() + curvature, sums, v.direction, v.image);
        norm = std::sqrt(reproducible_sums<1>(sums, "update_solution", size, UpdateSolution{v, iteration})[0]);
    }
    report.residual = norm / first;
    report.converged = norm <= target; // false for NaN as well
    return report;
}

} // namespace arenite
