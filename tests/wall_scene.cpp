// SPDX-License-Identifier: MIT
#include "tests/wall_scene.hpp"

#include "kernels/evaluate_forces.hpp"

namespace arenite::test {

void WallScene::evaluate()
{
    evaluate_contacts(law, particles, box, contacts, settings.dt);
    evaluate_wall_contacts(law, particles, walls, wall_contacts, settings.dt);
}

} // namespace arenite::test
