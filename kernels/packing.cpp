// SPDX-License-Identifier: MIT
#include "kernels/packing.hpp"

#include "core/error.hpp"
#include "core/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace arenite {
namespace {

/// Cells as wide as the largest grain: a grain overlaps only what its 27 cells hold.
class Occupancy {
public:
    Occupancy(Region const& region, Real cell) : lower_(region.lower)
    {
        Vec3 const size = region.upper - region.lower;
        for (int axis = 0; axis < 3; ++axis) cells_[axis] = std::max(1, static_cast<int>(size[axis] / cell));
        for (int axis = 0; axis < 3; ++axis) width_[axis] = size[axis] / cells_[axis];
        grains_.resize(static_cast<std::size_t>(cells_[0]) * cells_[1] * cells_[2]);
    }

    bool is_free(Vec3 const& x, Real radius) const
    {
        int low[3], high[3];
        for (int axis = 0; axis < 3; ++axis) {
            int const c = cell_along(axis, x[axis]);
            low[axis] = std::max(0, c - 1);
            high[axis] = std::min(cells_[axis] - 1, c + 1);
        }
        for (int k = low[2]; k <= high[2]; ++k)
            for (int j = low[1]; j <= high[1]; ++j)
                for (int i = low[0]; i <= high[0]; ++i)
                    for (auto const& [center, other] : grains_[index(i, j, k)]) {
                        Vec3 const d = x - center;
                        if (dot(d, d) < (radius + other) * (radius + other)) return false;
                    }
        return true;
    }

    void add(Vec3 const& x, Real radius)
    {
        grains_[index(cell_along(0, x.x), cell_along(1, x.y), cell_along(2, x.z))].push_back({x, radius});
    }

private:
    int cell_along(int axis, Real x) const
    {
        return std::clamp(static_cast<int>((x - lower_[axis]) / width_[axis]), 0, cells_[axis] - 1);
    }
    std::size_t index(int i, int j, int k) const { return (static_cast<std::size_t>(k) * cells_[1] + j) * cells_[0] + i; }

    Vec3 lower_;
    int cells_[3];
    Real width_[3];
    std::vector<std::vector<std::pair<Vec3, Real>>> grains_;
};

Vec3 random_point(Region const& region, Real radius, unsigned long long seed, std::uint64_t grain, std::uint64_t attempt)
{
    Vec3 x;
    for (int axis = 0; axis < 3; ++axis) {
        Real const room = region.upper[axis] - region.lower[axis] - 2 * radius;
        x[axis] = region.lower[axis] + radius + room * random_uniform(seed, grain, 3 * attempt + axis);
    }
    return x;
}

[[noreturn]] void fail_too_full(std::vector<SizeClass> const& classes, Region const& region, std::size_t placed)
{
    Vec3 const size = region.upper - region.lower;
    Real solid = 0;
    long long total = 0;
    for (SizeClass const& c : classes) {
        solid += static_cast<Real>(c.count) * sphere_volume(c.diameter / 2);
        total += c.count;
    }
    throw InputError(fmt::format("particles.distribution: {} grains are a solid fraction of {:.3f} of their region; random "
                                 "placement without overlap, in front of the walls, stopped after {} of them (it reaches "
                                 "about 0.36): make the region larger or the grains fewer",
                                 total, solid / (size.x * size.y * size.z), placed));
}

} // namespace

std::vector<Grain> pack_at_random(std::vector<SizeClass> const& classes, Region const& region, int material,
                                  unsigned long long seed, std::function<bool(Vec3 const&, Real)> const& may_stand)
{
    for (SizeClass const& c : classes)
        for (int axis = 0; c.count > 0 && axis < 3; ++axis)
            if (c.diameter > region.upper[axis] - region.lower[axis])
                throw InputError(
                    fmt::format("particles.distribution: a grain of {:g} m has no room in a region of {:g} m along "
                                "{}",
                                c.diameter, region.upper[axis] - region.lower[axis], "xyz"[axis]));
    std::vector<Grain> grains;
    for (std::size_t c = 0; c < classes.size(); ++c)
        for (long long n = 0; n < classes[c].count; ++n) {
            Grain grain;
            grain.diameter = classes[c].diameter;
            grain.size_class = static_cast<int>(c);
            grain.material = material;
            grains.push_back(grain);
        }
    if (grains.empty()) return grains;
    std::stable_sort(grains.begin(), grains.end(), [](Grain const& a, Grain const& b) { return a.diameter > b.diameter; });

    constexpr std::uint64_t most_attempts = 100000;
    Occupancy occupancy(region, grains.front().diameter);
    for (std::size_t n = 0; n < grains.size(); ++n) {
        Real const radius = grains[n].diameter / 2;
        std::uint64_t attempt = 0;
        for (; attempt < most_attempts; ++attempt) {
            grains[n].position = random_point(region, radius, seed, n, attempt);
            if (may_stand(grains[n].position, radius) && occupancy.is_free(grains[n].position, radius)) break;
        }
        if (attempt == most_attempts) fail_too_full(classes, region, n);
        occupancy.add(grains[n].position, radius);
        grains[n].id = static_cast<GrainId>(n);
    }
    return grains;
}

} // namespace arenite
