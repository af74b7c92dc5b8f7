// SPDX-License-Identifier: MIT
// The scene reader. Lines at the start that begin with "#set " are --set options, as the command line gives them. A scene
// that is accepted must read back equal from its resolved form.
#include "core/error.hpp"
#include "io/scene_reader.hpp"
#include "tests/fuzz/fuzz.hpp"

#include <string_view>

using namespace arenite;

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size)
{
    std::string_view text(reinterpret_cast<char const*>(data), size);
    std::vector<std::string> overrides;
    constexpr std::string_view mark = "#set ";
    while (text.starts_with(mark) && text.find('\n') != std::string_view::npos) {
        std::size_t const end = text.find('\n');
        overrides.emplace_back(text.substr(mark.size(), end - mark.size()));
        text.remove_prefix(end + 1);
    }
    std::string const name = "no/such/folder/fuzzed.toml"; // so that what the scene names is not there
    Scene scene;
    try {
        scene = read_scene_text(std::string(text), name, overrides);
    } catch (InputError const&) {
        return 0;
    }
    FUZZ_REQUIRE(read_scene_text(scene.resolved, name) == scene);
    return 0;
}
