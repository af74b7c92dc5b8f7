# SPDX-License-Identifier: MIT
"""The pressure system that bench_projection wrote, solved by PyAMG: python3 pyamg_poisson.py FOLDER CELLS REPEATS.

One JSON line per solver: median milliseconds of set-up and solve together, since the coefficients change every step, and
iterations to a residual of 1e-8 of the right-hand side, the tolerance of Arenite's own solve."""

import json
import pathlib
import statistics
import sys
import time

import numpy as np
import pyamg
import scipy.sparse
import scipy.sparse.linalg


def matrix(folder, n):
    """Sum over a cell's faces of conductance * (x - x_neighbour); a boundary face joins the cell to 0."""
    diagonal = np.zeros((n, n, n))  # [z][y][x]
    cell = np.arange(n ** 3).reshape(n, n, n)
    rows, columns, values = [], [], []
    for axis, name in ((2, "x"), (1, "y"), (0, "z")):
        shape = [n, n, n]
        shape[axis] += 1
        conductance = np.fromfile(folder / f"conductance_{name}").reshape(shape)
        diagonal += np.take(conductance, range(n), axis) + np.take(conductance, range(1, n + 1), axis)
        inner = np.take(conductance, range(1, n), axis).ravel()
        below, above = np.take(cell, range(n - 1), axis).ravel(), np.take(cell, range(1, n), axis).ravel()
        rows += [below, above]
        columns += [above, below]
        values += [-inner, -inner]
    rows.append(cell.ravel())
    columns.append(cell.ravel())
    values.append(diagonal.ravel())
    return scipy.sparse.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))))


def main():
    folder, n, repeats = pathlib.Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
    a = matrix(folder, n)
    b = np.fromfile(folder / "right_hand_side")
    for name, make in (("pyamg smoothed aggregation", pyamg.smoothed_aggregation_solver), ("pyamg Ruge-Stueben", pyamg.ruge_stuben_solver)):
        seconds, residuals = [], []
        for _ in range(repeats):
            residuals.clear()
            begin = time.perf_counter()
            x = make(a).solve(b, tol=1e-8, accel="cg", residuals=residuals)
            seconds.append(time.perf_counter() - begin)
        reached = np.linalg.norm(b - a @ x) / np.linalg.norm(b)
        if not reached < 2e-8:
            raise SystemExit(f"{name}: residual {reached:g}")
        print(json.dumps({"solver": name, "ms": 1e3 * statistics.median(seconds), "iterations": len(residuals) - 1}), flush=True)


if __name__ == "__main__":
    main()
