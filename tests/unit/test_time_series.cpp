// SPDX-License-Identifier: MIT
#include "io/history.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>

namespace arenite {
namespace {

using test::contains;
using test::content_of;
using test::message_of;

TEST(TimeSeries, WritesHeaderRowsEmptyCellsAndQuotes)
{
    test::ScratchFolder const folder;
    TimeSeries table(folder / "t.csv", {"time", "name", "count"});
    table.add({0.1, std::string("a \"b\", c"), std::int64_t(7)});
    table.add({1e-300, Cell(), -1});
    table.flush();
    EXPECT_EQ(content_of(folder / "t.csv"), "time,name,count\n0.1,\"a \"\"b\"\", c\",7\n1e-300,,-1\n");
    EXPECT_EQ(split_csv_line("0.1,\"a \"\"b\"\", c\",7"), (std::vector<std::string>{"0.1", "a \"b\", c", "7"}));
}

TEST(TimeSeries, RealsReadBackToTheSameBits)
{
    for (Real const value : {0.1 + 0.2, 1.0 / 3, std::numeric_limits<Real>::denorm_min(), -0.0, 1.7976931348623157e308}) {
        Real const read = std::strtod(Cell(value).text.c_str(), nullptr);
        EXPECT_EQ(read, value);
        EXPECT_EQ(std::signbit(read), std::signbit(value));
    }
}

TEST(TimeSeries, ResumeDropsLaterRowsAndTheRowThatAKillCutShort)
{
    test::ScratchFolder const folder;
    test::put(folder / "t.csv", "step,x\n10,a\n20,b\n30,c\n4");
    {
        TimeSeries table(folder / "t.csv", {"step", "x"}, TimeSeries::Keep{"step", 20, ""});
        table.add({25, std::string("d")});
        table.flush();
    }
    EXPECT_EQ(content_of(folder / "t.csv"), "step,x\n10,a\n20,b\n25,d\n");
    TimeSeries fresh(folder / "t.csv", {"step", "x"});                     // without a step to keep, an old table goes
    EXPECT_EQ(content_of(folder / "t.csv"), "step,x\n10,a\n20,b\n25,d\n"); // but not before the run writes
    fresh.flush();
    EXPECT_EQ(content_of(folder / "t.csv"), "step,x\n");
}

TEST(TimeSeries, ResumeAtTheBeginningOfAStageDropsItsFirstRow)
{
    test::ScratchFolder const folder;
    test::put(folder / "t.csv", "step,stage\n10,a\n20,a\n20,b\n30,b\n");
    TimeSeries table(folder / "t.csv", {"step", "stage"}, rows_until(ResumePoint{20, 0, "b"}));
    table.add({20, std::string("b")}); // the stage begins again
    table.flush();
    EXPECT_EQ(content_of(folder / "t.csv"), "step,stage\n10,a\n20,a\n20,b\n");
}

TEST(TimeSeries, ResumeRefusesATableOfOtherColumns)
{
    test::ScratchFolder const folder;
    test::put(folder / "t.csv", "step,y\n10,a\n");
    auto const message =
        message_of<InputError>([&] { TimeSeries(folder / "t.csv", {"step", "x"}, TimeSeries::Keep{"step", 20, ""}); });
    EXPECT_TRUE(contains(message, "t.csv"));
    EXPECT_TRUE(contains(message, "step,x"));
    EXPECT_TRUE(contains(message, "step,y"));
    test::put(folder / "t.csv", "step,x\nabc,a\n");
    auto const no_number =
        message_of<InputError>([&] { TimeSeries(folder / "t.csv", {"step", "x"}, TimeSeries::Keep{"step", 20, ""}); });
    EXPECT_TRUE(contains(no_number, "abc,a"));
    EXPECT_EQ(content_of(folder / "t.csv"), "step,x\nabc,a\n");
}

TEST(TimeSeries, ARowOfAnotherLengthIsAMistakeOfOurs)
{
    test::ScratchFolder const folder;
    TimeSeries table(folder / "t.csv", {"a", "b"});
    EXPECT_THROW(table.add({1}), std::logic_error);
}

TEST(History, ColumnsFollowFromTheSceneAndMissingValuesAreEmpty)
{
    test::ScratchFolder const folder;
    History history(folder.path(), {{"lid"}, true, {"probe_p"}});
    HistoryRow row;
    row.time = 0.5;
    row.stage = "fill";
    row.step = 100;
    row.grains = 3;
    row.wall_forces = {Vec3{1, 2, 3}};
    row.extra = {std::nullopt};
    history.add(row);
    row.wall_forces = {std::nullopt};
    row.flow = FlowReport{4, 1e-9, 1e-12, 0.5, 2, 3, true};
    row.porosity = 0.41;
    history.add(row);
    history.flush();
    EXPECT_EQ(content_of(folder / "history.csv"),
              "time,stage,step,grains,contacts,bonds,kinetic_energy,porosity,coordination,produced_mass,produced_count,"
              "lost_mass,lost_count,max_overlap_ratio,force_lid_x,force_lid_y,force_lid_z,pressure_iterations,pressure_"
              "residual,continuity_error,"
              "courant,inflow,outflow,probe_p\n"
              "0.5,fill,100,3,0,0,0,,,0,0,0,0,0,1,2,3,,,,,,,\n"
              "0.5,fill,100,3,0,0,0,0.41,,0,0,0,0,0,,,,4,1e-09,1e-12,0.5,2,3,\n");
}

TEST(ProducedLedger, ResumeKeepsGrainsUpToTheCheckpointsTimeExactly)
{
    test::ScratchFolder const folder;
    Real const checkpoint_time = 0.1 + 0.2; // not 0.3
    {
        ProducedLedger ledger(folder.path());
        ledger.add({0.3, 7, 2, 5e-4, 2, 1e-6, {1, 2, 3}, {0, 0, -1}});
        ledger.add({checkpoint_time, 8, 0, 5e-4, 2, 1e-6, {}, {}});
        ledger.add({std::nextafter(checkpoint_time, 1), 9, 0, 5e-4, 2, 1e-6, {}, {}});
        ledger.flush();
    }
    ProducedLedger resumed(folder.path(), ResumePoint{100, checkpoint_time, ""});
    resumed.flush();
    EXPECT_EQ(content_of(folder / "produced.csv"), "time,id,class,diameter,k,mass,x,y,z,vx,vy,vz\n"
                                                   "0.3,7,2,0.0005,2,1e-06,1,2,3,0,0,-1\n"
                                                   "0.30000000000000004,8,0,0.0005,2,1e-06,0,0,0,0,0,0\n");
}

} // namespace
} // namespace arenite
