#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks what is recorded at points, along lines and by load step, and that finished load steps go on.

    run_records.py --program build/perideal [--mpirun "mpirun ..."]
"""

import argparse
import csv
import json
import re
import shlex
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from checks import count_failures, expect
from execute import execute
from run_points import CONSISTENT, POISSON, SCENE, STRESS, TORN, YOUNG
from vtu import read_vtu

PROBES = {"Probes/tip/Point": "0.73, 0.31", "Probes/tip/Fields": "displacement, stress, strain, von mises",
          "Probes/corner/Point": "1.2, 0.8"}
LINE = {"Comparison/middle/From": "0, 0.4", "Comparison/middle/To": "1.2, 0.4", "Comparison/middle/Points": "7",
        "Comparison/FEM": "true"}


class Folder:
    """Runs in one folder, which keeps their results."""

    def __init__(self, program, mpirun, path):
        self.program, self.mpirun, self.path = program, mpirun, path

    def run(self, scene, settings, ranks=1, status=0, name="output"):
        (self.path / "case.prm").write_text(scene, encoding="utf-8")
        command = (self.mpirun + ["-n", str(ranks)] if ranks > 1 else []) + [self.program, "case.prm"]
        for path, value in {"Output directory": name, **settings}.items():
            command += ["--set", f"{path}={value}"]
        ended, out, err = execute(command, self.path)
        expect(ended == status, f"{settings}: exit status {ended}, not {status}\n{out}{err}")
        return out + err

    def table(self, file, name="output"):
        """{column: [value]} of a .csv file."""
        with open(self.path / name / file, encoding="utf-8", newline="") as text:
            header, *rows = csv.reader(text)
        return {title: [float(row[k]) for row in rows] for k, title in enumerate(header)}

    def bytes(self, file, name="output"):
        return (self.path / name / file).read_bytes()


def expect_close(found, expected, scale, tolerance, case):
    expect(len(found) == len(expected), f"{case}: {len(found)} values, not {len(expected)}")
    for a, b in zip(found, expected):
        expect(abs(a - b) <= tolerance * scale, f"{case}: {found}, not {expected}")


def check_probes(folder):
    """Uniform tension, at points between the nodes: exact but for the tolerance of the solver."""
    strain = STRESS / YOUNG
    for ranks in (1, 2):
        # t_x grows to 7e6 in two load steps.
        folder.run(SCENE.replace("t_x = 7e6", "t_x = 7e6*t"), PROBES | CONSISTENT | {"Solver/Load steps": "2"}, ranks)
        history = folder.table("history.csv")
        largest = 1.2 * strain
        for column, value, scale in (("displacement_x at tip [m]", 0.73 * strain, largest),
                                     ("displacement_y at tip [m]", -POISSON * 0.31 * strain, largest),
                                     ("displacement_x at corner [m]", 1.2 * strain, largest),
                                     ("stress_xx at tip [Pa]", STRESS, STRESS), ("stress_xy at tip [Pa]", 0, STRESS),
                                     ("strain_yy at tip [-]", -POISSON * strain, strain),
                                     ("von_mises_stress at tip [Pa]", STRESS, STRESS)):
            expect_close(history[column], [0.5 * value, value], scale, 1e-6, f"{ranks} ranks: {column}")
        summary = json.loads(folder.bytes("summary.json"))
        expect(summary["probes"]["tip"]["stress_xx"] == history["stress_xx at tip [Pa]"], "probes of the summary")


def check_probes_in_motion(folder):
    """A body that moves as a whole: its velocity at a point, and the displacement that it makes."""
    motion = {"Material/Density": "2700", "Solver/Name": "dynamics", "Solver/End time": "2e-5", "Solver/Time step": "1e-6",
              "Output/History steps": "1", "Probes/tip/Point": "0.73, 0.31", "Probes/tip/Fields": "displacement, velocity", "Initial conditions/v_y": "3"}
    free = re.sub(r"(?s)subsection Boundary conditions.*", "", SCENE)
    for form in ("consistent", "energy"):
        folder.run(free, motion | {"Material/Form": form})
        history = folder.table("history.csv")
        expect(len(history["time [s]"]) > 2, "rows of the history")
        for time, u, v in zip(history["time [s]"], history["displacement_y at tip [m]"], history["velocity_y at tip [m/s]"]):
            expect(abs(v - 3) < 1e-9 and abs(u - 3 * time) < 1e-12, f"{form}: {u}, {v} at t = {time}")


def check_line(folder):
    """Displacement, strain and stress along a line, and the finite elements' beside them."""
    strain = STRESS / YOUNG
    for ranks in (1, 2):
        folder.run(SCENE, LINE | CONSISTENT | {"Output/Fields": "displacement, fem stress, stress error"}, ranks)
        line = folder.table("line_middle.csv")
        places = [0.2 * k for k in range(7)]
        expect_close(line["s [m]"], places, 1.2, 1e-12, "places")
        # The mid-height moves down by half of what the width shrinks by.
        for start in ("", "fem_"):
            expect_close(line[start + "displacement_x [m]"], [strain * x for x in places], 1.2 * strain, 1e-6, start + "u_x")
            expect_close(line[start + "displacement_y [m]"], [-POISSON * strain * 0.4] * 7, 1.2 * strain, 1e-6, start + "u_y")
            expect_close(line[start + "strain_xx [-]"], [strain] * 7, strain, 1e-6, start + "strain")
            expect_close(line[start + "stress_xx [Pa]"], [STRESS] * 7, STRESS, 1e-6, start + "stress")
        cells = read_vtu(folder.path / "output" / "solution.vtu")["cell"]
        expect_close(cells["fem_stress_xx"], [STRESS] * 96, STRESS, 1e-6, "fem stress")
        expect_close(cells["stress_error_xx"], [0] * 96, STRESS, 1e-6, "stress error")
    # A hole of radius 0.3 in a plate from -0.5 to 0.5: what is in it, and outside of the plate, is left out.
    folder.run(SCENE, {"Mesh/Generator": "plate with hole", "Mesh/Cells": "10, 10", "Mesh/Size": "1",
                       "Mesh/Hole radius": "0.3", "Comparison/across/From": "0, 0", "Comparison/across/To": "1, 1",
                       "Comparison/across/Points": "101"})
    line = folder.table("line_across.csv")
    expect(0.25 < min(line["s [m]"]) < 0.32, f"the line begins at {min(line['s [m]'])}")
    expect(abs(max(line["s [m]"]) - 0.5**0.5) < 1e-12, f"the line ends at {max(line['s [m]'])}")


def check_frames(folder):
    """Load steps that leave field files."""
    elastic = {"Boundary conditions/pull/u_x": "1e-5*t", "Output/Fields": "displacement"}
    for text, steps in (("", range(1, 9)), ("3", (3, 6, 8)), ("1, 4", (1, 4, 8)), ("8", (8,))):
        name = f"frames {text or 'of all'}"
        folder.run(TORN, elastic | ({"Output/Frame steps": text} if text else {}), name=name)
        times = re.findall(r'timestep="([^"]*)"', folder.bytes("solution.pvd", name).decode())
        expect([float(time) for time in times] == [step / 8 for step in steps], f"frames {text!r}: times {times}")
        files = sorted(path.name for path in (folder.path / name).glob("solution_*.vtu"))
        expect(files == [f"solution_{k + 1:04d}.vtu" for k in range(len(steps))], f"frames {text!r}: {files}")


def check_more_steps(folder):
    """A run that came to its end goes on with more load steps, as if it had been one run."""
    at_end = {"Checkpoints/At end": "true"}
    for solver, limit in (("quasi static", "1e-9"), ("dynamic relaxation", "1e-6")):
        settings = {"Solver/Name": solver, "Solver/Tolerance": limit, "Solver/Load steps": "4",
                    "Boundary conditions/pull/u_x": "6e-4*t"}
        name = solver.split()[0]
        folder.run(TORN, settings | {"Solver/Last load step": "6"}, name=f"{name} whole")
        folder.run(TORN, settings | at_end, name=name)
        table = folder.table("history.csv", name)
        expect(table["time [s]"][-1] == 1, f"{name}: ends at {table['time [s]'][-1]}")
        text = folder.run(TORN, settings | {"Checkpoints/Restart": "true"}, status=1, name=name)
        expect("Solver/Last load step" in text and "more than 4" in text, f"{name}: nothing is left to do\n{text}")
        folder.run(TORN, settings | {"Checkpoints/Restart": "true", "Solver/Last load step": "6"}, name=name)
        for file in ("history.csv", "solution_0006.vtu"):
            expect(folder.bytes(file, name) == folder.bytes(file, f"{name} whole"), f"{name}: {file} is another")
        broken = folder.table("history.csv", name)["broken bonds"]
        expect(broken[-1] > broken[3], f"{name}: nothing breaks in steps 5 and 6: {broken}")


def check_longer_motion(folder):
    """The same of dynamics, whose End time grows."""
    motion = {"Solver/Name": "dynamics", "Solver/Time step": "1e-6", "Output/Frames": "2",
              "Boundary conditions/pull/u_x": "20*t", "Output/History steps": "5"}
    folder.run(TORN, motion | {"Solver/End time": "4e-5"}, name="moved whole")
    folder.run(TORN, motion | {"Solver/End time": "2e-5", "Checkpoints/At end": "true"}, name="moved")
    folder.run(TORN, motion | {"Solver/End time": "4e-5", "Checkpoints/Restart": "true"}, name="moved")
    expect(folder.bytes("history.csv", "moved") == folder.bytes("history.csv", "moved whole"), "another history")


def main():
    parser = argparse.ArgumentParser(description="checks what is recorded at points, along lines and by load step")
    parser.add_argument("--program", required=True, type=Path)
    parser.add_argument("--mpirun", default="mpirun --bind-to none --oversubscribe")
    arguments = parser.parse_args()
    program, mpirun = str(arguments.program.resolve()), shlex.split(arguments.mpirun)
    checks = (check_probes, check_probes_in_motion, check_line, check_frames, check_more_steps, check_longer_motion)
    return 1 if count_failures([(check.__doc__, lambda path, check=check: check(Folder(program, mpirun, path))) for check in checks]) else 0


if __name__ == "__main__":
    sys.exit(main())
