# SPDX-License-Identifier: LGPL-2.1-or-later
"""Specimens that linear elastic fracture mechanics judges: what crack surfaces take, and at which load they grow."""

import importlib.util
from math import isfinite, sqrt

from page import Row, judged
from scenes import HERE, SPRINGS, Failed, peak, slope

MODELS = {"ordinary": ["Material/Model=ordinary"],
          "energy form": ["Material/Model=extended ordinary", "Material/Form=energy"],
          "springs": SPRINGS}
# With what load steps take where a scene names no form.
DEFAULT = "consistent form, the default"
ALONG_LOAD_STEPS = {**MODELS, DEFAULT: ["Material/Model=extended ordinary", "Material/Form=automatic"]}
STRESS, STRAIN = ["Material/Assumption=plane stress"], ["Material/Assumption=plane strain"]
# What is varied, one at a time: by name, the settings of each value; springs have one Poisson's ratio.
VARIED = {
    "horizon 2.01, 3.01, 4.01, 5.01": [[f"Nodes/Horizon factor={m}"] for m in (2.01, 3.01, 4.01, 5.01)],
    "influence constant, inverse, gaussian, cubic spline":
        [[f"Nodes/Influence function={name}"] for name in ("constant", "inverse", "gaussian", "cubic spline")],
    "nu .1, .3, .45 in plane strain": [[f"Material/Poisson ratio={nu}"] for nu in (.1, .3, .45)],
    "nu .1, .3, .45 in plane stress": [STRESS + [f"Material/Poisson ratio={nu}"] for nu in (.1, .3, .45)],
    "plane stress, plane strain": [STRESS, STRAIN],
    "cubes": [["Dimension=3", "Mesh/Cells=16, 20, 8", "Mesh/Size=0.016, 0.02, 0.008", "Boundary conditions/bottom/u_z=0",
               "Boundary conditions/top/u_z=0"]],
}


def separation(runner, _):
    """Two halves pulled apart rigidly: dissipated over the fracture energy, 100 J/m^2, of the area."""
    rows = []
    for model, settings in MODELS.items():
        for varied, values in VARIED.items():
            if ("nu" in varied) if model == "springs" else varied.startswith("plane"):
                continue
            read = [separate(runner, f"{model} {varied}", settings + value) for value in values]
            rows.append(Row("separation", "definition of G0", f"{model}; {varied}", "dissipated over G0", "1.00 +- .01",
                            ", ".join(f"{value:.3f}" for value in read), judged(read, .99, 1.01)))
    return rows


def separate(runner, name, settings):
    """Dissipated over G0 of one case, in load steps of 2e-7 m (cubes: twice that), until nothing is left in between.

    Breaks wait for the end of a load step: longer ones dissipate less.
    """
    solid = "Dimension=3" in settings
    for opening in (8e-5, 1.6e-4, 3.2e-4):
        run = runner.run("../scenes/separation.prm", "separation/" + name.split(",")[0],
                         [*settings, f"Boundary conditions/top/u_y={opening}*t",
                          f"Solver/Load steps={round(opening / (4e-7 if solid else 2e-7))}"])
        energy = run.summary["energy"]
        if abs(energy["strain"]) <= 1e-9 * energy["dissipated"]:
            return energy["dissipated"] / (100 * (.016 * .008 if solid else .04))
    raise Failed(f"{name}: the halves are not apart")


def strip(runner, long):
    """The strip under pure shear: the load at which it grows, G by the domain integral, and what it dissipates."""
    rows = []
    for model in ("energy form", "springs", DEFAULT):
        for columns in (60, 90, 120, *([180] if long else [])):
            mesh = f"{model}, {columns} x {columns // 3}"
            nu = 1 / 3 if model == "springs" else .35
            try:
                run = runner.run("strip/strip.prm", f"strip/{mesh}",
                                 [f"Mesh/Cells={columns}, {columns // 3}", *ALONG_LOAD_STEPS[model]])
            except Failed as failure:
                rows.append(Row("strip", "Rivlin and Thomas", mesh, "a run to its end", "", str(failure), "no"))
                continue
            griffith = sqrt(2 * 300 * (.05 - .15 / columns) * (1 - nu**2) / 3.2e9)
            steady = [k for k, length in enumerate(run.column("length of")) if .075 <= length <= .115]
            load = [run.column("displacement of top along y")[k] / griffith for k in steady]
            release = [run.column("G of")[k] / 300 for k in steady if isfinite(run.column("G of")[k])]
            taken = slope([run.column("length of")[k] for k in steady],
                          [run.column("dissipated energy [J]")[k] for k in steady]) / 300
            mean = sum(load) / len(load)
            for figure, asked, read, within in (
                    ("u_y at growth over Griffith's: mean (range)", "1.00 +- .04",
                     f"{mean:.3f} ({min(load):.3f}-{max(load):.3f})", judged([mean], .96, 1.04)),
                    ("G of the domain integral at growth over G0: mean (range)", "",
                     f"{sum(release) / len(release):.3f} ({min(release):.3f}-{max(release):.3f})", "-"),
                    ("dissipated over G0 times new length", "1.00 +- .05", f"{taken:.3f}", judged([taken], .95, 1.05))):
                rows.append(Row("strip", "Rivlin and Thomas", mesh, figure, asked, read, within))
    return rows


def slit_square(runner, long):
    """The square with a slit: its peak over that of Griffith by the domain integral, energy, iterations, time."""
    rows = []
    for cells in (64, *([128] if long else [])):
        mesh, scene = f"{cells} x {cells}", "../../prm/examples/slit_square.prm"
        size = f"Mesh/Cells={cells}, {cells}"
        elastic = runner.run(scene, f"slit_square/elastic {cells}",
                             [size, "Material/Fracture energy=0", "Material/Softening=none", "Solver/Control=loads",
                              "Solver/Load steps=1"])
        share = sqrt(2700 / elastic.column("G of")[-1])
        griffith = share * elastic.column("reaction of top along y")[-1]
        try:
            run = runner.run(scene, f"slit_square/{cells}", [size])
        except Failed as failure:
            rows.append(Row("square with a slit", "Miehe et al. 2010", mesh, "a run to its end", "", str(failure), "no"))
            continue
        runner.plot("plot_reaction.sh", run, "top", "y")
        moved, load = peak(run.column("displacement of top along y"), run.column("reaction of top along y"))
        over, taken = load / griffith, run.summary["energy"]["dissipated"] / 1.35
        most, iterations = max(run.history["iterations"]), int(sum(run.history["iterations"]))
        seconds = "<= 60" if cells == 128 else ""
        for figure, asked, read, within in (
                ("peak over Griffith's", "1.00 +- .02",
                 f"{over:.3f} ({1e-3 * load:.0f} N at {1e3 * moved:.2e} mm; Griffith's {1e-3 * griffith:.0f} N)",
                 judged([over], .98, 1.02)),
                ("dissipated over 1.35 N mm", "1.00 +- .03", f"{taken:.3f}", judged([taken], .97, 1.03)),
                ("most Newton iterations of a load step", "<= 60",
                 f"{most:.0f} ({iterations} in {len(run.history['iterations'])} load steps)", judged([most], 0, 60)),
                ("processor time [s]", seconds, f"{run.seconds:.0f}",
                 judged([run.seconds], 0, 60) if seconds else "-")):
            rows.append(Row("square with a slit", "Miehe et al. 2010", mesh, figure, asked, read, within))
    return rows


def stress_intensity(runner, _):
    """K_I of the specimens in stress_intensity, on 40 and 80 cells, over the handbook's."""
    spec = importlib.util.spec_from_file_location("stress_intensity", HERE / "stress_intensity/run.py")
    handbook = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(handbook)
    rows = []
    for specimen, (intensity, meshes, short) in handbook.SPECIMENS.items():
        for model, of_model in handbook.MODELS.items():
            for drawn, precrack in (("at a corner of cells", []),
                                    ("a hair short of it", [f"Precracks/crack/Points={short}"])):
                off = [handbook.intensity(runner.program, specimen,
                                          [*of_model, f"Mesh/Cells={cells}", *precrack]) / intensity - 1
                       for cells in meshes]
                within = "yes" if abs(off[0]) <= .03 and abs(off[1]) <= .015 else "no"
                rows.append(Row(specimen.replace("_", " "), "handbook named in the scene",
                                f"{model}, tip {drawn}; 40, 80 cells", "K_I off by", "3 %, 1.5 %",
                                ", ".join(f"{100 * value:+.1f} %" for value in off), within))
    return rows
