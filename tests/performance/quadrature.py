#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Error of the displacement against CPU time for every quadrature scheme, as a table and as a plot.

    tests/performance/quadrature.py --program build/perideal [--repeat N] [--problems column square] [--plot FILE.png]

Two problems, each on several meshes: prm/examples/tension_column.prm (three layers held at the ends, the sides free: all
schemes of springs have the error of the soft surface there, and ghosts none), and
prm/verification/graded_square.prm (a manufactured field on a graded mesh). Errors are relative l2 errors against the
exact displacement, times are those of whole runs on one core, medians of --repeat runs. Finite elements (Q1) of the same
meshes stand at the end. Plots need gnuplot.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ENVIRONMENT = {"OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
ROOT = Path(__file__).resolve().parents[2]
GAUSS = "Quadrature/Scheme=gauss points"
GHOSTS = ["Boundary conditions/Treatment=taylor ghosts", "Boundary conditions/Displacement treatment=automatic",
          "Boundary conditions/Layers=1"]
EXTENDED = "Material/Model=extended ordinary"
SCHEMES = {
    "one point": ["Quadrature/Scheme=one point"],
    "cubic cell": ["Quadrature/Scheme=cubic cell"],
    "partial volume": ["Quadrature/Scheme=partial volume"],
    "adaptive": ["Quadrature/Scheme=adaptive"],
    "exact": ["Quadrature/Scheme=exact"],
    "gauss 1": [GAUSS, "Quadrature/Gauss points=1"],
    "gauss 2": [GAUSS, "Quadrature/Gauss points=2"],
    "gauss 3": [GAUSS, "Quadrature/Gauss points=3"],
    "gauss 4": [GAUSS, "Quadrature/Gauss points=4"],
    "exact, energy of the sphere": ["Quadrature/Scheme=exact", "Material/Boundary compensation=sphere"],
    "exact, ghosts": ["Quadrature/Scheme=exact", *GHOSTS],
    "gauss 2, ghosts": [GAUSS, "Quadrature/Gauss points=2", *GHOSTS],
    "multipliers (energy form)": [EXTENDED, "Material/Form=energy", "Quadrature/Scheme=one point"],
    "consistent form": [EXTENDED, "Material/Form=consistent", "Quadrature/Scheme=one point", "Boundary conditions/Layers=1"],
}
PROBLEMS = {
    "column": ("prm/examples/tension_column.prm",
               {"2,000": "Mesh/Cells=10, 20, 10", "16,000": "Mesh/Cells=20, 40, 20"},
               ["Solver/Tolerance=1e-8"]),
    "square": ("prm/verification/graded_square.prm",
               {"1,600": "Mesh/Refinements=1", "6,400": "Mesh/Refinements=2", "25,600": "Mesh/Refinements=3"},
               ["Solver/Tolerance=1e-8"]),
}


def run(program, scene, settings):
    """summary.json of one run."""
    with tempfile.TemporaryDirectory() as directory:
        command = [str(program), str(ROOT / scene)]
        for setting in [*settings, f"Output directory={directory}", "Output/Fields=displacement"]:
            command += ["--set", setting]
        done = subprocess.run(command, env={**os.environ, **ENVIRONMENT}, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
        return json.loads((Path(directory) / "summary.json").read_text())


def measure(program, scene, settings, repeat):
    """Relative error and median seconds."""
    results = [run(program, scene, settings) for _ in range(repeat)]
    return results[0]["errors"]["exact"]["l2"], statistics.median(r["seconds"]["total"] for r in results)


def finite_elements(program, scene, settings, repeat):
    """The same of Q1 finite elements; their own mesh, assembly, multigrid and solve."""
    results = [run(program, scene, [*settings, "Comparison/FEM=true"]) for _ in range(repeat)]
    return (results[0]["errors"]["fem"]["own error against exact"]["l2"],
            statistics.median(r["seconds"]["fem"] + r["seconds"]["mesh"] for r in results))


def plot(rows, path):
    """One panel a problem: error against time, a line a scheme."""
    problems = list(dict.fromkeys(row[0] for row in rows))
    script = [f'set terminal pngcairo size {620 * len(problems)}, 620 font ",10"', f'set output "{path}"',
              f"set multiplot layout 1, {len(problems)}", "set logscale xy", "set grid",
              "set key outside below maxcols 3", 'set xlabel "CPU time of the run [s]"',
              'set ylabel "relative l2 error of the displacement"', 'set format y "%.0e"']
    for problem in problems:
        names = list(dict.fromkeys(row[1] for row in rows if row[0] == problem))
        script.append(f'set title "{problem}"')
        for k, name in enumerate(names):
            points = "\n".join(f"{row[4]} {max(row[3], 1e-15)}" for row in rows if row[0] == problem and row[1] == name)
            script.append(f"$data{k} << EOD\n{points}\nEOD")
        script.append("plot " + ", ".join(f'$data{k} with linespoints title "{name}"' for k, name in enumerate(names)))
    subprocess.run(["gnuplot"], input="\n".join(script), text=True, check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, required=True)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--problems", nargs="+", choices=PROBLEMS, default=list(PROBLEMS))
    parser.add_argument("--plot", type=Path)
    options = parser.parse_args()

    rows = []
    for problem in options.problems:
        scene, meshes, common = PROBLEMS[problem]
        print(f"\n{scene}\n\n| scheme | " + " | ".join(f"{mesh} nodes: error | s" for mesh in meshes) + " |")
        print("|---|" + "---|---|" * len(meshes))
        for scheme, settings in [*SCHEMES.items(), ("finite elements", None)]:
            line = f"| {scheme} |"
            for mesh, cells in meshes.items():
                if settings is None:
                    error, seconds = finite_elements(options.program, scene,
                                                     [*common, cells, *SCHEMES["one point"]], options.repeat)
                else:
                    error, seconds = measure(options.program, scene, [*common, cells, *settings], options.repeat)
                rows.append((problem, scheme, mesh, error, seconds))
                line += f" {error:.2e} | {seconds:.2f} |"
            print(line, flush=True)
    if options.plot:
        plot(rows, options.plot)


if __name__ == "__main__":
    main()
