#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks that bars show how far a run has come, on a terminal and nowhere else.

    run_progress.py --program build/perideal [--mpirun "mpirun ..."]

The runs have more to do than a second takes; they are ended when they have shown what they must.
"""

import argparse
import os
import pty
import re
import select
import shlex
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from checks import count_failures, expect
from execute import environment
from run_points import CONSISTENT, SCENE, TORN

# A bar, its per cent, the time left with two digits.
BAR = re.compile(r"\r\x1b\[K([a-z ]+)[^\r\n]*?  \[=*>? *\]  +\d+ %  (?:\d\d|\d\.\d|0\.\d\d) (?:s|min|h|d) left")
FINE = {"Mesh/Cells": "240, 160", "Solver/Tolerance": "1e-12", "Solver/Preconditioner": "block jacobi", "Solver/Linear solver": "cg"}
RUNS = (("solving t", SCENE, FINE | CONSISTENT),
        ("load steps", TORN, {"Mesh/Cells": "120, 60", "Solver/Load steps": "40000", "Boundary conditions/pull/u_x": "2e-4*t"}),
        ("load steps", TORN, {"Mesh/Cells": "60, 30", "Solver/Load steps": "200000", "Solver/Name": "dynamic relaxation",
                              "Boundary conditions/pull/u_x": "2e-4*t"}),
        ("moving", TORN, {"Mesh/Cells": "60, 30", "Solver/Name": "dynamics", "Solver/End time": "1e2",
                          "Boundary conditions/pull/u_x": "2e-4*t"}))
LIMIT = 60  # seconds


def command_of(program, folder, scene, settings):
    (folder / "case.prm").write_text(scene, encoding="utf-8")
    command = [program, "case.prm"]
    for path, value in settings.items():
        command += ["--set", f"{path}={value}"]
    return command


def see(command, folder, is_enough, on_terminal, seconds):
    """What a command prints, until that is enough or the time is over, and whether it had more to do; then it is ended."""
    with tempfile.TemporaryDirectory(prefix="perideal-", ignore_cleanup_errors=True) as temporary:
        ours, theirs = pty.openpty() if on_terminal else os.pipe()
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=theirs, stderr=subprocess.STDOUT,
                                   start_new_session=True, env=environment(temporary))
        os.close(theirs)
        text, end = "", time.time() + seconds
        while time.time() < end and not is_enough(text):
            if select.select([ours], [], [], 0.2)[0]:
                try:
                    got = os.read(ours, 65536)
                except OSError:  # a terminal that nobody writes to any more
                    got = b""
                if not got:
                    break
                text += got.decode(errors="replace")
        works = process.poll() is None
        if works:
            os.killpg(process.pid, signal.SIGKILL)  # the group of our own child
        process.wait()
        os.close(ours)
    return text, works


def check_bars(program, folder):
    for what, scene, settings in RUNS:
        command = command_of(program, folder, scene, settings)
        text, _ = see(command, folder, lambda text: any(bar.group(1).startswith(what) for bar in BAR.finditer(text)), True, LIMIT)
        expect(any(bar.group(1).startswith(what) for bar in BAR.finditer(text)), f"no bar of {what!r} on a terminal:\n{text[-2000:]}")


def check_files(program, folder):
    """Some seconds of the same without a terminal. (Bars would be there at once, other lines wait for more of them.)"""
    for what, scene, settings in RUNS:
        text, works = see(command_of(program, folder, scene, settings), folder, lambda text: False, False, 5)
        expect(works, f"{what}: the run ended before there was anything to show:\n{text}")
        expect("\r" not in text and "\x1b" not in text and " left" not in text, f"{what}: bars in a file:\n{text[-2000:]}")


def check_ranks(program, folder, mpirun):
    """mpirun gives its processes terminals; what counts is where its own output goes."""
    what, scene, settings = RUNS[3]
    command = mpirun + ["-n", "2"] + command_of(program, folder, scene, settings)
    text, works = see(command, folder, lambda text: False, False, 6)
    expect(works, f"two ranks ended before there was anything to show:\n{text}")
    expect("\r" not in text and "\x1b" not in text, f"bars of two ranks in a file:\n{text[-2000:]}")
    # Ranks may outlive their mpirun for a moment, with their directory.
    text, _ = see(command + ["--set", "Output directory=again"], folder, BAR.search, True, LIMIT)
    expect(BAR.search(text), f"no bar of two ranks on a terminal ({what}):\n{text[-2000:]}")


def main():
    parser = argparse.ArgumentParser(description="checks bars that show how far a run has come")
    parser.add_argument("--program", required=True, type=Path)
    parser.add_argument("--mpirun", default="mpirun --bind-to none --oversubscribe")
    arguments = parser.parse_args()
    program = str(arguments.program.resolve())
    return 1 if count_failures([
        ("bars on a terminal", lambda folder: check_bars(program, folder)),
        ("none in a file", lambda folder: check_files(program, folder)),
        ("bars of two ranks", lambda folder: check_ranks(program, folder, shlex.split(arguments.mpirun))),
    ]) else 0


if __name__ == "__main__":
    sys.exit(main())
