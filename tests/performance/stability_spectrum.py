# SPDX-License-Identifier: LGPL-2.1-or-later
"""Eigenvalues of free bodies of every model for stability.py, by the program performance_spectrum."""

import math
import subprocess
import sys
from pathlib import Path

import runs
from stability_cases import SQUARE, Case, Study

STUDY = Study("eigenvalues", "lowest elastic eigenvalue of the energy form over that of the model",
              "20; as many zero eigenvalues as rigid-body motions, none below, none complex", None, None)
BOUND = 20.
ROUND_OFF = 1e-9
REFERENCE = ("extended ordinary", "energy")
WORDS = ("turn freely", "push sideways", "follow from no energy", "without a penalty")


def find_spectrum(options):
    """The program, where it was not named: in the build tree to which the program belongs."""
    if options.spectrum:
        return options.spectrum
    folder = Path(options.program).parent
    for place in (folder, folder.parent):
        path = place / "tests" / "performance" / "performance_spectrum"
        if path.exists():
            return str(path)
    sys.exit(f"no tests/performance/performance_spectrum beside {options.program}: build it, or name it with --spectrum")


def read_table(text):
    """Rows of the table of models as dictionaries by its headings."""
    lines = [[cell.strip() for cell in line.strip("| ").split("|")] for line in text.splitlines() if line.startswith("|")]
    start = next(k for k, line in enumerate(lines) if line[0] == "model")
    return [dict(zip(lines[start], line)) for line in lines[start + 2:]]


def figure_of(row, reference):
    """How much softer the model's first elastic mode is; infinite with other zero modes than rigid-body motions, with
    eigenvalues below zero, and with complex ones, by which motions grow."""
    dim = int(row["dim"])
    zero, negative, imaginary = int(row["zero modes"]), int(row["negative"]), float(row["largest imaginary part"])
    if zero != dim * (dim + 1) // 2 or negative > 0 or imaginary > ROUND_OFF:
        return math.inf
    return float(reference["first"]) / float(row["first"])


def told(options, row):
    """What --check warns about a body of that model that nothing holds."""
    form = row["form"].split(",")[0]
    settings = [f"Dimension={row['dim']}", f"Material/Model={row['model']}", "Material/Poisson ratio=0.3",
                "Mesh/Cells=" + ("14, 14" if row["dim"] == "2" else "6, 6, 6")]
    if row["model"] not in ("bond based", "ordinary"):
        settings.append(f"Material/Form={form}")
    if row["model"] == "correspondence" or form in ("consistent", "surface cure"):
        settings.append("Boundary conditions/Rigid body motions=remove")
    else:
        settings += ["Solver/Name=dynamics", "Solver/End time=1"]
    if "no penalty" in row["form"]:
        settings.append("Material/Stabilisation=0")
    if row["dim"] == "2":
        settings.append("Material/Assumption=plane stress")
    run = runs.run(options, SQUARE, settings, check=True, may_fail=True)
    return [line for line in run.warnings() if any(word in line for word in WORDS)]


def rows(options, make_row):
    """Rows of the study: make_row(study name, case, verdict, figure, bound, what the program says)."""
    done = subprocess.run([find_spectrum(options), "models"], capture_output=True, text=True, check=True)
    table = read_table(done.stdout)
    result = []
    for row in table:
        same = [other for other in table if other["dim"] == row["dim"] and other["distortion"] == row["distortion"]]
        reference = next(other for other in same if (other["model"], other["form"]) == REFERENCE)
        figure = figure_of(row, reference)
        name = row["model"] if row["model"] in ("bond based", "ordinary") else f"{row['model']} {row['form']}"
        case = Case(f"{row['dim']}-D, distortion {row['distortion']}", name, [])
        says = f"{row['zero modes']} zero, {row['negative']} negative (lowest {row['lowest']}), first elastic {row['first']}"
        verdict = "ok"
        if not figure <= BOUND:
            warned = told(options, row)
            verdict = "warned" if warned else "silent"
            says += "; " + warned[0].removeprefix("warning").strip() if warned else ""
        result.append(make_row(STUDY.name, case, verdict, figure, BOUND, says if verdict != "ok" else ""))
        print(f"eigenvalues: {case.value}, {name}: {figure:.2e}, {verdict} {says}", flush=True)
    return result
