# SPDX-License-Identifier: MIT
"""The 3-D pictures, off-screen with PyVista: grains cut at the plane through the axis, fluid speed with streamlines.

A program of its own (`python -m arenite_report.render JOB.json`), because an OpenGL library that does not work ends the whole
process. Pictures have neither text nor bars: `pictures` sets them on axes in mm and draws those.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pyvista
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkRenderingCore import vtkActor, vtkGlyph3DMapper

from . import palette

PIXELS = 1000  # of a picture's width


class View:
    """Parallel view onto the section plane; half of the sample, the half behind the plane, is seen."""

    def __init__(self, section: dict[str, Any]):
        self.centre = np.array(section["centre"], dtype=float)
        self.up, self.lateral, self.normal = section["up"], section["lateral"], section["normal"]
        unit = np.eye(3)
        self.towards = np.cross(unit[self.up], unit[self.lateral])  # the direction of sight

    def depth(self, points: np.ndarray) -> np.ndarray:
        """m behind the plane."""
        return (points - self.centre) @ self.towards

    def plotter(self, extent: list[float]) -> pyvista.Plotter:
        """extent: lateral from, to, up from, to, in m."""
        width, height = extent[1] - extent[0], extent[3] - extent[2]
        plotter = pyvista.Plotter(off_screen=True, window_size=(PIXELS, max(1, round(PIXELS * height / width))))
        plotter.disable_anti_aliasing()  # the report shows them at half this size
        plotter.set_background(palette.BACKGROUND)
        focus = self.centre.copy()
        focus[self.lateral], focus[self.up] = (extent[0] + extent[1]) / 2, (extent[2] + extent[3]) / 2
        plotter.camera.position = focus - 10 * width * self.towards
        plotter.camera.focal_point = focus
        plotter.camera.up = np.eye(3)[self.up]
        plotter.camera.parallel_projection = True
        plotter.camera.parallel_scale = height / 2
        plotter.camera.clipping_range = (width, 30 * width)
        return plotter


def add_grains(plotter: pyvista.Plotter, view: View, grains: pyvista.PolyData, colours: np.ndarray) -> None:
    """Spheres behind the plane; those that the plane cuts end there in a disc."""
    radius, depth = grains["diameter"] / 2, view.depth(grains.points)
    deepest = 6 * radius.max() + 0.2 * np.ptp(grains.points[:, view.lateral])  # what is farther back is hidden
    behind = (depth > -radius) & (depth < deepest)
    cut = np.abs(depth) < radius
    sides = 24 if behind.sum() < 20000 else 14
    # The half that faces the eye: nobody sees the other, and without a GPU every triangle counts.
    towards_eye = pyvista.Sphere(radius=0.5, direction=-view.towards, end_phi=90, theta_resolution=sides, phi_resolution=sides // 4)
    spheres = glyphs(grains.points[behind], grains["diameter"][behind], colours[behind], towards_eye)
    plane = vtkPlane()
    plane.SetOrigin(view.centre)
    plane.SetNormal(view.towards)
    spheres.GetMapper().AddClippingPlane(plane)
    spheres.GetProperty().SetAmbient(0.3)
    spheres.GetProperty().SetDiffuse(0.75)
    plotter.add_actor(spheres, reset_camera=False)

    disc = pyvista.Disc(inner=0, outer=0.5, normal=view.towards, r_res=1, c_res=2 * sides)
    middle = grains.points[cut] - np.outer(depth[cut], view.towards)
    caps = glyphs(middle, 2 * np.sqrt(radius[cut] ** 2 - depth[cut] ** 2), colours[cut], disc)
    caps.GetProperty().LightingOff()
    plotter.add_actor(caps, reset_camera=False)
    ring = pyvista.Disc(inner=0.46, outer=0.5, normal=view.towards, r_res=1, c_res=2 * sides)
    lifted = middle - 0.02 * radius.max() * view.towards
    rings = glyphs(lifted, 2 * np.sqrt(radius[cut] ** 2 - depth[cut] ** 2), (colours[cut] * 0.55).astype(np.uint8), ring)
    rings.GetProperty().LightingOff()
    plotter.add_actor(rings, reset_camera=False)


def glyphs(points: np.ndarray, sizes: np.ndarray, colours: np.ndarray, shape: pyvista.PolyData) -> vtkActor:
    """The shape at every point, drawn in instances: a quarter of a million spheres need no memory of their own."""
    cloud = pyvista.PolyData(np.ascontiguousarray(points, dtype=float))
    cloud["size"] = np.ascontiguousarray(sizes, dtype=float)
    cloud["colour"] = np.ascontiguousarray(colours)
    mapper = vtkGlyph3DMapper()
    mapper.SetInputData(cloud)
    mapper.SetSourceData(shape)
    mapper.SetScaleArray("size")
    mapper.SetScaleModeToScaleByMagnitude()
    mapper.OrientOff()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("colour")
    mapper.SetColorModeToDirectScalars()
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


def add_walls(plotter: pyvista.Plotter, view: View, walls: pyvista.PolyData, rod: int | None, width: float) -> None:
    """Where the plane cuts the walls, a line (a hole is a gap in it); the rod is glass, so that its hole is seen."""
    outline = walls.slice(normal=view.towards, origin=view.centre)
    if outline.n_cells:
        outline.points = outline.points - 0.01 * width * view.towards
        plotter.add_mesh(outline.tube(radius=0.0015 * width), color=palette.WALL, lighting=False, reset_camera=False)
    if rod is None:
        return
    cells = np.flatnonzero(walls.cell_data["wall"] == rod)
    shape = walls.extract_cells(cells).clip(normal=-view.towards, origin=view.centre) if cells.size else pyvista.PolyData()
    if shape.n_cells:
        plotter.add_mesh(shape, color=palette.ROD, opacity=0.5, smooth_shading=False, reset_camera=False)


def add_fluid(plotter: pyvista.Plotter, view: View, slice_: pyvista.DataSet, lines: pyvista.PolyData, norm: Any,
              extent: list[float]) -> None:
    slice_["colour"] = palette.rgb(slice_["speed"], palette.FLUID_SPEED_COLOURS, norm)
    plotter.add_mesh(slice_, scalars="colour", rgb=True, lighting=False, reset_camera=False)
    if lines.n_cells == 0:
        return
    # Seeds lie in the plane and the lines near it: they are drawn on the plane, in front of the speed.
    radius = 0.0025 * (extent[1] - extent[0])
    lines.points = lines.points - np.outer(view.depth(lines.points) + 2 * radius, view.towards)
    plotter.add_mesh(lines.tube(radius=radius, n_sides=8), color="white", lighting=False, reset_camera=False)


def fluid_slice(view: View, fluid: pyvista.DataSet) -> pyvista.DataSet:
    return fluid.cell_data_to_point_data().slice(normal=view.towards, origin=view.centre)


def stream_lines(view: View, fluid: pyvista.DataSet, path: str | None) -> pyvista.PolyData:
    """The series' own, or traced here from a line across the middle of the sample."""
    if path:
        return pyvista.read(path)
    low, high = np.array(fluid.bounds[::2]), np.array(fluid.bounds[1::2])
    ends = np.tile(view.centre, (2, 1))
    ends[:, view.up] = (low + high)[view.up] / 2
    ends[:, view.lateral] = low[view.lateral] * 0.98 + high[view.lateral] * 0.02, low[view.lateral] * 0.02 + high[view.lateral] * 0.98
    seeds = pyvista.Line(*ends, resolution=31)
    return fluid.cell_data_to_point_data().streamlines_from_source(seeds, vectors="velocity", integration_direction="both")


class Job:
    """Pictures of one kind share their colours, pictures of one kind and run their extent."""

    def __init__(self, pictures: list[dict[str, Any]]):
        self.pictures = pictures
        self.highest: dict[str, float] = {}
        self.extents: dict[tuple[str, str], list[float]] = {}
        for picture in pictures:
            self._read(picture)

    def _read(self, picture: dict[str, Any]) -> None:
        """Keeps what it reads: the files are needed twice, for the ranges and to be drawn."""
        view = picture["view"] = View(picture["section"])
        kind = picture["kind"]
        if kind == "fluid_speed":
            fluid = pyvista.read(picture["fluid"])
            picture["slice"] = fluid_slice(view, fluid)
            picture["lines"] = stream_lines(view, fluid, picture.get("streamlines"))
            self._include(picture, fluid.bounds, np.asarray(picture["slice"]["speed"]), 99.8)
        else:
            grains = picture["grains"] = pyvista.read(picture["particles"])
            largest = grains["diameter"].max() if grains.n_points else 0.0
            low, high = grains.points.min(axis=0) - largest / 2, grains.points.max(axis=0) + largest / 2
            bounds = [value for pair in zip(low, high) for value in pair]
            values = np.linalg.norm(grains["velocity"], axis=1) if "velocity" in grains.point_data else np.zeros(0)
            self._include(picture, bounds, values, 99.8)

    def _include(self, picture: dict[str, Any], bounds: Any, values: np.ndarray, percentile: float) -> None:
        view, kind = picture["view"], picture["kind"]
        box = [*bounds[2 * view.lateral:2 * view.lateral + 2], *bounds[2 * view.up:2 * view.up + 2]]
        given = picture.get("lateral")  # the domain's, where it is known
        if given:
            box[:2] = given
        old = self.extents.setdefault((kind, picture["run"]), list(box))
        self.extents[kind, picture["run"]] = [min(old[0], box[0]), max(old[1], box[1]), min(old[2], box[2]), max(old[3], box[3])]
        if values.size:
            self.highest[kind] = max(self.highest.get(kind, 0.0), float(np.percentile(values, percentile)))

    def extent(self, picture: dict[str, Any]) -> list[float]:
        low, high, bottom, top = self.extents[picture["kind"], picture["run"]]
        head = 0.12 * (top - bottom) if picture["kind"] == "bonds" else 0.02 * (top - bottom)  # room for the rod
        return [low, high, bottom - 0.02 * (top - bottom), top + head]

    def draw(self, picture: dict[str, Any], path: Path) -> dict[str, Any]:
        view, kind, extent = picture["view"], picture["kind"], self.extent(picture)
        plotter = view.plotter(extent)
        if kind == "fluid_speed":
            norm = palette.speed_norm(self.highest.get(kind, 0.0), palette.FLUID_DECADES)
            add_fluid(plotter, view, picture["slice"], picture["lines"], norm, extent)
        elif kind == "grain_speed":
            norm = palette.speed_norm(self.highest.get(kind, 0.0), palette.GRAIN_DECADES)
            values = np.linalg.norm(picture["grains"]["velocity"], axis=1)
            add_grains(plotter, view, picture["grains"], palette.rgb(values, palette.GRAIN_SPEED_COLOURS, norm))
        else:
            colours = palette.rgb(np.asarray(picture["grains"]["bonds"]), palette.BOND_COLOURS, palette.BOND_NORM)
            add_grains(plotter, view, picture["grains"], colours)
        if picture.get("walls"):
            add_walls(plotter, view, pyvista.read(picture["walls"]), picture.get("rod"), extent[1] - extent[0])
        plotter.screenshot(str(path))
        plotter.close()
        return {"extent": extent, "highest": self.highest.get(kind, 0.0), "file": str(path)}


def main(job_file: str) -> int:
    begin = time.perf_counter()
    folder = Path(job_file).parent
    job = Job(json.loads(Path(job_file).read_text(encoding="utf-8")))
    results = {picture["name"]: job.draw(picture, folder / f"{picture['name']}.png") for picture in job.pictures}
    results["seconds"] = time.perf_counter() - begin
    (folder / "drawn.json").write_text(json.dumps(results), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
