// SPDX-License-Identifier: MIT
// A three-vector for host and device code.
#pragma once

#include "core/real.hpp"

namespace arenite {

/// Of numbers N: Real, or several in one (core/lanes.hpp). The operators are friends so that a Real can stand
/// where an N is meant.
template <class N> struct Vector {
    N x = 0, y = 0, z = 0;

    KOKKOS_FORCEINLINE_FUNCTION constexpr N& operator[](int axis) { return axis == 0 ? x : (axis == 1 ? y : z); }
    KOKKOS_FORCEINLINE_FUNCTION constexpr N operator[](int axis) const { return axis == 0 ? x : (axis == 1 ? y : z); }
    KOKKOS_FORCEINLINE_FUNCTION constexpr Vector& operator+=(Vector const& b) { return *this = *this + b; }
    KOKKOS_FORCEINLINE_FUNCTION constexpr Vector& operator-=(Vector const& b) { return *this = *this - b; }
    KOKKOS_FORCEINLINE_FUNCTION constexpr Vector& operator*=(N const& s) { return *this = s * *this; }

    KOKKOS_FORCEINLINE_FUNCTION friend constexpr Vector operator+(Vector const& a, Vector const& b)
    {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    KOKKOS_FORCEINLINE_FUNCTION friend constexpr Vector operator-(Vector const& a, Vector const& b)
    {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    KOKKOS_FORCEINLINE_FUNCTION friend constexpr Vector operator-(Vector const& a) { return {-a.x, -a.y, -a.z}; }
    KOKKOS_FORCEINLINE_FUNCTION friend constexpr Vector operator*(N const& s, Vector const& a)
    {
        return {s * a.x, s * a.y, s * a.z};
    }
    KOKKOS_FORCEINLINE_FUNCTION friend constexpr Vector operator*(Vector const& a, N const& s)
    {
        return {s * a.x, s * a.y, s * a.z};
    }
    KOKKOS_FORCEINLINE_FUNCTION friend constexpr Vector operator/(Vector const& a, N const& s)
    {
        return {a.x / s, a.y / s, a.z / s};
    }
    KOKKOS_FORCEINLINE_FUNCTION friend constexpr bool operator==(Vector const& a, Vector const& b)
    {
        return a.x == b.x && a.y == b.y && a.z == b.z;
    }

    KOKKOS_FORCEINLINE_FUNCTION friend constexpr N dot(Vector const& a, Vector const& b)
    {
        return a.x * b.x + a.y * b.y + a.z * b.z;
    }
    KOKKOS_FORCEINLINE_FUNCTION friend constexpr Vector cross(Vector const& a, Vector const& b)
    {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
    KOKKOS_FORCEINLINE_FUNCTION friend N norm(Vector const& a)
    {
        using Kokkos::sqrt;
        return sqrt(dot(a, a));
    }
};

using Vec3 = Vector<Real>;

template <class N> KOKKOS_FORCEINLINE_FUNCTION Vector<N> normalized(Vector<N> const& a) { return a / norm(a); }
KOKKOS_FORCEINLINE_FUNCTION Vec3 normalized(Vec3 const& a) { return a / norm(a); }

/// The three leading components of a record View's row.
template <class Records> KOKKOS_FORCEINLINE_FUNCTION Vec3 vector_of(Records const& records, int row)
{
    return {records(row, 0), records(row, 1), records(row, 2)};
}
template <class Records> KOKKOS_FORCEINLINE_FUNCTION void set_vector(Records const& records, int row, Vec3 const& v)
{
    records(row, 0) = v.x;
    records(row, 1) = v.y;
    records(row, 2) = v.z;
}

} // namespace arenite
