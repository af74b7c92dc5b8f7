// SPDX-License-Identifier: MIT
#include "apps/calibrate.hpp"

#include "apps/bench_pack.hpp"

namespace arenite {

Calibration calibrate()
{
    BenchPack const pack = lattice_pack(8000);
    BenchSettings settings;
    settings.gravity = 0;
    settings.warm_up = 10;
    settings.steps = 60;
    Calibration speed;
    speed.hertz = run_pack(pack, settings).particle_steps_per_second();
    settings.law = NormalLaw::jkr;
    speed.jkr = run_pack(pack, settings).particle_steps_per_second();
    return speed;
}

} // namespace arenite
