// SPDX-License-Identifier: MIT
// Files that appear whole or not at all: written beside their name, synced to the disk, then renamed.
// Whatever goes wrong names the file and the system's own cause, and leaves an older file as it was.
#pragma once

#include "core/error.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace arenite {

/// A result cannot be stored (full disk, unwritable folder). The run cannot go on.
struct OutputError : SimulationError {
    using SimulationError::SimulationError;
};

/// Replaces the file with the content, or throws OutputError and leaves it alone.
void write_file_atomically(std::filesystem::path const& path, std::string_view content);

/// Where a file is written before it gets its name: beside it, with an ending that no other program uses.
std::filesystem::path temporary_name(std::filesystem::path const& path);

/// Deletes what a killed run left under temporary names in the folder (not in folders below it).
void remove_unfinished(std::filesystem::path const& folder);

/// Syncs the file that was written under temporary_name(path) and gives it its name.
void publish_file(std::filesystem::path const& path);

/// The whole file. Throws InputError if it cannot be read.
std::string read_file(std::filesystem::path const& path);

/// Creates the folder and its parents. Throws OutputError with the cause.
void make_folder(std::filesystem::path const& folder);

/// A file that grows at its end; every byte is written or an OutputError says why not.
class AppendedFile {
public:
    AppendedFile() = default;
    explicit AppendedFile(std::filesystem::path path); // must exist
    bool is_open() const { return descriptor_ >= 0; }
    ~AppendedFile();
    AppendedFile(AppendedFile&& other) noexcept;
    AppendedFile& operator=(AppendedFile&& other) noexcept;

    void append(std::string_view text);
    void sync(); // to the disk: survives a kill and a power failure

private:
    std::filesystem::path path_;
    int descriptor_ = -1;
};

} // namespace arenite
