// SPDX-License-Identifier: MIT
#include "io/field_output.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

namespace arenite {
namespace {

void check_choice(std::vector<std::string> const& chosen, std::vector<std::string> const& known, char const* what)
{
    for (auto const& name : chosen)
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw InputError(
                fmt::format("output: there is no {} field '{}'; there are: {}", what, name, fmt::join(known, ", ")));
}

bool is_chosen(std::vector<std::string> const& chosen, std::string const& name)
{
    return std::find(chosen.begin(), chosen.end(), name) != chosen.end();
}

/// Takes the chosen arrays that have a value for each item.
class Selection {
public:
    Selection(std::vector<std::string> const& chosen, std::size_t items) : chosen_(chosen), items_(items) {}

    template <class T> void add(char const* name, int components, std::vector<T> const& values)
    {
        bool const known = values.size() == items_ * components;
        ARENITE_REQUIRE(known || values.empty(), fmt::format("{} values of {} for {} items", values.size(), name, items_));
        if (known && is_chosen(chosen_, name)) arrays.push_back({name, components, values});
    }

    std::vector<DataArray> arrays;

private:
    std::vector<std::string> const& chosen_;
    std::size_t items_;
};

} // namespace

std::vector<Real> speeds(std::vector<Real> const& velocity)
{
    std::vector<Real> result(velocity.size() / 3);
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = norm(Vec3{velocity[3 * i], velocity[3 * i + 1], velocity[3 * i + 2]});
    return result;
}

std::vector<std::string> const& grain_fields()
{
    static std::vector<std::string> const names{"diameter", "velocity",     "spin",  "force",    "torque", "fluid_force",
                                                "bonds",    "coordination", "class", "material", "id"};
    return names;
}

std::vector<std::string> const& fluid_fields()
{
    static std::vector<std::string> const names{"velocity", "speed", "pressure", "porosity"};
    return names;
}

PolyPiece grain_piece(GrainSnapshot const& grains, std::vector<std::string> const& fields)
{
    check_choice(fields, grain_fields(), "grain");
    PolyPiece piece;
    piece.time = grains.time;
    piece.points = grains.position;
    piece.connectivity.resize(grains.count());
    std::iota(piece.connectivity.begin(), piece.connectivity.end(), 0);
    piece.offsets.resize(grains.count());
    std::iota(piece.offsets.begin(), piece.offsets.end(), 1);
    Selection selection(fields, grains.count());
    selection.add("diameter", 1, grains.diameter);
    selection.add("velocity", 3, grains.velocity);
    selection.add("spin", 3, grains.spin);
    selection.add("force", 3, grains.force);
    selection.add("torque", 3, grains.torque);
    selection.add("fluid_force", 3, grains.fluid_force);
    selection.add("bonds", 1, grains.bonds);
    selection.add("coordination", 1, grains.coordination);
    selection.add("class", 1, grains.size_class);
    selection.add("material", 1, grains.material);
    selection.add("id", 1, grains.id);
    piece.point_data = std::move(selection.arrays);
    return piece;
}

ImagePiece fluid_piece(FluidSnapshot const& fluid, std::vector<std::string> const& fields)
{
    check_choice(fields, fluid_fields(), "fluid");
    ImagePiece piece;
    piece.time = fluid.time;
    for (int axis = 0; axis < 3; ++axis) {
        piece.cells[axis] = fluid.cells[axis];
        piece.lower[axis] = fluid.lower[axis];
        piece.spacing[axis] = fluid.spacing[axis];
    }
    Selection selection(fields, fluid.count());
    selection.add("velocity", 3, fluid.velocity);
    selection.add("speed", 1, speeds(fluid.velocity));
    selection.add("pressure", 1, fluid.pressure);
    selection.add("porosity", 1, fluid.porosity);
    piece.cell_data = std::move(selection.arrays);
    return piece;
}

FieldOutput::FieldOutput(std::filesystem::path folder, std::optional<ResumePoint> const& resume)
    : folder_(std::move(folder)), resume_(resume)
{
    make_folder(folder_);
    for (auto const& [name, extension] :
         {std::pair{"particles", "vtp"}, {"fluid", "vti"}, {"streamlines", "vtp"}, {"walls", "vtp"}})
        if (std::filesystem::exists(folder_ / (std::string(name) + ".pvd"))) series(name, extension);
}

PvdSeries& FieldOutput::series(std::string const& name, std::string const& extension)
{
    return series_.try_emplace(name, folder_, name, extension, resume_).first->second;
}

void FieldOutput::store(std::string const& name, std::string const& extension, Real time, std::string const& content)
{
    PvdSeries& target = series(name, extension);
    write_file_atomically(target.next_piece(), content);
    target.add(time);
}

void FieldOutput::write(GrainSnapshot const& grains)
{
    store("particles", "vtp", grains.time, encode(grain_piece(grains, grain_choice_)));
}

void FieldOutput::write(FluidSnapshot const& fluid)
{
    store("fluid", "vti", fluid.time, encode(fluid_piece(fluid, fluid_choice_)));
}

void FieldOutput::write_streamlines(FluidSnapshot const& fluid, StreamlineSettings const& settings)
{
    if (!can_trace()) return; // optional_parts() says so once
    store("streamlines", "vtp", fluid.time, encode(trace_streamlines(fluid, settings)));
}

void FieldOutput::write_walls(PolyPiece const& walls) { store("walls", "vtp", walls.time, encode(walls)); }

} // namespace arenite
