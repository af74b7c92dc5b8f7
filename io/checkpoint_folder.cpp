// SPDX-License-Identifier: MIT
#include "io/checkpoint_folder.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace arenite {
namespace {

namespace fs = std::filesystem;

/// The step in a checkpoint's name; none for any other file.
std::optional<std::int64_t> step_in_name(fs::path const& path)
{
    std::string const name = path.filename().string(), head = "checkpoint-", tail = ".h5";
    if (name.size() <= head.size() + tail.size() || !name.starts_with(head) || !name.ends_with(tail)) return {};
    std::int64_t step = 0;
    char const* const end = name.data() + name.size() - tail.size();
    auto const [stop, error] = std::from_chars(name.data() + head.size(), end, step);
    if (error != std::errc() || stop != end || step < 0) return {};
    return step;
}

bool ends_stage_or_unreadable(fs::path const& path)
{
    try {
        return CheckpointReader(path).stamp().stage_end;
    } catch (InputError const&) {
        return true;
    }
}

void remove_quietly(fs::path const& path)
{
    std::error_code ignored; // a checkpoint too many does no harm
    fs::remove(path, ignored);
}

} // namespace

fs::path checkpoint_path(fs::path const& folder, std::int64_t step)
{
    return folder / fmt::format("checkpoint-{:09}.h5", step);
}

std::vector<fs::path> list_checkpoints(fs::path const& folder)
{
    std::vector<fs::path> paths;
    std::error_code error;
    for (auto const& entry : fs::directory_iterator(folder, error))
        if (step_in_name(entry.path())) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end(), [](auto const& a, auto const& b) { return *step_in_name(a) < *step_in_name(b); });
    return paths;
}

std::optional<fs::path> latest_checkpoint(fs::path const& folder, ExpectedHash const& expected,
                                          std::vector<std::string>& messages)
{
    auto const paths = list_checkpoints(folder);
    for (auto path = paths.rbegin(); path != paths.rend(); ++path) {
        try {
            CheckpointReader const reader(*path);
            reader.require_scene(expected(reader.stamp()));
            reader.verify();
            return *path;
        } catch (InputError const& fault) {
            messages.emplace_back(fault.what());
        }
    }
    return {};
}

void prune_checkpoints(fs::path const& folder, int keep)
{
    auto const paths = list_checkpoints(folder);
    int kept = 0;
    for (auto path = paths.rbegin(); path != paths.rend(); ++path)
        if (!ends_stage_or_unreadable(*path) && kept++ >= keep) remove_quietly(*path);
}

void drop_checkpoints_after(fs::path const& folder, std::int64_t step)
{
    for (auto const& path : list_checkpoints(folder))
        if (*step_in_name(path) > step) remove_quietly(path);
}

} // namespace arenite
