// SPDX-License-Identifier: MIT
#include "io/scene/check.hpp"

#include "core/coarse_graining.hpp"
#include "core/error.hpp"
#include "core/grain.hpp"
#include "io/scene_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <sstream>

namespace arenite::scene {
namespace {

constexpr Real fraction_tolerance = 1e-6; // fractions are typed with a few digits

bool is_inside(Vec3 const& point, Region const& region)
{
    for (int axis = 0; axis < 3; ++axis)
        if (point[axis] < region.lower[axis] || point[axis] > region.upper[axis]) return false;
    return true;
}

void check_classes(DistributionSettings const& d, std::string const& path, Faults& faults)
{
    if (faults.any_faulty({path + ".diameters", path + ".fractions", path + ".lognormal"})) return;
    if (d.diameters.empty()) return faults.add(path, "needs diameters and fractions, or a lognormal table");
    if (d.diameters.size() != d.fractions.size())
        return faults.add(path + ".fractions",
                          fmt::format("must have one value for each of the {} diameters", d.diameters.size()));
    for (std::size_t i = 1; i < d.diameters.size(); ++i)
        if (!(d.diameters[i - 1] < d.diameters[i])) {
            faults.add(path + ".diameters", "must be ascending");
            break;
        }
    Real const sum = std::accumulate(d.fractions.begin(), d.fractions.end(), Real(0));
    if (!(std::abs(sum - 1) <= fraction_tolerance))
        faults.add(path + ".fractions", fmt::format("the sum must be 1, it is {}", sum));
}

/// Amounts that no computer holds are refused before anything is counted or made.
void check_amount(Scene const& scene, std::string const& path, Faults& faults)
{
    DistributionSettings const& d = scene.particles.distribution;
    if (faults.any_faulty({path, path + ".diameters", path + ".fractions", path + ".lognormal", path + ".region",
                           "coarse_graining.factor"}))
        return;
    Real const mean = scene.coarse_graining.factor * mean_volume_diameter(d);
    if (!(mean > 0) || !std::isfinite(mean * mean * mean) || !(mean * mean * mean > 0))
        return faults.add(path, "the grains' mean volume is not a number that can be computed with");
    if (d.count > 0) return;
    Region const region = generation_region(scene);
    Vec3 const size = region.upper - region.lower;
    Real const solid = d.solid_volume > 0 ? d.solid_volume : d.solid_fraction * size.x * size.y * size.z;
    Real const grains = solid / sphere_volume(mean / 2);
    constexpr Real most = std::numeric_limits<int>::max();
    if (!(grains <= most))
        faults.add(path, fmt::format("is {:.3g} grains, more than the {:.0f} that a run can have", grains, most));
}

void check_distribution(Scene const& scene, Faults& faults)
{
    DistributionSettings const& d = scene.particles.distribution;
    std::string const path = "particles.distribution";
    if (!faults.given(path)) return; // its absence is a fault already
    check_classes(d, path, faults);
    int const amounts = (d.count > 0) + (d.solid_volume > 0) + (d.solid_fraction > 0);
    if (amounts != 1 && !faults.any_faulty({path + ".count", path + ".solid_volume", path + ".solid_fraction"}))
        faults.add(path, "needs exactly one of count, solid_volume and solid_fraction");
    check_amount(scene, path, faults);
    if (!d.region) return;
    check_region(*d.region, path + ".region", faults);
    Region const domain{scene.domain.lower, scene.domain.upper};
    if (!is_inside(d.region->lower, domain) || !is_inside(d.region->upper, domain))
        faults.add(path + ".region", "must lie in the domain");
}

/// The materials that occur in the file; its faults become faults of the scene.
std::vector<int> check_csv(Scene const& scene, Faults& faults)
{
    std::set<int> rows;
    try {
        GrainTable const table = grains_of_file(scene);
        Region const domain{scene.domain.lower, scene.domain.upper};
        int outside = 0;
        for (std::size_t i = 0; i < table.grains.size(); ++i) {
            rows.insert(table.grains[i].material);
            if (is_inside(table.grains[i].position, domain) || ++outside > 5) continue;
            faults.add_line(fmt::format("{}:{}: the grain's centre is outside the domain",
                                        path_of(scene, scene.particles.file), table.lines[i]));
        }
        if (outside > 5)
            faults.add_line(
                fmt::format("{}: {} grains are outside the domain", path_of(scene, scene.particles.file), outside));
    } catch (InputError const& error) {
        std::istringstream lines(error.what());
        for (std::string line; std::getline(lines, line);) faults.add_line(line);
    }
    return {rows.begin(), rows.end()};
}

std::vector<int> check_source(Scene const& scene, Faults& faults)
{
    ParticlesSettings const& p = scene.particles;
    int const named = material_row(scene, p.material);
    if (!p.material.empty()) check_name(p.material, names_of(scene.materials), "material", "particles.material", faults);
    bool const reads = p.source == ParticleSource::file || p.source == ParticleSource::checkpoint;
    if (reads && !p.file.empty() && !is_file(path_of(scene, p.file))) {
        faults.add("particles.file", fmt::format("there is no file {}", path_of(scene, p.file)));
    } else if (p.source == ParticleSource::file && !p.file.empty()) {
        return check_csv(scene, faults);
    }
    if (p.source == ParticleSource::distribution) {
        check_distribution(scene, faults);
        if (p.material.empty()) faults.add("particles", "missing key material: the grains of a distribution need one");
    }
    if (p.source == ParticleSource::checkpoint) { // its grains may be of any material
        std::vector<int> all(scene.materials.size());
        std::iota(all.begin(), all.end(), 0);
        return all;
    }
    return named < 0 ? std::vector<int>{} : std::vector<int>{named};
}

void check_group(Scene const& scene, GrainGroupSettings const& g, std::string const& path, Faults& faults)
{
    for (std::string const& stage : g.stages) check_name(stage, names_of(scene.stages), "stage", path + ".stages", faults);
    if (g.ids.empty() && g.classes.empty() && !g.region) faults.add(path, "chooses no grains: needs ids, classes or region");
    if (g.region) check_region(*g.region, path + ".region", faults);
    if (g.held && g.velocity) faults.add(path + ".held", "stands beside velocity: a grain is held or moved");
    if (g.spin && !g.velocity) faults.add(path + ".spin", "needs velocity beside it");
    if (!g.held && !g.velocity && g.force == Vec3{}) faults.add(path, "does nothing: needs force, held or velocity");
}

} // namespace

std::vector<int> check_grains(Scene const& scene, Faults& faults)
{
    std::vector<int> materials = check_source(scene, faults);
    bool const any = scene.particles.source != ParticleSource::none;
    if (any && scene.materials.empty()) faults.add("", "missing table [materials.NAME]: grains need a material");
    if (scene.coarse_graining.scheme == CoarseGraining::ssp && scene.particles.source != ParticleSource::distribution)
        faults.add("coarse_graining.scheme", "ssp needs grains from a distribution");
    for (std::size_t i = 0; i < scene.groups.size(); ++i)
        check_group(scene, scene.groups[i], element("groups", i, scene.groups[i].name), faults);
    if (!any && !scene.groups.empty()) faults.add("groups", "there are no grains: [particles] names no source");
    return materials;
}

} // namespace arenite::scene
