#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Times the linear operators of tensor-involved and of ordinary state-based bonds in turn and prints their ratio.

    tests/performance/tensor_bonds.py --program build/perideal [--repeat N] [--dimensions 2 3]

Each run does the same number of unpreconditioned CG iterations on the same box of cells; a bond's time is that of the
solve over iterations and bonds. Medians of --repeat runs of either, one after the other.
"""

import argparse
import statistics
import sys
import tempfile
from pathlib import Path

from runs import add_arguments, run

CELLS = {2: "700, 700", 3: "56, 56, 56"}
MODELS = {"ordinary": ["Material/Model=ordinary"],
          "tensor involved": ["Material/Model=tensor involved", "Material/Form=moment corrected"],
          "bond based": ["Material/Model=bond based"]}
SCENE = """
set Dimension = {dimension}
subsection Mesh
  set Generator = box
  set Cells = {cells}
end
subsection Material
  set Young modulus = 70e9
  set Poisson ratio = 0.2
  set Density = 2700
end
subsection Solver
  set Preconditioner = none
  set Linear solver = cg
  set Tolerance = 1e-300
  set Maximum iterations = 60
end
subsection Boundary conditions
  subsection left
    set Boundary = left
    set u_x = 0
    set u_y = 0
    {hold_z}
  end
  subsection right
    set Boundary = right
    set t_x = 1e6
  end
end
"""


def nanoseconds_a_bond(arguments, dimension, model):
    """One run; it ends without convergence, as it is meant to."""
    with tempfile.TemporaryDirectory() as directory:
        scene = Path(directory) / "box.prm"
        scene.write_text(SCENE.format(dimension=dimension, cells=CELLS[dimension],
                                      hold_z="set u_z = 0" if dimension == 3 else ""), encoding="utf-8")
        done = run(arguments, scene, MODELS[model], may_fail=True)
    if done.status != 2 or not done.summary:
        sys.exit(f"tensor_bonds.py: exit status {done.status}\n{done.output}")
    iterations = done.summary["solver"]["iterations"][0]
    return 1e9 * done.summary["seconds"]["solve"] / (iterations * done.summary["bonds"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_arguments(parser, repeat=5)
    parser.add_argument("--dimensions", type=int, nargs="+", default=[2, 3])
    arguments = parser.parse_args()
    print("| dim | model | ns a bond and iteration | ordinary over it |\n|--:|---|--:|--:|")
    for dimension in arguments.dimensions:
        times = {model: [] for model in MODELS}
        for _ in range(arguments.repeat):
            for model, list_of_times in times.items():
                list_of_times.append(nanoseconds_a_bond(arguments, dimension, model))
        median = {model: statistics.median(values) for model, values in times.items()}
        for model, value in median.items():
            print(f"| {dimension} | {model} | {value:.2f} | {median['ordinary'] / value:.2f} |")


if __name__ == "__main__":
    main()
