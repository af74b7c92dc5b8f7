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

/// Solves matrix(solution) = right-hand side. On entry solution is 0 and residual the right-hand side. The host waits once
/// an iteration, for the residual's norm: the other two sums stay where the vectors are.
template <class Matrix, class Preconditioner>
KrylovReport solve_by_conjugate_gradients(KrylovVectors const& v, KrylovLimits const& limits, SumWorkspace& sums,
                                          Matrix const& matrix, Preconditioner const& precondition)
{
    auto const first = std::sqrt(reproducible_dot(sums, v.residual, v.residual));
    Real const target = std::fmax(limits.relative * first, limits.absolute);
    KrylovReport report;
    if (first <= target) return report;
    int const size = v.solution.extent_int(0);
    KrylovVectors const of = v;
    Real* const scalar = v.scalars.data(); // r z of the last iteration and of this one, taking turns; d A d
    Real norm = first;
    while (norm > target && report.iterations < limits.iterations) {
        precondition(v.residual, v.preconditioned);
        int const now = report.iterations % 2;
        bool const is_first = report.iterations == 0;
        reproducible_dot_to(scalar + now, sums, v.residual, v.preconditioned);
        Kokkos::parallel_for(
            "update_direction", RangePolicy(0, size), KOKKOS_LAMBDA(int i) {
                Real const kept = is_first ? 0 : scalar[now] / scalar[1 - now] * of.direction(i);
                of.direction(i) = of.preconditioned(i) + kept;
            });
        matrix(v.direction, v.image);
        reproducible_dot_to(scalar + 2, sums, v.direction, v.image);
        auto const square = reproducible_sums<1>(
            sums, "update_solution", size, KOKKOS_LAMBDA(int i) {
                Real const alpha = scalar[now] / scalar[2];
                of.solution(i) += alpha * of.direction(i);
                Real const residual = of.residual(i) - alpha * of.image(i);
                of.residual(i) = residual;
                return Terms<1>{residual * residual};
            });
        norm = std::sqrt(square[0]);
        ++report.iterations;
    }
    report.residual = norm / first;
    report.converged = norm <= target; // false for NaN as well
    return report;
}

} // namespace arenite
