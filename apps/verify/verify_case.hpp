// SPDX-License-Identifier: MIT
// How a check makes its rows.
#pragma once

#include "apps/verify/verify.hpp"

#include <cmath>

namespace arenite
{

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
inline VerifyCase compare_error(VerifyLabel const& label, Real error, Real limit)
{
    return compare(label, error, 0, limit);
}

/// Something that has to be exactly so: 1 is yes.
inline VerifyCase expect_true(VerifyLabel const& label, bool holds) { return compare(label, holds ? 1 : 0, 1, 0); }

} // namespace arenite
