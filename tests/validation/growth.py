# SPDX-License-Identifier: LGPL-2.1-or-later
"""Specimens of the handbook whose cracks grow: at which load, taking how much, and where to."""

import importlib.util
from dataclasses import dataclass
from math import atan, cos, degrees, isfinite, pi, radians, sin, sqrt
from typing import Callable

from cracks import MODELS
from page import Row
from scenes import HERE, Failed, slope

# The models whose cracks grow here, with the cells on which displacements are prescribed around the K field.
GROWING = {"energy form": (MODELS["energy form"], 4),
           "springs": (MODELS["springs"], 4),
           "consistent form": (["Material/Model=extended ordinary", "Material/Form=consistent"], 1)}
YOUNG = 70e9
# Cells of growth between which loads are read: before, the process zone builds up; after, ligaments become short.
FROM, TO = 2, 6
# Growth of a load step, in cells: loads rise and fall by some per cent with the place of the tip in its cell.
STEP = .3


def edge_crack(a):
    """K_I of 1 MPa; the sources of these four stand in the scenes of stress_intensity."""
    share = a / .1
    return 1e6 * sqrt(pi * a) * (.265 * (1 - share)**4 + (.857 + .265 * share) / (1 - share)**1.5)


def centre_crack(a):
    share = a / .05
    return 1e6 * sqrt(pi * a / cos(pi * share / 2)) * (1 - .025 * share**2 + .06 * share**4)


def compact_tension(a):
    share = a / .08
    return 1e5 / sqrt(.08) * (2 + share) / (1 - share)**1.5 * (.886 + 4.64 * share - 13.32 * share**2 + 14.72 * share**3 -
                                                              5.6 * share**4)


def double_cantilever(a):
    return 1e4 * sqrt(12 / .02) * (a / .02 + .673)


@dataclass
class Specimen:
    """A specimen of stress_intensity: K_I at t = 1 by the crack's length, that length, its tips, its rectangle (corner,
    width, height), and the columns of its meshes."""
    intensity: Callable
    length: float
    tips: int
    rectangle: tuple
    columns: tuple


SPECIMENS = {
    "edge_crack": Specimen(edge_crack, .05, 1, (0, 0, .1, .2), (40, 80)),
    "centre_crack": Specimen(centre_crack, .025, 2, (0, 0, .1, .2), (40, 80)),
    "compact_tension": Specimen(compact_tension, .04, 1, (-.02, -.048, .1, .096), (50, 100)),
    "double_cantilever": Specimen(double_cantilever, .08, 1, (0, -.02, .14, .04), (140, 280)),
}


@dataclass
class Growth:
    """What one run tells: load over Griffith's between FROM and TO cells of growth, G of the domain integral there over G0,
    what was dissipated over G0 times the new length [-], and the angle off straight on [degrees]."""
    loads: list
    releases: list
    taken: float
    angle: float


def read(run, energy, size, tips, griffith):
    """The figures of a run. energy: G0; size: of cells; griffith: Griffith's t at a growth of each tip.

    A crack counts for as long as what it dissipated: its nodes count as broken only once it has passed, two cells later.
    """
    times, lengths = run.column("time"), [values for name, values in run.history.items() if name.startswith("length of")]
    dissipated = run.column("dissipated energy [J]")
    grown = [value / energy / tips for value in dissipated]
    window = [k for k, growth in enumerate(grown) if FROM * size <= growth <= TO * size]
    steady = [k for k, length in enumerate(lengths[0]) if length - lengths[0][0] >= 1.2 * size]
    if not window:
        raise Failed("no growth")
    releases = [run.column("G of")[k] / energy for k in window]
    angles = [min(abs(crack["angle"]), 180 - abs(crack["angle"])) for crack in run.summary["cracks"].values() if crack["angle"] is not None]
    # Of centre cracks the length is that of the precrack and what grew at one tip.
    return Growth([times[k] / griffith(grown[k]) for k in window], [value for value in releases if isfinite(value)],
                  slope([sum(length[k] for length in lengths) for k in steady], [dissipated[k] for k in steady]) / energy,
                  max(angles, default=float("nan")))


def rows_of(specimen, source, mesh, growths):
    """The rows of one specimen and model on its meshes, the finer last."""
    def told(figure):
        return ", ".join("none" if not values else f"{sum(values) / len(values):.3f} ({min(values):.3f}-{max(values):.3f})"
                         for values in map(figure, growths))

    off = [abs(sum(growth.loads) / len(growth.loads) - 1) for growth in growths]
    nearer = off[-1] <= max(off[0], .01)
    return [Row(specimen, source, mesh, f"load over Griffith's, {FROM} to {TO} cells of growth: mean (range)",
                "1.00 +- .04, nearer or within .01 on the finer", told(lambda growth: growth.loads),
                "yes" if max(off) <= .04 and nearer else "no"),
            Row(specimen, source, mesh, "G of the domain integral then over G0: mean (range)", "",
                told(lambda growth: growth.releases)),
            Row(specimen, source, mesh, "dissipated over G0 times new length", "1.00 +- .05",
                ", ".join(f"{growth.taken:.3f}" for growth in growths),
                "yes" if all(abs(growth.taken - 1) <= .05 for growth in growths) else "no"),
            Row(specimen, source, mesh, "direction off [degrees]", "3", ", ".join(f"{growth.angle:.1f}" for growth in growths),
                "yes" if all(growth.angle <= 3 for growth in growths) else "no")]


def rows_of_runs(specimen, source, mesh, runs):
    """The rows of the runs that come to an end, and one for each that does not; runs: functions, the finer last."""
    growths, rows = [], []
    for run in runs:
        try:
            growths.append(run())
        except Failed as failure:
            rows.append(Row(specimen, source, mesh, "a run to its end", "", str(failure), "no"))
    return (rows_of(specimen, source, mesh, growths) if growths else []) + rows


def handbook_growth(runner, name, model, columns, unstructured):
    """Growth of a specimen of the handbook; G0 is such that Griffith's load is t = 0.775."""
    specimen = SPECIMENS[name]
    left, bottom, width, height = specimen.rectangle
    size = width / columns
    modulus = YOUNG / (1 - (.25 if model == "springs" else .3)**2)
    energy = .6 * specimen.intensity(specimen.length)**2 / modulus
    settings = [*GROWING[model][0], "Material/Softening=linear", f"Material/Fracture energy={energy}", "Solver/Tolerance=1e-6",
                "Solver/Control=dissipated energy", f"Solver/Control end={(10 if specimen.tips == 1 else 14) * size * energy}",
                f"Solver/Control step={STEP * specimen.tips * size * energy}", "Solver/Load steps=10"]
    if unstructured:
        mesh = runner.mesh("growth/plate.geo", f"{name}_{columns}", Left=left, Bottom=bottom, Width=width, Height=height,
                           Size=size)
        settings += ["Mesh/Generator=", "Mesh/Corner=", f"Mesh/File={mesh}"]
        if model != "consistent form":
            settings.append("Boundary conditions/Traction treatment=transfer")
    else:
        settings += [f"Mesh/Cells={columns}, {round(height / size)}", f"Precracks/crack/Points={short_crack(name)}"]
    run = runner.run(f"stress_intensity/{name}.prm", f"growth/{name} {model} {columns} {'un' * unstructured}structured", settings)
    return read(run, energy, size, specimen.tips,
                lambda growth: sqrt(energy * modulus) / specimen.intensity(specimen.length + growth))


def short_crack(name):
    """The precrack whose tip is a hair short of the corner of cells, as stress_intensity/run.py draws it."""
    spec = importlib.util.spec_from_file_location("stress_intensity", HERE / "stress_intensity/run.py")
    handbook = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(handbook)
    return handbook.SPECIMENS[name][2]


def field(angle):
    """u_x and u_y of the field of growth/k_field.prm about a crack that is turned by an angle."""
    c, s = cos(angle), sin(angle)
    along, across = f"({c:.12g}*x + ({s:.12g})*y)", f"({c:.12g}*y - ({s:.12g})*x)"
    theta = f"atan2({across}, {along})"
    length = f"1.42478e-5*t*sqrt(sqrt(x^2 + y^2))*(2 - cos({theta}))"
    return [f"Boundary conditions/around/u_x={length}*({c:.12g}*cos(0.5*{theta}) - ({s:.12g})*sin(0.5*{theta}))",
            f"Boundary conditions/around/u_y={length}*({s:.12g}*cos(0.5*{theta}) + ({c:.12g})*sin(0.5*{theta}))"]


def field_growth(runner, model, cells, angle, unstructured):
    """Growth in the field of a stress intensity, at an angle to the grid."""
    scene, size, energy = "growth/k_field.prm", 1 / cells, 8
    name = f"growth/k_field {model} {cells} {'unstructured' if unstructured else f'{degrees(angle):.0f}'}"
    c, s = cos(angle), sin(angle)
    chosen, layers = GROWING[model]
    settings = [*chosen, *field(angle), f"Boundary conditions/Layers={layers}", f"Mesh/Cells={cells}, {cells}", f"Cracks/tip/Direction={c}, {s}"]
    if unstructured:
        mesh = runner.mesh("growth/plate.geo", f"k_field_{cells}", Left=-.5, Bottom=-.5, Width=1, Height=1, Size=size)
        settings += ["Mesh/Generator=", "Mesh/Corner=", f"Mesh/File={mesh}"]
    lengths, releases = [k * 3 * size for k in range(3)], []
    for k, length in enumerate(lengths):
        tip = length - 1e-6
        elastic = runner.run(scene, f"{name} elastic {k}",
                             [*settings, "Material/Fracture energy=0", "Material/Softening=none", "Solver/Control=loads",
                              "Solver/Load steps=1", f"Precracks/crack/Points={-c}, {-s}; {tip * c}, {tip * s}",
                              f"Cracks/tip/Origin={length * c}, {length * s}"])
        releases.append(elastic.column("G of")[-1])
    run = runner.run(scene, name, [*settings, f"Precracks/crack/Points={-c}, {-s}; {-1e-6 * c}, {-1e-6 * s}",
                                   f"Solver/Control end={12 * size * energy}", f"Solver/Control step={STEP * size * energy}"])

    def griffith(growth):
        k = min(int(growth / lengths[1]), 1)
        share = growth / lengths[1] - k
        return sqrt(energy / ((1 - share) * releases[k] + share * releases[k + 1]))

    return read(run, energy, size, 1, griffith)


def growth(runner, long):
    """Cracks of the handbook's specimens and in the field of a stress intensity, by model, mesh and angle to the grid.

    Without a grid specimens have the coarser mesh only, whose bonds are each calibrated by themselves, which takes as long as
    the run. Of two the handbook knows nothing then: centre cracks grow at one tip first, those of double cantilevers turn
    aside, by 9 mm within 10 mm with the energy form.
    """
    rows = []
    for model, unstructured in ((model, unstructured) for unstructured in (False, True) for model in GROWING):
        for angle in (0, atan(.5), radians(45)) if not unstructured else (0, ):
            sizes = (40, 80) if long else (40, )
            mesh = (f"{model}, {'unstructured' if unstructured else f'{degrees(angle):.1f} degrees to the grid'}; "
                    f"{', '.join(str(number) for number in sizes)} columns")
            rows += rows_of_runs("crack in a K field", "Williams 1957", mesh,
                                 [lambda number=number: field_growth(runner, model, number, angle, unstructured)
                                  for number in sizes])
        for name, specimen in SPECIMENS.items():
            if unstructured and name not in ("edge_crack", "compact_tension"):
                continue
            columns = specimen.columns if long and not unstructured else specimen.columns[:1]
            mesh = (f"{model}, {'unstructured' if unstructured else 'along the grid'}; "
                    f"{', '.join(str(number) for number in columns)} columns")
            rows += rows_of_runs(name.replace("_", " ") + " that grows", "handbook named in its scene", mesh,
                                 [lambda number=number: handbook_growth(runner, name, model, number, unstructured)
                                  for number in columns])
    return rows
