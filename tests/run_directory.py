#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Holds the program to what it does with its output directory: two runs in one, links, full disks, lost histories.

    run_directory.py --program build/perideal [--mpirun "mpirun ..."]
"""

import argparse
import json
import resource
import shlex
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from checks import count_failures, expect
from execute import environment, start
LIMIT = 120  # seconds, for a machine that is busy
SCENE = """set Dimension = 2
set Output directory = output
subsection Mesh
  set Generator = box
  set Cells = 12, 8
end
subsection Material
  set Form = energy
  set Young modulus = 70e9
  set Poisson ratio = 0.3
  set Density = 2700
  set Critical stretch = 1
end
subsection Solver
  set Name = dynamics
  set End time = 2e-3
end
subsection Boundary conditions
  subsection clamp
    set Boundary = left
    set u_x = 0
    set u_y = 0
  end
  subsection pull
    set Boundary = right
    set t_x = 1e6
  end
end
subsection Output
  set Fields = displacement, velocity, damage, dilatation, volume, horizon
  set Frames = 2
end
"""
FOREIGN = ("HDF5-DIAG", "terminate called", "Stacktrace", "An error occurred", "internal error", "MPI_ABORT", "mca_")


class Directory:
    """A scene with its output directory."""

    def __init__(self, arguments, folder):
        self.program, self.mpirun, self.folder = str(Path(arguments.program).resolve()), arguments.mpirun, folder
        folder.mkdir()
        self.output = folder / "output"
        (folder / "case.prm").write_text(SCENE, encoding="utf-8")

    def command(self, overrides, ranks=1):
        launcher = shlex.split(self.mpirun) + ["-n", str(ranks)] if ranks > 1 else []
        return launcher + [self.program, "case.prm", *[word for text in overrides for word in ("--set", text)]]

    def start(self, *overrides, file_size=None):
        process = start(self.command(overrides), self.folder, tempfile.mkdtemp(dir=self.folder), text=True)
        if file_size is not None:
            # Open MPI writes large files of its own before.
            while not (self.output / "perideal.lock").exists() and process.poll() is None:
                time.sleep(0.0005)
            resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (file_size, resource.RLIM_INFINITY))
        return process

    def begin(self, *overrides):
        """Starts a run and waits for its first steps."""
        (self.output / "history.csv").unlink(missing_ok=True)
        process, deadline = self.start(*overrides), time.time() + LIMIT
        while not (self.output / "history.csv").exists() or (self.output / "history.csv").stat().st_size < 500:
            expect(process.poll() is None and time.time() < deadline, "the run does not begin")
            time.sleep(0.01)
        return process

    def run(self, *overrides, ranks=1, file_size=None):
        """(exit status, stdout, stderr), of which nothing is not ours."""
        if ranks > 1:
            result = subprocess.run(self.command(overrides, ranks), cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                                    text=True, timeout=LIMIT, check=False, env=environment(tempfile.mkdtemp(dir=self.folder)))
            status, out, err = result.returncode, result.stdout, result.stderr
        else:
            process = self.start(*overrides, file_size=file_size)
            out, err = process.communicate(timeout=LIMIT)
            status = process.returncode
        for word in FOREIGN:
            expect(word not in out + err, f"prints {word!r}\n{out}{err}")
        expect(err.count("perideal: ") == (0 if status == 0 else 1), f"status {status}, and not one message\n{err}")
        return status, out, err

    def good(self, *overrides, **more):
        status, out, err = self.run(*overrides, **more)
        expect(status == 0, f"exit status {status}\n{out}{err}")
        return out

    def refused(self, words, *overrides, **more):
        status, _, err = self.run(*overrides, **more)
        expect(status == 1, f"exit status {status}, not 1\n{err}")
        expect(all(word in err for word in words), f"the message lacks one of {words}\n{err}")

    def end(self):
        summary = json.loads((self.output / "summary.json").read_text(encoding="utf-8"))
        return [summary.get(part) for part in ("status", "energy", "reactions", "solver", "damage")]


LONG = ["Solver/End time=100", "Solver/Time step=1e-6"]


def check_two_runs(make):
    """One directory, two runs."""
    case = make("two_runs")
    first = case.begin(*LONG)
    case.refused(["another run writes", "Output directory", f"process {first.pid} on host"])
    case.refused(["another run writes", f"process {first.pid} on host"], ranks=2)
    first.send_signal(signal.SIGKILL)
    first.communicate(timeout=LIMIT)
    # What the killed one left keeps nobody out.
    case.good()
    case.good(ranks=2)
    expect(not (case.output / "perideal.lock").exists(), "a run that is over leaves its lock")
    # Nor does a failed or stopped one.
    case.refused(["Young modulus"], "Material/Young modulus=-1")
    second = case.begin(*LONG)
    second.send_signal(signal.SIGINT)
    second.communicate(timeout=LIMIT)
    expect(second.returncode == 2, f"Ctrl-C: exit status {second.returncode}")
    case.good()


def check_links(make):
    """Results that are links: what they point to is not touched."""
    case = make("links")
    case.output.mkdir()
    names = ["solution.pvd", "solution_0001.vtu", "history.csv", "history.h5", "summary.json", "checkpoint.json", "checkpoint_0.h5",
             "checkpoint_1.h5", "summary.json.part", "history.h5.part"]
    for name in names:
        (case.folder / ("mine_" + name)).write_text("mine", encoding="utf-8")
        (case.output / name).symlink_to(case.folder / ("mine_" + name))
    case.good("Checkpoints/Steps=10")
    for name in names:
        expect((case.folder / ("mine_" + name)).read_text(encoding="utf-8") == "mine", f"{name} is written through a link")
        expect(not (case.output / name).is_symlink(), f"{name} is still a link")
    # A directory elsewhere is as good as another.
    case = make("linked_directory")
    elsewhere = case.folder / "elsewhere"
    elsewhere.mkdir()
    case.output.symlink_to(elsewhere)
    case.good()
    expect((elsewhere / "summary.json").exists(), "the linked directory has no results")


def check_in_the_way(make):
    """What cannot be written is said before anything is computed."""
    case = make("in_the_way")
    (case.output / "history.csv").mkdir(parents=True)
    case.refused(["history.csv", "Output directory"])
    expect(not list(case.output.glob("solution*")), "a run without a history writes fields")
    case = make("file")
    case.output.write_text("mine", encoding="utf-8")
    case.refused(["Output directory"])
    for name in ("solution_0001.vtu", "summary.json", "history.h5"):
        case = make("in_the_way_" + name)
        (case.output / name).mkdir(parents=True)
        status, _, err = case.run()
        expect(status == 2 and name in err, f"{name}: exit status {status}\n{err}")


def check_full_disk(make):
    """Files that cannot grow, as on a full disk: status 2, one message, and the last checkpoint is whole."""
    whole = make("whole")
    steps = "Checkpoints/Steps=5"
    whole.good(steps)
    size = {path.name: path.stat().st_size for path in whole.output.iterdir()}
    names = ["history.csv", "solution_0001.vtu", "history.h5", "summary.json", "checkpoint_0.h5"]
    expect(all(name in size for name in names), f"lacks one of {names}")
    hit = set()
    for limit in sorted({size[name] - 1 for name in names} | {100, 1000, 4096}):
        case = make(f"full_{limit}")
        status, _, err = case.run(steps, file_size=limit)
        expect(status == 2, f"limit of {limit} bytes: exit status {status}\n{err}")
        expect("cannot write" in err, f"limit of {limit} bytes\n{err}")
        hit |= {name for name in names + ["checkpoint_1.h5"] if name in err}
        if (case.output / "checkpoint.json").exists():
            case.good(steps, "Checkpoints/Restart=true")
            expect(case.end() == whole.end(), f"another end after a limit of {limit} bytes")
            hit.add("restart")
        # A full disk in the middle of a run keeps the checkpoint of before.
        case = make(f"later_{limit}")
        case.good(steps, "Solver/End time=1e-3")
        case.run(steps, "Checkpoints/Restart=true", file_size=limit)
        case.good(steps, "Checkpoints/Restart=true", "Solver/End time=2.5e-3")
    expect(len(hit & {"history.csv", "solution_0001.vtu", "history.h5", "checkpoint_0.h5", "checkpoint_1.h5"}) >= 2, f"only {hit} was hit")


def check_full_disk_of_ranks(make):
    """A full disk is told once by two ranks, too, and neither waits for the other."""
    for name in ("history.csv", "history.h5.part", "solution.pvd.part", "solution_0001.vtu.part", "summary.json.part", "checkpoint.json.part"):
        case = make("ranks_" + name)
        case.output.mkdir()
        (case.output / name).symlink_to("/dev/full")
        status, _, err = case.run("Checkpoints/Steps=5", ranks=2)
        expect(status == 2 and name.replace(".part", "") in err, f"{name}: exit status {status}\n{err}")


def check_lost_history(make):
    """A restart without its history, or with another one."""
    case = make("history")
    steps = ["Checkpoints/Steps=10", "Output/History steps=2"]
    restart = [*steps, "Checkpoints/Restart=true"]
    case.good(*steps)
    end, path = case.end(), case.output / "history.csv"
    text = path.read_text(encoding="utf-8")
    lines = text.splitlines(keepends=True)
    path.unlink()
    out = case.good(*restart)
    expect("warning" in out and "there is no history.csv" in out and case.end() == end, f"a lost history is not told\n{out}")
    for name, wrong in (("shortened", "".join(lines[:3])), ("emptied", lines[0]), ("with other columns", text.replace("time [s]", "time [h]")),
                        ("with other figures", text.replace("e-", "e-1"))):
        case = make("history " + name)
        case.good(*steps)
        path = case.output / "history.csv"
        path.write_text(wrong, encoding="utf-8")
        case.refused(["history.csv", "Checkpoints/Restart", "advice"], *restart)
        path.write_text(text, encoding="utf-8")
        case.good(*restart)
        expect(case.end() == end, f"history {name}: another end")


CHECKS = (check_two_runs, check_links, check_in_the_way, check_full_disk, check_full_disk_of_ranks, check_lost_history)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--mpirun", default="mpirun --bind-to none --oversubscribe")
    parser.add_argument("--only", choices=[check.__name__ for check in CHECKS])
    arguments = parser.parse_args()
    chosen = [check for check in CHECKS if arguments.only in (None, check.__name__)]
    return 1 if count_failures([
        (check.__doc__, lambda path, check=check: check(lambda case: Directory(arguments, path / case))) for check in chosen
    ]) else 0


if __name__ == "__main__":
    sys.exit(main())
