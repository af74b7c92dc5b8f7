// SPDX-License-Identifier: MIT
#include "io/checkpoint.hpp"
#include "io/checkpoint_hdf5.hpp"
#include "io/checkpoint_header.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace arenite {

using hdf5::Handle;

struct CheckpointReader::File {
    std::filesystem::path path;
    CheckpointHeader header;
    Handle handle; // only once the content is known to be whole

    [[noreturn]] void fail(std::string const& what) const { throw InputError(fmt::format("{}: {}", path.string(), what)); }

    hid_t opened();
    Handle dataset(std::string const& name);
    std::vector<std::size_t> shape(hid_t dataset) const;
    Element kind(hid_t dataset, std::string const& name) const;
};

namespace {

herr_t collect_names(hid_t, char const* name, H5O_info_t const* info, void* result)
{
    if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(result)->emplace_back(name);
    return 0;
}

} // namespace

hid_t CheckpointReader::File::opened()
{
    if (handle.valid()) return handle.get();
    check_content(path, header);
    handle = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!handle.valid()) fail(fmt::format("the checkpoint is damaged ({}){}", hdf5::cause(), what_now));
    return handle.get();
}

Handle CheckpointReader::File::dataset(std::string const& name)
{
    Handle target(H5Dopen2(opened(), name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!target.valid()) fail(fmt::format("the checkpoint has no array '{}'", name));
    return target;
}

std::vector<std::size_t> CheckpointReader::File::shape(hid_t dataset) const
{
    Handle const space(H5Dget_space(dataset), H5Sclose);
    int const rank = space.valid() ? H5Sget_simple_extent_ndims(space.get()) : -1;
    if (rank < 0) fail(fmt::format("the checkpoint is damaged ({}){}", hdf5::cause(), what_now));
    std::vector<hsize_t> extents(rank);
    H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr);
    // What is announced is not asked for before it is known to be there.
    std::error_code error;
    std::uintmax_t most = std::filesystem::file_size(path, error);
    for (hsize_t const extent : extents) {
        if (extent > most) fail(fmt::format("the checkpoint is damaged (an array larger than the file){}", what_now));
        if (extent > 0) most /= extent;
    }
    return {extents.begin(), extents.end()};
}

Element CheckpointReader::File::kind(hid_t dataset, std::string const& name) const
{
    Handle const type(H5Dget_type(dataset), H5Tclose);
    for (int kind = 0; kind <= static_cast<int>(Element::text); ++kind)
        if (type.valid() && H5Tequal(type.get(), hdf5::type_of(Element(kind))) > 0) return Element(kind);
    fail(fmt::format("the array '{}' has a type that no checkpoint has{}", name, what_now));
}

CheckpointReader::CheckpointReader(std::filesystem::path path) : file_(std::make_unique<File>())
{
    file_->path = std::move(path);
    file_->header = read_header(file_->path);
}

CheckpointReader::~CheckpointReader() = default;

CheckpointStamp const& CheckpointReader::stamp() const { return file_->header.stamp; }

void CheckpointReader::require_scene(std::uint64_t hash) const
{
    if (hash == file_->header.stamp.scene_hash) return;
    if (hash == 0)
        file_->fail(
            fmt::format("was written in the stage \"{}\", which this scene does not have", file_->header.stamp.stage));
    file_->fail(fmt::format(
        "was written for another scene: what made the state differs from this scene, or the files that the scenes "
        "name do (hash {:016x}, this scene's {:016x}); only stages that have not begun, the duration and end of the stage "
        "in progress and the output may change",
        file_->header.stamp.scene_hash, hash));
}

bool CheckpointReader::has(std::string const& name) const
{
    hdf5::Quiet const quiet;
    auto const all = names();
    return std::binary_search(all.begin(), all.end(), name);
}

std::vector<std::string> CheckpointReader::names() const
{
    hdf5::Quiet const quiet;
    std::vector<std::string> result;
    if (H5Ovisit(file_->opened(), H5_INDEX_NAME, H5_ITER_INC, collect_names, &result) < 0)
        file_->fail(fmt::format("the checkpoint is damaged ({}){}", hdf5::cause(), what_now));
    std::sort(result.begin(), result.end());
    return result;
}

std::vector<std::size_t> CheckpointReader::shape(std::string const& name) const
{
    hdf5::Quiet const quiet;
    return file_->shape(file_->dataset(name).get());
}

std::vector<std::size_t> CheckpointReader::shape_checked(std::string const& name, Element kind, std::size_t rank) const
{
    hdf5::Quiet const quiet;
    Handle const source = file_->dataset(name);
    Element const found = file_->kind(source.get(), name);
    if (found != kind)
        file_->fail(
            fmt::format("the array '{}' is of type {}, expected {}", name, hdf5::name_of(found), hdf5::name_of(kind)));
    auto const extents = file_->shape(source.get());
    if (extents.size() != rank)
        file_->fail(fmt::format("the array '{}' has rank {}, expected {}", name, extents.size(), rank));
    return extents;
}

void CheckpointReader::require_extent(std::string const& name, std::size_t axis, std::size_t expected) const
{
    auto const extents = shape(name);
    if (extents[axis] != expected)
        file_->fail(fmt::format("the array '{}' has shape [{}], expected {} along axis {}", name, fmt::join(extents, ", "),
                                expected, axis));
}

void CheckpointReader::require_one(std::string const& name, std::size_t found) const
{
    if (found != 1) file_->fail(fmt::format("'{}' has {} values, expected one", name, found));
}

void CheckpointReader::read(std::string const& name, void* target) const
{
    hdf5::Quiet const quiet;
    Handle const source = file_->dataset(name);
    hid_t const type = hdf5::type_of(file_->kind(source.get(), name));
    std::size_t const count = size_of(file_->shape(source.get()));
    if (count > 0 && H5Dread(source.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, target) < 0)
        file_->fail(fmt::format("cannot read '{}': {}", name, hdf5::cause()));
}

void CheckpointReader::verify() const
{
    hdf5::Quiet const quiet;
    file_->opened();
}

} // namespace arenite
