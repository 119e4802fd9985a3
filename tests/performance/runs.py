# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of the program and tables of what came out, for the measurements of this directory."""

import csv
import json
import os
import re
import shlex
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = Path(__file__).resolve().parent / "README.md"
# One thread a rank; Open MPI may run as root (containers).
ENVIRONMENT = {"OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_mpi_yield_when_idle": "1"}


@dataclass
class Run:
    """One run. status: of exit, negative the number of a signal, None: it took too long."""
    status: int | None
    output: str
    summary: dict = field(default_factory=dict)
    seconds: float = 0.
    history: dict = field(default_factory=dict)  # columns of history.csv

    def warnings(self):
        return [line for line in self.output.splitlines() if line.startswith("warning")]

    def message(self):
        """The first line of what the program said of a failure."""
        for word in ("error", "failed", ""):
            for line in self.output.splitlines():
                if line.strip() and word in line.lower():
                    return line.strip()
        return ""


def add_arguments(parser, repeat=3):
    """The options that all measurements have; no --repeat where repeat is None."""
    parser.add_argument("--program", required=True, type=lambda path: str(Path(path).resolve()))
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--mpirun", default="mpirun --bind-to none --oversubscribe")
    if repeat is not None:
        parser.add_argument("--repeat", type=int, default=repeat, help="runs of each case, for medians")


def launcher(options):
    """What stands before a program that runs on several ranks."""
    ranks = getattr(options, "ranks", 1)
    return [*shlex.split(options.mpirun), "-n", str(ranks)] if ranks > 1 else []


def execute(command, timeout=None, directory=None):
    """Status and output of a program, any; status None: it took too long."""
    try:
        done = subprocess.run(command, cwd=directory, env={**os.environ, **ENVIRONMENT}, capture_output=True, text=True,
                              timeout=timeout, check=False)
    except subprocess.TimeoutExpired:
        return None, f"no end within {timeout} s"
    return done.returncode, done.stdout + done.stderr


def run(options, scene, settings, check=False, timeout=None, may_fail=False):
    """Runs a scene, a path from the project's root as are those in settings "Section/Name=value"; ends this program
    when the run fails, unless it may."""
    with tempfile.TemporaryDirectory() as directory:
        command = [*launcher(options), options.program, str(ROOT / scene)]
        for setting in [*settings, f"Output directory={directory}"]:
            command += ["--set", setting]
        if check:
            command.append("--check")
        start = time.monotonic()
        status, output = execute(command, timeout, ROOT)
        seconds = time.monotonic() - start
        if status != 0 and not may_fail:
            sys.exit(f"exit status {status} of {shlex.join(command)}\n{output}")
        path = Path(directory) / "summary.json"
        summary = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
        return Run(status, output, summary, seconds, read_history(Path(directory) / "history.csv"))


def read_history(path):
    """The columns of a history.csv as lists of numbers, by their names; empty when there is none."""
    if not path.exists():
        return {}
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name]) for row in rows] for name in rows[0]} if rows else {}


def sized_mesh(directory, mesh, size):
    """A .geo file of the project, a path from its root, with another value of the parameter Size [m]."""
    path = Path(directory) / f"{Path(mesh).stem}_{size}.geo"
    path.write_text(f'Size = {size};\nInclude "{ROOT / mesh}";\n', encoding="utf-8")
    return path


def medians(options, figures, scene, settings, **more):
    """Medians of figures(summary), a dictionary of numbers, over the repeated runs of a scene."""
    rows = [figures(run(options, scene, settings, **more).summary) for _ in range(options.repeat)]
    return {key: statistics.median(row[key] for row in rows) for key in rows[0]}


def markdown_table(headings, rows):
    """A Markdown table as text; columns of numbers to the right."""
    texts = [[str(cell) for cell in row] for row in rows]
    numbers = [bool(texts) and all(re.match(r"^[-+0-9.,e% ]*$", row[k]) for row in texts) for k in range(len(headings))]
    lines = ["| " + " | ".join(headings) + " |", "|" + "|".join("--:" if number else "---" for number in numbers) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in texts])


def write_csv(path, headings, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(headings)
        writer.writerows(rows)


def replace_section(name, text, page=PAGE):
    """Puts text between the page's lines <!-- NAME --> and <!-- end of NAME -->."""
    begin, end = f"<!-- {name} -->", f"<!-- end of {name} -->"
    old = page.read_text(encoding="utf-8")
    if old.count(begin) != 1 or old.count(end) != 1:
        sys.exit(f"{page} has not one section {begin} ... {end}")
    head, rest = old.split(begin)
    page.write_text(f"{head}{begin}\n\n{text.strip()}\n\n{end}{rest.split(end)[1]}", encoding="utf-8")
