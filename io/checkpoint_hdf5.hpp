// SPDX-License-Identifier: MIT
// HDF5 handles that close themselves, and its error stack as one line. Included only where HDF5 is there.
#pragma once

#include "io/checkpoint_element.hpp"

#define H5_USE_110_API // the oldest interface that we know; later releases still have it
#include <hdf5.h>

#include <filesystem>
#include <string>
#include <utility>

namespace arenite::hdf5 {

/// An HDF5 id and the function that closes it.
class Handle {
public:
    using Close = herr_t (*)(hid_t);
    Handle() = default;
    Handle(hid_t id, Close close) : id_(id), close_(close) {}
    ~Handle() { reset(); }
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Handle& operator=(Handle&& other) noexcept
    {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }
    hid_t get() const { return id_; }
    bool valid() const { return id_ >= 0; }
    bool reset() { return !valid() || close_(std::exchange(id_, -1)) >= 0; }

private:
    hid_t id_ = -1;
    Close close_ = nullptr;
};

/// HDF5 prints its errors by default; ours are exceptions.
class Quiet {
public:
    Quiet();
    ~Quiet();
    Quiet(Quiet const&) = delete;
    Quiet& operator=(Quiet const&) = delete;

private:
    H5E_auto2_t function_ = nullptr;
    void* data_ = nullptr;
};

/// The innermost cause on HDF5's error stack.
std::string cause();

hid_t type_of(Element kind);
char const* name_of(Element kind);

} // namespace arenite::hdf5
