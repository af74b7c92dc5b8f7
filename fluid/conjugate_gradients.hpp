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

// Functions of their own: under nvcc a kernel cannot stand in a template over a caller's lambda.
namespace krylov_detail {

/// Places in KrylovVectors::scalars: r z of this iteration, and d A d.
inline int product_of(int iteration) { return iteration % 2; }
constexpr int curvature = 2;

/// d = z + beta d.
inline void update_direction(KrylovVectors const& vectors, int iteration)
{
    KrylovVectors const v = vectors;
    int const now = product_of(iteration), before = product_of(iteration + 1);
    Kokkos::parallel_for(
        "update_direction", RangePolicy(0, v.direction.extent_int(0)), KOKKOS_LAMBDA(int i) {
            Real const kept = iteration == 0 ? 0 : v.scalars(now) / v.scalars(before) * v.direction(i);
            v.direction(i) = v.preconditioned(i) + kept;
        });
}

/// x += alpha d, r -= alpha A d; the square of r's norm.
inline Real update_solution(KrylovVectors const& vectors, SumWorkspace& sums, int iteration)
{
    KrylovVectors const v = vectors;
    int const now = product_of(iteration);
    return reproducible_sums<1>(
        sums, "update_solution", v.solution.extent_int(0), KOKKOS_LAMBDA(int i) {
            Real const alpha = v.scalars(now) / v.scalars(curvature);
            v.solution(i) += alpha * v.direction(i);
            Real const residual = v.residual(i) - alpha * v.image(i);
            v.residual(i) = residual;
            return Terms<1>{residual * residual};
        })[0];
}

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
    Real norm = first;
    for (int& iteration = report.iterations; norm > target && iteration < limits.iterations; ++iteration) {
        precondition(v.residual, v.preconditioned);
        reproducible_dot_to(v.scalars.data() + product_of(iteration), sums, v.residual, v.preconditioned);
        update_direction(v, iteration);
        matrix(v.direction, v.image);
        reproducible_dot_to(v.scalars.data() + curvature, sums, v.direction, v.image);
        norm = std::sqrt(update_solution(v, sums, iteration));
    }
    report.residual = norm / first;
    report.converged = norm <= target; // false for NaN as well
    return report;
}

} // namespace arenite
