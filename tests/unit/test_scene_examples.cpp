// SPDX-License-Identifier: MIT
// Every scene of the repository reads, and its resolved form reads back equal.
#include "scene_text.hpp"

#include <filesystem>
#include <set>

using namespace arenite;

namespace {

std::vector<std::string> scene_files()
{
    std::set<std::string> files;
    for (auto const& entry : std::filesystem::recursive_directory_iterator(ARENITE_SOURCE_DIR "/scenes"))
        if (entry.path().extension() == ".toml") files.insert(entry.path().string());
    return {files.begin(), files.end()};
}

} // namespace

TEST(SceneExamples, EverySceneReads)
{
    std::vector<std::string> const files = scene_files();
    EXPECT_GE(files.size(), 10u);
    for (std::string const& file : files) {
        SCOPED_TRACE(file);
        Scene scene;
        ASSERT_NO_THROW(
            try { scene = read_scene(file); } catch (InputError const& error) {
                ADD_FAILURE() << error.what();
                throw;
            });
        EXPECT_TRUE(read_scene_text(scene.resolved, file) == scene);
    }
}

TEST(SceneExamples, ThePapersScenesDifferOnlyInGrains)
{
    Scene original = read_scene(ARENITE_SOURCE_DIR "/scenes/paper/original.toml");
    EXPECT_EQ(original.particles.distribution.count, 270000);
    EXPECT_EQ(original.fluid->cells, (std::array<int, 3>{12, 12, 6}));
    for (char const* name : {"ssw", "ssp"}) {
        Scene const coarse = read_scene(std::string(ARENITE_SOURCE_DIR "/scenes/paper/") + name + ".toml");
        EXPECT_EQ(coarse.particles.distribution.count, 33750);
        EXPECT_EQ(coarse.coarse_graining.factor, 2);
        EXPECT_TRUE(coarse.walls == original.walls);
        EXPECT_TRUE(coarse.fluid == original.fluid);
        EXPECT_TRUE(coarse.domain == original.domain);
        EXPECT_TRUE(coarse.materials == original.materials);
    }
}
