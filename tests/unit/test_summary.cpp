// SPDX-License-Identifier: MIT
#include "core/types.hpp"
#include "io/atomic_file.hpp"
#include "io/build_info.hpp"
#include "io/progress.hpp"
#include "io/summary.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <nlohmann/json.hpp>

#include <limits>
#include <sstream>

namespace arenite {
namespace {

using test::contains;

RunSummary two_stages()
{
    StageSummary first;
    first.name = "fill";
    first.wall_time = 2;
    first.particle_steps = 3e6;
    first.warnings = {{"overlap", 2}};
    first.kinetic_energy = std::numeric_limits<Real>::quiet_NaN();
    first.produced_mass = 0.5;
    StageSummary second = first;
    second.name = "pull \xff"; // not UTF-8
    second.porosity = 0.41;
    second.walls = {{"lid", {1, 2, 3}, 1e6}};
    second.warnings = {{"overlap", 1}, {"lost_grains", 4}};
    RunSummary summary;
    summary.scene = "a.toml";
    summary.scene_hash = 0xfedcba9876543210u;
    summary.stages = {first, second};
    return summary;
}

TEST(Summary, HoldsStagesTotalsVersionsAndMachine)
{
    test::ScratchFolder const folder;
    write_summary(folder.path(), two_stages());
    auto const json = nlohmann::json::parse(read_file(folder / "summary.json"));
    EXPECT_EQ(json["scene"]["hash"], "fedcba9876543210");
    EXPECT_EQ(json["stages"].size(), 2u);
    EXPECT_EQ(json["stages"][0]["particle_steps_per_second"], 1.5e6);
    EXPECT_TRUE(json["stages"][0]["end_state"]["kinetic_energy"].is_null()); // NaN
    EXPECT_TRUE(json["stages"][0]["end_state"]["porosity"].is_null());       // not known
    EXPECT_EQ(json["stages"][1]["end_state"]["porosity"], 0.41);
    EXPECT_EQ(json["stages"][1]["end_state"]["walls"]["lid"]["force"], (std::vector<Real>{1, 2, 3}));
    EXPECT_EQ(json["warnings"]["overlap"], 3);
    EXPECT_EQ(json["warnings"]["lost_grains"], 4);
    EXPECT_EQ(json["produced"]["mass"], 1.0);
    EXPECT_FALSE(json["versions"]["arenite"].get<std::string>().empty());
    EXPECT_FALSE(json["versions"]["kokkos"].get<std::string>().empty());
    EXPECT_FALSE(json["machine"]["cpu"].get<std::string>().empty());
    EXPECT_GT(json["machine"]["logical_cores"], 0);
    EXPECT_GT(json["machine"]["memory_bytes"], 1e6);
}

TEST(BuildInfo, NamesEveryOptionalPart)
{
    std::string const text = describe_build();
    for (OptionalPart const& part : optional_parts()) {
        EXPECT_TRUE(contains(text, part.name + ": "));
        EXPECT_EQ(part.present, !part.version.empty());
    }
    EXPECT_TRUE(contains(text, ExecutionSpace::name()));
    EXPECT_TRUE(contains(text, build_info().version));
    EXPECT_TRUE(contains(text, build_info().commit));
}

TEST(Progress, ShowsAtMostOneLineASecondWithTheTimeLeft)
{
    double now = 100;
    std::ostringstream stream;
    {
        Progress progress(stream, true, [&] { return now; });
        progress.update({"fill", 0, 10, 0, 1000});
        now += 0.9;
        progress.update({"fill", 0.1, 10, 100, 1000});
        EXPECT_EQ(stream.str(), "");
        now += 0.1;
        progress.update({"fill", 0.5, 10, 500, 1000});
        EXPECT_EQ(stream.str(), "\rfill: 0.5 s of 10 s (5 %), wall 1 s, 5.00e+05 particle-steps/s, 19 s left");
    }
    EXPECT_EQ(stream.str().back(), '\n');
}

TEST(Progress, SaysNothingWhereThereIsNoTerminal)
{
    double now = 0;
    std::ostringstream stream;
    {
        Progress progress(stream, false, [&] { return now += 5; });
        for (int step = 0; step < 5; ++step) progress.update({"fill", 1.0 * step, 10, step, 10});
        progress.clear();
    }
    EXPECT_EQ(stream.str(), "");
}

TEST(Progress, DurationsReadWell)
{
    EXPECT_EQ(duration_text(42.4), "42 s");
    EXPECT_EQ(duration_text(200), "3 min 20 s");
    EXPECT_EQ(duration_text(5 * 3600 + 125), "5 h 02 min");
    EXPECT_EQ(duration_text(3 * 86400 + 4 * 3600), "3 d 4 h");
    EXPECT_EQ(duration_text(std::numeric_limits<double>::infinity()), "unknown");
}

} // namespace
} // namespace arenite
