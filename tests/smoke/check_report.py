# SPDX-License-Identifier: MIT
"""The report of a small run, of one without fluid, of a killed one and of what is left of one: pictures have content, curves
have the ledger's numbers, the page needs no network, and what is missing is said."""

import csv
import json
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import matplotlib.image
import numpy as np

PROGRAM, SCENES, PACKAGE = sys.argv[1], Path(sys.argv[2]), sys.argv[3]
sys.path.insert(0, PACKAGE)
from arenite_report import numbers  # noqa: E402
from arenite_report.numbers import Curve  # noqa: E402

faults: list[str] = []


def expect(truth: object, what: str) -> None:
    if not truth:
        faults.append(what)
        print(f"FAULT: {what}", flush=True)


def arenite(*words: object, code: int = 0) -> str:
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    expect(done.returncode == code, f"{words[:2]}: exit code {done.returncode}, not {code}: {done.stderr[-300:]}")
    return done.stdout + done.stderr


def rows_of(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def check_page(page: Path, wanted: set[str], unwanted: set[str] = frozenset()) -> str:
    """The page opens by itself; each wanted figure is in it, beside it as PNG and CSV, and not blank."""
    text = page.read_text(encoding="utf-8")
    files = page.with_name(page.stem)
    expect(not re.search(r"https?://|<script|<link|@import|src=\"(?!data:)", text), f"{page} asks for something from elsewhere")
    shown = set(re.findall(r'<figure id="([^"]+)"', text))
    expect(wanted <= shown, f"{page} lacks {sorted(wanted - shown)}")
    expect(not unwanted & shown, f"{page} should not have {sorted(unwanted & shown)}")
    expect("could not be drawn" not in text, f"{page}: a figure could not be drawn")
    expect(text.count("data:image/png;base64,") == len(shown), f"{page}: a picture for each figure")
    for name in shown:
        check_picture(files / f"{name}.png")
        expect(len(rows_of(files / f"{name}.csv")) > 0, f"{name}.csv has no rows")
    return text


def check_picture(path: Path) -> None:
    """Coloured pixels: axes and letters are grey, so that a figure without its curves has none."""
    pixels = matplotlib.image.imread(path)[:, :, :3]
    coloured = np.ptp(pixels, axis=2) > 0.15
    least = 0.05 if path.stem.startswith(("figure-6", "figure-9")) else 0.0005  # a curve is thin
    expect(coloured.mean() > least, f"{path.name}: only {100 * coloured.mean():.3f} % of the pixels have a colour")
    if path.stem.startswith(("figure-6", "figure-9")):
        body = pixels[:, : int(0.8 * pixels.shape[1])]  # without the bar
        expect(np.unique((body * 15).astype(int).reshape(-1, 3), axis=0).shape[0] > 60, f"{path.name}: hardly any shades")


def check_numbers() -> None:
    """Eqs 39 to 41 on cases that one does in the head."""
    value = numbers.rmsre(np.array([1.0, 2.0, 0.0]), np.array([1.1, 1.8, 5.0]))
    expect(abs(value - 10) < 1e-9, f"RMSRE of two errors of 10 % is {value}")
    curve = Curve(np.array([0.0, 1.0, 2.0, 4.0]), np.array([0.0, 1.0, 3.0, 4.0]))
    expect(curve.time_of_share(0.5) == 2.0 and curve.time_of_share(0.9) == 4.0, "t50 and t90 of a staircase")
    expect(list(curve.at(np.array([0.5, 1.0, 3.9]))) == [0.0, 1.0, 3.0], "a staircase holds its value until the next step")
    double = Curve(2 * curve.time, 3 * curve.mass)
    expect(numbers.rmsre_of_curves(curve, double) == 0.0, "scaled curves are the same without dimensions")
    expect(numbers.rmsre_of_masses(curve, double) > 10, "and not the same with them")


def check_curves(run: Path, files: Path) -> None:
    """Figure 10 has the ledger's numbers, figure 11 all of its mass, the summary's total is the same."""
    ledger, curve = rows_of(run / "produced.csv"), rows_of(files / "figure-10-produced-mass.csv")
    expect(len(ledger) > 3, "the small run produces some grains")
    begin = next(float(row["time"]) for row in rows_of(run / "history.csv") if row["stage"] == "production")
    time_kept = [float(row["time_s"]) for row in curve[1:-1]]
    mass_kept = [float(row["produced_mass_kg"]) for row in curve[1:-1]]
    total, same = 0.0, len(ledger) == len(mass_kept)
    for row, t, m in zip(ledger, time_kept, mass_kept):
        total += float(row["mass"])
        same = same and m == total and abs(t - (float(row["time"]) - begin)) < 1e-12
    expect(same, "the curve of figure 10 is not the ledger's")
    summary = json.loads((run / "summary.json").read_text(encoding="utf-8"))
    expect(abs(float(curve[-1]["produced_mass_kg"]) / summary["produced"]["mass"] - 1) < 1e-12, "the curve ends at the summary's mass")
    classes = sum(float(row["produced_mass_kg"]) for row in rows_of(files / "figure-11-mass-by-class.csv"))
    expect(abs(classes / total - 1) < 1e-12, f"the classes of figure 11 hold {classes} of {total} kg")


def main() -> int:
    check_numbers()
    work = Path(tempfile.mkdtemp(prefix="arenite-report-test-"))
    states = ["--set", "stages.perforation.field_interval=6e-5"]
    curves = {"figure-10-produced-mass", "figure-8-dimensionless", "figure-11-mass-by-class", "bonds-broken", "margins", "wall-load", "energy-shares"}

    wet = work / "wet"
    arenite("run", SCENES / "small.toml", "-o", wet, "-q", *states)
    begin = time.monotonic()
    said = arenite("report", wet)
    expect(time.monotonic() - begin < 60, f"the report took {time.monotonic() - begin:.0f} s")
    expect("missing" not in said, f"a whole run lacks something: {said}")
    check_page(wet / "report.html", curves | {"figure-6-bonds", "figure-9-fluid", "figure-9-grains"})
    check_curves(wet, wet / "report")
    expect((wet / "view.py").is_file(), "no script for ParaView beside the series")
    compile((wet / "view.py").read_text(encoding="utf-8"), "view.py", "exec")

    dry = work / "dry"
    arenite("run", SCENES / "small.toml", "-o", dry, "-q", *states, "--set", "stages.production.fluid=false")
    # Side by side with points that are its own curve: no error; figures of the paper's table 5 beside given times.
    # Of grains that left in the same step the last one's sum is the curve's.
    points = {float(row["time_s"]): float(row["produced_mass_kg"]) for row in rows_of(wet / "report" / "figure-10-produced-mass.csv")}
    (work / "points.csv").write_text("t,M\n" + "".join(f"{t!r},{m!r}\n" for t, m in points.items()), encoding="utf-8")
    (work / "scaling.csv").write_text("case,k,threads,wall_time\noriginal,1,8,81\nssw,2,8,10\n", encoding="utf-8")
    arenite("report", dry, wet, "-o", work / "both", "--reference", wet, "--measured", work / "points.csv", "--scaling", work / "scaling.csv")
    text = check_page(work / "both" / "report.html", curves | {"figure-9-grains", "figure-9-fluid", "figure-12-speed"})
    expect(re.search(r"<th>wet[^<]*</th><td>–</td><td>–</td><td>–</td><td>0.00 %", text), "the run has an error against its own points")
    expect(re.search(r"<th>8</th><td>8.10</td><td>8.10</td><td>9.40</td>", text), "table 5: 81 s over 10 s beside the paper's figures")
    arenite("report", dry, "-o", work / "dry.html")
    check_page(work / "dry.html", curves | {"figure-6-bonds", "figure-9-grains"}, {"figure-9-fluid"})

    killed = shutil.copytree(wet, work / "killed", ignore=shutil.ignore_patterns("report*", "summary.json"))
    for name in ("history.csv", "produced.csv"):
        content = (killed / name).read_bytes()
        (killed / name).write_bytes(content[:-25])
    shutil.rmtree(killed / "streamlines")
    said = arenite("report", killed)
    expect(said.count("cut short") == 2 and "summary.json" in said and "streamlines.pvd" in said, f"what is missing is said: {said}")
    check_page(killed / "report.html", curves | {"figure-6-bonds", "figure-9-fluid", "figure-9-grains"})

    rest = work / "rest"
    rest.mkdir()
    shutil.copy(wet / "history.csv", rest)
    arenite("report", rest, "-o", rest / "page.html")
    check_page(rest / "page.html", {"figure-10-produced-mass", "bonds-broken"}, {"figure-6-bonds"})

    (work / "empty").mkdir()
    expect("nothing of a run" in arenite("report", work / "empty", code=2), "an empty folder is no run")
    expect("no folder" in arenite("report", work / "nowhere", code=2), "a folder that is not there")
    (work / "bad.csv").write_text("t,M\nx,y\n", encoding="utf-8")
    expect("bad.csv" in arenite("report", wet, "--measured", work / "bad.csv", code=2), "a CSV without points")
    arenite("report", code=2)

    if faults:
        print(f"{len(faults)} faults; the runs are in {work}")
        return 1
    shutil.rmtree(work)
    print("all as it should be")
    return 0


sys.exit(main())
