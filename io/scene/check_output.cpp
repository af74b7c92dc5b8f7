// SPDX-License-Identifier: MIT
#include "io/scene/check.hpp"

namespace arenite::scene {

void check_output(Scene const& scene, Faults& faults)
{
    for (std::size_t i = 0; i < scene.output.probes.size(); ++i) {
        ProbeSettings const& probe = scene.output.probes[i];
        std::string const path = element("output.probes", i, probe.name);
        if (probe.grain.has_value() == probe.point.has_value()) faults.add(path, "needs exactly one of grain and point");
        if (probe.point && !scene.fluid) faults.add(path + ".point", "there is no table [fluid]");
        if (!probe.point || !scene.fluid) continue;
        Region const box = scene.fluid->box.value_or(Region{scene.domain.lower, scene.domain.upper});
        for (int axis = 0; axis < 3; ++axis)
            if ((*probe.point)[axis] < box.lower[axis] || (*probe.point)[axis] > box.upper[axis]) {
                faults.add(path + ".point", "lies outside the fluid's box");
                break;
            }
    }
    StreamlineSettings const& s = scene.output.streamlines;
    std::string const path = "output.streamlines";
    bool const seeds = !s.points.empty() || s.line || s.disc_center;
    if (seeds && !scene.fluid) faults.add(path, "there is no table [fluid]");
    if ((s.line || s.disc_center) && s.count == 0) faults.add(path, "missing key count: seeds on the line or disc");
    if (s.disc_center.has_value() != s.disc_normal.has_value() || s.disc_center.has_value() != (s.disc_radius > 0))
        faults.add(path, "a disc needs disc_center, disc_normal and disc_radius");
    if (s.disc_normal && !(norm(*s.disc_normal) > 0)) faults.add(path + ".disc_normal", "must not be [0, 0, 0]");
}

} // namespace arenite::scene
