// SPDX-License-Identifier: MIT
// How far a grain's centre is from a wall, in which direction. Numbers in, numbers out, in the wall's own
// frame (its reference point at the origin). The distance is signed where a wall has an inside: a centre that
// got behind the surface is pushed back along the same normal.
//
// Which side of a thin sheet (tube, plate with holes, facet of a mesh) is a grain's? The side on which it came
// near. It is remembered per contact while the sheet is between, and taken anew where it is not (in the open
// disc of a hole, beyond the end of a tube): so a grain is neither lost through a sheet nor thrown out of it,
// and passes freely through an opening.
#pragma once

#include "core/scene.hpp"
#include "core/vec3.hpp"

namespace arenite {

/// Where a wall is and how it moves. rotation is row-major, from the wall's frame to the world's.
struct WallPose {
    Vec3 position; // of the reference point, m
    Real rotation[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    Vec3 velocity;         // of the reference point, m/s
    Vec3 angular_velocity; // rad/s

    KOKKOS_FUNCTION Vec3 direction_to_world(Vec3 const& v) const
    {
        Real const* r = rotation;
        return {r[0] * v.x + r[1] * v.y + r[2] * v.z, r[3] * v.x + r[4] * v.y + r[5] * v.z,
                r[6] * v.x + r[7] * v.y + r[8] * v.z};
    }
    KOKKOS_FUNCTION Vec3 direction_to_local(Vec3 const& v) const
    {
        Real const* r = rotation;
        return {r[0] * v.x + r[3] * v.y + r[6] * v.z, r[1] * v.x + r[4] * v.y + r[7] * v.z,
                r[2] * v.x + r[5] * v.y + r[8] * v.z};
    }
    KOKKOS_FUNCTION Vec3 to_world(Vec3 const& x) const { return position + direction_to_world(x); }
    KOKKOS_FUNCTION Vec3 to_local(Vec3 const& x) const { return direction_to_local(x - position); }
    /// Of the wall's material at the world point x, m/s.
    KOKKOS_FUNCTION Vec3 velocity_at(Vec3 const& x) const { return velocity + cross(angular_velocity, x - position); }
};

struct OpenHole {
    Vec3 center;     // in the wall's frame, on the plane, m
    Real radius = 0; // m
};

struct WallProximity {
    Vec3 normal;       // unit, from the wall's nearest point to the grain's centre
    Real distance = 0; // m, negative behind the surface
    bool faces = true; // false: nothing of this element is turned to the grain
};

namespace wall_geometry {

KOKKOS_FUNCTION inline Vec3 any_perpendicular(Vec3 const& unit)
{
    Vec3 const other = Kokkos::fabs(unit.x) < Real(0.6) ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    return normalized(cross(unit, other));
}

/// Position relative to an axis: height along it, distance from it and the direction of that distance.
struct AxialPosition {
    Real height = 0, radial = 0; // m
    Vec3 outward;                // unit
};
KOKKOS_FUNCTION inline AxialPosition axial_position(Vec3 const& x, Vec3 const& axis)
{
    AxialPosition p;
    p.height = dot(x, axis);
    Vec3 const across = x - p.height * axis;
    p.radial = norm(across);
    p.outward = p.radial > 0 ? across / p.radial : any_perpendicular(axis);
    return p;
}

/// A circular edge of radius rim; height and radial are those of the grain's centre relative to the circle.
/// A grain larger than the opening touches the circle all around: the far side's share (by Hertz's 3/2
/// power of its overlap) turns the normal, so that a grain that sits in the opening is held in its middle.
KOKKOS_FUNCTION inline WallProximity rim_proximity(AxialPosition const& p, Vec3 const& axis, Real rim, Real grain_radius)
{
    Vec3 const near = p.height * axis + (p.radial - rim) * p.outward;
    Vec3 const far = p.height * axis + (p.radial + rim) * p.outward;
    Real const near_distance = norm(near), far_distance = norm(far);
    if (!(near_distance > 0)) return {p.height < 0 ? -axis : axis, 0, true};
    Vec3 normal = near / near_distance;
    if (far_distance < grain_radius) {
        Real const ratio = (grain_radius - far_distance) / (grain_radius - near_distance);
        normal = normalized(normal + ratio * Kokkos::sqrt(ratio) / far_distance * far);
    }
    return {normal, near_distance, true};
}

/// A thin plate with open holes: the nearest point of {plane minus open discs}. side is kept outside the discs
/// (0: not known yet) and taken anew inside them.
template <class Holes>
KOKKOS_FUNCTION WallProximity plate(Vec3 const& normal, Holes const& holes, int first, int count, Vec3 const& x,
                                    Real grain_radius, Real& side)
{
    Real const height = dot(normal, x);
    Real const current = height < 0 ? Real(-1) : Real(1);
    for (int h = first; h < first + count; ++h) {
        AxialPosition const p = axial_position(x - holes(h).center, normal);
        if (p.radial >= holes(h).radius) continue;
        side = current;
        return rim_proximity(p, normal, holes(h).radius, grain_radius);
    }
    if (side == 0) side = current;
    return {side * normal, side * height, true};
}

/// A solid cylinder from the origin along axis: lateral surface, caps and their rims.
KOKKOS_FUNCTION inline WallProximity rod(Vec3 const& axis, Real length, Real radius, Vec3 const& x)
{
    AxialPosition const p = axial_position(x, axis);
    Real const below = -p.height, above = p.height - length, beside = p.radial - radius;
    Real const along = below > above ? below : above; // outside a cap where positive
    Vec3 const cap_normal = below > above ? -axis : axis;
    if (along <= 0 && beside <= 0) // inside: out by the shortest way
        return along > beside ? WallProximity{cap_normal, along, true} : WallProximity{p.outward, beside, true};
    if (along <= 0) return {p.outward, beside, true};
    if (beside <= 0) return {cap_normal, along, true};
    Vec3 const offset = along * cap_normal + beside * p.outward;
    Real const distance = norm(offset);
    return {offset / distance, distance, true};
}

/// A thin cylindrical shell with open ends; side +1 is within.
KOKKOS_FUNCTION inline WallProximity tube(Vec3 const& axis, Real length, Real radius, Vec3 const& x, Real grain_radius,
                                          Real& side)
{
    AxialPosition p = axial_position(x, axis);
    Real const current = p.radial < radius ? Real(1) : Real(-1);
    if (p.height < 0 || p.height > length) {
        side = current;
        if (p.height > length) p.height -= length;
        return rim_proximity(p, axis, radius, grain_radius);
    }
    if (side == 0) side = current;
    return {-side * p.outward, side * (radius - p.radial), true};
}

/// A solid box centred at the origin: faces, edges and corners.
KOKKOS_FUNCTION inline WallProximity solid_box(Vec3 const& half, Vec3 const& x)
{
    Vec3 offset;
    int nearest = 0;
    Real depth = 0;
    bool within = true;
    for (int axis = 0; axis < 3; ++axis) {
        Real const beyond = Kokkos::fabs(x[axis]) - half[axis];
        if (beyond > 0) {
            offset[axis] = x[axis] < 0 ? -beyond : beyond;
            within = false;
        }
        if (axis == 0 || beyond > depth) {
            depth = beyond;
            nearest = axis;
        }
    }
    if (within) { // out by the shortest way
        Vec3 normal;
        normal[nearest] = x[nearest] < 0 ? Real(-1) : Real(1);
        return {normal, depth, true};
    }
    Real const distance = norm(offset);
    return {offset / distance, distance, true};
}

} // namespace wall_geometry

/// The hole through which a grain has left, or -1: it is wholly past the plate (its centre lies behind the plane
/// by its radius or more). Behind a plate without open holes nothing counts as through. x in the wall's frame.
/// With several open holes: the one whose axis is nearest. Returns an index into holes.
template <class Holes>
KOKKOS_FUNCTION int hole_passed(Vec3 const& normal, Holes const& holes, int first, int count, Vec3 const& x,
                                Real grain_radius)
{
    if (dot(normal, x) > -grain_radius) return -1;
    int passed = -1;
    Real least = 0;
    for (int h = first; h < first + count; ++h) {
        Real const gap = wall_geometry::axial_position(x - holes(h).center, normal).radial - holes(h).radius;
        if (passed < 0 || gap < least) {
            passed = h;
            least = gap;
        }
    }
    return passed;
}

} // namespace arenite
