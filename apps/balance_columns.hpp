// SPDX-License-Identifier: MIT
// The balance sheet as columns of history.csv.
#pragma once

#include "core/types.hpp"

#include <optional>
#include <string>
#include <vector>

namespace arenite {

struct Look;
struct RunState;

/// Energies and momenta now, works and losses since the stage began: J, kg m/s, m3.
std::vector<std::string> balance_columns(bool fluid);

/// Their values; those of a fluid stay empty where the stage has none.
std::vector<std::optional<Real>> balance_row(Look const& look, bool fluid_columns, RunState& state);

} // namespace arenite
