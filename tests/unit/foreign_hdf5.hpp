// SPDX-License-Identifier: MIT
// HDF5 files that Arenite must refuse.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <vector>

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

/// Says that it is ours, but its "step" is a list: whoever reads it as one number writes past its end.
inline void write_hdf5_with_listed_step(std::filesystem::path const& path)
{
    hid_t const file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    auto const attribute = [&](char const* name, hid_t type, hsize_t count, void const* values) {
        hid_t const space = H5Screate_simple(1, &count, nullptr);
        hid_t const target = H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
        H5Awrite(target, type, values);
        H5Aclose(target);
        H5Sclose(space);
    };
    hid_t const text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, 19);
    attribute("format", text, 1, "arenite checkpoint");
    std::vector<std::int64_t> const steps(1000, 1);
    attribute("format_version", H5T_STD_I64LE, 1, steps.data());
    attribute("step", H5T_STD_I64LE, steps.size(), steps.data());
    H5Tclose(text);
    H5Fclose(file);
}

/// Adds an array that has a shape and no content, of far more bytes than the file.
inline void add_announced_array(std::filesystem::path const& path, char const* name)
{
    hid_t const file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    hsize_t const extent = hsize_t(1) << 40;
    hid_t const space = H5Screate_simple(1, &extent, nullptr);
    H5Dclose(H5Dcreate2(file, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    H5Sclose(space);
    H5Fclose(file);
}

} // namespace arenite::test
