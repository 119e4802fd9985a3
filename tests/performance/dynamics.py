#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bonds a second of explicit dynamics, beside LAMMPS where that is installed (apt install lammps).

    dynamics.py --program build/perideal [--size 60] [--steps 20] [--repeat 3] [--ranks N] [--lammps lmp]

A cube of size^3 nodes, horizon 3.01 spacings, that can break, is advanced some steps by either program, on
one rank unless told otherwise, in turns. Counted are undirected bonds times steps over the seconds of the
steps alone; printed are the medians and their ratios. LAMMPS has the models bond based (peri/pmb) and ordinary (peri/lps).
The bytes a node are those of families, bonds and contact while steps are taken, with failure and without.
"""

import argparse
import re
import shlex
import statistics
import sys
import tempfile

from runs import PAGE, add_arguments, execute, launcher, run

SCENE = "tests/performance/dynamics.prm"
LAMMPS_INPUT = PAGE.parent / "peridynamic_block.lammps"
CASES = [  # name, settings, style of LAMMPS
    ("bond based", ["Material/Model=bond based"], "pmb"),
    ("ordinary", ["Material/Model=ordinary"], "lps"),
    ("paper form", ["Material/Form=paper"], None),
    ("energy form", ["Material/Form=energy"], None),
    ("tensor involved", ["Material/Model=tensor involved"], None),
]


def block(size, steps, step=1e-8):
    """Settings of a cube with so many nodes along an edge, a millimetre each."""
    return [f"Mesh/Cells={size}, {size}, {size}", f"Mesh/Size={size * 1e-3}, {size * 1e-3}, {size * 1e-3}",
            f"Solver/Time step={step}", f"Solver/End time={step * steps}", f"Output/History steps={steps}"]


def run_perideal(options, settings):
    """The summary of one run."""
    return run(options, SCENE, [*settings, *block(options.size, options.steps)]).summary


def speed(summary):
    """Bonds times steps a second; the forces of the last time are computed too."""
    return summary["bonds"] * (summary["solver"]["steps"] + 1) / summary["seconds"]["solve"]


def run_lammps(options, style, bonds):
    """Bonds times steps a second of LAMMPS."""
    command = [*launcher(options), options.lammps, "-in", str(LAMMPS_INPUT), "-log", "none"]
    for name, value in (("n", options.size), ("steps", options.steps), ("style", style)):
        command += ["-var", name, str(value)]
    with tempfile.TemporaryDirectory() as directory:
        status, text = execute(command, directory=directory)
    if status != 0:
        sys.exit(f"{shlex.join(command)}\n{text[-2000:]}")
    return bonds * options.steps / float(re.search(r"Loop time of ([0-9.e+-]+)", text).group(1))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_arguments(parser)
    parser.add_argument("--size", type=int, default=60, help="nodes along an edge")
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--lammps", default="lmp", help="the program of LAMMPS; an empty text leaves it out")
    options = parser.parse_args()
    print("| model | million bonds/s | LAMMPS | ratio | bytes a node | without failure |\n|---|--:|--:|--:|--:|--:|")
    for name, settings, style in CASES:
        ours, theirs, summary = [], [], {}
        for _ in range(options.repeat):
            summary = run_perideal(options, settings)
            ours.append(speed(summary))
            if style and options.lammps:
                theirs.append(run_lammps(options, style, summary["bonds"]))
        intact = run_perideal(options, [*settings, "Material/Critical stretch=0"])
        memory, memory_intact = (each["operator_bytes"] / each["nodes"] for each in (summary, intact))
        own, other = statistics.median(ours), statistics.median(theirs) if theirs else None
        print(f"| {name} | {own / 1e6:.0f} | {f'{other / 1e6:.1f}' if other else ''} | "
              f"{f'{own / other:.1f}' if other else ''} | {memory:.0f} | {memory_intact:.0f} |", flush=True)


if __name__ == "__main__":
    main()
