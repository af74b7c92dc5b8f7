// SPDX-License-Identifier: MIT
#include "io/atomic_file.hpp"
#include "io/build_info.hpp"
#include "io/checkpoint.hpp"
#include "io/checkpoint_hdf5.hpp"
#include "io/checkpoint_header.hpp"

#include <fmt/format.h>

namespace arenite {

using hdf5::Handle;

bool can_write_checkpoints() { return true; }

namespace {

/// Properties of something that does not keep its time: the same state gives the same bytes.
Handle timeless(hid_t kind)
{
    Handle properties(H5Pcreate(kind), H5Pclose);
    H5Pset_obj_track_times(properties.get(), 0);
    return properties;
}

} // namespace

struct CheckpointWriter::File {
    std::filesystem::path path;
    CheckpointStamp stamp;
    Handle handle;
    bool committed = false;

    [[noreturn]] void fail(std::string const& what) const
    {
        throw OutputError(fmt::format("{}: {}: {}", path.string(), what, hdf5::cause()));
    }
    void check(bool good, std::string const& what) const
    {
        if (!good) fail(what);
    }
    void attribute(hid_t owner, char const* name, Element kind, void const* value) const
    {
        Handle const space(H5Screate(H5S_SCALAR), H5Sclose);
        hid_t const type = hdf5::type_of(kind);
        Handle const target(H5Acreate2(owner, name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
        check(target.valid() && H5Awrite(target.get(), type, value) >= 0, fmt::format("cannot write '{}'", name));
    }
    void attribute(hid_t owner, char const* name, std::string const& value) const
    {
        Handle const space(H5Screate(H5S_SCALAR), H5Sclose);
        Handle const type(H5Tcopy(H5T_C_S1), H5Tclose);
        H5Tset_size(type.get(), value.size() + 1);
        Handle const target(H5Acreate2(owner, name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
        check(target.valid() && H5Awrite(target.get(), type.get(), value.c_str()) >= 0,
              fmt::format("cannot write '{}'", name));
    }
    void make_groups(std::string const& name) const
    {
        Handle const creation = timeless(H5P_GROUP_CREATE);
        for (std::size_t end = name.find('/'); end != std::string::npos; end = name.find('/', end + 1)) {
            std::string const group = name.substr(0, end);
            if (H5Lexists(handle.get(), group.c_str(), H5P_DEFAULT) > 0) continue;
            Handle const made(H5Gcreate2(handle.get(), group.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT), H5Gclose);
            check(made.valid(), fmt::format("cannot write '{}'", group));
        }
    }
    /// For whoever opens the file with another program; we read the header.
    void describe() const
    {
        Handle const root(H5Gopen2(handle.get(), "/", H5P_DEFAULT), H5Gclose);
        attribute(root.get(), "arenite_version", build_info().version);
        attribute(root.get(), "step", Element::int64, &stamp.step);
        attribute(root.get(), "time", Element::real64, &stamp.time);
        attribute(root.get(), "stage", stamp.stage);
    }
};

CheckpointWriter::CheckpointWriter(std::filesystem::path path, CheckpointStamp const& stamp)
    : file_(std::make_unique<File>())
{
    hdf5::Quiet const quiet;
    file_->path = std::move(path);
    file_->stamp = stamp;
    Handle const access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose), creation = timeless(H5P_FILE_CREATE);
    H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_LATEST);
    H5Pset_userblock(creation.get(), header_room(stamp));
    file_->handle =
        Handle(H5Fcreate(temporary_name(file_->path).c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
    file_->check(file_->handle.valid(), "cannot create the checkpoint");
    file_->describe();
}

CheckpointWriter::~CheckpointWriter()
{
    hdf5::Quiet const quiet;
    file_->handle.reset();
    std::error_code ignored;
    if (!file_->committed) std::filesystem::remove(temporary_name(file_->path), ignored);
}

void CheckpointWriter::write(std::string const& name, Element kind, std::vector<std::size_t> const& shape, void const* data)
{
    hdf5::Quiet const quiet;
    std::vector<hsize_t> const extents(shape.begin(), shape.end());
    hid_t const type = hdf5::type_of(kind);
    Handle const space(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose);
    file_->make_groups(name);
    Handle const creation = timeless(H5P_DATASET_CREATE);
    Handle const target(
        H5Dcreate2(file_->handle.get(), name.c_str(), type, space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
        H5Dclose);
    std::size_t const count = size_of(shape);
    bool const written =
        target.valid() && (count == 0 || H5Dwrite(target.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0);
    file_->check(written, fmt::format("cannot write '{}'", name));
}

void CheckpointWriter::commit()
{
    hdf5::Quiet const quiet;
    file_->check(H5Fflush(file_->handle.get(), H5F_SCOPE_GLOBAL) >= 0 && file_->handle.reset(),
                 "cannot finish the checkpoint");
    write_header(temporary_name(file_->path), file_->stamp, file_->path);
    publish_file(file_->path);
    file_->committed = true;
}

} // namespace arenite
