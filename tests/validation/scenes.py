# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of the scenes of this folder, and figures of their histories."""

import csv
import json
import resource
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tests"))
from execute import execute  # noqa: E402  (beside this folder)

SPRINGS = ["Material/Model=bond based", "Material/Form=automatic", "Material/Poisson ratio=0"]


class Failed(Exception):
    """A run that came to no end; its text is what the program said."""


@dataclass
class Run:
    """One run: its folder, summary.json, what the columns of history.csv hold, and its processor time [s]."""
    folder: Path
    summary: dict
    history: dict
    seconds: float

    def column(self, *words):
        """The values of the column whose name has all these words."""
        return next(values for name, values in self.history.items() if all(word in name for word in words))


@dataclass
class Runner:
    """What all runs share: the program, the folder of their results, the seconds that each may take, and whether results
    that are there already, of the same command, will do."""
    program: str
    output: Path
    limit: int
    reuse: bool = False

    def run(self, scene, name, settings=()):
        """Runs a scene with settings "Section/Name=value" into output/NAME."""
        folder = self.output / name.replace(" ", "_")
        command = [self.program, str(HERE / scene)]
        for setting in [*settings, f"Output directory={folder}"]:
            command += ["--set", setting]
        if self.reuse and (old := finished(folder, command)):
            return old
        shutil.rmtree(folder, ignore_errors=True)
        folder.parent.mkdir(parents=True, exist_ok=True)
        before = processor_time()
        status, out, err = execute(command, self.output, self.limit)
        seconds = processor_time() - before
        if status != 0:
            raise Failed(f"no end within {self.limit} s" if status is None else what_failed(out + err))
        (folder / "processor_time").write_text(f"{seconds}\n", encoding="utf-8")
        return finished(folder, command)

    def mesh(self, geometry, name, **constants):
        """The mesh that Gmsh makes of a .geo file with values of its constants."""
        self.output.mkdir(parents=True, exist_ok=True)
        mesh = self.output / f"{name}.msh"
        values = [word for constant, value in constants.items() for word in ("-setnumber", constant, str(value))]
        subprocess.run(["gmsh", "-2", *values, "-o", str(mesh), str(HERE / geometry)], check=True, stdout=subprocess.DEVNULL)
        return mesh

    def plot(self, script, run, *arguments):
        """Draws a picture into the folder of a run, where gnuplot is there."""
        if shutil.which("gnuplot"):
            subprocess.run([str(ROOT / "prm/examples" / script), str(run.folder), *arguments], check=False)


def finished(folder, command):
    """The run of a command whose results are in a folder, None if there is none that came to its end."""
    if not (folder / "processor_time").exists():
        return None
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    if summary["command"] != " ".join(command):
        return None
    seconds = float((folder / "processor_time").read_text(encoding="utf-8"))
    return Run(folder, summary, read_history(folder / "history.csv"), seconds)


def processor_time():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def what_failed(text):
    """The line in which the program tells of its failure, without the residuals before."""
    lines = [line for line in text.splitlines() if line.startswith("perideal:")]
    return (lines or ["the program failed"])[0].removeprefix("perideal: ")


def read_history(path):
    """By name, the columns of a history.csv as numbers."""
    with path.open(encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    return {name: [float(row[k]) for row in rows] for k, name in enumerate(names)}


def at(xs, ys, x):
    """y at x on the first piece of a curve that passes x; None where it never does."""
    for x0, x1, y0, y1 in zip(xs, xs[1:], ys, ys[1:]):
        if x0 <= x <= x1 and x1 > x0:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    return None


def peak(xs, ys):
    """(x, y) where y is largest."""
    return max(zip(xs, ys), key=lambda point: point[1])


def slope(xs, ys):
    """Slope of the line that fits the points best."""
    x_mean, y_mean = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((x - x_mean) * (y - y_mean) for x, y in zip(xs, ys)) / sum((x - x_mean) ** 2 for x in xs)
