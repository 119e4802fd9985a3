#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Accuracy and cost of the correspondence model, as tables.

    tests/performance/correspondence.py --program build/perideal [--part convergence plate step] [--repeat N]

convergence: errors and orders of both forms on prm/verification/correspondence_convergence.prm, beside Q1 elements.
plate: set-up and solve of the anisotropic plate with a hole (prm/examples/laminate_with_hole.prm) by correspondence, with
and without its penalty, and by bonds with tensors; medians of --repeat runs of each in turn, as ratios to bonds with tensors
in the form "one point". Errors are those against one reference for all, on the finest mesh.
step: a load step of quasi static with a Saint Venant-Kirchhoff material over the linear static solve of the same square of
22,500 points.
All on --ranks ranks.
"""

import argparse
import math
import statistics
import sys
import tempfile

from runs import add_arguments, run, sized_mesh

FAMILY = "Material/Form=family"

# Settings of a column by its name; of tables: heading, cells a side, settings by these.
CLOUDS = {"regular": [], "perturbed": ["Nodes/Perturbation=0.1"], "distorted": ["Mesh/Distortion=0.1"]}
CONVERGENCE = [
    ("consistent, values at the faces", [12, 24, 48, 96], lambda cells: []),
    ("family, a collar of a sixth", [24, 48, 96, 192], lambda cells: [FAMILY, f"Boundary conditions/Layers={cells // 6}"]),
    ("family, a collar of four layers", [12, 24, 48, 96, 192], lambda cells: [FAMILY, "Boundary conditions/Layers=4"]),
]

COLLAR = ["Boundary conditions/Displacement treatment=reference", "Boundary conditions/Layers=3"]
CORRESPONDENCE = "Material/Model=correspondence"
PLATE_MODELS = {
    "tensors, one point": ["Material/Form=one point", *COLLAR],
    "tensors, moment corrected": ["Material/Form=moment corrected", *COLLAR],
    "family, no penalty": [CORRESPONDENCE, FAMILY, "Material/Stabilisation=0", *COLLAR],
    "family": [CORRESPONDENCE, FAMILY, *COLLAR],
    "consistent": [CORRESPONDENCE],
}
PLATE_SIZES = ["2.5e-3", "1e-3", "5e-4"]  # of the squares [m]

STEPS = 2
SQUARE = ["Mesh/Cells=150, 150", "Mesh/Size=1, 1", "Comparison/FEM=false", "Boundary conditions/right/u_x=0.02*t"]


def summary_of(arguments, scene, settings, may_fail=False):
    """summary.json of one run; of one without convergence, too, where it may fail."""
    done = run(arguments, scene, [*settings, "Output/Fields=displacement"], may_fail=may_fail)
    if done.status not in (0, 2):
        sys.exit(f"correspondence.py: exit status {done.status}\n{done.output}")
    return done.summary


def print_convergence(arguments):
    for heading, sizes, settings in CONVERGENCE:
        print(f"\n{heading}\n\n| cells | " + " | order | ".join(CLOUDS) + " | order | Q1 elements |")
        print("|--:" * (2 * len(CLOUDS) + 2) + "|")
        coarse = {}
        for cells in sizes:
            row = [str(cells)]
            for name, cloud in CLOUDS.items():
                errors = summary_of(arguments, "prm/verification/correspondence_convergence.prm",
                                    [f"Mesh/Cells={cells}, {cells}", *settings(cells), *cloud])["errors"]
                error = errors["exact"]["l2"]
                row += [f"{error:.2e}", f"{math.log2(coarse[name] / error):.2f}" if name in coarse else ""]
                coarse[name] = error
                if name == "regular":
                    elements = errors["fem"]["own error against exact"]["l2"]
            print("| " + " | ".join([*row, f"{elements:.2e}"]) + " |", flush=True)


def print_plate(arguments):
    print("\n| nodes | model | iterations | converged | l2 error | set-up | solve | both |\n|--:|---|--:|---|--:|--:|--:|--:|")
    with tempfile.TemporaryDirectory() as directory:
        for size in arguments.sizes:
            common = [f"Mesh/File={sized_mesh(directory, 'meshes/laminate_with_hole.geo', size)}", "Comparison/FEM=false",
                      "Comparison/Reference mesh=meshes/laminate_with_hole_fine.geo",
                      "Comparison/Reference refinements=0", *arguments.set]
            runs = {model: [] for model in PLATE_MODELS}
            for _ in range(arguments.repeat):
                for model, settings in PLATE_MODELS.items():
                    runs[model].append(summary_of(arguments, "prm/examples/laminate_with_hole.prm",
                                                  [*common, *settings], may_fail=True))
            seconds = {model: {phase: statistics.median(sum(r["seconds"][p] for p in phase.split("+")) for r in results)
                               for phase in ("setup", "solve", "setup+solve")} for model, results in runs.items()}
            base = seconds["tensors, one point"]
            for model, results in runs.items():
                solver, errors = results[0]["solver"], results[0].get("errors", {})
                error = f"{errors['reference']['l2']:.2e}" if "reference" in errors else ""
                print(f"| {results[0]['nodes']:,} | {model} | {sum(solver['iterations'])} | "
                      f"{'yes' if solver['converged'] else 'no'} | {error} | "
                      + " | ".join(f"{seconds[model][phase] / base[phase]:.2f}" for phase in base) + " |", flush=True)


def print_step(arguments):
    linear = ["Material/Law=linear elastic", "Solver/Name=static", "Solver/Load steps=1"]
    steps = ["Solver/Name=quasi static", f"Solver/Load steps={STEPS}"]
    times, iterations = {"static": [], "step": []}, {}
    for _ in range(arguments.repeat):
        for name, settings, n in (("static", linear, 1), ("step", steps, STEPS)):
            summary = summary_of(arguments, "prm/examples/hyperelastic_bar.prm", [*SQUARE, *settings])
            times[name].append(summary["seconds"]["solve"] / n)
            iterations[name] = summary["solver"]["iterations"], summary["solver"].get("linear_iterations")
    ratios = sorted(s / l for s, l in zip(times["step"], times["static"]))
    print(f"\nA load step over the linear solve, {arguments.ranks} ranks: {statistics.median(ratios):.1f} "
          f"({ratios[0]:.1f} to {ratios[-1]:.1f}); iterations of the solve {iterations['static'][0]}, "
          f"of Newton's method {iterations['step'][0]}, their linear ones {iterations['step'][1]}")


PARTS = {"convergence": print_convergence, "plate": print_plate, "step": print_step}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_arguments(parser, repeat=5)
    parser.add_argument("--part", nargs="+", choices=PARTS, default=list(PARTS))
    parser.add_argument("--sizes", nargs="+", default=PLATE_SIZES, help="of the plate's squares [m]")
    parser.add_argument("--set", action="append", default=[], help="of the part plate, as of perideal")
    arguments = parser.parse_args()
    for part in arguments.part:
        PARTS[part](arguments)


if __name__ == "__main__":
    main()
