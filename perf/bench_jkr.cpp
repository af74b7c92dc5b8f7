// SPDX-License-Identifier: MIT
// Overlap to force on the JKR curve, two ways: the closed form (Ferrari's root of y^4 - 2 y = D, with its cube roots), and
// what Arenite does, a rational start and one Newton step. Both are exact to rounding; this is their price.
#include "kernels/contact/jkr.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

namespace {

using arenite::Real;

/// Largest real root of y^4 - 2 y - D = 0 by the resolvent cubic z^3 + 4 D z - 4 = 0.
Real closed_form_root(Real overlap)
{
    Real const third = 4 * overlap / 3;
    Real const q = std::sqrt(std::fmax(4 + third * third * third, Real(0)));
    Real const z = std::cbrt(2 + q) - std::cbrt(q - 2);
    Real const u = std::sqrt(z);
    return (u + std::sqrt(std::fmax(-z + 4 / u, Real(0)))) / 2;
}

std::vector<Real> overlaps()
{
    std::vector<Real> values(4096);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] =
            arenite::jkr_points::overlap_S + 8 * static_cast<Real>(i * 2654435761u % 4096) / 4096; // S to well past B
    return values;
}

void run(benchmark::State& state, Real (*root)(Real))
{
    std::vector<Real> const values = overlaps();
    for (auto _ : state) {
        Real sum = 0;
        for (Real value : values) sum += root(value);
        benchmark::DoNotOptimize(sum);
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(values.size()));
}

void closed_form(benchmark::State& state) { run(state, closed_form_root); }
void rational_and_newton(benchmark::State& state)
{
    run(state, [](Real d) { return arenite::jkr_root(d); });
}

BENCHMARK(closed_form);
BENCHMARK(rational_and_newton);

} // namespace

BENCHMARK_MAIN();
