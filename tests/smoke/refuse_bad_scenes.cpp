// SPDX-License-Identifier: MIT
// Whatever key is wrong: the run ends before it begins (InputError, which the program turns into exit code 2), the folder
// of an earlier run stays as it was, and a folder that is not there is not made.
#include "apps/run.hpp"
#include "core/error.hpp"
#include "tests/unit/scene_keys.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <map>

namespace {

namespace fs = std::filesystem;
using namespace arenite;

std::map<std::string, std::string> contents(fs::path const& folder)
{
    std::map<std::string, std::string> files;
    for (auto const& entry : fs::directory_iterator(folder)) files[entry.path().filename()] = test::content_of(entry.path());
    return files;
}

TEST(BadScenes, LeaveTheOutputFolderAlone)
{
    test::ScratchFolder const scratch;
    fs::path const earlier = scratch / "earlier";
    fs::create_directory(earlier);
    for (char const* name :
         {"history.csv", "produced.csv", "summary.json", "scene.toml", "checkpoint-000000001.h5", "particles.pvd"})
        test::put(earlier / name, std::string("what was in ") + name);
    auto const before = contents(earlier);

    RunOptions options;
    options.scene = (scratch / "t.toml").string();
    options.quiet = true;
    int refused = 0;
    auto const expect_refusal = [&](std::string const& text) {
        test::put(options.scene, text);
        for (bool const resume : {false, true}) {
            options.folder = (resume ? earlier : scratch / "fresh").string();
            options.resume = resume;
            EXPECT_THROW(run_scene(options), InputError) << text;
        }
        options.folder = earlier.string();
        options.resume = false;
        EXPECT_THROW(run_scene(options), InputError) << text;
        ++refused;
    };
    for (test::SceneKey const& key : test::every_scene_key()) {
        expect_refusal(test::write_key(key, key.field.name, test::values_of_wrong_type(key).front()).text);
        expect_refusal(test::write_key(key, test::misspelled(key.field.name), "1").text);
        for (std::string const& value : test::values_out_of_range(key))
            expect_refusal(test::write_key(key, key.field.name, test::as_value(key, value)).text);
    }
    EXPECT_GT(refused, 400);
    EXPECT_EQ(contents(earlier), before);
    EXPECT_FALSE(fs::exists(scratch / "fresh"));
}

} // namespace
