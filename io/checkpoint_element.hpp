// SPDX-License-Identifier: MIT
// The types that a checkpoint can hold, and how Views get into rows (last index fastest) on the host.
#pragma once

#include "core/error.hpp"
#include "core/types.hpp"

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace arenite {

enum class Element { real64, real32, int8, int16, int32, int64, uint8, uint16, uint32, uint64, text };

/// The element kind of a C++ number or of an enum (stored as the number beneath it).
template <class T> struct ElementOf {
    static constexpr Element integer(bool is_signed, std::size_t bytes)
    {
        if (bytes == 1) return is_signed ? Element::int8 : Element::uint8;
        if (bytes == 2) return is_signed ? Element::int16 : Element::uint16;
        if (bytes == 4) return is_signed ? Element::int32 : Element::uint32;
        return is_signed ? Element::int64 : Element::uint64;
    }
    static constexpr Element find()
    {
        if constexpr (std::is_same_v<T, double>) return Element::real64;
        else if constexpr (std::is_same_v<T, float>) return Element::real32;
        else if constexpr (std::is_enum_v<T>) return ElementOf<std::underlying_type_t<T>>::kind;
        else {
            static_assert(std::is_integral_v<T>, "a checkpoint holds numbers, enums and text");
            return integer(std::is_signed_v<T>, sizeof(T));
        }
    }
    static constexpr Element kind = find();
};

inline std::size_t size_of(std::vector<std::size_t> const& shape)
{
    std::size_t size = 1;
    for (std::size_t const extent : shape) size *= extent;
    return size;
}

template <class ViewType>
using HostRows = Kokkos::View<typename ViewType::non_const_data_type, Kokkos::LayoutRight, HostSpace>;

/// A View of that shape, not initialised; extents known at compile time are not passed.
template <class ViewType> ViewType allocated(std::string const& label, std::vector<std::size_t> const& shape)
{
    auto const how = uninitialized(label);
    if constexpr (ViewType::rank_dynamic == 1) return ViewType(how, shape[0]);
    else if constexpr (ViewType::rank_dynamic == 2) return ViewType(how, shape[0], shape[1]);
    else return ViewType(how, shape[0], shape[1], shape[2]);
}

template <class ViewType> std::vector<std::size_t> shape_of(ViewType const& view)
{
    std::vector<std::size_t> shape;
    for (std::size_t axis = 0; axis < ViewType::rank; ++axis) shape.push_back(view.extent(axis));
    return shape;
}

/// A copy on the host with the last index fastest.
template <class ViewType> HostRows<ViewType> host_rows(ViewType const& view)
{
    static_assert(ViewType::rank >= 1 && ViewType::rank <= 3, "a checkpoint holds arrays of rank 1 to 3");
    auto const rows = allocated<HostRows<ViewType>>(view.label(), shape_of(view));
    auto const mirror = Kokkos::create_mirror_view_and_copy(HostSpace(), view);
    Kokkos::deep_copy(rows, mirror);
    return rows;
}

} // namespace arenite
