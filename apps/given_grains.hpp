// SPDX-License-Identifier: MIT
// Grains that a scene names one by one: those of a CSV file or of an earlier run's checkpoint.
#pragma once

#include "core/particles.hpp"
#include "core/scene.hpp"

#include <vector>

namespace arenite {

inline bool has_given_grains(Scene const& scene)
{
    return scene.particles.source == ParticleSource::file || scene.particles.source == ParticleSource::checkpoint;
}

/// Of a checkpoint only where the grains are and how they move: contacts begin anew. Throws InputError if the
/// file is missing, damaged or of another kind, or holds materials that the scene does not have.
std::vector<Grain> given_grains(Scene const& scene);

} // namespace arenite
