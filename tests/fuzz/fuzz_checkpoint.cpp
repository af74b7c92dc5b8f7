// SPDX-License-Identifier: MIT
// The checkpoint reader, from a file in memory (/dev/shm) where there is one. What verify() accepts must be readable in
// the types that it says it has.
#include "core/error.hpp"
#include "io/checkpoint.hpp"
#include "tests/fuzz/fuzz.hpp"

#include <filesystem>
#include <fstream>
#include <unistd.h>

using namespace arenite;

namespace {

std::string scratch_file()
{
    namespace fs = std::filesystem;
    std::error_code error;
    fs::path const memory = "/dev/shm", folder = fs::is_directory(memory, error) ? memory : fs::temp_directory_path();
    static std::string path;
    path = (folder / ("arenite-fuzz-" + std::to_string(::getpid()) + ".h5")).string();
    std::atexit([] { std::remove(path.c_str()); });
    return path;
}

/// As one type, and as another that it most likely is not.
template <class T> void read_as(CheckpointReader const& in, std::string const& name)
{
    try {
        FUZZ_REQUIRE(in.array<T>(name).size() == size_of(in.shape(name)));
    } catch (InputError const&) {
    }
}

void read_everything(CheckpointReader const& in)
{
    in.verify();
    for (std::string const& name : in.names()) {
        FUZZ_REQUIRE(in.has(name));
        read_as<Real>(in, name);
        read_as<int>(in, name);
        try {
            in.text(name);
        } catch (InputError const&) {
        }
    }
    in.require_scene(in.stamp().scene_hash);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size)
{
    static std::string const path = scratch_file();
    std::ofstream(path, std::ios::binary).write(reinterpret_cast<char const*>(data), static_cast<std::streamsize>(size));
    try {
        read_everything(CheckpointReader(path));
    } catch (InputError const&) {
    }
    return 0;
}
