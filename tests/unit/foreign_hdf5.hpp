// SPDX-License-Identifier: MIT
// HDF5 files that Arenite must refuse.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>

namespace arenite::test {

inline void write_foreign_hdf5(std::filesystem::path const& path)
{
    H5Fclose(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
}

inline void set_format_version(std::filesystem::path const& path, std::int64_t version)
{
    hid_t const file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    hid_t const attribute = H5Aopen(file, "format_version", H5P_DEFAULT);
    H5Awrite(attribute, H5T_NATIVE_INT64, &version);
    H5Aclose(attribute);
    H5Fclose(file);
}

} // namespace arenite::test
