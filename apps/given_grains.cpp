// SPDX-License-Identifier: MIT
#include "apps/given_grains.hpp"

#include "core/error.hpp"
#include "io/checkpoint.hpp"
#include "io/scene_reader.hpp"

#include <fmt/format.h>

namespace arenite {
namespace {

std::vector<Grain> grains_of_checkpoint(Scene const& scene)
{
    std::string const path = path_of(scene, scene.particles.file);
    CheckpointReader const file(path);
    Particles old;
    file.view("particles/position", old.position);
    file.view("particles/velocity", old.velocity);
    file.view("particles/spin", old.spin);
    file.view("particles/id", old.id);
    file.view("particles/material", old.material);
    file.view("particles/size_class", old.size_class);
    old.count = static_cast<int>(old.id.extent(0));
    old.motion = View1<Motion>("motion", old.count);
    std::vector<Grain> grains = download(old);
    std::vector<std::string> names; // of the scene that wrote it, whose order may be another
    for (int row = 0; row < file.value<int>("materials/count"); ++row)
        names.push_back(file.text(fmt::format("materials/{}", row)));
    for (Grain& grain : grains) {
        std::string const& name = names.at(static_cast<std::size_t>(grain.material));
        grain.material = material_row(scene, name);
        if (grain.material < 0)
            throw InputError(fmt::format("{}: grain {} is of material {}, which the scene {} does not have", path, grain.id,
                                         name, scene.path));
    }
    return grains;
}

} // namespace

std::vector<Grain> given_grains(Scene const& scene)
{
    if (scene.particles.source == ParticleSource::checkpoint) return grains_of_checkpoint(scene);
    return grains_of_file(scene).grains;
}

} // namespace arenite
