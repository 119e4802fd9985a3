#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Gives hostile values to every parameter that is a number: each must be refused in words, or do.

    fuzz_values.py --program build/perideal [--every 1] [--show]

Every number of --parameters gets every value, in statics, where it is read, and in dynamics, which is stopped soon.
Wrong are: a signal, no end within the time, words that are not ours, and an error that does not name the parameter.
--every N takes each Nth pair only.
"""

import argparse
import concurrent.futures
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from fuzz_meshes import OWN_LINE, WORDS_OF_OTHERS
from run_bad_input import HERE, execute

VALUES = ["0", "-1", "0.5", "1e-308", "-1e-308", "1e-320", "1e300", "-1e300", "1e308", "1e400", "nan", "-nan", "inf", "-inf",
          "", "abc", "0x10", "1e", "1,5", "1.5.2", "\u00e9", "\u0663", "1 2", "1;2", "2147483648", "-2147483649",
          "99999999999999999999", "--", "1e+", "+1", "1d5", "1/0", "t", "%s", "\\", "$HOME", "'1'", "\"1\"", "1_000", "1e-400"]
# What makes large meshes or many frames is meant; these are no slips.
LARGE = {"Mesh/Refinements", "Mesh/Refine times", "Mesh/Refine layers", "Mesh/Cells", "Comparison/Reference refinements",
         "Output/Frames"}
MOTION = ["Solver/Name=dynamics", "Material/Form=energy", "Solver/End time=1e-5"]


def numbers(program):
    """Paths of the parameters that are numbers, but for those of subsections that a user names."""
    listing = subprocess.run([program, "--parameters", "json"], capture_output=True, text=True, check=True).stdout
    return [entry["path"] for entry in json.loads(listing)
            if entry["kind"] in ("number", "whole number") and not any(part.isupper() for part in entry["path"].split("/"))]


def run_case(case, arguments):
    path, value, settings = case
    with tempfile.TemporaryDirectory(prefix="perideal-fuzz-") as name:
        folder = Path(name)
        (folder / "case.prm").write_text((HERE / "good.prm").read_text(encoding="utf-8"), encoding="utf-8")
        command = [arguments.program, "case.prm"]
        for setting in [*settings, f"{path}={value}"]:
            command += ["--set", setting]
        if path in LARGE:
            command.append("--check")
        status, out, err = execute(command, folder, arguments.timeout)
    found = []
    if status is None:
        found.append(f"did not end within {arguments.timeout:g} s")
    elif status not in (0, 1, 2):
        found.append(f"exit status {status}")
    elif status == 1 and path not in err and path.split("/")[-1] not in err:
        found.append("the message does not name the parameter")
    if status in (1, 2):
        found += [f"foreign line: {line!r}" for line in err.splitlines() if not OWN_LINE.match(line)]
    found += [f"foreign words: {line}" for line in (out + err).splitlines() if WORDS_OF_OTHERS.search(line)]
    if status == 0 and re.search(r"\bnan\b", out):
        found.append("goes on with what is not a number")
    return case, status, found, err


def main():
    parser = argparse.ArgumentParser(description="gives hostile values to numbers")
    parser.add_argument("--program", required=True, type=lambda path: str(Path(path).resolve()))
    parser.add_argument("--every", type=int, default=1, help="default: %(default)s")
    parser.add_argument("--only", help="the one parameter to look at")
    parser.add_argument("--show", action="store_true", help="print every message")
    parser.add_argument("--timeout", type=float, default=30, help="seconds a run; default: %(default)s")
    parser.add_argument("--jobs", type=int, default=2, help="runs side by side; default: %(default)s")
    arguments = parser.parse_args()
    paths = numbers(arguments.program) if arguments.only is None else [arguments.only]
    cases = [(path, value, settings) for path in paths for value in VALUES for settings in ([], MOTION)]
    cases = cases[::arguments.every]
    n_wrong = n_done = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for (path, value, settings), status, found, err in pool.map(lambda case: run_case(case, arguments), cases):
            n_wrong += bool(found)
            n_done += status == 0
            if found or arguments.show:
                print(f"{path} = {value!r}{' in dynamics' if settings else ''}: exit status {status}")
                print("".join(f"    {line}\n" for line in found + err.splitlines()), end="", flush=True)
    print(f"{len(cases)} values of {len(paths)} parameters: {n_done} taken, {len(cases) - n_done} not, {n_wrong} went wrong")
    return 1 if n_wrong or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
