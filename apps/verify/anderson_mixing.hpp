// SPDX-License-Identifier: MIT
// Anderson mixing (Anderson, J. ACM 12, 1965, 547): the fixed point of a map in fewer evaluations than by repeating it.
#pragma once

#include "core/real.hpp"

#include <deque>
#include <vector>

namespace arenite {

class AndersonMixing {
public:
    /// The next point to evaluate the map at, from the last one and its image. A sum of images with weights of sum 1,
    /// so what is linear in all of them (a divergence, a boundary value) holds in it too.
    std::vector<Real> next_point(std::vector<Real> const& point, std::vector<Real> const& image);

private:
    struct Pair {
        std::vector<Real> image, residual; // residual: image - point
    };
    Pair last_;
    std::deque<Pair> differences_; // between one evaluation and the next, the newest first
};

} // namespace arenite
