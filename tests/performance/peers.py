#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The bond loops beside LAMMPS and beside what one core can do, in the same run.

    peers.py --program build/perideal [--loops PROGRAM] [--size 60] [--steps 20] [--repeat N] [--lammps lmp] [--no-page]

Explicit dynamics against LAMMPS' peri/pmb and peri/lps (apt install lammps; an empty text leaves it out); the loops of the
program performance_bond_loops against read bandwidth and multiply-adds of the core, and against the linear operator as a plain
scalar loop; set-up against bonds and against a run of 1,000 steps. The tables go to README.md.
"""

import argparse
import json
import statistics
import subprocess
import sys
from pathlib import Path

import dynamics
from runs import add_arguments, markdown_table, replace_section, run


def compare_with_lammps(options):
    """Rows of explicit dynamics, and of what its set-up takes."""
    rows, set_up = [], []
    for name, settings, style in dynamics.CASES:
        ours, theirs, summaries = [], [], []
        for _ in range(options.repeat):
            summary = dynamics.run_perideal(options, settings)
            summaries.append(summary)
            ours.append(dynamics.speed(summary))
            if style and options.lammps:
                theirs.append(dynamics.run_lammps(options, style, summary["bonds"]))
        speed, other = statistics.median(ours), statistics.median(theirs) if theirs else None
        rows.append([name, f"{speed / 1e6:.0f}", f"{other / 1e6:.1f}" if other else "",
                     f"{speed / other:.1f}" if other else ""])
        bonds = summaries[0]["bonds"]
        seconds = statistics.median(s["seconds"]["neighbours"] + s["seconds"]["setup: weights"] for s in summaries)
        set_up.append([name, f"{seconds / (2 * bonds) * 1e6:.3f}", f"{100 * seconds / (1000 * bonds / speed):.1f}"])
        print(rows[-1] + set_up[-1], file=sys.stderr, flush=True)
    return rows, set_up


def measure_loops(options):
    """What the program performance_bond_loops prints."""
    done = subprocess.run([options.loops, str(options.size)], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def loop_rows(measured):
    bandwidth, arithmetic = measured["read_bytes_per_second"], measured["operations_per_second"]
    scalar = next(row["bonds_per_second"] for row in measured["loops"] if row["loop"].endswith("scalar"))
    for row in measured["loops"]:
        speed = row["bonds_per_second"]
        yield [row["loop"], f"{speed / 1e6:.0f}", f"{speed / scalar:.2f}", f"{100 * speed * row['bytes'] / bandwidth:.0f}",
               f"{100 * speed * row['operations'] / arithmetic:.0f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_arguments(parser)
    parser.add_argument("--loops", help="performance_bond_loops; without, that beside the program")
    parser.add_argument("--size", type=int, default=60, help="nodes along an edge")
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--lammps", default="lmp", help="the program of LAMMPS; an empty text leaves it out")
    parser.add_argument("--no-page", action="store_true", help="print the tables only")
    options = parser.parse_args()
    if not options.loops:
        options.loops = str(Path(options.program).parent / "tests" / "performance" / "performance_bond_loops")
    measured = measure_loops(options)
    rows, set_up = compare_with_lammps(options)
    text = "\n\n".join([
        "Explicit dynamics of bonds that may break, undirected bonds times steps over seconds:",
        markdown_table(["model", "million bonds/s", "LAMMPS", "ratio"], rows),
        "Search, families and weights before that, over directed bonds, and over 1,000 steps:",
        markdown_table(["model", "microseconds a bond", "% of 1,000 steps"], set_up),
        f"Single loops on {measured['nodes']:,} nodes; the core reads {measured['read_bytes_per_second'] / 1e9:.1f} GB/s and does "
        f"{measured['operations_per_second'] / 1e9:.1f} GFLOP/s in the same run:",
        markdown_table(["loop", "million bonds/s", "over scalar", "% of reading", "% of arithmetic"],
                       list(loop_rows(measured)))])
    print(text)
    if not options.no_page:
        replace_section("peers", text)


if __name__ == "__main__":
    main()
