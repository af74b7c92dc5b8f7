# SPDX-License-Identifier: MIT
"""Opens a run's series in ParaView as one likes to see them: half of the sample, grains as spheres by bonds and by speed, fluid
speed on the section with streamlines.

    paraview --script=DIR/view.py             from a shell, or Tools > Python Shell > Run Script in ParaView
    pvpython view.py DIR --picture out.png    without a window

It stands beside the series that it opens; another run's folder may be named after it. Needs ParaView 5.10 or newer.
"""

import argparse
import os
import sys

from paraview.simple import (AnnotateTimeFilter, Clip, CellDatatoPointData, ColorBy, GetActiveViewOrCreate, GetAnimationScene,
                             GetColorTransferFunction, GetScalarBar, Glyph, Hide, PVDReader, Render, SaveScreenshot, Show,
                             Slice, Transform, Tube, UpdatePipeline)

SECTION_NORMAL = (1.0, 0.0, 0.0)  # the water comes along y in most scenes; (0, 1, 0) for the other half
COLOUR_GRAINS_BY = "bonds"  # or "velocity", "coordination", "diameter", "class"


def arguments():
    here = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else os.getcwd()
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", nargs="?", default=here)
    parser.add_argument("--picture", help="write this PNG and end")
    parser.add_argument("--by", default=COLOUR_GRAINS_BY, help="array that colours the grains")
    known, _ = parser.parse_known_args(sys.argv[1:])  # ParaView has words of its own there
    return known


def series(folder, name):
    path = os.path.join(folder, name + ".pvd")
    if not os.path.isfile(path):
        print(name + ".pvd is not in " + folder)
        return None
    reader = PVDReader(registrationName=name, FileName=path)
    UpdatePipeline(proxy=reader)
    return reader


def half(source, name, keep_whole_cells):
    """The half behind the section plane. Grains are kept whole: their glyphs come afterwards."""
    clip = Clip(registrationName=name, Input=source, ClipType="Plane")
    clip.ClipType.Origin = [0.0, 0.0, 0.0]
    clip.ClipType.Normal = list(SECTION_NORMAL)
    clip.Invert = 1
    clip.Crinkleclip = 1 if keep_whole_cells else 0
    return clip


def colour(display, array, view, title, preset):
    ColorBy(display, ("POINTS", array, "Magnitude") if array == "velocity" else ("POINTS", array))
    display.RescaleTransferFunctionToDataRange(True, False)
    table = GetColorTransferFunction(array)
    table.ApplyPreset(preset, True)
    display.SetScalarBarVisibility(view, True)
    bar = GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, ""
    bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
    bar.TitleFontSize, bar.LabelFontSize, bar.LabelFormat = 12, 11, "%.3g"


def show_grains(grains, view, by):
    spheres = Glyph(registrationName="grains as spheres", Input=half(grains, "half of the grains", True), GlyphType="Sphere")
    spheres.GlyphType.Radius = 0.5
    spheres.GlyphType.ThetaResolution = 16
    spheres.GlyphType.PhiResolution = 16
    spheres.OrientationArray = ["POINTS", "No orientation array"]
    spheres.ScaleArray = ["POINTS", "diameter"]
    spheres.ScaleFactor = 1.0
    spheres.GlyphMode = "All Points"
    display = Show(spheres, view)
    title = {"velocity": "grain speed [m/s]", "diameter": "diameter [m]"}.get(by, by)
    colour(display, by, view, title, "Cool to Warm" if by == "bonds" else "Inferno (matplotlib)")
    return display


def prepare_fluid(fluid, view):
    """Speed on the section plane; it would hide the grains, so it waits for a click on its eye in the pipeline."""
    at_points = CellDatatoPointData(registrationName="fluid at points", Input=fluid)
    plane = Slice(registrationName="fluid speed", Input=at_points, SliceType="Plane")
    plane.SliceType.Origin = [0.0, 0.0, 0.0]
    plane.SliceType.Normal = list(SECTION_NORMAL)
    colour(Show(plane, view), "speed", view, "fluid speed [m/s]", "Viridis (matplotlib)")
    Hide(plane, view)


def show_streamlines(lines, width, view):
    """Tubes by speed, pulled out of the grains towards the eye."""
    tubes = Tube(registrationName="streamlines as tubes", Input=lines)
    tubes.Radius = 0.006 * width
    before = Transform(registrationName="streamlines before the section", Input=tubes)
    before.Transform.Translate = [0.06 * width * component for component in SECTION_NORMAL]
    colour(Show(before, view), "speed", view, "fluid speed [m/s]", "Viridis (matplotlib)")


def show_walls(walls, view):
    display = Show(half(walls, "half of the walls", False), view)
    display.ColorArrayName = [None, ""]
    display.Representation = "Wireframe"
    display.AmbientColor = display.DiffuseColor = [0.45, 0.48, 0.52]


def aim(view, bounds):
    """Parallel view along the section's normal, the axis of the hole upwards."""
    centre = [(bounds[2 * i] + bounds[2 * i + 1]) / 2 for i in range(3)]
    distance = 10 * max(bounds[2 * i + 1] - bounds[2 * i] for i in range(3))
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = centre
    view.CameraPosition = [centre[i] + distance * SECTION_NORMAL[i] for i in range(3)]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    view.CameraParallelScale = max(0.62 * (bounds[5] - bounds[4]), 0.4 * (bounds[3] - bounds[2]))


def main():
    chosen = arguments()
    view = GetActiveViewOrCreate("RenderView")
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesLabelColor = [0.1, 0.1, 0.1]

    grains = series(chosen.folder, "particles")
    fluid, lines, walls = (series(chosen.folder, name) for name in ("fluid", "streamlines", "walls"))
    scene = GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.GoToLast()
    if grains:
        show_grains(grains, view, chosen.by)
    if fluid:
        prepare_fluid(fluid, view)
    if grains:
        UpdatePipeline(time=scene.AnimationTime, proxy=grains)
    bounds = grains.GetDataInformation().GetBounds() if grains else (-1, 1, -1, 1, -1, 1)
    if lines:
        show_streamlines(lines, bounds[3] - bounds[2], view)
    if walls:
        show_walls(walls, view)
    if grains or fluid:
        clock = Show(AnnotateTimeFilter(registrationName="time", Input=grains or fluid, Format="{time:.5f} s"), view)
        clock.Color = [0.1, 0.1, 0.1]
        clock.FontSize = 14
    aim(view, bounds)
    Render(view)
    if chosen.picture:
        SaveScreenshot(chosen.picture, view, ImageResolution=[1600, 1000])


main()
