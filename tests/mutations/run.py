#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Breaks the physics on purpose, one place at a time, and asks whether `arenite verify` notices.

    tests/mutations/run.py [--folder DIR] [--only WORD] [--skip N] [--out FILE] [-- CMAKE ARGUMENTS]

A copy of the tree is built once; then each mutation below is a substitution of text in one file, a build and a run of
the groups named with it (through the test program `verify_groups`, which runs what `arenite verify` runs and builds in
less time), until a row fails. Prints a Markdown table and exits with 1 if a mutation survives (or no
longer applies). Takes about a minute a mutation, so it is run by name and is not part of ctest.
"""
import argparse
import datetime
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "perf"))
from page_parts import commit  # noqa: E402

# what, file, text, what it becomes, groups to ask
MUTATIONS = [
    ("Hertz: 4/3 to 1.30", "kernels/contact/hertz.hpp", "return {Real(4) / 3 * effective_youngs_modulus",
     "return {Real(1.30) * effective_youngs_modulus", "contact"),
    ("Hertz: stiffness 2 E* a to 1.9 E* a in the dashpot", "kernels/contact/hertz.hpp", "square_root(2 * pair",
     "square_root(1.9 * pair", "contact"),
    ("JKR: the same", "kernels/contact/jkr.hpp", "square_root(2 * pair", "square_root(1.9 * pair", "contact"),
    ("JKR: 4 y^3 to 3.9 y^3 in the force", "kernels/contact/jkr.hpp", "y3 * (Real(4) / 3 * y3 - 4)",
     "y3 * (Real(4) / 3 * y3 - Real(3.9))", "contact"),
    ("JKR: pull-off 3 pi gamma R* to 2 pi gamma R*", "kernels/contact/jkr.hpp", "3 * force_unit", "2 * force_unit", "contact"),
    ("dashpot: sign", "kernels/contact/contact_law.hpp", "response.force - (pair", "response.force + (pair",
     "contact"),
    ("beta: ln^2 e to ln e (the paper's print)", "core/material.cpp", "std::sqrt(log_e * log_e + pi * pi)",
     "std::sqrt(log_e + pi * pi)", "contact"),
    ("scale: a held grain takes part with its mass", "kernels/contact_memory.cpp", "i_moves == j_moves ? mi * mj / (mi + mj) : i_moves ? mi : mj",
     "mi * mj / (mi + mj)", "contact"),
    ("tangential stiffness: 8 G* a to 7 G* a", "kernels/contact/tangential.hpp", "N const stiffness = 8 * pair",
     "N const stiffness = 7 * pair", "friction"),
    ("Coulomb limit: mu F_n to 1.02 mu F_n", "kernels/contact/tangential.hpp", "return pair.friction * larger(normal_force + 2",
     "return Real(1.02) * pair.friction * larger(normal_force + 2", "friction"),
    ("arm of the torque: the first grain's for both", "kernels/contact_forces.hpp", "arm_j = distance - arm_i", "arm_j = arm_i",
     "friction integrator"),
    ("slip: 1/2 to 0.49 in the half angle of the turn", "kernels/contact/tangential.hpp", "time * (Real(0.5) - tangent",
     "time * (Real(0.49) - tangent", "friction integrator"),
    ("slip: both spins at the first grain's arm", "kernels/contact_forces.hpp", "(1 - share_i) * spin_j", "share_i * spin_j",
     "friction integrator"),
    ("spring: twist 0.5 to 0.45", "kernels/contact_forces.hpp", "Real(0.5) * dt * counted", "Real(0.45) * dt * counted",
     "friction integrator"),
    ("moment of inertia: 2/5 to 1/2 m R^2", "core/particles.cpp", "Real(0.4) * mass * radius * radius",
     "Real(0.5) * mass * radius * radius", "integrator coarse_graining"),
    ("integrator: half step 0.5 to 0.501", "kernels/integrate.cpp", "Real(0.5) * settings.dt", "Real(0.501) * settings.dt",
     "integrator"),
    ("drag: Di Felice's exponent 3.7 to 3.69", "fluid/drag.hpp", "return Real(3.7) - Real(0.65)", "return Real(3.69) - Real(0.65)",
     "coupling"),
    ("drag: Dallavalle's 4.8 to 4.7", "fluid/drag.hpp", "Real(4.8) * square_root(viscous_speed)",
     "Real(4.7) * square_root(viscous_speed)", "coupling"),
    ("drag: interstitial speed in Di Felice's law", "fluid/drag.hpp", "N const superficial = at.porosity * at.slip_speed;",
     "N const superficial = at.slip_speed;", "coupling"),
    ("drag on the fluid: sign of what moves with the grains", "fluid/exchange.cpp",
     "at(flow.drag_velocity[axis], cell) = cell_sum", "at(flow.drag_velocity[axis], cell) = -cell_sum", "coupling"),
    ("grains: no pressure gradient and stress", "fluid/exchange.cpp", "return volume(entry[n], 0);",
     "return 0 * volume(entry[n], 0);", "coupling"),
    ("means of a group of grains: its weights along x for those along y", "fluid/deposit.hpp",
     "Lanes const across = weight[stencil.y_slot() + b]", "Lanes const across = weight[b]", "coupling"),
    ("search: rows of cells are left out at 0.9 of the reach", "kernels/find_pairs.cpp", "(1 + Real(1e-9)); // more",
     "Real(0.9); // more", "search"),
    ("search: force rows keep what the old list left there", "kernels/contact_memory.cpp", "force(row, n) = 0;", "force(row, n) += 0;",
     "search integrator"),
    ("viscous term: factor 1.02 along the transverse axes", "fluid/momentum_system.hpp", "weight * coefficient * scale_of_link",
     "Real(1.02) * weight * coefficient * scale_of_link", "fluid"),
    ("slope at a wall: 8/3 to 2", "fluid/momentum_system.hpp", "Real(8) / 3 * wall_scale", "Real(2) * wall_scale", "fluid"),
    ("continuity: no dn/dt", "fluid/pressure.cpp", "Real sum = (at(flow.porosity, cell) - at(flow.porosity_previous, cell)) / dt;",
     "Real sum = 0;", "fluid"),
    ("BDF2: 1 + 2w to 1 + 1.9w", "fluid/flow_solver.cpp", "d.now = (1 + 2 * w)", "d.now = (1 + Real(1.9) * w)", "fluid"),
    ("deposit: volume of a sphere 4/3 to 1.3", "fluid/exchange.cpp", "volume(entry, 0) = sphere", "volume(entry, 0) = Real(0.975) * sphere",
     "coupling"),
    ("coarse graining: drag k^3 to k^2", "fluid/drag.hpp", "return coarse_grain_factor * coarse_grain_factor * coarse_grain_factor",
     "return coarse_grain_factor * coarse_grain_factor", "coarse_graining"),
    ("coarse graining: drag at the grain's own diameter", "fluid/drag.hpp", "grain.diameter /= coarse_grain_factor;", "",
     "coarse_graining"),
    ("critical step: 10 to 9 in 3m/(10 Z k_t)", "core/critical_time_step.cpp", "(10 * 12 * tangential", "(9 * 12 * tangential",
     "coarse_graining"),
    ("stored energy of a bond: 8/15 to 7/15", "kernels/diagnostics.hpp", "y4 * (Real(8) / 15 * y4", "y4 * (Real(7) / 15 * y4",
     "coarse_graining"),
]

BUILD = "build/dev"


def copy_tree(folder):
    tracked = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], check=True, capture_output=True).stdout
    for name in filter(None, tracked.decode().split("\0")):
        source, target = ROOT / name, folder / name
        if not source.exists() or (target.exists() and target.read_bytes() == source.read_bytes()):
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
    if (ROOT / "deps").exists() and not (folder / "deps").exists():
        (folder / "deps").symlink_to(ROOT / "deps")


def build(folder):
    return subprocess.run(["cmake", "--build", folder / BUILD, "--target", "verify_groups"], capture_output=True, text=True)


def first_failing_row(folder, groups):
    """Group and row that fails first; a crash counts as noticed."""
    environment = dict(os.environ, OMP_NUM_THREADS="1", OMP_PROC_BIND="false")
    for group in groups.split():
        test = "Verify." + group.title().replace("_", "")
        result = subprocess.run([folder / BUILD / "tests/verify_groups", "--gtest_filter=" + test], capture_output=True, text=True,
                                env=environment)
        if "1 test from 1 test suite ran" not in result.stdout:
            return f"{group}: stops: {(result.stderr.strip().splitlines() or ['no output'])[-1][:80]}"
        rows = re.findall(r"^(.*): .*, reference .*, error (.*) over (.*)$", result.stdout, re.MULTILINE)
        if rows:
            row, error, limit = rows[0]
            row = row.replace("|", "\\|")  # a cell of the table
            return f"{group}: {row} (error {float(error):.2g}, limit {float(limit):.2g}; {len(rows)} rows)"
        if result.returncode != 0:
            return f"{group}: stops"
    return None


def try_mutation(folder, mutation):
    what, file, old, new, groups = mutation
    path = folder / file
    text = path.read_text()
    if text.count(old) < 1:
        return False, "the text is no longer there: mend the list"
    path.write_text(text.replace(old, new, 1))
    try:
        built = build(folder)
        if built.returncode != 0:
            return False, "does not compile: " + (built.stdout + built.stderr)[-300:].replace("\n", " ")
        row = first_failing_row(folder, groups)
        return row is not None, row or "SURVIVED"
    finally:
        path.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--folder", type=pathlib.Path, help="where the copy is built; kept")
    parser.add_argument("--only", default="", help="mutations whose description or file holds this word")
    parser.add_argument("--skip", type=int, default=0, help="this many of the list have been tried")
    parser.add_argument("--out", type=pathlib.Path, help="the table as a file too")
    parser.add_argument("cmake", nargs="*", help="arguments for cmake, after --")
    arguments = parser.parse_args()
    folder = (arguments.folder or pathlib.Path(tempfile.mkdtemp(prefix="arenite-mutations-"))).resolve()
    copy_tree(folder)
    subprocess.run(["cmake", "-S", folder, "-B", folder / BUILD, "-DCMAKE_BUILD_TYPE=Release", "-DARENITE_ENABLE_TESTS=ON",
                    *arguments.cmake], check=True, stdout=subprocess.DEVNULL)
    if build(folder).returncode != 0:
        sys.exit("the tree does not build as it is")
    chosen = [m for m in MUTATIONS if arguments.only in m[0] or arguments.only in m[1]][arguments.skip:]
    if not chosen:
        sys.exit("no mutation holds that word")
    lines = [f"Run at commit {commit(marked=True)}, {datetime.date.today()}.", "", "| mutation | file | first row that fails |", "| --- | --- | --- |"]
    survivors = 0
    print("\n".join(lines), flush=True)
    for mutation in chosen:
        caught, row = try_mutation(folder, mutation)
        survivors += not caught
        lines.append(f"| {mutation[0]} | `{mutation[1]}` | {row} |")
        print(lines[-1], flush=True)
        if arguments.out:
            arguments.out.write_text("\n".join(lines) + "\n")
    print(f"\n{len(chosen)} mutations, {survivors} not noticed")
    sys.exit(1 if survivors else 0)


if __name__ == "__main__":
    main()
