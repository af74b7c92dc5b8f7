# SPDX-License-Identifier: MIT
"""YADE on a pack: yade -jTHREADS -n -x yade_pack.py PACK SIDE_X SIDE_Y SKIN WARM STEPS.
Hertz-Mindlin with history, restitution 0.8, friction 0.2."""
import math
import os
import sys
import time

from yade import *  # noqa: F401,F403: inside yade its names are there already

pack, side_x, side_y, skin = sys.argv[1], *map(float, sys.argv[2:5])
warm, steps = map(int, sys.argv[5:7])

O.materials.append(FrictMat(young=2e10, poisson=0.3, frictionAngle=math.atan(0.2), density=2605, label="sand"))
for line in open(pack):
    if not line.startswith("#"):
        x, y, z, radius = map(float, line.split())
        O.bodies.append(utils.sphere((x, y, z), radius, material="sand"))
grains = len(O.bodies)
lower, right, back = (0, 0, 0), (side_x, 0, 0), (0, side_y, 0)
for position, axis, sense in ((lower, 0, 1), (right, 0, -1), (lower, 1, 1), (back, 1, -1), (lower, 2, 1)):
    O.bodies.append(utils.wall(position, axis, sense=sense, material="sand"))

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=skin / 2),  # each of the two boxes grows by it
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_MindlinPhys(en=0.8)],
                    [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(damping=0, gravity=(0, 0, -9810)),
]
O.dt = 1e-8
O.run(warm, True)
begin = time.perf_counter()
O.run(steps, True)
seconds = time.perf_counter() - begin
pairs = sum(1 for i in O.interactions if i.isReal and i.id1 < grains and i.id2 < grains)
print(f"\nloop_seconds {seconds:.6f}\ncontacts_per_grain {pairs / grains:.6f}", flush=True)
os._exit(0)  # without YADE's question whether to leave
