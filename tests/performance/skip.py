#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a scene saves by what it does not need: each run beside the same with that forced on.

    skip.py --program build/perideal [--cases NAME...] [--repeat N] [--no-page]

Every line compares one run as it is with one that has to do what the other may leave out, on the same input: seconds of the
phase, memory, and the largest relative difference of the answers (energies, reactions). The table goes to README.md.
"""

import argparse
import statistics
import sys
from dataclasses import dataclass

from dynamics import block
from runs import add_arguments, markdown_table, replace_section, run

SPRINGS = ["Material/Critical stretch=0", "Material/Model=bond based"]
DYNAMICS = "tests/performance/dynamics.prm"
BLOCK = "tests/scenes/tension_box_3d.prm"


def cube(size, form):
    return [f"Mesh/Cells={size}, {size}, {size}", f"Material/Form={form}", "Comparison/FEM=false",
            "Boundary conditions/Displacement treatment=layer", "Output/Fields=displacement"]


@dataclass
class Case:
    """name: what is skipped. phases: keys of "seconds" that are added up. apart: the forced run is made in so many runs,
    whose times add up."""
    name: str
    scene: str
    settings: list
    forced: list
    phases: tuple
    memory: str = "operator_bytes"
    apart: int = 1


STRIP = ["Mesh/Cells=600, 20", "Mesh/Size=0.6, 0.02", "Dimension=2", "Material/Critical stretch=0",
         "Material/Model=ordinary", "Solver/Time step=4e-8", "Solver/End time=1.2e-5", "Initial conditions/v_x=0",
         "Boundary conditions/pushed/Boundary=left", "Boundary conditions/pushed/v_x=1"]
SQUARE = ["Mesh/Cells=200, 200", "Mesh/Size=0.2, 0.2", "Dimension=2"]
CASES = {
    "bond state": Case(
        "bond state where nothing can break", DYNAMICS, [*block(50, 40), *SPRINGS],
        ["Material/Critical stretch=1e6", "Contact/Enabled=false"], ("solve",)),
    "contact": Case(
        "contact where nothing can break", DYNAMICS, [*block(50, 40), *SPRINGS], ["Contact/Enabled=true"], ("solve",)),
    "rest": Case(
        "bonds at rest, until the wave gets there", DYNAMICS, STRIP, ["Initial conditions/v_x=1e-9*sin(1e4*x)"], ("solve",)),
    "load steps": Case(
        "set-ups of further load steps, linear (10 steps, and 10 runs of one)", BLOCK,
        [*cube(32, "energy"), "Solver/Load steps=10"], ["Solver/Load steps=1"],
        ("neighbours", "setup", "solve"), "operator_bytes", 10),
    "equal families": Case(
        "weights of equal families, energy form: making them", BLOCK, cube(48, "energy"),
        ["Nodes/Share equal families=false"], ("setup: weights",)),
    "equal families, paper": Case(
        "weights of equal families, paper form: making them", BLOCK, cube(48, "paper"),
        ["Nodes/Share equal families=false"], ("setup: weights",)),
    "equal families, solve": Case(
        "weights of equal families, energy form: solving", BLOCK, cube(48, "energy"),
        ["Nodes/Share equal families=false"], ("solve",)),
    "fields": Case(
        "strains, stresses, energies that are not asked for", BLOCK, cube(48, "energy"),
        ["Output/Fields=displacement, strain, stress, von mises, principal stress, strain energy density, dilatation"],
        ("setup", "solve", "output"), "memory_bytes"),
    "comparison": Case(
        "finite elements that are not asked for", BLOCK, cube(32, "energy"), ["Comparison/FEM=true"],
        ("total",), "memory_bytes"),
}


def numbers(value):
    """All numbers in a part of a summary, in order."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [number for part in value for number in numbers(part)]
    return [float(value)] if isinstance(value, (int, float)) and not isinstance(value, bool) else []


def difference(one, other):
    """The largest difference of energies and reactions over the largest of each."""
    worst = 0.
    for part in ("strain", "kinetic"):
        a, b = (summary["energy"].get(part) or 0. for summary in (one, other))
        if a or b:
            worst = max(worst, abs(a - b) / max(abs(a), abs(b)))
    a, b = numbers(one.get("reactions", {})), numbers(other.get("reactions", {}))
    if a and len(a) == len(b):
        worst = max(worst, max(abs(x - y) for x, y in zip(a, b)) / max(map(abs, a)))
    return worst


def measure(options, case):
    """Row of the table."""
    seconds, forced_seconds = [], []
    for _ in range(options.repeat):
        summary = run(options, case.scene, case.settings).summary
        seconds.append(sum(summary["seconds"][phase] for phase in case.phases))
        forced_time = 0.
        for _ in range(case.apart):
            forced = run(options, case.scene, [*case.settings, *case.forced]).summary
            forced_time += sum(forced["seconds"][phase] for phase in case.phases)
        forced_seconds.append(forced_time)
    time, forced_time = statistics.median(seconds), statistics.median(forced_seconds)
    return [case.name, " + ".join(case.phases), f"{time:.3g}", f"{forced_time:.3g}", f"{forced_time / time:.2f}",
            f"{forced[case.memory] / summary[case.memory]:.2f}", f"{difference(summary, forced):.1e}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_arguments(parser)
    parser.add_argument("--cases", nargs="+", choices=CASES, default=list(CASES))
    parser.add_argument("--no-page", action="store_true", help="print the table only")
    options = parser.parse_args()
    rows = []
    for name in options.cases:
        rows.append(measure(options, CASES[name]))
        print(rows[-1], file=sys.stderr, flush=True)
    table = markdown_table(["skipped", "phases", "s", "s with it", "times", "memory, times", "answers differ by"], rows)
    print(table)
    if not options.no_page:
        replace_section("skip", table)


if __name__ == "__main__":
    main()
