// SPDX-License-Identifier: MIT
// What a grain's centre is near to on a mesh, triangle by triangle: the features (face, edges, vertices) that a
// triangle owns and in whose region the centre lies. All tests of one edge use the same numbers for both of its
// faces, so the regions neither overlap nor leave a gap by rounding. Mesh is MeshViews or a copy of it on the host.
#pragma once

#include "core/triangle_mesh.hpp"
#include "core/wall_geometry.hpp"

namespace arenite {
namespace wall_geometry {

/// How far x is beyond edge k of t, in t's plane, times the edge's length; negative towards t's inside.
KOKKOS_FUNCTION inline Real beyond_own_edge(MeshTriangle const& t, int k, Vec3 const& x)
{
    Vec3 const along = t.corner[(k + 1) % 3] - t.corner[k];
    return dot(x - t.corner[k], cross(along, t.normal));
}

/// The same; of two coplanar faces one number decides for both.
template <class Mesh> KOKKOS_FUNCTION Real beyond_edge(Mesh const& mesh, int triangle, int k, Vec3 const& x)
{
    MeshTriangle const& t = mesh.triangle(triangle);
    if (t.edge[k] == EdgeKind::coplanar && !t.owns_edge[k])
        return -beyond_own_edge(mesh.triangle(t.neighbor[k]), t.neighbor_edge[k], x);
    return beyond_own_edge(t, k, x);
}

template <class Mesh> KOKKOS_FUNCTION bool is_over_face(Mesh const& mesh, int triangle, Vec3 const& x)
{
    for (int k = 0; k < 3; ++k)
        if (!(beyond_edge(mesh, triangle, k, x) < 0)) return false;
    return true;
}

/// On a curved surface made of facets that meet at small concave angles only the nearest facet counts.
template <class Mesh> KOKKOS_FUNCTION bool is_hidden_by_neighbor(Mesh const& mesh, int triangle, Vec3 const& x, Real height)
{
    MeshTriangle const& t = mesh.triangle(triangle);
    for (int k = 0; k < 3; ++k) {
        int const other = t.neighbor[k];
        if (t.edge[k] != EdgeKind::smooth_concave || !is_over_face(mesh, other, x)) continue;
        MeshTriangle const& o = mesh.triangle(other);
        Real const other_height = dot(o.normal, x - o.corner[0]);
        if (other_height < height || (other_height == height && other < triangle)) return true;
    }
    return false;
}

template <class Mesh> KOKKOS_FUNCTION bool is_in_edge_region(Mesh const& mesh, int triangle, int k, Vec3 const& x)
{
    MeshTriangle const& t = mesh.triangle(triangle);
    if (t.edge[k] == EdgeKind::concave || t.edge[k] == EdgeKind::smooth_concave) return false;
    Vec3 const a = mesh.vertex(t.vertex[k]).position, b = mesh.vertex(t.vertex[(k + 1) % 3]).position;
    if (!(dot(x - a, b - a) > 0) || !(dot(x - b, a - b) > 0)) return false;
    if (beyond_edge(mesh, triangle, k, x) < 0) return false;
    return t.edge[k] == EdgeKind::boundary || !(beyond_edge(mesh, t.neighbor[k], t.neighbor_edge[k], x) < 0);
}

template <class Mesh> KOKKOS_FUNCTION bool is_in_vertex_region(Mesh const& mesh, int vertex, Vec3 const& x)
{
    MeshVertex const& v = mesh.vertex(vertex);
    for (int e = v.begin; e < v.end; ++e)
        if (dot(x - v.position, mesh.vertex(mesh.edge_end(e)).position - v.position) > 0) return false;
    return v.boundary || dot(x - v.position, v.normal) >= 0;
}

KOKKOS_FUNCTION inline WallProximity from_point(Vec3 const& point, Vec3 const& x, Vec3 const& fallback)
{
    Vec3 const offset = x - point;
    Real const distance = norm(offset);
    return {distance > 0 ? offset / distance : fallback, distance, true};
}

/// side: of the face, kept while x is over it (see wall_geometry.hpp); a face has no back.
template <class Mesh>
KOKKOS_FUNCTION WallProximity mesh_triangle(Mesh const& mesh, int triangle, Vec3 const& x, Real grain_radius, Real& side)
{
    MeshTriangle const& t = mesh.triangle(triangle);
    WallProximity const nothing{t.normal, 0, false};
    Real const height = dot(t.normal, x - t.corner[0]);
    Real const current = height < 0 ? Real(-1) : Real(1);
    if (is_over_face(mesh, triangle, x)) {
        if (side == 0 || current > 0) side = current;
        if (side < 0 || is_hidden_by_neighbor(mesh, triangle, x, height)) return nothing;
        return {t.normal, height, true};
    }
    side = current;
    if (Kokkos::fabs(height) >= grain_radius) return nothing; // its edges and vertices are no nearer
    for (int k = 0; k < 3; ++k) {
        Vec3 const a = t.corner[k], along = t.corner[(k + 1) % 3] - a;
        if (t.owns_edge[k] && is_in_edge_region(mesh, triangle, k, x)) {
            WallProximity const p = from_point(a + dot(x - a, along) / dot(along, along) * along, x, t.normal);
            bool const front =
                t.edge[k] == EdgeKind::boundary || dot(p.normal, t.normal + mesh.triangle(t.neighbor[k]).normal) >= 0;
            return front ? p : nothing;
        }
        if (t.owns_vertex[k] && is_in_vertex_region(mesh, t.vertex[k], x)) return from_point(a, x, t.normal);
    }
    return nothing;
}

/// Nearest point of a triangle, whatever its neighbours (Ericson 2005, section 5.1.5).
KOKKOS_FUNCTION inline Vec3 nearest_on_triangle(Vec3 const (&corner)[3], Vec3 const& x)
{
    Vec3 const ab = corner[1] - corner[0], ac = corner[2] - corner[0];
    Real const d1 = dot(ab, x - corner[0]), d2 = dot(ac, x - corner[0]);
    if (d1 <= 0 && d2 <= 0) return corner[0];
    Real const d3 = dot(ab, x - corner[1]), d4 = dot(ac, x - corner[1]);
    if (d3 >= 0 && d4 <= d3) return corner[1];
    Real const vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return corner[0] + d1 / (d1 - d3) * ab;
    Real const d5 = dot(ab, x - corner[2]), d6 = dot(ac, x - corner[2]);
    if (d6 >= 0 && d5 <= d6) return corner[2];
    Real const vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return corner[0] + d2 / (d2 - d6) * ac;
    Real const va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 >= d3 && d5 >= d6) return corner[1] + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (corner[2] - corner[1]);
    Real const scale = 1 / (va + vb + vc);
    return corner[0] + vb * scale * ab + vc * scale * ac;
}

} // namespace wall_geometry

/// Calls visit(triangle) once for every triangle of the part closer than reach to x (in the mesh's frame).
template <class Mesh, class Visit>
KOKKOS_FUNCTION void visit_near_triangles(Mesh const& mesh, MeshGrid const& grid, Vec3 const& x, Real reach,
                                          Visit const& visit)
{
    int low[3], high[3];
    for (int axis = 0; axis < 3; ++axis) {
        Real const top = grid.lower[axis] + grid.cells[axis] * grid.cell;
        if (x[axis] + reach < grid.lower[axis] || x[axis] - reach > top) return;
        low[axis] = grid.along(axis, x[axis] - reach);
        high[axis] = grid.along(axis, x[axis] + reach);
    }
    for (int cz = low[2]; cz <= high[2]; ++cz)
        for (int cy = low[1]; cy <= high[1]; ++cy)
            for (int cx = low[0]; cx <= high[0]; ++cx) {
                int const cell = grid.first_cell + cx + grid.cells[0] * (cy + grid.cells[1] * cz);
                for (int n = mesh.cell_begin(cell); n < mesh.cell_begin(cell + 1); ++n) {
                    int const triangle = mesh.cell_triangle(n);
                    MeshTriangle const& t = mesh.triangle(triangle);
                    // A triangle lies in many cells; the first that it shares with the query reports it.
                    if (cx != Kokkos::max(t.cell_low[0], low[0]) || cy != Kokkos::max(t.cell_low[1], low[1]) ||
                        cz != Kokkos::max(t.cell_low[2], low[2]))
                        continue;
                    Vec3 const offset = x - wall_geometry::nearest_on_triangle(t.corner, x);
                    if (dot(offset, offset) < reach * reach) visit(triangle);
                }
            }
}

} // namespace arenite
