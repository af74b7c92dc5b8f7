// SPDX-License-Identifier: MIT
// The lines of text in front of a checkpoint's HDF5 part (in its user block, which HDF5 leaves to us): what the checkpoint
// belongs to, its length, and a checksum of what follows. So a damaged, truncated or foreign file is known as one before
// HDF5 looks at it (HDF5 1.10 leaks, or worse, on some damaged files), and the stamp is read without opening it.
// `head -c 300 FILE` shows it.
#pragma once

#include "io/checkpoint.hpp"

namespace arenite {

struct CheckpointHeader {
    CheckpointStamp stamp;
    std::uintmax_t room = 0;    // bytes of the header: where the HDF5 part begins
    std::uint64_t checksum = 0; // of the HDF5 part
};

/// Ends every message about a checkpoint that is damaged.
inline constexpr char const* what_now = "; it cannot be used, take an earlier checkpoint";

/// Bytes to leave in front, as HDF5 wants them: a power of two.
std::size_t header_room(CheckpointStamp const& stamp);

/// Fills the room in front of a closed HDF5 file. Throws OutputError that names `name`.
void write_header(std::filesystem::path const& file, CheckpointStamp const& stamp, std::filesystem::path const& name);

/// Throws InputError if the file cannot be read, is no checkpoint, of another format, or not as long as it was.
CheckpointHeader read_header(std::filesystem::path const& path);

/// Throws InputError if the HDF5 part is not what it was.
void check_content(std::filesystem::path const& path, CheckpointHeader const& header);

} // namespace arenite
