// SPDX-License-Identifier: MIT
// The checkpoints of a run's folder: their names, which of them stay, and which one to go on from.
#pragma once

#include "io/checkpoint.hpp"

#include <functional>
#include <optional>

namespace arenite {

/// checkpoint-000012345.h5; the names sort by step.
std::filesystem::path checkpoint_path(std::filesystem::path const& folder, std::int64_t step);

/// Those in the folder, by step.
std::vector<std::filesystem::path> list_checkpoints(std::filesystem::path const& folder);

/// The hash that a checkpoint with this stamp has if it belongs to the scene at hand.
using ExpectedHash = std::function<std::uint64_t(CheckpointStamp const&)>;

/// The newest one that is whole and belongs to the scene. Every one that is passed over adds its fault to
/// `messages`.
std::optional<std::filesystem::path> latest_checkpoint(std::filesystem::path const& folder, ExpectedHash const& expected,
                                                       std::vector<std::string>& messages);

/// Deletes all but the last `keep` of those that do not end a stage. Unreadable ones are left alone.
void prune_checkpoints(std::filesystem::path const& folder, int keep = 2);

/// Deletes those of later steps: the run went on from an earlier one, they are of another future.
void drop_checkpoints_after(std::filesystem::path const& folder, std::int64_t step);

} // namespace arenite
