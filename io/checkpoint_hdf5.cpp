// SPDX-License-Identifier: MIT
#include "io/checkpoint_hdf5.hpp"

namespace arenite::hdf5 {
namespace {

herr_t keep_first(unsigned, H5E_error2_t const* error, void* result)
{
    auto& text = *static_cast<std::string*>(result);
    if (text.empty() && error->desc != nullptr) text = error->desc;
    return 0;
}

} // namespace

Quiet::Quiet()
{
    // A file that a full disk keeps from being closed would make HDF5 complain once more at exit.
    [[maybe_unused]] static herr_t const no_cleanup_at_exit = H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Quiet::~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

std::string cause()
{
    std::string text;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &text);
    return text.empty() ? "unknown HDF5 error" : text;
}

hid_t type_of(Element kind)
{
    switch (kind) {
    case Element::real64:
        return H5T_IEEE_F64LE;
    case Element::real32:
        return H5T_IEEE_F32LE;
    case Element::int8:
        return H5T_STD_I8LE;
    case Element::int16:
        return H5T_STD_I16LE;
    case Element::int32:
        return H5T_STD_I32LE;
    case Element::int64:
        return H5T_STD_I64LE;
    case Element::uint8:
        return H5T_STD_U8LE;
    case Element::uint16:
        return H5T_STD_U16LE;
    case Element::uint32:
        return H5T_STD_U32LE;
    case Element::uint64:
        return H5T_STD_U64LE;
    case Element::text:
        return H5T_STD_B8LE; // bytes: text may hold anything, and be empty
    }
    return -1;
}

char const* name_of(Element kind)
{
    static constexpr char const* names[] = {"real64", "real32", "int8",   "int16",  "int32", "int64",
                                            "uint8",  "uint16", "uint32", "uint64", "text"};
    return names[static_cast<int>(kind)];
}

} // namespace arenite::hdf5
