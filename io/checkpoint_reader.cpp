// SPDX-License-Identifier: MIT
#include "io/checkpoint.hpp"
#include "io/checkpoint_hdf5.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace arenite {

using hdf5::Handle;

struct CheckpointReader::File {
    std::filesystem::path path;
    Handle handle;
    CheckpointStamp stamp;
    std::uintmax_t size = 0; // bytes

    [[noreturn]] void fail(std::string const& what) const
    {
        throw InputError(fmt::format("{}: {}", path.string(), what));
    }

    void open();
    void read_stamp();
    Handle dataset(std::string const& name) const;
    std::vector<std::size_t> shape(hid_t dataset) const;
    Element kind(hid_t dataset, std::string const& name) const;
    void attribute(hid_t owner, char const* name, Element kind, void* value) const;
    std::string attribute_text(hid_t owner, char const* name) const;
};

namespace {

constexpr char const* what_now = "; it cannot be used, take an earlier checkpoint";

/// One value: of a list, HDF5 would write more than there is room for.
bool is_single(hid_t attribute)
{
    Handle const space(H5Aget_space(attribute), H5Sclose);
    return space.valid() && H5Sget_simple_extent_npoints(space.get()) == 1;
}

herr_t collect_names(hid_t, char const* name, H5O_info_t const* info, void* result)
{
    if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(result)->emplace_back(name);
    return 0;
}

} // namespace

void CheckpointReader::File::open()
{
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) fail("is a folder, not a checkpoint");
    if (!std::ifstream(path)) fail(fmt::format("cannot read the checkpoint: {}", std::strerror(errno)));
    size = std::filesystem::file_size(path, error);
    handle = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (handle.valid()) return;
    std::string const cause = hdf5::cause();
    if (cause.find("truncated") != std::string::npos)
        fail(fmt::format("the checkpoint is truncated ({}){}", cause, what_now));
    if (H5Fis_hdf5(path.c_str()) <= 0) fail("is not an Arenite checkpoint (not an HDF5 file)");
    fail(fmt::format("the checkpoint is damaged ({}){}", cause, what_now));
}

void CheckpointReader::File::attribute(hid_t owner, char const* name, Element kind, void* value) const
{
    Handle const source(H5Aopen(owner, name, H5P_DEFAULT), H5Aclose);
    Handle const type(source.valid() ? H5Aget_type(source.get()) : -1, H5Tclose);
    bool const good = type.valid() && is_single(source.get()) && H5Tequal(type.get(), hdf5::type_of(kind)) > 0 &&
                      H5Aread(source.get(), hdf5::type_of(kind), value) >= 0;
    if (!good) fail(fmt::format("the checkpoint is damaged (no '{}'){}", name, what_now));
}

std::string CheckpointReader::File::attribute_text(hid_t owner, char const* name) const
{
    Handle const source(H5Aopen(owner, name, H5P_DEFAULT), H5Aclose);
    Handle const type(source.valid() ? H5Aget_type(source.get()) : -1, H5Tclose);
    if (!type.valid() || H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) > 0) return {};
    if (!is_single(source.get()) || H5Tget_size(type.get()) > size) return {};
    std::string text(H5Tget_size(type.get()), '\0');
    if (H5Aread(source.get(), type.get(), text.data()) < 0) return {};
    return text.substr(0, text.find('\0'));
}

void CheckpointReader::File::read_stamp()
{
    Handle const root(H5Gopen2(handle.get(), "/", H5P_DEFAULT), H5Gclose);
    if (!root.valid()) fail(fmt::format("the checkpoint is damaged ({}){}", hdf5::cause(), what_now));
    if (attribute_text(root.get(), "format") != hdf5::format_name)
        fail("is not an Arenite checkpoint (an HDF5 file of another program)");
    std::int64_t version = 0;
    attribute(root.get(), "format_version", Element::int64, &version);
    if (version != hdf5::format_version)
        fail(fmt::format(
            "has checkpoint format {}, this program reads format {}: use the version of Arenite that wrote it ({})",
            version, hdf5::format_version, attribute_text(root.get(), "arenite_version")));
    std::uint8_t stage_end = 0;
    attribute(root.get(), "step", Element::int64, &stamp.step);
    attribute(root.get(), "time", Element::real64, &stamp.time);
    attribute(root.get(), "stage_end", Element::uint8, &stage_end);
    attribute(root.get(), "scene_hash", Element::uint64, &stamp.scene_hash);
    stamp.stage = attribute_text(root.get(), "stage");
    stamp.stage_end = stage_end != 0;
}

Handle CheckpointReader::File::dataset(std::string const& name) const
{
    Handle target(H5Dopen2(handle.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
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
    std::uintmax_t most = size;
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
    hdf5::Quiet const quiet;
    file_->path = std::move(path);
    file_->open();
    file_->read_stamp();
}

CheckpointReader::~CheckpointReader() = default;

CheckpointStamp const& CheckpointReader::stamp() const { return file_->stamp; }

void CheckpointReader::require_scene(std::uint64_t hash) const
{
    if (hash == file_->stamp.scene_hash) return;
    file_->fail(fmt::format(
        "was written for another scene: what made the state differs from this scene, or the files that the scenes "
        "name do (hash {:016x}, this scene's {:016x}); only stages that have not begun, the duration and end of the stage "
        "in progress and the output may change",
        file_->stamp.scene_hash, hash));
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
    if (H5Ovisit(file_->handle.get(), H5_INDEX_NAME, H5_ITER_INC, collect_names, &result) < 0)
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
        file_->fail(fmt::format("the array '{}' has shape [{}], expected {} along axis {}", name,
                                fmt::join(extents, ", "), expected, axis));
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
    std::uint64_t expected = 0;
    file_->attribute(source.get(), "fnv1a", Element::uint64, &expected);
    if (hdf5::checksum(target, count * H5Tget_size(type)) != expected)
        file_->fail(fmt::format("the array '{}' is damaged (its checksum is wrong){}", name, what_now));
}

void CheckpointReader::verify() const
{
    hdf5::Quiet const quiet;
    std::vector<char> buffer;
    for (auto const& name : names()) {
        Handle const source = file_->dataset(name);
        std::size_t const size =
            size_of(file_->shape(source.get())) * H5Tget_size(hdf5::type_of(file_->kind(source.get(), name)));
        if (H5Dget_storage_size(source.get()) != size)
            file_->fail(fmt::format("the array '{}' is damaged (its size is wrong){}", name, what_now));
        buffer.resize(size);
        read(name, buffer.data());
    }
}

} // namespace arenite
