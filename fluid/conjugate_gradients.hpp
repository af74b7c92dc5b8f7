// SPDX-License-Identifier: MIT
// Preconditioned conjugate gradients on device vectors, with sums that do not depend on the number of
// threads. The matrix and the preconditioner, both symmetric and positive (semi-)definite, are functions.
#pragma once

#include "core/reproducible_sum.hpp"

#include <KokkosBlas1_axpby.hpp>

#include <cmath>

namespace arenite {

struct KrylovVectors {
    View1<Real> solution, residual, preconditioned, direction, image;
};

inline KrylovVectors make_krylov_vectors(int size)
{
    return {View1<Real>("solution", size), View1<Real>("residual", size), View1<Real>("preconditioned", size),
            View1<Real>("direction", size), View1<Real>("image", size)};
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

/// Solves matrix(solution) = right-hand side. On entry solution is 0 and residual the right-hand side.
template <class Matrix, class Preconditioner>
KrylovReport solve_by_conjugate_gradients(KrylovVectors const& v, KrylovLimits const& limits, SumWorkspace& sums,
                                          Matrix const& matrix, Preconditioner const& precondition)
{
    auto const first = std::sqrt(reproducible_dot(sums, v.residual, v.residual));
    Real const target = std::fmax(limits.relative * first, limits.absolute);
    KrylovReport report;
    if (first <= target) return report;
    Real norm = first, product = 0;
    while (norm > target && report.iterations < limits.iterations) {
        precondition(v.residual, v.preconditioned);
        Real const old_product = product;
        product = reproducible_dot(sums, v.residual, v.preconditioned);
        Real const beta = report.iterations == 0 ? 0 : product / old_product;
        KokkosBlas::axpby(Real(1), v.preconditioned, beta, v.direction);
        matrix(v.direction, v.image);
        Real const alpha = product / reproducible_dot(sums, v.direction, v.image);
        KokkosBlas::axpy(alpha, v.direction, v.solution);
        KokkosBlas::axpy(-alpha, v.image, v.residual);
        norm = std::sqrt(reproducible_dot(sums, v.residual, v.residual));
        ++report.iterations;
    }
    report.residual = norm / first;
    report.converged = norm <= target; // false for NaN as well
    return report;
}

} // namespace arenite
