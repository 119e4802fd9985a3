#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Holds --sweep and --compare to the figures of the runs that they make and compare.

    run_sweep.py --program build/perideal --scenes tests/scenes [--mpirun "mpirun ..."]
"""

import argparse
import csv
import json
import math
import os
import shlex
import sys
from pathlib import Path

from checks import count_failures, expect
from execute import execute


def run(command, folder, status=0):
    code, out, err = execute(command, folder)
    expect(code == status, f"{' '.join(command)}: exit status {code}, not {status}\n{out}{err}")
    return out, err


def table_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def convergence(launcher, program, scenes, folder):
    """A study of convergence: two meshes, two forms, on one rank or more."""
    out, _ = run([*launcher, program, str(scenes / "sine_field.prm"), "--set", "Output directory=study", "--sweep", "Mesh/Refinements=0,1",
                  "--sweep", "Material/Poisson ratio=0.3, 0.2"], folder)
    rows = table_of(folder / "study" / "sweep.csv")
    values = [(row["Mesh/Refinements"], row["Material/Poisson ratio"]) for row in rows]
    expect(values == [("0", "0.3"), ("0", "0.2"), ("1", "0.3"), ("1", "0.2")], f"the combinations are {values}")
    for row in rows:
        directory = folder / "study" / f"Refinements_{row['Mesh/Refinements']}_Poisson_ratio_{row['Material/Poisson ratio']}"
        summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
        expect(int(row["nodes"]) == summary["nodes"] and row["status"] == "done", f"nodes of {directory.name}")
        expect(math.isclose(float(row["error against exact [-]"]), summary["errors"]["exact"]["l2"], rel_tol=1e-3), f"error of {directory.name}")
        expect(f"{summary['nodes']} " in out, "the table is not printed")
    # A row and the one before it differ in more than the mesh: no order.
    expect([row["order against exact [-]"] for row in rows] == ["", "", "", ""], "an order between runs that differ in two parameters")
    out, _ = run([*launcher, program, str(scenes / "sine_field.prm"), "--set", "Output directory=order", "--sweep", "Mesh/Refinements=0,1"], folder)
    first, second = table_of(folder / "order" / "sweep.csv")
    order = math.log2(float(first["error against exact [-]"]) / float(second["error against exact [-]"]))
    expect(abs(float(second["order against exact [-]"]) - order) < 0.01 and order > 1.5, f"the order is {second['order against exact [-]']}, of the errors {order:.3f}")
    picture = [line for line in out.splitlines() if line.startswith("pictures ")]
    expect(len(picture) == 1 and ("sweep.svg" in picture[0] or "apt-get install" in picture[0]), "no word of the picture")
    if "sweep.svg" in picture[0]:
        text = (folder / "order" / "sweep.svg").read_text(encoding="utf-8")
        expect("relative error" in text and "against exact" in text, "sweep.svg shows no errors")


def comparison(launcher, program, scenes, folder):
    """Two runs side by side."""
    for name, more in (("one", []), ("other", ["--set", "Mesh/Refinements=1"])):
        run([*launcher, program, str(scenes / "plate_small.prm"), "--set", f"Output directory={name}", *more], folder)
    out, _ = run([*launcher, program, "--compare", "one", "other"], folder)
    words = {line.split()[0]: line.split()[1:] for line in out.splitlines() if line.strip()}
    one, other = (json.loads((folder / name / "summary.json").read_text(encoding="utf-8")) for name in ("one", "other"))
    expect(words.get("nodes") == [str(one["nodes"]), str(other["nodes"]), "+300", "%"], f"nodes: {words.get('nodes')}")
    expect(words.get("Mesh/Refinements") == ["0", "1"], "does not list the parameter that differs")
    expect("Material/Form" not in words, "lists a parameter that is equal")
    expect(f"{other['errors']['fem']['l2']:.4g}" in out, "does not show an error")
    out, _ = run([program, "--compare", "one", "one"], folder)
    expect("all parameters are equal" in out and "differs" not in out.replace("difference", ""), "a run differs from itself")


def failing_run(launcher, program, scenes, folder):
    """A run that does not converge does not keep the next from being done; mistakes are told before the first."""
    command = [*launcher, program, str(scenes / "plate_small.prm"), "--set", "Output directory=study", "--sweep"]
    _, err = run([*command, "Solver/Maximum iterations=1, 1000"], folder, status=2)
    rows = table_of(folder / "study" / "sweep.csv")
    expect([row["status"] for row in rows] == ["failed", "done"] and "1 of 2 runs" in err, f"status {[row['status'] for row in rows]}")
    run([*command, "Material/Poisson ratio=0.3, 0.7"], folder, status=1)
    expect(not (folder / "study" / "Poisson_ratio_0.3").exists(), "runs before it finds the mistake")


def main():
    parser = argparse.ArgumentParser(description="runs sweeps and comparisons")
    parser.add_argument("--program", required=True, type=os.path.abspath)
    parser.add_argument("--scenes", required=True, type=lambda name: Path(name).resolve())
    parser.add_argument("--mpirun", default="mpirun --bind-to none --oversubscribe", help="default: %(default)s")
    arguments = parser.parse_args()
    two_ranks = shlex.split(arguments.mpirun) + ["-n", "2"]
    tests = (([], convergence), (two_ranks, convergence), ([], comparison), (two_ranks, comparison), (two_ranks, failing_run))
    return 1 if count_failures([
        (f"{test.__doc__}{' (2 ranks)' if launcher else ''}",
         lambda path, launcher=launcher, test=test: test(launcher, arguments.program, arguments.scenes, path))
        for launcher, test in tests
    ]) else 0


if __name__ == "__main__":
    sys.exit(main())
