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
import json
import os
import re
import shlex
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
# One thread a rank; Open MPI may run as root (containers).
ENVIRONMENT = {"OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
CASES = [
    ("bond based", ["Material/Model=bond based"], "pmb"),
    ("ordinary", ["Material/Model=ordinary"], "lps"),
    ("paper form", ["Material/Form=paper"], None),
    ("energy form", ["Material/Form=energy"], None),
    ("tensor involved", ["Material/Model=tensor involved"], None),
]


def run(command, directory):
    result = subprocess.run(
        command, cwd=directory, env={**os.environ, **ENVIRONMENT}, capture_output=True, text=True, check=False
    )
    if result.returncode != 0:
        sys.exit(f"{shlex.join(command)}\n{result.stdout[-2000:]}{result.stderr[-2000:]}")
    return result.stdout


def launcher(arguments):
    return shlex.split(arguments.mpirun) + ["-n", str(arguments.ranks)] if arguments.ranks > 1 else []


def run_perideal(arguments, overrides, directory):
    command = launcher(arguments) + [arguments.program, str(HERE / "dynamics.prm")]
    size = arguments.size
    step = 1e-8
    for override in overrides + [
        f"Mesh/Cells={size}, {size}, {size}",
        f"Mesh/Size={size * 1e-3}, {size * 1e-3}, {size * 1e-3}",
        f"Solver/Time step={step}",
        f"Solver/End time={step * arguments.steps}",
        f"Output/History steps={arguments.steps}",
    ]:
        command += ["--set", override]
    run(command, directory)
    summary = json.loads((Path(directory) / "output" / "summary.json").read_text(encoding="utf-8"))
    # The forces of the last time are computed too.
    bonds = summary["bonds"] * (summary["solver"]["steps"] + 1)
    return bonds / summary["seconds"]["solve"], summary["bonds"], summary["operator_bytes"] / summary["nodes"]


def run_lammps(arguments, style, bonds, directory):
    command = launcher(arguments) + [arguments.lammps, "-in", str(HERE / "peridynamic_block.lammps"), "-log", "none"]
    for name, value in (("n", arguments.size), ("steps", arguments.steps), ("style", style)):
        command += ["-var", name, str(value)]
    text = run(command, directory)
    seconds = float(re.search(r"Loop time of ([0-9.e+-]+)", text).group(1))
    return bonds * arguments.steps / seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, type=lambda path: str(Path(path).resolve()))
    parser.add_argument("--size", type=int, default=60, help="nodes along an edge")
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--lammps", default="lmp", help="the program of LAMMPS; an empty text leaves it out")
    parser.add_argument("--mpirun", default="mpirun --bind-to none --oversubscribe")
    arguments = parser.parse_args()
    print("| model | million bonds/s | LAMMPS | ratio | bytes a node | without failure |\n|---|--:|--:|--:|--:|--:|")
    for name, overrides, style in CASES:
        ours, theirs, memory = [], [], 0
        for _ in range(arguments.repeat):
            with tempfile.TemporaryDirectory() as directory:
                speed, bonds, memory = run_perideal(arguments, overrides, directory)
                ours.append(speed)
                if style and arguments.lammps:
                    theirs.append(run_lammps(arguments, style, bonds, directory))
        with tempfile.TemporaryDirectory() as directory:
            memory_intact = run_perideal(arguments, overrides + ["Material/Critical stretch=0"], directory)[2]
        speed = statistics.median(ours)
        other = statistics.median(theirs) if theirs else None
        print(
            f"| {name} | {speed / 1e6:.0f} | {f'{other / 1e6:.1f}' if other else ''} | "
            f"{f'{speed / other:.1f}' if other else ''} | {memory:.0f} | {memory_intact:.0f} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
