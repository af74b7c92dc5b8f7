# SPDX-License-Identifier: MIT
"""What docs/material.md says around its tables."""

HEAD = """# Behaviour of the material

Made by `perf/material/run.py`; do not edit. {date}; {version}; {machine}, beside other programs;
{minutes:.0f} minutes of one core in all. All triaxial tests: `perf/results/{name}/material.csv`.

Samples fill a box that is periodic on all sides, so there are no walls and no gravity: the paper's sizes (0.15 to
0.355 mm), pressed without friction to the confining stress on every axis, then sheared by a constant axial strain rate
while x and y keep that stress (`scenes/triaxial.toml`, `scenes/triaxial_bonded.toml`) or stand still
(`scenes/oedometer.toml`). The rates keep the inertial number, rate × diameter × √(density / confinement), at 1e-3:
quasi-static. "±" is half the range over the seeds, which are other samples of the same sand. A peak is the largest
σz/σx of a running mean over 0.25 % strain. E50 is half the peak deviator over its strain. The gates were set before the
runs; **no** is a gate that fails.
"""

DRY = """## Dry sand: the Mohr–Coulomb line (D16)

2000 grains, E = 2 GPa, a tenth of the paper's (overlaps of 0.1 to 0.5 %), Hertz, no rolling resistance. Gates at the peak:
one straight line through the origin over the three confinements with R² > 0.99 for every seed; φ of the seeds within 1°;
at μ = 0.5, φ between 25 and 33°. R² is about the mean of t = (σz − σx)/2.
"""

DRY_STIFF = """Soft grains overlap, so the porosity before the shear falls with the confinement and φ of the peak rises: the
sample at 2 GPa and 1 MPa is not the one at 0.1 MPa. With the paper's E = 20 GPa, from the samples of D17 without surface
energy, to 6 % strain:
"""

DRY_LARGE = """With 5000 grains, as the case asks for:
"""

DRY_CHECKS = """What the choices do, at 0.5 MPa, μ = 0.5, one seed:
"""

BONDED = """## Cemented sand: cohesion (D17)

2000 grains, E = 20 GPa, μ = 0.2. The dry sample of each confinement and seed is given the surface energy (JKR), follows to
the confining stress, and all that touches is bonded (modified JKR). So fabric and porosity are all but the same at every
γ. c′ and φ′ are of the line through the peaks at three confinements, a seed at a time. Rumpf's tensile strength is
(1 − n) Z F_C / (π d²) with F_C = 3πγd/4, d = 0.23 mm and the bonds a grain, Z, at the start.
"""

BONDED_CHECKS = """The rate, at 0.5 MPa, γ = 30 J/m², one seed:
"""

SCALED = """## Coarse graining (G3)

The same volume of sand, 2000 grains at k = 1 and 250 at k = 2, of sizes times k (SSW) or of one size (SSP). The oedometer
is dry sand (μ = 0.2) from 0.1 MPa; the triaxial test is cemented sand (γ = 30 J/m² of the original grains) at 0.5 MPa. Rates
are those of k = 1 over k, at the same inertial number. Gate: L2 gap of the mean curve below 5 % at k = 2, and within the
scatter of the seeds.
"""

SCALED_LARGE = """Four times the volume: 8000 grains at k = 1, 1000 at k = 2, 125 at k = 4.
"""
