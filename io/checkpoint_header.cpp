// SPDX-License-Identifier: MIT
#include "io/checkpoint_header.hpp"

#include "io/atomic_file.hpp"
#include "io/build_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

namespace arenite {
namespace {

constexpr std::string_view first_line = "arenite checkpoint format ";
constexpr int format = 5;
constexpr std::size_t least_room = 512, most_room = 1 << 20; // a stage's name may be long

[[noreturn]] void refuse(std::filesystem::path const& path, std::string const& what)
{
    throw InputError(fmt::format("{}: {}", path.string(), what));
}

/// FNV-1a over words of eight bytes (the last one filled up with zeros): eight times as fast as over bytes, and every
/// change within one word still changes the sum.
class Checksum {
public:
    void add(char const* data, std::size_t bytes) // a multiple of 8, except at the end
    {
        for (std::size_t at = 0; at < bytes; at += 8) {
            std::uint64_t word = 0;
            std::memcpy(&word, data + at, std::min<std::size_t>(8, bytes - at));
            sum_ = (sum_ ^ word) * 0x100000001b3u;
        }
    }
    std::uint64_t sum() const { return sum_; }

private:
    std::uint64_t sum_ = 0xcbf29ce484222325u;
};

std::uint64_t checksum_of(std::string_view text)
{
    Checksum checksum;
    checksum.add(text.data(), text.size());
    return checksum.sum();
}

/// The checksum of all from `begin` on, and where the file ends; nothing if it cannot be read.
std::optional<std::pair<std::uint64_t, std::uintmax_t>> checksum_from(std::filesystem::path const& path,
                                                                      std::uintmax_t begin)
{
    std::ifstream file(path, std::ios::binary);
    file.seekg(static_cast<std::streamoff>(begin));
    Checksum checksum;
    std::vector<char> buffer(1 << 20);
    std::uintmax_t end = begin;
    while (file) {
        file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        checksum.add(buffer.data(), static_cast<std::size_t>(file.gcount()));
        end += static_cast<std::uintmax_t>(file.gcount());
    }
    if (!file.eof()) return {};
    return std::pair(checksum.sum(), end);
}

std::string header_text(CheckpointStamp const& stamp, std::uintmax_t room, std::uintmax_t bytes, std::uint64_t checksum)
{
    std::string const text =
        fmt::format("{}{}\nwritten by arenite {}\nroom {}\nbytes {}\nchecksum {:016x}\nstep {}\ntime {:016x} {}\n"
                    "stage_end {}\nscene {:016x}\nstage {} {}\n",
                    first_line, format, build_info().version, room, bytes, checksum, stamp.step,
                    std::bit_cast<std::uint64_t>(stamp.time), stamp.time, stamp.stage_end ? 1 : 0, stamp.scene_hash,
                    stamp.stage.size(), stamp.stage);
    return text + fmt::format("header {:016x}\n", checksum_of(text));
}

/// Reads the lines one after the other; any that is not as header_text writes it makes the whole invalid.
class Lines {
public:
    explicit Lines(std::string_view text) : text_(text) {}

    template <class Number> Number number(std::string_view name, int base = 10)
    {
        Number value{};
        skip(name);
        skip(" ");
        auto const [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value, base);
        valid = valid && error == std::errc();
        at_ = static_cast<std::size_t>(end - text_.data());
        return value;
    }
    std::string text(std::size_t length)
    {
        valid = valid && length <= text_.size() - at_;
        std::string const result(text_.substr(at_, valid ? length : 0));
        at_ += result.size();
        return result;
    }
    void skip(std::string_view expected)
    {
        valid = valid && text_.substr(at_, expected.size()) == expected;
        if (valid) at_ += expected.size();
    }
    void end_line() // whatever else it says
    {
        std::size_t const end = text_.find('\n', at_);
        valid = valid && end != std::string_view::npos;
        if (valid) at_ = end + 1;
    }
    std::size_t at() const { return at_; }

    bool valid = true;

private:
    std::string_view text_;
    std::size_t at_ = 0;
};

std::string beginning_of(std::filesystem::path const& path)
{
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) refuse(path, "is a folder, not a checkpoint");
    std::ifstream file(path, std::ios::binary);
    if (!file) refuse(path, fmt::format("cannot read the checkpoint: {}", std::strerror(errno)));
    std::string text(most_room, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    return text;
}

void require_our_format(std::string_view text, std::filesystem::path const& path)
{
    if (text.substr(0, 4) == "\x89HDF") refuse(path, "is not an Arenite checkpoint (an HDF5 file of another program)");
    if (text.substr(0, first_line.size()) != first_line)
        refuse(path, text.empty() ? "is not an Arenite checkpoint (the file is empty)"
                                  : "is not an Arenite checkpoint (not an HDF5 file)");
    Lines lines(text.substr(first_line.size() - 1));
    int const found = lines.number<int>("");
    lines.skip("\nwritten by ");
    std::size_t const begin = first_line.size() - 1 + lines.at(), end = text.find('\n', begin);
    if (lines.valid && found != format)
        refuse(path,
               fmt::format(
                   "has checkpoint format {}, this program reads format {}: use the version of Arenite that wrote it ({})",
                   found, format, text.substr(begin, std::min<std::size_t>(end, begin + 80) - begin)));
}

} // namespace

std::size_t header_room(CheckpointStamp const& stamp)
{
    constexpr std::size_t numbers = 400; // all lines but the stage's name, and more
    std::size_t const room = std::bit_ceil(std::max(least_room, stamp.stage.size() + numbers));
    ARENITE_REQUIRE(room <= most_room, "a stage's name of a million letters");
    return room;
}

void write_header(std::filesystem::path const& file, CheckpointStamp const& stamp, std::filesystem::path const& name)
{
    std::size_t const room = header_room(stamp);
    auto const content = checksum_from(file, room);
    if (!content)
        throw OutputError(fmt::format("{}: cannot read what was written: {}", name.string(), std::strerror(errno)));
    std::string const text = header_text(stamp, room, content->second, content->first);
    ARENITE_REQUIRE(text.size() <= room, "the header does not fit");
    std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.flush();
    if (!out) throw OutputError(fmt::format("{}: cannot finish the checkpoint: {}", name.string(), std::strerror(errno)));
}

CheckpointHeader read_header(std::filesystem::path const& path)
{
    std::string const text = beginning_of(path);
    require_our_format(text, path);
    Lines lines(text);
    CheckpointHeader header;
    lines.end_line();
    lines.end_line();
    auto const next = [&](auto& value, char const* name, int base = 10) { // of one line
        value = lines.number<std::decay_t<decltype(value)>>(name, base);
        lines.end_line();
    };
    std::uintmax_t bytes = 0;
    std::uint64_t time = 0;
    int stage_end = 0;
    next(header.room, "room");
    next(bytes, "bytes");
    next(header.checksum, "checksum", 16);
    next(header.stamp.step, "step");
    next(time, "time", 16);
    next(stage_end, "stage_end");
    next(header.stamp.scene_hash, "scene", 16);
    auto const length = lines.number<std::size_t>("stage");
    lines.skip(" ");
    header.stamp.stage = lines.text(length);
    lines.skip("\n");
    std::size_t const end = lines.at();
    auto const expected = lines.number<std::uint64_t>("header", 16);
    lines.skip("\n");
    if (!lines.valid || checksum_of(std::string_view(text).substr(0, end)) != expected ||
        header.room != header_room(header.stamp))
        refuse(path, fmt::format("the checkpoint is damaged (its header is){}", what_now));
    header.stamp.time = std::bit_cast<Real>(time);
    header.stamp.stage_end = stage_end != 0;

    std::error_code error;
    std::uintmax_t const size = std::filesystem::file_size(path, error);
    if (error) refuse(path, fmt::format("cannot read the checkpoint: {}", error.message()));
    if (size < bytes) refuse(path, fmt::format("the checkpoint is truncated ({} of {} bytes){}", size, bytes, what_now));
    if (size > bytes) refuse(path, fmt::format("the checkpoint is damaged ({} bytes, not {}){}", size, bytes, what_now));
    return header;
}

void check_content(std::filesystem::path const& path, CheckpointHeader const& header)
{
    auto const content = checksum_from(path, header.room);
    if (!content) refuse(path, fmt::format("cannot read the checkpoint: {}", std::strerror(errno)));
    if (content->first != header.checksum)
        refuse(path, fmt::format("the checkpoint is damaged (its checksum is wrong){}", what_now));
}

} // namespace arenite
