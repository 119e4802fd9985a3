#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stops a breaking plate in several ways and goes on from its checkpoints.

    run_restart.py --program build/perideal --scene prm/examples/kalthoff_winkler.prm [--mpirun "mpirun ..."]
"""

import argparse
import json
import shlex
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from checks import Failure

# A coarse plate in which the first bonds break at about 90 of 320 steps.
SCENE = ["Mesh/Refinements=0", "Material/Form=energy", "Solver/Time step=160e-9", "Solver/End time=51.2e-6"]
LIMIT = 120  # seconds, for a machine that is busy


class Runs:
    def __init__(self, program, mpirun, scene, base, directory):
        """The scene with the overrides of base, each run in a folder of the directory."""
        self.program, self.mpirun, self.scene, self.base, self.directory = program, mpirun, scene, base, directory

    def command(self, name, ranks, overrides):
        launcher = shlex.split(self.mpirun) + ["-n", str(ranks)] if ranks > 1 else []
        command = launcher + [self.program, self.scene]
        for override in self.base + [f"Output directory={self.directory / name}"] + overrides:
            command += ["--set", override]
        return command

    def run(self, name, ranks=1, overrides=(), status=0):
        result = subprocess.run(
            self.command(name, ranks, list(overrides)), capture_output=True, text=True, check=False, timeout=LIMIT
        )
        if result.returncode != status:
            raise Failure(f"{name}: exit status {result.returncode}, not {status}\n{result.stdout}{result.stderr}")
        return result.stdout + result.stderr

    def stop(self, name, how, after_step, ranks=1, overrides=()):
        """Starts a run and sends a signal when a checkpoint of the step or a later one is there."""
        with subprocess.Popen(
            self.command(name, ranks, list(overrides)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        ) as process:
            deadline = time.time() + LIMIT
            while self.checkpoint_step(name) < after_step:
                if process.poll() is not None or time.time() > deadline:
                    process.kill()
                    raise Failure(f"{name}: ended before it was stopped\n{process.stdout.read()}")
                time.sleep(0.002)
            process.send_signal(how)
            return process.communicate(timeout=LIMIT)[0], process.returncode

    def checkpoint_step(self, name):
        try:
            return json.loads((self.directory / name / "checkpoint.json").read_text(encoding="utf-8"))["step"]
        except (OSError, ValueError):
            return -1

    def history(self, name):
        lines = (self.directory / name / "history.csv").read_text(encoding="utf-8").splitlines()
        return lines[0], [[float(value) for value in line.split(",")] for line in lines[1:]]

    def expect_same_bits(self, name, other, fields="solution_0002.vtu"):
        for file in ("history.csv", fields, "solution.pvd"):
            one, two = ((self.directory / run / file).read_bytes() for run in (name, other))
            if file == "solution.pvd":  # but for the date in its head
                one, two = (text[text.index(b"<VTKFile") :] for text in (one, two))
            if one != two:
                raise Failure(f"{file} of '{name}' is not that of '{other}'")

    def expect_close(self, name, other, tolerance, apart=()):
        """The same rows, but for the columns apart."""
        (header, rows), (other_header, other_rows) = self.history(name), self.history(other)
        if header != other_header or len(rows) != len(other_rows):
            raise Failure(f"the history of '{name}' has other rows than that of '{other}'")
        for column, title in enumerate(header.split(",")):
            if title in apart:
                continue
            # The drift is a difference of large numbers that nearly cancel.
            scale = 1 if title.startswith("drift") else max(abs(row[column]) for row in other_rows)
            for row, expected in zip(rows, other_rows):
                if abs(row[column] - expected[column]) > tolerance * scale:
                    raise Failure(f"'{title}' of '{name}' is {row[column]} at step {row[0]}, not {expected[column]}")


def check(runs):
    frames = ["Output/Frames=2", "Output/History steps=10"]
    runs.run("whole", overrides=frames)

    # Killed after a checkpoint: the same bits.
    runs.stop("killed", signal.SIGKILL, 100, overrides=frames + ["Checkpoints/Steps=50"])
    runs.run("killed", overrides=frames + ["Checkpoints/Restart=true"])
    runs.expect_same_bits("killed", "whole")

    # The same with weights that follow the broken bonds.
    changing = frames + ["Material/Multipliers=recomputed"]
    runs.run("changing whole", overrides=changing)
    runs.stop("changing", signal.SIGKILL, 150, overrides=changing + ["Checkpoints/Steps=50"])
    runs.run("changing", overrides=changing + ["Checkpoints/Restart=true"])
    runs.expect_same_bits("changing", "changing whole")

    # The same on a mesh that follows the cracks, after steps 180, 220, 290, ...: between its changes, and at one.
    adapting = frames + ["Adaptation/Levels=1", "Adaptation/Interval=10"]
    runs.run("adapting whole", overrides=adapting)
    for step in (195, 220):
        runs.stop(f"adapting {step}", signal.SIGKILL, step, overrides=adapting + [f"Checkpoints/Steps={step}"])
        runs.run(f"adapting {step}", overrides=adapting + ["Checkpoints/Restart=true"])
        runs.expect_same_bits(f"adapting {step}", "adapting whole")

    # More ranks go on through two changes of the mesh.
    runs.run("adapting on one", overrides=adapting + ["Solver/End time=47.2e-6"])
    runs.run("adapting", overrides=adapting + ["Solver/End time=32e-6", "Checkpoints/Steps=195"])
    more = adapting + ["Solver/End time=47.2e-6", "Checkpoints/Restart=true"]
    if "adaptation  2:" not in runs.run("adapting", ranks=2, overrides=more):
        raise Failure("the mesh did not change twice when another number of ranks went on")
    runs.expect_close("adapting", "adapting on one", 1e-10)

    # Killed while it writes, again and again, at moments of chance.
    for step in (40, 110, 170, 230):
        restart = ["Checkpoints/Restart=true"] if step > 40 else []
        runs.stop("torn", signal.SIGKILL, step, overrides=frames + ["Checkpoints/Steps=1"] + restart)
    runs.run("torn", overrides=frames + ["Checkpoints/Restart=true"])
    runs.expect_same_bits("torn", "whole")

    # Asked to stop: writes a checkpoint; more ranks go on. Until bonds that lie alike break by chance,
    # rounding alone differs.
    text, status = runs.stop("asked", signal.SIGTERM, 100, overrides=frames + ["Checkpoints/Steps=100"])
    if status != 2 or "asked to stop after step" not in text:
        raise Failure(f"asked to stop: exit status {status}\n{text}")
    short = frames + ["Checkpoints/Restart=true"]
    summary = json.loads((runs.directory / "asked" / "summary.json").read_text(encoding="utf-8"))
    if summary["status"] != "stopped" or summary["damage"]["broken_bonds"] == 0:
        raise Failure(f"asked to stop: status {summary['status']}, {summary['damage']}")

    runs.run("two", ranks=2, overrides=frames + ["Solver/End time=16e-6", "Checkpoints/Steps=98"])
    runs.run("two", ranks=1, overrides=frames + ["Solver/End time=17.6e-6", "Checkpoints/Restart=true"])
    runs.run("one", ranks=1, overrides=frames + ["Solver/End time=16e-6", "Checkpoints/Steps=98"])
    runs.run("one", ranks=2, overrides=frames + ["Solver/End time=17.6e-6", "Checkpoints/Restart=true"])
    runs.run("both", ranks=1, overrides=frames + ["Solver/End time=17.6e-6"])
    if runs.history("both")[1][-1][8] == 0:
        raise Failure("nothing had broken when another number of ranks went on")
    runs.expect_close("two", "both", 1e-10)
    runs.expect_close("one", "both", 1e-10)

    # What cannot go on says why.
    text = runs.run("asked", overrides=short + ["Material/Young modulus=191e9"], status=1)
    if "Material/Young modulus" not in text or "another scene" not in text:
        raise Failure(f"another scene is not refused by name\n{text}")
    text = runs.run("nothing", overrides=short, status=1)
    if "no checkpoint" not in text:
        raise Failure(f"a missing checkpoint is not told\n{text}")
    for name in ("checkpoint_0.h5", "checkpoint_1.h5"):
        path = runs.directory / "asked" / name
        if path.exists():
            path.write_bytes(path.read_bytes()[:100].replace(b"HDF", b"???"))
    text = runs.run("asked", overrides=short, status=1)
    if "cannot be read" not in text:
        raise Failure(f"a damaged checkpoint is not told\n{text}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--scene", required=True)
    parser.add_argument("--mpirun", default="mpirun --bind-to none --oversubscribe")
    with tempfile.TemporaryDirectory() as directory:
        try:
            given = parser.parse_args()
            check(Runs(given.program, given.mpirun, given.scene, SCENE, Path(directory)))
        except Failure as failure:
            sys.exit(f"FAILED: {failure}")


if __name__ == "__main__":
    main()
