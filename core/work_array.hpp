// SPDX-License-Identifier: MIT
// Work arrays that grow with the number of grains and are kept when it falls: to a GPU an allocation is as dear as a kernel.
#pragma once

#include "core/types.hpp"

namespace arenite {

/// `view` as it is where it has `rows` rows, else a new one, uninitialised: [rows][further...].
template <class View, class... Extents> void fit(View& view, std::string const& label, std::size_t rows, Extents... further)
{
    if (view.extent(0) < rows) view = View(uninitialized(label), rows, further...);
}

} // namespace arenite
