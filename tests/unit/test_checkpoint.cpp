// SPDX-License-Identifier: MIT
#include "io/atomic_file.hpp"
#include "io/checkpoint_folder.hpp"
#include "tests/unit/foreign_hdf5.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace arenite {
namespace {

namespace fs = std::filesystem;
using test::contains;
using test::content_of;
using test::message_of;

constexpr std::uint64_t scene_hash = 0xfedcba9876543210u; // does not fit a signed integer

fs::path write_small(fs::path const& folder, std::int64_t step, bool stage_end = false)
{
    fs::path const path = checkpoint_path(folder, step);
    CheckpointWriter out(path, {step, 0.5 * static_cast<double>(step), "pull \xc3\xa9", stage_end, scene_hash});
    out.array("particles/x", std::vector<Real>{1, 2, 3});
    out.value("fluid/time", Real(0.25));
    out.commit();
    return path;
}

template <class T> void expect_round_trip(std::vector<T> const& values)
{
    test::ScratchFolder const folder;
    CheckpointWriter out(folder / "c.h5", {});
    out.array("deep/in/a", values);
    out.commit();
    auto const read = CheckpointReader(folder / "c.h5").array<T>("deep/in/a");
    ASSERT_EQ(read.size(), values.size());
    if (!values.empty()) { EXPECT_EQ(std::memcmp(read.data(), values.data(), values.size() * sizeof(T)), 0); }
}

TEST(Checkpoint, EveryTypeComesBackBitForBit)
{
    using Limits = std::numeric_limits<Real>;
    Real const odd_nan = std::bit_cast<Real>(std::uint64_t(0x7ff8dead0000beef));
    expect_round_trip<Real>({0.0, -0.0, 1.0 / 3, Limits::denorm_min(), Limits::infinity(), -Limits::infinity(), odd_nan});
    expect_round_trip<float>({-0.0f, 1.0f / 3});
    expect_round_trip<std::int8_t>({-128, 127});
    expect_round_trip<std::uint8_t>({0, 255});
    expect_round_trip<std::int16_t>({-32768, 32767});
    expect_round_trip<std::uint16_t>({65535});
    expect_round_trip<int>({std::numeric_limits<int>::min(), std::numeric_limits<int>::max()});
    expect_round_trip<std::uint32_t>({4294967295u});
    expect_round_trip<std::int64_t>({std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()});
    expect_round_trip<std::uint64_t>({std::numeric_limits<std::uint64_t>::max()});
    expect_round_trip<Real>({});
}

enum class Colour : std::uint8_t { red = 1, blue = 200 };

TEST(Checkpoint, ValuesTextEnumsAndStampComeBack)
{
    test::ScratchFolder const folder;
    std::string const text("zero\0 and \xc3\xbc\n", 12);
    CheckpointWriter out(folder / "c.h5", {123456789012, -0.0, "pull", true, scene_hash});
    out.value("n", std::int64_t(-5));
    out.text("scene", text);
    out.text("empty", "");
    out.array("colours", std::vector<Colour>{Colour::red, Colour::blue});
    out.commit();
    CheckpointReader const in(folder / "c.h5");
    EXPECT_EQ(in.value<std::int64_t>("n"), -5);
    EXPECT_EQ(in.text("scene"), text);
    EXPECT_EQ(in.text("empty"), "");
    EXPECT_EQ(in.array<Colour>("colours"), (std::vector<Colour>{Colour::red, Colour::blue}));
    EXPECT_EQ(in.stamp().step, 123456789012);
    EXPECT_TRUE(std::signbit(in.stamp().time));
    EXPECT_EQ(in.stamp().stage, "pull");
    EXPECT_TRUE(in.stamp().stage_end);
    EXPECT_EQ(in.stamp().scene_hash, scene_hash);
    EXPECT_EQ(in.names(), (std::vector<std::string>{"colours", "empty", "n", "scene"}));
    EXPECT_TRUE(in.has("n"));
    EXPECT_FALSE(in.has("m"));
}

template <class ViewType> void fill(ViewType const& view)
{
    auto const host = Kokkos::create_mirror_view(view);
    Real next = 1;
    for (std::size_t i = 0; i < view.extent(0); ++i)
        for (std::size_t j = 0; j < view.extent(1); ++j)
            for (std::size_t k = 0; k < view.extent(2); ++k) host.access(i, j, k) = next++;
    Kokkos::deep_copy(view, host);
}

template <class ViewType> void expect_view_round_trip(ViewType const& view)
{
    test::ScratchFolder const folder;
    fill(view);
    CheckpointWriter out(folder / "c.h5", {});
    out.array("v", view);
    out.commit();
    ViewType read;
    CheckpointReader(folder / "c.h5").view("v", read);
    ASSERT_EQ(read.size(), view.size());
    auto const expected = Kokkos::create_mirror_view_and_copy(HostSpace(), view);
    auto const found = Kokkos::create_mirror_view_and_copy(HostSpace(), read);
    for (std::size_t i = 0; i < view.extent(0); ++i)
        for (std::size_t j = 0; j < view.extent(1); ++j)
            for (std::size_t k = 0; k < view.extent(2); ++k) EXPECT_EQ(found.access(i, j, k), expected.access(i, j, k));
}

TEST(Checkpoint, DeviceViewsOfEveryRankComeBackInTheirOwnLayout)
{
    expect_view_round_trip(View1<Real>("v", 5));
    expect_view_round_trip(View1<std::int16_t>("v", 5));
    expect_view_round_trip(RecordView("v", 7));
    expect_view_round_trip(FieldView("v", 2, 3, 4));
    expect_view_round_trip(Kokkos::View<int* [2][3], MemorySpace>("v", 4));
    expect_view_round_trip(View1<Real>("v", 0));
}

TEST(Checkpoint, RowsInTheFileHaveTheLastIndexFastestWhateverTheLayout)
{
    test::ScratchFolder const folder;
    FieldView const field("f", 2, 3, 4);
    fill(field);
    CheckpointWriter out(folder / "c.h5", {});
    out.array("f", field);
    out.commit();
    CheckpointReader const in(folder / "c.h5");
    EXPECT_EQ(in.shape("f"), (std::vector<std::size_t>{2, 3, 4}));
    Kokkos::View<Real***, Kokkos::LayoutRight, HostSpace> rows;
    in.view("f", rows);
    for (int n = 0; n < 24; ++n) EXPECT_EQ(rows.data()[n], n + 1);
}

TEST(Checkpoint, AnotherTypeRankShapeOrNameIsNamed)
{
    test::ScratchFolder const folder;
    CheckpointReader const in(write_small(folder.path(), 1));
    EXPECT_TRUE(contains(message_of<InputError>([&] { in.array<int>("particles/x"); }),
                         "'particles/x' is of type real64, expected int32"));
    EXPECT_TRUE(contains(message_of<InputError>([&] { in.array<Real>("nothing"); }), "no array 'nothing'"));
    EXPECT_TRUE(contains(message_of<InputError>([&] { in.value<Real>("particles/x"); }), "has 3 values, expected one"));
    RecordView records;
    EXPECT_TRUE(contains(message_of<InputError>([&] { in.view("particles/x", records); }), "rank 1, expected 2"));
    CheckpointWriter out(folder / "d.h5", {});
    out.array("r", Kokkos::View<Real* [3], MemorySpace>("r", 2));
    out.commit();
    EXPECT_TRUE(contains(message_of<InputError>([&] { CheckpointReader(folder / "d.h5").view("r", records); }),
                         "shape [2, 3], expected 4 along axis 1"));
}

TEST(Checkpoint, AnotherSceneIsRefused)
{
    test::ScratchFolder const folder;
    CheckpointReader const in(write_small(folder.path(), 1));
    EXPECT_NO_THROW(in.require_scene(scene_hash));
    EXPECT_TRUE(contains(message_of<InputError>([&] { in.require_scene(1); }), "another scene"));
}

TEST(Checkpoint, MissingForeignAndOtherVersionsAreRefused)
{
    test::ScratchFolder const folder;
    EXPECT_TRUE(contains(message_of<InputError>([&] { CheckpointReader(folder / "none.h5"); }), "No such file"));
    EXPECT_TRUE(contains(message_of<InputError>([&] { CheckpointReader(folder.path()); }), "is a folder"));
    test::put(folder / "text.h5", "x,y,z\n1,2,3\n");
    EXPECT_TRUE(contains(message_of<InputError>([&] { CheckpointReader(folder / "text.h5"); }), "not an HDF5 file"));
    test::put(folder / "empty.h5", "");
    EXPECT_TRUE(contains(message_of<InputError>([&] { CheckpointReader(folder / "empty.h5"); }), "the file is empty"));
    test::write_foreign_hdf5(folder / "foreign.h5");
    EXPECT_TRUE(contains(message_of<InputError>([&] { CheckpointReader(folder / "foreign.h5"); }), "of another program"));
    std::string content = content_of(write_small(folder.path(), 1));
    content.replace(content.find("format ") + 7, 1, "99");
    test::put(folder / "later.h5", content);
    EXPECT_TRUE(
        contains(message_of<InputError>([&] { CheckpointReader(folder / "later.h5"); }), "has checkpoint format 99"));
}

TEST(Checkpoint, WhatAFileAnnouncesIsNotBelieved)
{
    test::ScratchFolder const folder;
    fs::path const path = write_small(folder.path(), 1);
    test::add_announced_array(path, "huge");
    auto const larger = [&](auto const& call) {
        EXPECT_TRUE(contains(message_of<InputError>(call), "an array larger than the file"));
    };
    larger([&] { CheckpointReader(path).array<Real>("huge"); });
    View1<Real> view;
    larger([&] { CheckpointReader(path).view("huge", view); });
}

TEST(Checkpoint, EveryTruncationIsRefusedAtOnce)
{
    test::ScratchFolder const folder;
    fs::path const path = write_small(folder.path(), 1);
    for (std::uintmax_t size = fs::file_size(path); size-- > 0;) {
        fs::resize_file(path, size);
        auto const message = message_of<InputError>([&] { CheckpointReader in(path); });
        EXPECT_TRUE(contains(message, path.string())) << size;
        if (size > 512) { EXPECT_TRUE(contains(message, "the checkpoint is truncated")) << size; }
    }
}

TEST(Checkpoint, WhatWasAppendedIsNoticed)
{
    test::ScratchFolder const folder;
    fs::path const path = write_small(folder.path(), 1);
    test::put(path, content_of(path) + std::string(1, '\0'));
    EXPECT_TRUE(contains(message_of<InputError>([&] { CheckpointReader in(path); }), "damaged"));
}

TEST(Checkpoint, ALongStageNameHasRoom)
{
    test::ScratchFolder const folder;
    std::string const name = std::string(3000, 'x') + "\n\"";
    CheckpointWriter out(folder / "c.h5", {1, 2, name, false, 3});
    out.value("x", 1.5);
    out.commit();
    CheckpointReader const in(folder / "c.h5");
    EXPECT_EQ(in.stamp().stage, name);
    EXPECT_EQ(in.value<Real>("x"), 1.5);
}

/// Everything a reader can get out of the file, as text.
std::string everything(fs::path const& path)
{
    CheckpointReader const in(path);
    in.verify();
    CheckpointStamp const& stamp = in.stamp();
    return fmt::format("{} {} {} {} {} {} {}", stamp.stage, stamp.step, stamp.time, stamp.scene_hash, stamp.stage_end,
                       fmt::join(in.array<Real>("particles/x"), " "), in.value<Real>("fluid/time"));
}

TEST(Checkpoint, AnyDamagedByteIsFoundOrDoesNotMatter)
{
    test::ScratchFolder const folder;
    fs::path const path = write_small(folder.path(), 1);
    std::string const whole = content_of(path), expected = everything(path);
    int found = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
        test::put(path, damaged);
        try {
            EXPECT_EQ(everything(path), expected) << "byte " << i;
        } catch (InputError const&) {
            ++found;
        }
    }
    // Nothing matters but the blanks at the header's end.
    int const blanks = static_cast<int>(std::count(whole.begin(), whole.begin() + 512, '\0'));
    EXPECT_EQ(found, static_cast<int>(whole.size()) - blanks);
}

TEST(Checkpoint, ADamagedValueIsFoundBeforeItIsUsed)
{
    test::ScratchFolder const folder;
    fs::path const path = write_small(folder.path(), 1);
    std::string content = content_of(path);
    Real const values[] = {1, 2, 3};
    auto const at = content.find(std::string(reinterpret_cast<char const*>(values), sizeof values));
    ASSERT_NE(at, std::string::npos);
    content[at + 9] ^= 1;
    test::put(path, content);
    CheckpointReader const in(path); // its stamp is still right
    EXPECT_EQ(in.stamp().step, 1);
    EXPECT_TRUE(contains(message_of<InputError>([&] { in.array<Real>("particles/x"); }), "damaged (its checksum is wrong)"));
}

TEST(Checkpoint, NothingIsLeftOfOneThatWasNotFinished)
{
    test::ScratchFolder const folder;
    {
        CheckpointWriter out(folder / "c.h5", {});
        out.value("x", 1.0);
    }
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Checkpoint, AFullDiskKeepsTheOldOneAndIsNamed)
{
    test::ScratchFolder const folder;
    fs::path const path = write_small(folder.path(), 1);
    std::string const before = content_of(path);
    fs::create_symlink("/dev/full", temporary_name(path));
    auto const message = message_of<OutputError>([&] {
        CheckpointWriter out(path, {});
        out.array("x", std::vector<Real>(100000, 1));
        out.commit();
    });
    EXPECT_TRUE(contains(message, path.string()));
    EXPECT_TRUE(contains(message, "No space left on device"));
    EXPECT_EQ(content_of(path), before);
    EXPECT_TRUE(contains(message_of<OutputError>([&] { CheckpointWriter out(folder / "no/c.h5", {}); }), "No such file"));
}

TEST(CheckpointFolder, TheLatestWholeOneOfTheSceneIsTaken)
{
    test::ScratchFolder const folder;
    std::vector<std::string> messages;
    auto const of_this_scene = [](CheckpointStamp const&) { return scene_hash; };
    EXPECT_FALSE(latest_checkpoint(folder.path(), of_this_scene, messages));
    write_small(folder.path(), 10);
    fs::path const good = write_small(folder.path(), 200);
    fs::resize_file(write_small(folder.path(), 1000000000), 900); // ten digits
    test::put(folder / "checkpoint-abc.h5", "not ours");
    EXPECT_EQ(latest_checkpoint(folder.path(), of_this_scene, messages), good);
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_TRUE(contains(messages[0], "checkpoint-1000000000.h5"));
    messages.clear();
    EXPECT_FALSE(latest_checkpoint(folder.path(), [](CheckpointStamp const&) { return 1; }, messages));
    EXPECT_EQ(messages.size(), 3u);
}

TEST(CheckpointFolder, PruningKeepsTheLastOnesAndStageEnds)
{
    test::ScratchFolder const folder;
    for (int step = 1; step <= 6; ++step) write_small(folder.path(), step, step == 2);
    prune_checkpoints(folder.path(), 2);
    std::vector<fs::path> const expected{checkpoint_path(folder.path(), 2), checkpoint_path(folder.path(), 5),
                                         checkpoint_path(folder.path(), 6)};
    EXPECT_EQ(list_checkpoints(folder.path()), expected);
    drop_checkpoints_after(folder.path(), 5);
    EXPECT_EQ(list_checkpoints(folder.path()).size(), 2u);
}

} // namespace
} // namespace arenite
