// SPDX-License-Identifier: MIT
// How a check makes its rows.
#pragma once

#include "apps/verify/verify.hpp"

#include <cmath>

namespace arenite {

/// What a row says beside its numbers.
struct VerifyLabel {
    std::string name, quantity, source;
};

/// A value against its reference: relative error, or absolute where the reference is 0. NaN fails.
inline VerifyCase compare(VerifyLabel const& label, Real value, Real reference, Real limit)
{
    Real const scale = reference == 0 ? 1 : std::fabs(reference);
    Real const error = std::fabs(value - reference) / scale;
    return {"", label.name, label.quantity, value, reference, error, limit, label.source, error <= limit};
}

/// A measured error, which should be 0.
inline VerifyCase compare_error(VerifyLabel const& label, Real error, Real limit) { return compare(label, error, 0, limit); }

/// A value that may not be below `least`, as an observed order: the error is what is missing.
inline VerifyCase at_least(VerifyLabel const& label, Real value, Real least)
{
    bool const holds = value >= least; // false for NaN
    return {"", label.name, label.quantity, value, least, holds ? 0 : least - value, 0, label.source, holds};
}

/// A value that may not be above `most`, as a count of iterations.
inline VerifyCase at_most(VerifyLabel const& label, Real value, Real most)
{
    bool const holds = value <= most;
    return {"", label.name, label.quantity, value, most, holds ? 0 : value - most, 0, label.source, holds};
}

/// Something that has to be exactly so: 1 is yes.
inline VerifyCase expect_true(VerifyLabel const& label, bool holds) { return compare(label, holds ? 1 : 0, 1, 0); }

} // namespace arenite
