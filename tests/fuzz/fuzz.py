#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Gives the program wrong inputs by chance, and looks at how it ends.

    fuzz.py --program build/perideal --seed S --cases N --seconds T [--only GENERATOR] [--case K] [--record FILE]

Hostile values of parameters, choices that need not go together, damaged meshes, parameter files and checkpoints. A case is
made from the seed and its number alone: --case K runs it again, --keep leaves its folder. Each must end by itself
with status 0, 1 or 2, print nothing that is not ours, and name what is wrong. What goes on from a damaged checkpoint or
history must refuse, or come to the same end. With --record the figures go to a file of tests/fuzz/results.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import random
import shlex
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from generators import GENERATORS, RESUMED, flipped, parameters, plain
from judge import environment, run

LIMIT = 20  # seconds a run
KINDS = [*GENERATORS, "restart"]


class Resumed:
    """Runs that stopped with a checkpoint, and how they end when nothing is damaged: made once, at first use."""

    def __init__(self, program, folder):
        self.program, self.folder, self.ends = program, folder, {}
        self.lock = threading.Lock()

    def get(self, number):
        """(folder of the stopped run, what its restart leaves)."""
        with self.lock:
            if number not in self.ends:
                self.ends[number] = self.make(number)
            return self.ends[number]

    def make(self, number):
        start = self.folder / f"resumed_{number}"
        start.mkdir()
        (start / "case.prm").write_text(RESUMED[number], encoding="utf-8")
        steps = 6 if "dynamics\n" in RESUMED[number] else 2
        result = run([self.program, "case.prm", "--set", f"Checkpoints/Steps={steps}"], start, 10 * LIMIT)
        if result.status != 0 or not (start / "output" / "checkpoint.json").exists():
            sys.exit(f"the scene of restarts left no checkpoint: {result.err}")
        end = self.folder / f"end_{number}"
        shutil.copytree(start, end)
        result = run([self.program, "case.prm", "--set", "Checkpoints/Restart=true"], end, 10 * LIMIT)
        if result.status != 0:
            sys.exit(f"an undamaged checkpoint is refused: {result.err}")
        return start, figures(end)


def figures(folder):
    """What a run found, without how long it took."""
    summary = json.loads((folder / "output" / "summary.json").read_text(encoding="utf-8"))
    parts = ("status", "solver", "energy", "reactions", "displacements", "damage")
    return {part: summary.get(part) for part in parts}


def restart(dice, resumed, folder):
    """Makes the folder of a stopped run with one damaged file; returns its name and what the end must be."""
    start, end = resumed.get(dice.randrange(len(RESUMED)))
    shutil.copytree(start, folder, dirs_exist_ok=True)
    files = sorted(path for path in (folder / "output").iterdir() if path.name.startswith(("checkpoint", "history")))
    # The checkpoint that is pointed to, more often than what is hardly read.
    pointed = folder / "output" / json.loads((folder / "output" / "checkpoint.json").read_text(encoding="utf-8"))["file"]
    path = dice.choice([*files, pointed, pointed, pointed])
    path.write_bytes(flipped(dice, path.read_bytes()))
    return path.name, end


def judge_case(number, arguments, known, resumed):
    """(kind, exit status, complaints, command) of a case."""
    dice = random.Random(f"{arguments.seed}:{number}")
    kind = dice.choice(KINDS)
    if arguments.only:
        kind = arguments.only
    folder = Path(tempfile.mkdtemp(prefix=f"perideal-fuzz-{number}-"))
    what, end = "", None
    if kind == "restart":
        what, end = restart(dice, resumed, folder)
        command = [arguments.program, "case.prm", "--set", "Checkpoints/Restart=true"]
    else:
        case = GENERATORS[kind](dice, known)
        for name, data in case["files"].items():
            (folder / name).write_bytes(data)
        settings = [word for setting in case["set"] for word in ("--set", setting)]
        command = [arguments.program, *(["--check"] if case["check"] else []), "case.prm", *settings]
    result = run(command, folder, LIMIT)
    found = result.complaints()
    # A lost history is said, and the run goes on.
    if end is not None and result.status == 0 and figures(folder) != end:
        found.append(f"another end than from undamaged files, {what} was damaged")
    if end is not None and result.status == 2:
        found.append("a damaged file is no failed computation")
    if found and arguments.show:
        found.append(result.out[-1500:] + result.err[-3000:])
    if not arguments.keep:
        shutil.rmtree(folder, ignore_errors=True)
    else:
        what += f" in {folder}"
    return kind, result.status, found, shlex.join(command) + (f"   # {what}" if what else "")


def record(path, arguments, counts, n_bad, seconds):
    """Adds a row to a table of results."""
    is_new = not path.exists()
    path.parent.mkdir(exist_ok=True)
    version = subprocess.run([arguments.program, "--version"], capture_output=True, text=True, check=True,
                             env=environment()).stdout.splitlines()[0]
    with path.open("a", encoding="utf-8") as file:
        if is_new:
            file.write("version,seed,cases," + ",".join(f"{kind} (done/refused/failed)" for kind in KINDS) + ",deviating,seconds\n")
        shares = [f"{counts[kind, 0]}/{counts[kind, 1]}/{counts[kind, 2]}" for kind in KINDS]
        file.write(f"{version},{arguments.seed},{sum(counts.values())},{','.join(shares)},{n_bad},{seconds:.0f}\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, type=os.path.abspath)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--cases", type=int, default=2000, help="default: %(default)s")
    parser.add_argument("--seconds", type=float, default=1e9, help="no case begins after this time")
    parser.add_argument("--only", choices=KINDS, help="one generator")
    parser.add_argument("--case", type=int, help="only the case of this number, with all that it prints")
    parser.add_argument("--show", action="store_true", help="print what deviating runs print")
    parser.add_argument("--keep", action="store_true", help="leave the folders of the cases")
    parser.add_argument("--jobs", type=int, default=2, help="runs side by side; default: %(default)s")
    parser.add_argument("--record", type=Path, help="table that gets a row")
    arguments = parser.parse_args()
    arguments.show = arguments.show or arguments.case is not None
    began = time.monotonic()
    listed = subprocess.run([arguments.program, "--parameters", "json"], capture_output=True, text=True, check=True,
                            env=environment()).stdout
    known = parameters(listed)
    if len(known) < 100:
        sys.exit("the list of parameters is not read")
    numbers = [arguments.case] if arguments.case is not None else range(arguments.cases)
    counts, bad = collections.Counter(), []
    with tempfile.TemporaryDirectory(prefix="perideal-fuzz-resumed-") as name:
        resumed = Resumed(arguments.program, Path(name))
        # Untouched scenes must be good, or damage would prove nothing.
        base = Path(name) / "base"
        base.mkdir()
        for file, data in plain(RESUMED[0]).get("files").items():
            (base / file).write_bytes(data)
        if run([arguments.program, "--check", "case.prm"], base, 10 * LIMIT).status != 0:
            sys.exit("the undamaged scene is refused")

        def judge(number):
            if time.monotonic() - began > arguments.seconds:
                return None
            return number, *judge_case(number, arguments, known, resumed)

        with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
            for result in pool.map(judge, numbers):
                if result is None:
                    continue
                number, kind, status, found, command = result
                counts[kind, status] += 1
                if found:
                    bad.append(number)
                    print(f"DEVIATES  case {number} ({kind}): {'; '.join(found)}\n    {command}", flush=True)
                elif arguments.case is not None:
                    print(f"case {number} ({kind}): status {status}\n    {command}")
    seconds = time.monotonic() - began
    n_run = sum(counts.values())
    for kind in KINDS:
        of_kind = {status: count for (of, status), count in counts.items() if of == kind}
        print(f"{kind:8} {sum(of_kind.values())} cases: " + ", ".join(f"{count} with status {status}" for status, count in
                                                                     sorted(of_kind.items(), key=str)))
    print(f"{n_run} cases in {seconds:.0f} s, {len(bad)} deviate; again: fuzz.py --seed {arguments.seed} --case K")
    if arguments.record:
        record(arguments.record, arguments, counts, len(bad), seconds)
    # Damage that nothing refuses, or that refuses everything, would be no test.
    statuses = {status for _, status in counts}
    return 1 if bad or not n_run or (n_run > 40 and not {0, 1} <= statuses) else 0


if __name__ == "__main__":
    sys.exit(main())
