// SPDX-License-Identifier: MIT
// A three-vector for host and device code.
#pragma once

#include "core/types.hpp"

namespace arenite {

struct Vec3 {
    Real x = 0, y = 0, z = 0;

    KOKKOS_FUNCTION constexpr Real& operator[](int axis) { return axis == 0 ? x : (axis == 1 ? y : z); }
    KOKKOS_FUNCTION constexpr Real operator[](int axis) const { return axis == 0 ? x : (axis == 1 ? y : z); }
    KOKKOS_FUNCTION constexpr Vec3& operator+=(Vec3 const& b) { x += b.x; y += b.y; z += b.z; return *this; }
    KOKKOS_FUNCTION constexpr Vec3& operator-=(Vec3 const& b) { x -= b.x; y -= b.y; z -= b.z; return *this; }
    KOKKOS_FUNCTION constexpr Vec3& operator*=(Real s) { x *= s; y *= s; z *= s; return *this; }
};

KOKKOS_FUNCTION constexpr Vec3 operator+(Vec3 const& a, Vec3 const& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
KOKKOS_FUNCTION constexpr Vec3 operator-(Vec3 const& a, Vec3 const& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
KOKKOS_FUNCTION constexpr Vec3 operator-(Vec3 const& a) { return {-a.x, -a.y, -a.z}; }
KOKKOS_FUNCTION constexpr Vec3 operator*(Real s, Vec3 const& a) { return {s * a.x, s * a.y, s * a.z}; }
KOKKOS_FUNCTION constexpr Vec3 operator*(Vec3 const& a, Real s) { return {s * a.x, s * a.y, s * a.z}; }
KOKKOS_FUNCTION constexpr Vec3 operator/(Vec3 const& a, Real s) { return {a.x / s, a.y / s, a.z / s}; }
KOKKOS_FUNCTION constexpr bool operator==(Vec3 const& a, Vec3 const& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

KOKKOS_FUNCTION constexpr Real dot(Vec3 const& a, Vec3 const& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
KOKKOS_FUNCTION constexpr Vec3 cross(Vec3 const& a, Vec3 const& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
KOKKOS_FUNCTION inline Real norm(Vec3 const& a) { return Kokkos::sqrt(dot(a, a)); }
KOKKOS_FUNCTION inline Vec3 normalized(Vec3 const& a) { return a / norm(a); }

/// The three leading components of a record View's row.
template <class Records> KOKKOS_FUNCTION Vec3 vector_of(Records const& records, int row)
{
    return {records(row, 0), records(row, 1), records(row, 2)};
}
template <class Records> KOKKOS_FUNCTION void set_vector(Records const& records, int row, Vec3 const& v)
{
    records(row, 0) = v.x;
    records(row, 1) = v.y;
    records(row, 2) = v.z;
}

} // namespace arenite
