#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kills runs at moments of chance and lets them go on from their checkpoints: the end is that of a run that nobody killed.

    kill_and_restart.py --program build/perideal [--kills N] [--drivers NAME,...] [--record FILE]

Each driver: N times a run is killed (kill -9) somewhere between its start and its end, and goes on; every tenth loses one of two
ranks instead. Where there is no checkpoint yet, the run begins anew.
"""

import argparse
import json
import os
import random
import shlex
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from execute import start

os.environ.setdefault("OMPI_MCA_mpi_yield_when_idle", "1")
LIMIT = 300  # seconds, for a machine that is busy
BODY = """set Dimension = 2
set Output directory = output
subsection Mesh
  set Generator = box
  set Cells = {cells}
end
subsection Material
  set Form = energy
  set Young modulus = 70e9
  set Poisson ratio = 0.3
  set Density = 2700
  set Critical stretch = {stretch}
end
subsection Boundary conditions
  subsection clamp
    set Boundary = left
    set u_x = 0
    set u_y = 0
  end
  subsection pull
    set Boundary = right
    set {pull}
  end
end
subsection Solver
  set Name = {solver}
  {controls}
end
subsection Output
  set Fields = displacement, volume
end
"""
SCENES = {
    "quasi static": BODY.format(cells="16, 16", stretch="2e-3", pull="u_x = 1e-3*t", solver="quasi static", controls="set Load steps = 12"),
    "dynamic relaxation": BODY.format(cells="16, 16", stretch="2e-3", pull="u_x = 1e-3*t", solver="dynamic relaxation",
                                      controls="set Load steps = 60\n  set Tolerance = 1e-6"),
    "dynamics": BODY.format(cells="24, 24", stretch="2e-5", pull="t_x = 1e6", solver="dynamics", controls="set End time = 16e-3"),
    # Without checkpoints: a killed run begins anew.
    "static": BODY.format(cells="40, 40", stretch="0", pull="t_x = 1e6*t", solver="static", controls="set Load steps = 12"),
}
INTERVAL = {"quasi static": 1, "dynamic relaxation": 1, "dynamics": 40}


class Failure(Exception):
    pass


class Case:
    """A scene of a driver in a folder."""

    def __init__(self, arguments, driver, folder):
        self.driver, self.folder, self.mpirun = driver, folder, shlex.split(arguments.mpirun)
        self.program, self.interval = str(Path(arguments.program).resolve()), INTERVAL.get(driver)
        folder.mkdir()
        (folder / "temporary").mkdir()
        (folder / "case.prm").write_text(SCENES[driver], encoding="utf-8")

    def start(self, restart=False, ranks=1):
        settings = [f"Checkpoints/Steps={self.interval}"] if self.interval else []
        settings += ["Checkpoints/Restart=true"] if restart else []
        launcher = self.mpirun + ["-n", str(ranks)] if ranks > 1 else []
        command = [*launcher, self.program, "case.prm", *[word for text in settings for word in ("--set", text)]]
        return start(command, self.folder, self.folder / "temporary", text=True)

    def finish(self, process, what):
        try:
            out, err = process.communicate(timeout=LIMIT)
        except subprocess.TimeoutExpired:
            process.kill()
            raise Failure(f"{what}: does not end") from None
        if process.returncode != 0:
            raise Failure(f"{what}: exit status {process.returncode}\n{out[-1000:]}{err}")

    def go_on(self, what, ranks=1):
        """Goes on from the checkpoint, or from the beginning where there is none."""
        restart = (self.folder / "output" / "checkpoint.json").exists()
        self.finish(self.start(restart, ranks), what)
        return restart

    def end(self):
        summary = json.loads((self.folder / "output" / "summary.json").read_text(encoding="utf-8"))
        parts = [summary.get(part) for part in ("status", "energy", "reactions", "damage", "solver", "displacements")]
        return parts, (self.folder / "output" / "history.csv").read_bytes()


def ranks_of(mpirun):
    """Process ids of the ranks that mpirun has started."""
    return [int(pid) for pid in Path(f"/proc/{mpirun.pid}/task/{mpirun.pid}/children").read_text(encoding="utf-8").split()]


def lose_rank(case, seconds, dice):
    """Kills one of two ranks; the other must end with it."""
    process = case.start(ranks=2)
    time.sleep(seconds)
    ranks = ranks_of(process) if process.poll() is None else []
    if ranks:
        try:
            os.kill(dice.choice(ranks), signal.SIGKILL)  # a child of our own child
        except ProcessLookupError:
            pass
    try:
        process.communicate(timeout=60)
    except subprocess.TimeoutExpired:
        process.kill()
        raise Failure("the rank that is left does not end") from None
    if ranks and process.returncode == 0 and not (case.folder / "output" / "summary.json").exists():
        raise Failure("mpirun says that all is well after a rank was lost")


def try_driver(arguments, driver, folder, dice):
    """(kills, restarts from checkpoints, kills of one rank, seconds of a run)."""
    whole = Case(arguments, driver, folder / "whole")
    began = time.monotonic()
    whole.finish(whole.start(), "nobody kills it")
    seconds = time.monotonic() - began
    # Killed as late as can be: the last checkpoint is that of the last step, its results are not written.
    last = Case(arguments, driver, folder / "last")
    last.interval = 1 if last.interval else None
    last.finish(last.start(), "with a checkpoint each step")
    end = last.end()
    (last.folder / "output" / "summary.json").unlink()
    last.go_on(f"{driver}, from the last step")
    if last.end() != end:
        raise Failure(f"{driver}, from the last step: another end")
    n_resumed = n_ranks = 0
    for number in range(arguments.kills):
        case = Case(arguments, driver, folder / f"killed_{number}")
        moment = dice.uniform(0.1, 1.0) * seconds
        what = f"{driver}, killed after {moment:.3f} s of {seconds:.3f} s"
        if number % 10 == 9:
            lose_rank(case, 2 * moment, dice)
            n_ranks += 1
        else:
            process = case.start()
            if number % 3 == 0 and case.interval:  # these have something to go on from on any machine
                while process.poll() is None and not (case.folder / "output" / "checkpoint.json").exists():
                    time.sleep(0.001)
                moment *= 0.1
            time.sleep(moment)
            process.kill()
            process.communicate()
        n_resumed += case.go_on(what)
        if number % 10 == 9:
            broken = [part[0][3] for part in (case.end(), whole.end())]
            if case.end()[0][0] != "done" or (broken[0] is None) != (broken[1] is None):
                raise Failure(f"{what}, of two ranks: another end")
        elif case.end() != whole.end():
            raise Failure(f"{what}: another end\n{case.end()[0]}\n{whole.end()[0]}")
    return arguments.kills, n_resumed, n_ranks, seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--mpirun", default="mpirun --bind-to none --oversubscribe")
    parser.add_argument("--kills", type=int, default=50, help="of each driver; default: %(default)s")
    parser.add_argument("--drivers", default=",".join(SCENES), help="default: all")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--record", type=Path, help="table that gets a row a driver")
    arguments = parser.parse_args()
    n_failed = 0
    for driver in arguments.drivers.split(","):
        with tempfile.TemporaryDirectory(prefix="perideal-kill-") as name:
            try:
                kills, resumed, ranks, seconds = try_driver(arguments, driver, Path(name), random.Random(arguments.seed))
            except Failure as failure:
                print(f"DEVIATES  {failure}", flush=True)
                n_failed += 1
                continue
        print(f"ok        {driver}: {kills} kills ({ranks} of one rank of two), {resumed} went on from a checkpoint, a run takes {seconds:.2f} s",
              flush=True)
        if driver in INTERVAL and resumed == 0:
            print(f"DEVIATES  {driver}: no run went on from a checkpoint")
            n_failed += 1
        if arguments.record:
            is_new = not arguments.record.exists()
            arguments.record.parent.mkdir(exist_ok=True)
            with arguments.record.open("a", encoding="utf-8") as file:
                file.write("driver,seed,kills,of one rank of two,from a checkpoint,other ends\n" if is_new else "")
                file.write(f"{driver},{arguments.seed},{kills},{ranks},{resumed},0\n")
    return 1 if n_failed else 0


if __name__ == "__main__":
    sys.exit(main())
