// SPDX-License-Identifier: MIT
// Built where HDF5 is left out.
#include "io/atomic_file.hpp"
#include "io/checkpoint.hpp"

namespace arenite {
namespace {

constexpr char const* left_out = ": this build of Arenite has no HDF5, so it neither writes nor reads checkpoints; "
                                 "configure it with ARENITE_ENABLE_HDF5=ON";

} // namespace

bool can_write_checkpoints() { return false; }

struct CheckpointWriter::File {};
struct CheckpointReader::File {};

CheckpointWriter::CheckpointWriter(std::filesystem::path path, CheckpointStamp const&)
{
    throw OutputError(path.string() + left_out);
}
CheckpointWriter::~CheckpointWriter() = default;
void CheckpointWriter::write(std::string const&, Element, std::vector<std::size_t> const&, void const*) {}
void CheckpointWriter::commit() {}

CheckpointReader::CheckpointReader(std::filesystem::path path) { throw InputError(path.string() + left_out); }
CheckpointReader::~CheckpointReader() = default;
CheckpointStamp const& CheckpointReader::stamp() const
{
    fail_requirement("HDF5", "there is no reader", __FILE__, __LINE__);
}
void CheckpointReader::require_scene(std::uint64_t) const {}
bool CheckpointReader::has(std::string const&) const { return false; }
std::vector<std::string> CheckpointReader::names() const { return {}; }
std::vector<std::size_t> CheckpointReader::shape(std::string const&) const { return {}; }
std::vector<std::size_t> CheckpointReader::shape_checked(std::string const&, Element, std::size_t rank) const
{
    return std::vector<std::size_t>(rank, 0);
}
void CheckpointReader::require_extent(std::string const&, std::size_t, std::size_t) const {}
void CheckpointReader::require_one(std::string const&, std::size_t) const {}
void CheckpointReader::read(std::string const&, void*) const {}
void CheckpointReader::verify() const {}

} // namespace arenite
