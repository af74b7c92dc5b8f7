// SPDX-License-Identifier: MIT
#include "io/atomic_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <unistd.h>
#include <utility>

namespace arenite {
namespace {

namespace fs = std::filesystem;

constexpr char const* unfinished = ".unfinished";

[[noreturn]] void fail(fs::path const& path, char const* what, int error)
{
    throw OutputError(fmt::format("{}: {}: {}", path.string(), what, std::strerror(error)));
}

void write_all(int descriptor, std::string_view text, fs::path const& path)
{
    while (!text.empty()) {
        ssize_t const written = ::write(descriptor, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(path, "cannot write", errno);
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

/// A rename is on the disk only when its folder is. Folders of some network file systems refuse to be
/// synced (EINVAL); there is nothing better to do for them.
void sync_folder(fs::path const& folder)
{
    int const descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY);
    if (descriptor < 0) return;
    int const error = ::fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno;
    ::close(descriptor);
    if (error != 0) fail(folder, "cannot sync the folder", error);
}

class Descriptor {
public:
    Descriptor(fs::path const& path, int flags) : value(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
    ~Descriptor()
    {
        if (value >= 0) ::close(value);
    }
    Descriptor(Descriptor const&) = delete;
    Descriptor& operator=(Descriptor const&) = delete;

    int value;
};

void write_temporary(fs::path const& path, std::string_view content)
{
    Descriptor const file(temporary_name(path), O_WRONLY | O_CREAT | O_TRUNC);
    if (file.value < 0) fail(path, "cannot create", errno);
    write_all(file.value, content, path);
}

} // namespace

fs::path temporary_name(fs::path const& path) { return path.string() + unfinished; }

void remove_unfinished(fs::path const& folder)
{
    std::error_code ignored; // one that stays does no harm
    for (auto const& entry : fs::directory_iterator(folder, ignored))
        if (entry.path().extension() == unfinished) fs::remove(entry.path(), ignored);
}

void publish_file(fs::path const& path)
{
    fs::path const temporary = temporary_name(path);
    {
        Descriptor const file(temporary, O_RDONLY);
        if (file.value < 0) fail(path, "cannot open what was written", errno);
        if (::fsync(file.value) != 0) fail(path, "cannot write to the disk", errno);
    }
    if (::rename(temporary.c_str(), path.c_str()) != 0) fail(path, "cannot rename", errno);
    sync_folder(path.parent_path());
}

void write_file_atomically(fs::path const& path, std::string_view content)
{
    try {
        write_temporary(path, content);
        publish_file(path);
    } catch (OutputError const&) {
        std::error_code ignored; // the first fault is the one to report
        fs::remove(temporary_name(path), ignored);
        throw;
    }
}

std::string read_file(fs::path const& path)
{
    std::error_code error;
    bool const is_folder = fs::is_directory(path, error);
    std::ifstream stream(path, std::ios::binary);
    if (is_folder || !stream)
        throw InputError(fmt::format("{}: cannot read: {}", path.string(), std::strerror(is_folder ? EISDIR : errno)));
    std::ostringstream content;
    content << stream.rdbuf();
    return std::move(content).str();
}

void make_folder(fs::path const& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw OutputError(fmt::format("{}: cannot create the folder: {}", folder.string(), error.message()));
}

AppendedFile::AppendedFile(fs::path path)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC))
{
    if (descriptor_ < 0) fail(path_, "cannot open", errno);
}

AppendedFile::~AppendedFile()
{
    if (descriptor_ >= 0) ::close(descriptor_);
}

AppendedFile::AppendedFile(AppendedFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1))
{
}

AppendedFile& AppendedFile::operator=(AppendedFile&& other) noexcept
{
    std::swap(path_, other.path_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

void AppendedFile::append(std::string_view text) { write_all(descriptor_, text, path_); }

void AppendedFile::sync()
{
    // A device or a pipe has nothing to sync; the rest must reach the disk.
    if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail(path_, "cannot write to the disk", errno);
}

} // namespace arenite
