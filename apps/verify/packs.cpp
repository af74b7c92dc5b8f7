// SPDX-License-Identifier: MIT
#include "apps/verify/packs.hpp"

#include "core/random.hpp"

#include <algorithm>
#include <map>

namespace arenite {

std::vector<Grain> random_pack(PackSettings const& settings)
{
    int const along = static_cast<int>(std::ceil(std::cbrt(static_cast<Real>(settings.count))));
    std::vector<Grain> grains(settings.count);
    for (int i = 0; i < settings.count; ++i) {
        auto const draw = [&](int n) { return random_uniform(settings.seed, i, n); };
        Grain& grain = grains[i];
        grain.id = i;
        grain.diameter = settings.largest * std::pow(settings.size_ratio, -draw(0));
        int const site[3] = {i % along, i / along % along, i / (along * along)};
        for (int axis = 0; axis < 3; ++axis) {
            Real const anywhere = draw(1 + axis) * (settings.box + 2 * settings.overhang) - settings.overhang;
            Real const cell = settings.box / along, jittered = (site[axis] + Real(0.4) + Real(0.2) * draw(1 + axis)) * cell;
            grain.position[axis] = settings.lattice ? jittered : anywhere;
            grain.velocity[axis] = settings.speed * (2 * draw(4 + axis) - 1);
            grain.spin[axis] = settings.spin * (2 * draw(7 + axis) - 1);
        }
    }
    return grains;
}

SystemSettings rough_pack(NormalLaw law, int count, Real box, Real largest, bool periodic)
{
    PackSettings pack;
    pack.count = count;
    pack.box = box;
    pack.largest = largest;
    pack.size_ratio = 2.4;
    pack.speed = 3;
    pack.spin = 3000;
    pack.lattice = true;
    SystemSettings settings;
    settings.grains = random_pack(pack);
    settings.materials = {with(sand(), 0.8, 0.3)};
    settings.contact = contact_settings(law, DampingLaw::restitution, TangentialLaw::secant);
    settings.box.upper = {box, box, box};
    for (bool& axis : settings.box.periodic) axis = periodic;
    settings.skin = 2e-5;
    settings.dt = 2e-8;
    return settings;
}

std::vector<Grain> shuffled(std::vector<Grain> grains, std::uint64_t seed)
{
    for (std::size_t i = grains.size(); i > 1; --i) std::swap(grains[i - 1], grains[random_bits(seed, i, 0) % i]);
    return grains;
}

Vec3 nearest_offset(Vec3 offset, PeriodicBox const& box)
{
    Vec3 const size = box.size();
    for (int axis = 0; axis < 3; ++axis)
        if (box.periodic[axis]) offset[axis] -= size[axis] * std::round(offset[axis] / size[axis]);
    return offset;
}

int wrong_pairs(GrainSystem const& system)
{
    std::vector<Grain> const grains = grains_by_id(system);
    PeriodicBox const& box = system.settings.box;
    std::map<std::pair<GrainId, GrainId>, int> listed;
    int wrong = 0;
    std::map<GrainId, std::size_t> row;
    for (std::size_t i = 0; i < grains.size(); ++i) row[grains[i].id] = i;
    for (ListedPair const& pair : listed_pairs(system)) {
        wrong += listed[std::minmax(pair.first, pair.second)]++ > 0;
        // The image that the list names is the nearest one.
        Vec3 const offset = grains[row[pair.first]].position - grains[row[pair.second]].position;
        wrong += norm(offset - box.image_shift(pair.image) - nearest_offset(offset, box)) > Real(1e-9) * norm(box.size());
    }
    for (std::size_t i = 0; i < grains.size(); ++i)
        for (std::size_t j = i + 1; j < grains.size(); ++j) {
            Real const distance = norm(nearest_offset(grains[i].position - grains[j].position, box));
            bool const near = distance < (grains[i].diameter + grains[j].diameter) / 2 + system.settings.skin;
            wrong += near != (listed.count({grains[i].id, grains[j].id}) > 0);
        }
    return wrong;
}

} // namespace arenite
