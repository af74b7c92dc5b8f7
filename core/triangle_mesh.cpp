// SPDX-License-Identifier: MIT
#include "core/triangle_mesh.hpp"

#include "core/error.hpp"
#include "core/to_device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace arenite {
namespace {

constexpr Real weld_fraction = 1e-9;                // of the mesh's diagonal: what text files lose
constexpr Real coplanar_sine = 1e-7;                // a few roundings of single-precision STL coordinates
constexpr Real smooth_cosine = 0.86602540378443865; // 30 degrees

struct Extent {
    Vec3 lower, upper;
};

Extent extent_of(std::vector<Triangle> const& triangles, std::string const& name)
{
    Extent extent{triangles[0].corner[0], triangles[0].corner[0]};
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (Vec3 const& corner : triangles[t].corner)
            for (int axis = 0; axis < 3; ++axis) {
                if (!std::isfinite(corner[axis]))
                    throw InputError(fmt::format("{}: triangle {} has a coordinate that is not a number", name, t + 1));
                extent.lower[axis] = std::min(extent.lower[axis], corner[axis]);
                extent.upper[axis] = std::max(extent.upper[axis], corner[axis]);
            }
    return extent;
}

/// One vertex for corners closer than the tolerance.
class Welder {
public:
    Welder(std::vector<MeshVertex>& vertices, Extent const& extent)
        : vertices_(vertices), lower_(extent.lower),
          tolerance_(std::max(weld_fraction * norm(extent.upper - extent.lower), Real(1e-300)))
    {
    }

    int operator()(Vec3 const& point)
    {
        std::array<long long, 3> cell;
        for (int axis = 0; axis < 3; ++axis)
            cell[axis] = static_cast<long long>(std::floor((point[axis] - lower_[axis]) / (2 * tolerance_)));
        for (long long x = cell[0] - 1; x <= cell[0] + 1; ++x)
            for (long long y = cell[1] - 1; y <= cell[1] + 1; ++y)
                for (long long z = cell[2] - 1; z <= cell[2] + 1; ++z) {
                    auto const found = known_.find({x, y, z});
                    if (found != known_.end() && norm(vertices_[found->second].position - point) <= tolerance_)
                        return found->second;
                }
        int const vertex = static_cast<int>(vertices_.size());
        vertices_.push_back({point, {}, 0, 0, false});
        known_.emplace(cell, vertex);
        return vertex;
    }

private:
    std::vector<MeshVertex>& vertices_;
    Vec3 lower_;
    Real tolerance_;
    std::map<std::array<long long, 3>, int> known_;
};

void add_triangles(MeshData& data, std::vector<Triangle> const& triangles, Extent const& extent)
{
    Welder weld(data.vertices, extent);
    Real const longest = norm(extent.upper - extent.lower);
    for (Triangle const& given : triangles) {
        MeshTriangle t{};
        for (int k = 0; k < 3; ++k) {
            t.vertex[k] = weld(given.corner[k]);
            t.corner[k] = data.vertices[t.vertex[k]].position;
            t.neighbor[k] = -1;
        }
        Vec3 const area = cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]);
        if (norm(area) <= Real(1e-14) * longest * longest) continue;
        t.normal = normalized(area);
        data.triangles.push_back(t);
    }
}

using Edge = std::pair<int, int>;                                   // vertices, the lower first
using EdgeFaces = std::map<Edge, std::vector<std::pair<int, int>>>; // (triangle, edge of it)

EdgeFaces collect_edges(MeshData const& data, int first)
{
    EdgeFaces edges;
    for (int t = first; t < static_cast<int>(data.triangles.size()); ++t)
        for (int k = 0; k < 3; ++k) {
            int const a = data.triangles[t].vertex[k], b = data.triangles[t].vertex[(k + 1) % 3];
            edges[{std::min(a, b), std::max(a, b)}].push_back({t, k});
        }
    return edges;
}

EdgeKind kind_of(MeshTriangle const& a, MeshTriangle const& b, int edge_of_a)
{
    // Outward in a's plane: the grains' side is convex if b's normal leans that way.
    Vec3 const outward = normalized(cross(a.corner[(edge_of_a + 1) % 3] - a.corner[edge_of_a], a.normal));
    Real const cosine = dot(a.normal, b.normal), sine = dot(outward, b.normal);
    if (cosine > 0 && std::fabs(sine) < coplanar_sine) return EdgeKind::coplanar;
    if (sine > 0 || (cosine < 0 && std::fabs(sine) < coplanar_sine)) return EdgeKind::convex;
    return cosine > smooth_cosine ? EdgeKind::smooth_concave : EdgeKind::concave;
}

/// Neighbours, edge kinds, owners of edges (the lower triangle) and the edges of each vertex.
void connect(MeshData& data, EdgeFaces const& edges, int first_vertex)
{
    std::vector<std::vector<int>> ends(data.vertices.size() - first_vertex);
    for (auto const& [edge, faces] : edges) {
        ends[edge.first - first_vertex].push_back(edge.second);
        ends[edge.second - first_vertex].push_back(edge.first);
        auto const [t, k] = faces[0];
        data.triangles[t].owns_edge[k] = true;
        if (faces.size() != 2) { // an open rim, or more sheets than two: the edge stands alone
            for (auto const& [other, e] : faces) data.triangles[other].edge[e] = EdgeKind::boundary;
            data.vertices[edge.first].boundary = data.vertices[edge.second].boundary = true;
            continue;
        }
        auto const [u, l] = faces[1];
        MeshTriangle &a = data.triangles[t], &b = data.triangles[u];
        a.neighbor[k] = u;
        b.neighbor[l] = t;
        a.neighbor_edge[k] = static_cast<std::uint8_t>(l);
        b.neighbor_edge[l] = static_cast<std::uint8_t>(k);
        a.edge[k] = b.edge[l] = kind_of(a, b, k);
    }
    for (std::size_t v = 0; v < ends.size(); ++v) {
        MeshVertex& vertex = data.vertices[first_vertex + v];
        vertex.begin = static_cast<int>(data.edge_ends.size());
        data.edge_ends.insert(data.edge_ends.end(), ends[v].begin(), ends[v].end());
        vertex.end = static_cast<int>(data.edge_ends.size());
    }
}

void own_vertices(MeshData& data, int first_triangle)
{
    std::vector<bool> owned(data.vertices.size(), false);
    for (int t = first_triangle; t < static_cast<int>(data.triangles.size()); ++t) {
        MeshTriangle& triangle = data.triangles[t];
        for (int k = 0; k < 3; ++k) {
            int const v = triangle.vertex[k];
            if (!owned[v]) triangle.owns_vertex[k] = owned[v] = true;
            Vec3 const a = normalized(triangle.corner[(k + 1) % 3] - triangle.corner[k]);
            Vec3 const b = normalized(triangle.corner[(k + 2) % 3] - triangle.corner[k]);
            Real const angle = std::acos(std::clamp(dot(a, b), Real(-1), Real(1)));
            data.vertices[v].normal += angle * triangle.normal;
        }
    }
}

void fill_grid(MeshData& data, MeshPart& part)
{
    MeshGrid& grid = part.grid;
    Real mean = 0;
    auto const bounds = [](MeshTriangle const& t, int axis) {
        return std::minmax({t.corner[0][axis], t.corner[1][axis], t.corner[2][axis]});
    };
    for (int t = part.first_triangle; t < part.first_triangle + part.triangles; ++t)
        for (int axis = 0; axis < 3; ++axis) {
            auto const [low, high] = bounds(data.triangles[t], axis);
            mean += (high - low) / (3 * part.triangles);
        }
    Vec3 const size = part.upper - part.lower;
    Real const longest = std::max({size.x, size.y, size.z});
    grid.lower = part.lower;
    grid.cell = std::max(2 * mean, longest / 64);
    for (int axis = 0; axis < 3; ++axis) grid.cells[axis] = std::max(1, static_cast<int>(std::ceil(size[axis] / grid.cell)));
    grid.first_cell = static_cast<int>(data.cell_begin.size());
    std::vector<std::vector<int>> content(static_cast<std::size_t>(grid.cells[0]) * grid.cells[1] * grid.cells[2]);
    for (int t = part.first_triangle; t < part.first_triangle + part.triangles; ++t) {
        MeshTriangle& triangle = data.triangles[t];
        for (int axis = 0; axis < 3; ++axis) {
            auto const [low, high] = bounds(triangle, axis);
            triangle.cell_low[axis] = grid.along(axis, low);
            triangle.cell_high[axis] = grid.along(axis, high);
        }
        for (int z = triangle.cell_low[2]; z <= triangle.cell_high[2]; ++z)
            for (int y = triangle.cell_low[1]; y <= triangle.cell_high[1]; ++y)
                for (int x = triangle.cell_low[0]; x <= triangle.cell_high[0]; ++x)
                    content[x + grid.cells[0] * (y + static_cast<std::size_t>(grid.cells[1]) * z)].push_back(t);
    }
    for (auto const& cell : content) {
        data.cell_begin.push_back(static_cast<int>(data.cell_triangles.size()));
        data.cell_triangles.insert(data.cell_triangles.end(), cell.begin(), cell.end());
    }
    data.cell_begin.push_back(static_cast<int>(data.cell_triangles.size()));
}

} // namespace

MeshPart append_mesh(MeshData& data, std::vector<Triangle> const& triangles, std::string const& name)
{
    if (triangles.empty()) throw InputError(name + ": the mesh has no triangles");
    if (triangles.size() > static_cast<std::size_t>(most_mesh_triangles))
        throw InputError(fmt::format("{}: the mesh has {} triangles, more than the {} that one wall can have", name,
                                     triangles.size(), most_mesh_triangles));
    Extent const extent = extent_of(triangles, name);
    MeshPart part;
    part.first_triangle = static_cast<int>(data.triangles.size());
    part.lower = extent.lower;
    part.upper = extent.upper;
    int const first_vertex = static_cast<int>(data.vertices.size());
    add_triangles(data, triangles, extent);
    part.triangles = static_cast<int>(data.triangles.size()) - part.first_triangle;
    if (part.triangles == 0) throw InputError(name + ": no triangle of the mesh has an area");
    connect(data, collect_edges(data, part.first_triangle), first_vertex);
    own_vertices(data, part.first_triangle);
    fill_grid(data, part);
    return part;
}

MeshViews upload(MeshData const& data)
{
    return {to_device(data.triangles, "mesh_triangle"), to_device(data.vertices, "mesh_vertex"),
            to_device(data.edge_ends, "mesh_edge_end"), to_device(data.cell_begin, "mesh_cell_begin"),
            to_device(data.cell_triangles, "mesh_cell_triangle")};
}

} // namespace arenite
