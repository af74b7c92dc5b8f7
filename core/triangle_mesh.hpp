// SPDX-License-Identifier: MIT
// A triangle mesh as grains feel it: every face, edge and vertex is a feature with a region of space of its own
// (where it is the mesh's locally nearest point), and every feature belongs to one triangle. So a grain on a
// shared edge or over the diagonal of a flat quadrilateral touches once, whichever triangles are near.
// A uniform grid over the triangles finds the near ones.
#pragma once

#include "core/types.hpp"
#include "core/vec3.hpp"

#include <string>
#include <vector>

namespace arenite {

/// Contacts with walls are sorted by keys that hold 22 bits of an element's number.
inline constexpr int most_mesh_triangles = 1 << 22;

struct Triangle {
    Vec3 corner[3]; // m, counter-clockwise seen from the grains
};

/// How the two faces of an edge meet, seen from the grains.
enum class EdgeKind : std::uint8_t {
    boundary, // one face only
    convex,
    coplanar,
    smooth_concave, // less than 30 degrees: the nearer face stands for both, as on a curved surface
    concave,        // a grain in the corner touches both faces
};

struct MeshTriangle {
    Vec3 corner[3];
    Vec3 normal;     // unit, towards the grains
    int vertex[3];   // rows of MeshViews::vertex
    int neighbor[3]; // triangle across the edge from corner k to corner k+1, or -1
    std::uint8_t neighbor_edge[3];
    EdgeKind edge[3];
    bool owns_edge[3], owns_vertex[3];
    int cell_low[3], cell_high[3]; // grid cells that its bounding box covers
};

struct MeshVertex {
    Vec3 position;
    Vec3 normal;            // sum of the faces' normals by their angle here (Baerentzen & Aanaes 2005)
    int begin = 0, end = 0; // its edges: rows of MeshViews::edge_end
    bool boundary = false;
};

/// All meshes of a scene, one after another.
struct MeshViews {
    View1<MeshTriangle> triangle;
    View1<MeshVertex> vertex;
    View1<int> edge_end;   // vertex at the other end
    View1<int> cell_begin; // [cell + 1 of each grid]
    View1<int> cell_triangle;
};

/// Grid over the triangles of one mesh.
struct MeshGrid {
    Vec3 lower;
    Real cell = 1; // m
    int cells[3] = {0, 0, 0};
    int first_cell = 0; // row of MeshViews::cell_begin

    KOKKOS_FUNCTION int along(int axis, Real x) const // clamped
    {
        Real const c = Kokkos::floor((x - lower[axis]) / cell);
        return c < 0 ? 0 : (c >= cells[axis] ? cells[axis] - 1 : static_cast<int>(c));
    }
};

/// On the host, before upload.
struct MeshData {
    std::vector<MeshTriangle> triangles;
    std::vector<MeshVertex> vertices;
    std::vector<int> edge_ends, cell_begin, cell_triangles;
};

struct MeshPart {
    int first_triangle = 0, triangles = 0;
    MeshGrid grid;
    Vec3 lower, upper; // bounding box
};

/// Welds corners, drops triangles without area, finds neighbours and owners and fills the grid; appends to data.
/// Throws InputError, with `name`, if no triangle is left or a coordinate is not finite.
MeshPart append_mesh(MeshData& data, std::vector<Triangle> const& triangles, std::string const& name);

MeshViews upload(MeshData const& data);

} // namespace arenite
