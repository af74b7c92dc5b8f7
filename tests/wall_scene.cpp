// SPDX-License-Identifier: MIT
#include "tests/wall_scene.hpp"

#include "kernels/contact_forces.hpp"
#include "kernels/wall_forces.hpp"

namespace arenite::test {

void WallScene::evaluate()
{
    std::visit(
        [&](auto const& chosen) {
            evaluate_contacts(chosen, particles, box, contacts, settings.dt);
            evaluate_wall_contacts(chosen, particles, walls, wall_contacts, settings.dt);
        },
        law);
}

} // namespace arenite::test
