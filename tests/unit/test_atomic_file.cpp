// SPDX-License-Identifier: MIT
#include "io/atomic_file.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <unistd.h>

namespace arenite {
namespace {

namespace fs = std::filesystem;
using test::contains;
using test::content_of;
using test::message_of;

TEST(AtomicFile, ReplacesTheContentAndLeavesNothingBeside)
{
    test::ScratchFolder const folder;
    std::string const binary("a\0b\n", 4);
    write_file_atomically(folder / "file", "first");
    write_file_atomically(folder / "file", binary);
    EXPECT_EQ(content_of(folder / "file"), binary);
    EXPECT_EQ(read_file(folder / "file"), binary);
    EXPECT_FALSE(fs::exists(temporary_name(folder / "file")));
}

TEST(AtomicFile, WhatAKilledRunLeftUnfinishedIsRemoved)
{
    test::ScratchFolder const folder;
    test::put(folder / "file", "kept");
    test::put(folder / "notes.tmp", "the user's");
    test::put(temporary_name(folder / "file"), "half");
    remove_unfinished(folder.path());
    EXPECT_FALSE(fs::exists(temporary_name(folder / "file")));
    EXPECT_EQ(content_of(folder / "file"), "kept");
    EXPECT_TRUE(fs::exists(folder / "notes.tmp"));
}

TEST(AtomicFile, AFullDiskKeepsTheOldFileAndNamesFileAndCause)
{
    test::ScratchFolder const folder;
    fs::path const path = folder / "results.csv";
    write_file_atomically(path, "old");
    fs::create_symlink("/dev/full", temporary_name(path)); // what is written there finds no space
    auto const message = message_of<OutputError>([&] { write_file_atomically(path, "new"); });
    EXPECT_TRUE(contains(message, path.string()));
    EXPECT_TRUE(contains(message, "No space left on device"));
    EXPECT_EQ(content_of(path), "old");
    EXPECT_FALSE(fs::exists(fs::symlink_status(temporary_name(path))));
}

TEST(AtomicFile, AMissingOrImpossibleFolderIsNamed)
{
    test::ScratchFolder const folder;
    auto const missing = message_of<OutputError>([&] { write_file_atomically(folder / "no/such/file", "x"); });
    EXPECT_TRUE(contains(missing, "no/such/file"));
    EXPECT_TRUE(contains(missing, "No such file or directory"));
    test::put(folder / "plain", "x");
    auto const impossible = message_of<OutputError>([&] { make_folder(folder / "plain/sub"); });
    EXPECT_TRUE(contains(impossible, "plain/sub"));
    EXPECT_TRUE(contains(impossible, "Not a directory"));
}

TEST(AtomicFile, AnUnwritableFolderIsNamed)
{
    test::ScratchFolder const folder;
    fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
    bool const root = ::access(folder.path().c_str(), W_OK) == 0; // root may write everywhere
    if (!root) {
        auto const message = message_of<OutputError>([&] { write_file_atomically(folder / "file", "x"); });
        EXPECT_TRUE(contains(message, "Permission denied"));
    }
    fs::permissions(folder.path(), fs::perms::owner_all);
    if (root) GTEST_SKIP() << "this user may write into any folder";
}

TEST(AtomicFile, ReadingNamesTheCause)
{
    test::ScratchFolder const folder;
    EXPECT_TRUE(contains(message_of<InputError>([&] { read_file(folder / "none"); }), "No such file"));
    EXPECT_TRUE(contains(message_of<InputError>([&] { read_file(folder.path()); }), "Is a directory"));
}

TEST(AppendedFile, GrowsAndReportsAFullDisk)
{
    test::ScratchFolder const folder;
    test::put(folder / "log", "a");
    AppendedFile file(folder / "log");
    file.append("b");
    file.sync();
    EXPECT_EQ(content_of(folder / "log"), "ab");
    AppendedFile full("/dev/full");
    auto const message = message_of<OutputError>([&] { full.append("x"); });
    EXPECT_TRUE(contains(message, "/dev/full: cannot write: No space left on device"));
}

} // namespace
} // namespace arenite
