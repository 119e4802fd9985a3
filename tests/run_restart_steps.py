#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stops load steps of nonlinear equilibria and goes on from their checkpoints.

    run_restart_steps.py --program build/perideal --examples prm/examples [--mpirun "mpirun ..."]
"""

import argparse
import json
import signal
import sys
import tempfile
from pathlib import Path

from checks import Failure
from run_restart import Runs

# Bonds break from step 2 of 20 on, and pieces come loose.
PANEL = ["Mesh/Refinements=0", "Solver/Load steps=20"]
# Bonds break from step 4 of 24 on.
STRIP = ["Mesh/Cells=60, 20"]
# Values at faces, and gauges.
BAR = ["Mesh/Cells=30, 6", "Solver/Load steps=10"]
# Nodes on the surface; no bonds break.
PLATE = ["Mesh/Cells=40, 20", "Solver/Name=dynamic relaxation", "Solver/Tolerance=1e-8", "Solver/Load steps=4"]
# Bonds soften from step 16 on; the loads are an unknown.
SLIT = ["Mesh/Cells=24, 24"]
# The mesh changes after steps 14, 18 and 26.
ADAPTED = ["Mesh/Cells=20, 20", "Adaptation/Levels=1"]
# How the solver came to the same equilibrium.
WAY = ("iterations", "linear iterations", "residual [-]")
RESTART = ["Checkpoints/Restart=true"]


def summary(runs, name):
    return json.loads((runs.directory / name / "summary.json").read_text(encoding="utf-8"))


def expect_same_summary(runs, name, other):
    """All of the summary that load steps leave."""
    one, two = summary(runs, name), summary(runs, other)
    for part in ("solver", "damage", "energy", "reactions", "largest_reactions", "displacements", "cracks", "gauges"):
        if one.get(part) != two.get(part):
            raise Failure(f"'{part}' of '{name}' is {one.get(part)}, that of '{other}' {two.get(part)}")


def expect_same(runs, name, other, last):
    runs.expect_same_bits(name, other, f"solution_{last:04d}.vtu")
    expect_same_summary(runs, name, other)
    if (runs.directory / name / "history.h5").stat().st_size != (runs.directory / other / "history.h5").stat().st_size:
        raise Failure(f"history.h5 of '{name}' has other arrays than that of '{other}'")


def expect_other_ranks_close(runs, name, other):
    # Bonds are judged from residuals of 1e-4 on: the work until then may be off by as much.
    runs.expect_close(name, other, 1e-4, WAY + WITHOUT_SCALE)
    # Equilibria are found to 1e-8, energies and reactions not much worse.
    runs.expect_close(name, other, 1e-6, WAY + WITHOUT_SCALE + WORK)
    broken = [summary(runs, run).get("damage", {}).get("broken_bonds", 0) for run in (name, other)]
    if broken[0] != broken[1]:
        raise Failure(f"{broken[0]} bonds of '{name}' broke, {broken[1]} of '{other}'")


WORK = ("external work [J]", "dissipated energy [J]", "drift [-]")
# What is zero but for the tolerance of the solver, by symmetry or balance.
WITHOUT_SCALE = (
    "reaction of bottom along x [N]",
    "reaction of left along y [N]",
    "reaction of right along y [N]",
    "fem: reaction of left along y [N]",
    "fem: reaction of right along y [N]",
)


def check_panel(runs):
    """Newton's method, with failure."""
    runs.run("whole")
    if summary(runs, "whole")["damage"]["floating_nodes"] == 0:
        raise Failure("no piece of the panel comes loose")
    text, status = runs.stop("asked", signal.SIGTERM, 4, overrides=["Checkpoints/Steps=4"])
    if status != 2 or "asked to stop after load step" not in text:
        raise Failure(f"asked to stop: exit status {status}\n{text}")
    stopped = summary(runs, "asked")
    step = runs.checkpoint_step("asked")
    if stopped["status"] != "stopped" or stopped["solver"]["steps"] != step or not 4 <= step < 20:
        raise Failure(f"asked to stop: {stopped['status']} after {stopped['solver']['steps']}, checkpoint of {step}")
    text = runs.run("asked", overrides=RESTART + ["Solver/Load steps=40"], status=1)
    if "Solver/Load steps" not in text or "another scene" not in text:
        raise Failure(f"another number of load steps is not refused by name\n{text}")
    runs.run("asked", overrides=RESTART)
    expect_same(runs, "asked", "whole", 20)

    # Killed, and gone on with by two ranks, and from their checkpoint by one.
    runs.stop("killed", signal.SIGKILL, 4, overrides=["Checkpoints/Steps=1"])
    runs.run("killed", ranks=2, overrides=RESTART + ["Checkpoints/Steps=15"])
    expect_other_ranks_close(runs, "killed", "whole")
    runs.run("killed", overrides=RESTART)
    if runs.checkpoint_step("killed") != 15:
        raise Failure("two ranks left no checkpoint")
    expect_other_ranks_close(runs, "killed", "whole")


def check_strip(runs):
    """Dynamic relaxation, with failure."""
    runs.run("whole")
    runs.stop("killed", signal.SIGKILL, 12, overrides=["Checkpoints/Steps=1"])
    runs.run("killed", overrides=RESTART)
    expect_same(runs, "killed", "whole", 24)


def check_bar(runs):
    """Values at faces, from one rank to two."""
    runs.run("whole")
    runs.run("one", overrides=["Checkpoints/Steps=7"])
    runs.run("one", overrides=RESTART)
    expect_same(runs, "one", "whole", 10)
    runs.run("two", overrides=["Checkpoints/Steps=7"])
    runs.run("two", ranks=2, overrides=RESTART)
    expect_other_ranks_close(runs, "two", "whole")


def check_plate(runs):
    """Nodes on the surface, from two ranks to one."""
    runs.run("whole")
    runs.run("two", ranks=2, overrides=["Checkpoints/Steps=3"])
    runs.run("two", overrides=RESTART)
    expect_other_ranks_close(runs, "two", "whole")


def check_adapted(runs):
    """A mesh that changes as bonds soften, killed between changes, and gone on with by two ranks."""
    runs.run("whole")
    whole = summary(runs, "whole")
    steps, meshes = whole["solver"]["steps"], len(whole["adaptation"])
    if meshes < 4:
        raise Failure(f"the path has {meshes} meshes")
    runs.stop("killed", signal.SIGKILL, 21, overrides=["Checkpoints/Steps=21"])
    runs.run("killed", overrides=RESTART)
    expect_same(runs, "killed", "whole", steps)
    runs.stop("two", signal.SIGKILL, 21, overrides=["Checkpoints/Steps=21"])
    runs.run("two", ranks=2, overrides=RESTART)
    two = summary(runs, "two")
    for figure in ("dissipated", "external"):
        if abs(two["energy"][figure] / whole["energy"][figure] - 1) > 0.02:
            raise Failure(f"{figure} energy of two ranks {two['energy'][figure]}, of one {whole['energy'][figure]}")

    # Ranks are balanced by cost; they have the same cells again.
    runs.run("whole of two", ranks=2)
    runs.run("by two", ranks=2, overrides=["Checkpoints/Steps=25"])
    steps = summary(runs, "whole of two")["solver"]["steps"]
    if not 0 < runs.checkpoint_step("by two") < steps - 10:
        raise Failure(f"the checkpoint is of step {runs.checkpoint_step('by two')} of {steps}")
    runs.run("by two", ranks=2, overrides=RESTART)
    expect_same(runs, "by two", "whole of two", steps)


def check_slit(runs):
    """Softening bonds and load steps by dissipated energy, from before and from behind the peak."""
    runs.run("whole")
    steps = summary(runs, "whole")["solver"]["steps"]
    if steps < 30:
        raise Failure(f"the path has {steps} steps")
    for interval in (17, 25):
        name = f"from {interval}"
        runs.stop(name, signal.SIGKILL, interval, overrides=[f"Checkpoints/Steps={interval}"])
        runs.run(name, overrides=RESTART)
        expect_same(runs, name, "whole", steps)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--examples", required=True)
    parser.add_argument("--mpirun", default="mpirun --bind-to none --oversubscribe")
    given = parser.parse_args()
    scenes = (
        ("l_panel", PANEL, check_panel),
        ("notched_strip", STRIP, check_strip),
        ("hyperelastic_bar", BAR, check_bar),
        ("pdbc_1_mixed", PLATE, check_plate),
        ("slit_square", SLIT, check_slit),
        ("slit_square", ADAPTED, check_adapted),
    )
    for name, base, check in scenes:
        with tempfile.TemporaryDirectory() as directory:
            try:
                check(Runs(given.program, given.mpirun, f"{given.examples}/{name}.prm", base, Path(directory)))
            except Failure as failure:
                sys.exit(f"FAILED: {name}: {failure}")


if __name__ == "__main__":
    main()
