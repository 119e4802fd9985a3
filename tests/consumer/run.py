#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Builds the program beside this file against perideal, installed and in its build folder, and runs it.

    run.py --build BUILD [--cmake cmake] [--mpirun mpirun]
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
# Families at surfaces lack bonds, and a thick bar is slower than a thin one.
LARGEST_ERROR = 0.05


def call(*command):
    done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: exit status {done.returncode}\n{done.stdout}")
    return done.stdout


def build(arguments, package, folder):
    """The program, built against the package that is in a folder."""
    call(arguments.cmake, "-S", HERE, "-B", folder, f"-Dperideal_DIR={package}")
    cache = (folder / "CMakeCache.txt").read_text(encoding="utf-8")
    if re.search(rf"^perideal_DIR:\w+={re.escape(str(package))}$", cache, re.MULTILINE) is None:
        sys.exit(f"another perideal was found than {package}")
    call(arguments.cmake, "--build", folder)
    return folder / "ringing_bar"


def period(text):
    """(period, period of a thin bar) as printed."""
    found = re.search(r"period ([\d.]+) microseconds, of a thin bar ([\d.]+)", text)
    if found is None:
        sys.exit(f"no period is printed: {text}")
    return float(found.group(1)), float(found.group(2))


def main():
    parser = argparse.ArgumentParser(description="builds a program against perideal and runs it")
    parser.add_argument("--build", required=True, type=Path)
    parser.add_argument("--cmake", default="cmake")
    parser.add_argument("--mpirun", default="mpirun")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="perideal-consumer-") as name:
        folder = Path(name)
        call(arguments.cmake, "--install", arguments.build, "--prefix", folder / "prefix")
        package = next((folder / "prefix").rglob("perideal-config.cmake")).parent
        installed = build(arguments, package, folder / "installed")
        in_tree = build(arguments, arguments.build.resolve(), folder / "in_tree")
        # The installed package needs nothing of the build folder.
        targets = "".join(path.read_text(encoding="utf-8") for path in package.glob("*.cmake"))
        if str(arguments.build.resolve()) in targets:
            sys.exit("the installed package points into the build folder")
        results = [period(call(installed)), period(call(in_tree)), period(call(*arguments.mpirun.split(), "-n", 2, in_tree))]
    print(results)
    measured, thin = results[0]
    if abs(measured - thin) > LARGEST_ERROR * thin:
        sys.exit(f"the period is off by more than {LARGEST_ERROR}")
    if len(set(results)) != 1:
        sys.exit("installed, in the build folder and on two ranks are not the same")
    return 0


if __name__ == "__main__":
    sys.exit(main())
