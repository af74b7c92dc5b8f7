// SPDX-License-Identifier: MIT
// A scene that is right and uses most of the vocabulary, and the faults of it after some --set.
#pragma once

#include "core/error.hpp"
#include "io/scene_reader.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace arenite::test {

inline std::string const valid_scene = R"(title = "a test"
random_seed = 7
[domain]
lower = [0, 0, 0]
upper = [0.01, 0.01, 0.02]
periodic = [true, false, false]
gravity = [0, 0, -9.81]

[materials.sand]
density = 2605
youngs_modulus = 2e10
poissons_ratio = 0.3
restitution = 0.8
friction = 0.2
surface_energy = 30

[materials.steel]
rigid = true
restitution = 0.8
friction = 0.1

[[interactions]]
materials = ["sand", "steel"]
friction = 0.15

[coarse_graining]
scheme = "ssw"
factor = 2

[particles]
source = "distribution"
material = "sand"
[particles.distribution]
diameters = [0.2e-3, 0.3e-3]
fractions = [0.4, 0.6]
count = 100

[[groups]]
name = "pushed"
classes = [1]
force = [0, 0, -1e-6]

[[walls]]
name = "floor"
type = "plane"
material = "sand"
point = [0, 0, 0]
normal = [0, 0, 1]

[[walls]]
name = "top"
type = "plane"
material = "steel"
point = [0, 0, 0.02]
normal = [0, 0, -1]
[[walls.holes]]
name = "perforation"
center = [0.005, 0.005, 0.02]
diameter = 2.6e-3

[[walls]]
name = "rod"
type = "cylinder"
material = "steel"
base = [0.005, 0.005, 0.021]
axis = [0, 0, 0.01]
diameter = 1.7e-3
present = false

[fluid]
cells = [6, 6, 12]
time_step = 1e-6
fit_wall = "top"
[[fluid.patches]]
face = "x_lower"
type = "periodic"
[[fluid.patches]]
face = "x_upper"
type = "periodic"
[[fluid.patches]]
face = "y_lower"
type = "velocity"
velocity = [0, 1e-4, 0]
[[fluid.patches]]
face = "z_upper"
type = "pressure"
shape = "disc"
center = [0.005, 0.005, 0]
diameter = 2.6e-3
pressure = 101325

[[stages]]
name = "fill"
kind = "generation"

[[stages]]
name = "press"
duration = 1
time_step_fraction = 0.2
contact = { law = "jkr" }
[stages.materials.sand]
friction = 0.15
[[stages.interactions]]
materials = ["steel", "sand"]
restitution = 0.7
[[stages.walls]]
wall = "top"
servo = { stress = 1e6, axis = [0, 0, -1], max_speed = 0.1 }
[stages.end]
stress_wall = "top"
stress = 1e6
kinetic_energy_ratio = 1e-4

[[stages]]
name = "flow"
duration = 0.04
time_step = 1e-8
fluid = true
outlet_wall = "top"
contact = { law = "modified_jkr", damping = "restitution_clipped" }
[[stages.walls]]
wall = "top"
open = ["perforation"]

[output]
history_interval = 1e-4
probes = [ { name = "first", grain = 0 }, { name = "middle", point = [0.005, 0.005, 0.005] } ]
streamlines = { line = { from = [0, 0, 0.001], to = [0.01, 0.01, 0.001] }, count = 20 }
)";

/// The lines of the InputError, or "" if there is none.
inline std::string faults_of_text(std::string const& text, std::vector<std::string> const& overrides = {})
{
    try {
        read_scene_text(text, "scenes/x.toml", overrides);
    } catch (InputError const& error) {
        return error.what();
    }
    return "";
}

inline std::string faults_with(std::vector<std::string> const& overrides) { return faults_of_text(valid_scene, overrides); }

inline testing::AssertionResult contains(std::string const& text, std::string const& piece)
{
    if (text.find(piece) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "expected\n  " << piece << "\nin\n  " << text;
}

inline std::string without(std::string text, std::string const& piece)
{
    std::size_t const at = text.find(piece);
    EXPECT_NE(at, std::string::npos) << piece;
    return at == std::string::npos ? text : text.erase(at, piece.size());
}

} // namespace arenite::test
