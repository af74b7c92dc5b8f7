// SPDX-License-Identifier: MIT
// The columns of history.csv that only some scenes have: those of a deforming box, and the balance sheet.
#pragma once

#include "core/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace arenite {

struct Look;
struct RunState;

/// Names for this scene. Of a box that some stage deforms: its edges [m] and the mean stress of the contacts in it [Pa,
/// compression positive]. Of a balance: energies and momenta now, works and losses since the stage began [J, kg m/s, m3].
std::vector<std::string> extra_columns(Scene const& scene);

/// Their values; those of a fluid stay empty in a stage without one.
std::vector<std::optional<Real>> extra_values(Scene const& scene, Look const& look, RunState& state);

} // namespace arenite
