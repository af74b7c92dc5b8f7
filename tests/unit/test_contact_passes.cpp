// SPDX-License-Identifier: MIT
// A step in parts is the step: what each part has to do, and the same bits.
#include "apps/verify/packs.hpp"
#include "kernels/contact_passes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace arenite {
namespace {

SystemSettings colliding_pack(NormalLaw law, bool periodic)
{
    SystemSettings settings = rough_pack(law, 1500, 2.4e-3, 0.24e-3, periodic);
    settings.start_bonded = law != NormalLaw::hertz;
    settings.fused = true;
    return settings;
}

/// What became of a list's contacts and grains, pass after pass.
struct Audit {
    ContactList const& list;
    std::vector<int> evaluated, moved, left; // [block], [grain]; left: contacts that are not evaluated yet
    int shared = 0;                          // contacts

    explicit Audit(ContactList const& tiled)
        : list(tiled), evaluated(blocks_of(tiled)), moved(tiled.grains()), left(tiled.grains())
    {
        for (int c = 0; c < list.count; ++c) ++left[list.first(c)], ++left[list.second(c)];
    }

    void make(ContactPass const& pass)
    {
        std::vector<int> taken(list.touching.extent(0) + pass.force_row.count); // rows of forces
        for (Range const& blocks : {pass.close, pass.close_across, pass.others})
            for (int block = blocks.begin; block < blocks.end; ++block) evaluate(pass, block, taken);
        for (int i = pass.grains.begin; i < pass.grains.end; ++i) {
            EXPECT_EQ(left[i], 0) << "a grain without all its contacts";
            ++moved[i];
        }
    }

    void evaluate(ContactPass const& pass, int block, std::vector<int>& taken)
    {
        ++evaluated[block];
        int const begin = block * lane_count;
        for (int c = begin; c < begin + lane_count; ++c) {
            int const row = pass.force_row(c);
            EXPECT_EQ(row, pass.force_row(begin) + c - begin) << "a block's rows follow each other";
            ASSERT_LT(row, static_cast<int>(taken.size()));
            EXPECT_EQ(++taken[row], 1) << "two contacts of a pass have one row";
            if (c < list.count) evaluate_contact(pass, c);
        }
    }

    void evaluate_contact(ContactPass const& pass, int c)
    {
        int const i = list.first(c), j = list.second(c);
        EXPECT_TRUE(moved[i] == 0 && moved[j] == 0) << "a contact of grains that have moved";
        --left[i], --left[j];
        if (pass.force_row(c) == c) return;
        ++shared; // the next pass writes there: both grains have to be of this one
        EXPECT_TRUE(std::min(i, j) >= pass.grains.begin && std::max(i, j) < pass.grains.end);
        EXPECT_GE(pass.force_row(c), list.touching.extent_int(0));
    }
};

TEST(ContactPasses, MoveAGrainOnceAllItsContactsAreEvaluated)
{
    if (!on_host) GTEST_SKIP() << "a device makes a step in one part";
    for (bool const periodic : {false, true})
        for (int const tile : {1, 7, 64, 400, 1499, 1500, 2000}) {
            SystemSettings settings = colliding_pack(NormalLaw::hertz, periodic);
            settings.tile_grains = tile;
            GrainSystem const system = make_system(settings);
            ContactList const& list = system.contacts;
            ASSERT_EQ(list.tile_grains, tile);
            EXPECT_LE(list.touching.extent_int(0) + shared_rows(list, ExecutionSpace().concurrency()),
                      list.force.extent_int(0));
            for (int const together : {1, 2, 5}) {
                SCOPED_TRACE(testing::Message() << "tiles of " << tile << ", " << together << " at a time, " << periodic);
                Audit audit(list);
                std::vector<bool> last;
                for_each_pass(list, together, [&](ContactPass const& pass) {
                    audit.make(pass);
                    last.push_back(pass.last);
                });
                EXPECT_EQ(std::find(last.begin(), last.end(), true), std::prev(last.end()));
                EXPECT_EQ(std::count(audit.evaluated.begin(), audit.evaluated.end(), 1), blocks_of(list));
                EXPECT_EQ(std::count(audit.moved.begin(), audit.moved.end(), 1), list.grains());
                if (tile >= 64) { EXPECT_GT(audit.shared, list.close / 4); }
            }
        }
}

TEST(ContactPasses, LeaveTheBitsAsTheyAre)
{
    for (NormalLaw const law : {NormalLaw::hertz, NormalLaw::modified_jkr})
        for (bool const periodic : {false, true}) {
            SystemSettings settings = colliding_pack(law, periodic);
            GrainSystem whole = make_system(settings);
            std::vector<std::uint64_t> hashes; // also where a step is made in one part and forces are looked at
            for (int const steps : {40, 1, 60, 50}) {
                advance(whole, steps);
                hashes.push_back(state_hash(whole));
            }
            EXPECT_GT(whole.rebuilds, 3);
            for (int const tile : {1, 13, 100, 700}) {
                settings.tile_grains = tile;
                GrainSystem tiled = make_system(settings);
                std::vector<std::uint64_t> same;
                for (int const steps : {40, 1, 60, 50}) {
                    advance(tiled, steps);
                    same.push_back(state_hash(tiled));
                }
                EXPECT_EQ(hashes, same) << "tiles of " << tile;
                EXPECT_EQ(tiled.rebuilds, whole.rebuilds);
            }
        }
}

/// Rows that a grain gathers must not hold what another contact, or an earlier step, left there.
TEST(ContactPasses, ForgetForcesOfContactsThatCameApart)
{
    for (NormalLaw const law : {NormalLaw::hertz, NormalLaw::modified_jkr}) {
        SystemSettings settings = colliding_pack(law, false);
        settings.skin = 1e-3; // a list lasts long: pairs come apart in it
        settings.start_bonded = false;
        GrainSystem whole = make_system(settings);
        settings.tile_grains = 100;
        GrainSystem tiled = make_system(settings);
        for (int n = 0; n < 30; ++n) {
            advance(whole, 1 + n);
            advance(tiled, 1 + n);
            ASSERT_EQ(state_hash(whole), state_hash(tiled)) << n;
        }
        EXPECT_LT(whole.rebuilds, 10);
    }
}

} // namespace
} // namespace arenite
