// SPDX-License-Identifier: MIT
// HDF5 files that Arenite must refuse, and checkpoints changed behind its back.
#pragma once

#include "io/checkpoint_header.hpp"

#include <hdf5.h>

#include <filesystem>

namespace arenite::test {

inline void write_foreign_hdf5(std::filesystem::path const& path)
{
    H5Fclose(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
}

/// Adds an array that has a shape and no content, of far more bytes than the file.
inline void add_announced_array(std::filesystem::path const& path, char const* name)
{
    CheckpointStamp const stamp = CheckpointReader(path).stamp();
    hid_t const file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    hsize_t const extent = hsize_t(1) << 40;
    hid_t const space = H5Screate_simple(1, &extent, nullptr);
    H5Dclose(H5Dcreate2(file, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    H5Sclose(space);
    H5Fclose(file);
    write_header(path, stamp, path); // as if nothing had happened
}

} // namespace arenite::test
