#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks displacements at the points of solution files: one at each vertex of the mesh, two where a crack runs.

    run_points.py --program build/perideal [--mpirun "mpirun ..."]
"""

import argparse
import shlex
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from checks import count_failures, expect
from execute import execute
from vtu import read_vtu

STRESS, YOUNG, POISSON = 7e6, 70e9, 0.3
# Uniform tension: u_x = s/E x, u_y = u_z = -nu s/E (y, z).
SCENE = """
set Dimension = 2
set Output directory = output
subsection Mesh
  set Generator = box
  set Cells = 12, 8
  set Size = 1.2, 0.8
end
subsection Material
  set Young modulus = 70e9
  set Poisson ratio = 0.3
end
subsection Boundary conditions
  subsection left
    set Boundary = left
    set u_x = 0
  end
  subsection bottom
    set Boundary = bottom
    set u_y = 0
  end
  subsection pull
    set Boundary = right
    set t_x = 7e6
  end
end
subsection Output
  set Fields = displacement, stress
end
"""
SOLID = {"Dimension": "3", "Mesh/Cells": "6, 4, 4", "Mesh/Size": "1.2, 0.8, 0.8"}
BACK = """
subsection Boundary conditions
  subsection back
    set Boundary = back
    set u_z = 0
  end
end
"""
CONSISTENT = {"Material/Form": "consistent"}
# A strip that is torn apart along x = 0.5 of 1, where a notch comes from below.
TORN = """
set Dimension = 2
set Output directory = output
subsection Mesh
  set Generator = box
  set Cells = 20, 10
  set Size = 1, 0.5
end
subsection Material
  set Model = bond based
  set Assumption = plane stress
  set Young modulus = 70e9
  set Poisson ratio = 0.3333333333333333
  set Density = 2700
  set Critical stretch = 1e-3
end
subsection Precracks
  subsection notch
    set Points = 0.5, 0; 0.5, 0.1
  end
end
subsection Solver
  set Name = quasi static
  set Load steps = 8
end
subsection Boundary conditions
  subsection left
    set Boundary = left
    set u_x = 0
    set u_y = 0
  end
  subsection pull
    set Boundary = right
    set u_x = 2e-3*t
    set u_y = 0
  end
end
"""


class Scenes:
    def __init__(self, program, mpirun):
        self.program, self.mpirun = program, shlex.split(mpirun)

    def run(self, scene, settings, ranks=1, status=0):
        """The last of the solution files, as read; with them the names of all files."""
        with tempfile.TemporaryDirectory(prefix="perideal-points-") as name:
            folder = Path(name)
            (folder / "case.prm").write_text(scene, encoding="utf-8")
            command = (self.mpirun + ["-n", str(ranks)] if ranks > 1 else []) + [self.program, "case.prm"]
            for path, value in settings.items():
                command += ["--set", f"{path}={value}"]
            ended, out, err = execute(command, folder)
            expect(ended == status, f"{settings}: exit status {ended}\n{out}{err}")
            files = sorted((folder / "output").glob("solution*.vtu"))
            names = [path.name for path in sorted((folder / "output").iterdir())]
            return [read_vtu(path) for path in files], names, out


def expect_tension(solution, case, tolerance, depth=0.8):
    """Uniform tension at every point, up to a share of the largest displacement."""
    largest = STRESS / YOUNG * 1.2
    for (x, y, z), found in zip(solution["points"], solution["point"]["displacement"]):
        expected = [STRESS / YOUNG * x, -POISSON * STRESS / YOUNG * y, -POISSON * STRESS / YOUNG * z]
        if depth == 0:
            expected[2] = 0
        for a, b in zip(found, expected):
            expect(abs(a - b) <= tolerance * largest, f"{case}: {found} at {(x, y, z)}, not {expected}")


def check_tension(scenes):
    """Linear fields are exact, on any number of ranks, and cells share their points."""
    # Single precision has seven digits, and the solver stops at 1e-8.
    for ranks in (1, 2, 3):
        (solution,), _, _ = scenes.run(SCENE, CONSISTENT, ranks)
        expect(len(solution["points"]) == 13 * 9, f"{ranks} ranks: {len(solution['points'])} points, not 117")
        expect(len(solution["cells"]) == 96, f"{ranks} ranks: {len(solution['cells'])} cells")
        expect("displacement" not in solution["cell"] and "stress_xx" in solution["cell"], "displacements are of points")
        expect_tension(solution, f"{ranks} ranks", 1e-5, 0)
        for stress in solution["cell"]["stress_xx"]:
            expect(abs(stress - STRESS) < 1e-5 * STRESS, f"{ranks} ranks: stress {stress}")
    for ranks in (1, 2):
        (solution,), _, _ = scenes.run(SCENE + BACK, SOLID | CONSISTENT, ranks)
        expect(len(solution["points"]) == 7 * 5 * 5, f"{len(solution['points'])} points of the box, not 175")
        expect_tension(solution, f"box, {ranks} ranks", 1e-5)


def check_hanging(scenes):
    """Larger cells beside smaller ones: no point stands twice, and those that hang are on their edges."""
    refined = {"Mesh/Refine at": "left", "Mesh/Refine times": "2"}
    for ranks in (1, 2):
        (solution,), _, _ = scenes.run(SCENE, CONSISTENT | refined, ranks)
        places = {tuple(round(c, 6) for c in point) for point in solution["points"]}
        expect(len(places) == len(solution["points"]), f"{len(solution['points'])} points at {len(places)} places")
        expect(len(solution["cells"]) > 96, "nothing was refined")
        expect_tension(solution, "refined", 1e-4, 0)


def check_other_forms(scenes):
    """Bonds of other forms: softer at surfaces, by some per cent; fits to the nodes around do not add to that."""
    (solution,), _, _ = scenes.run(SCENE, {"Material/Form": "energy", "Mesh/Cells": "36, 24"})
    expect(len(solution["points"]) == 37 * 25, f"{len(solution['points'])} points")
    expect_tension(solution, "energy form", 0.1, 0)


def check_crack(scenes):
    """A precrack has two sides, which move apart."""
    crack = {"Precracks/crack/Points": "0.6, -0.1; 0.6, 0.4"}
    for ranks in (1, 2, 3):
        for form in ("consistent", "energy"):
            case = f"crack, {form}, {ranks} ranks"
            # In linear statics the consistent form alone has cracks.
            solver = "static" if form == "consistent" else "quasi static"
            (solution,), _, _ = scenes.run(SCENE, crack | {"Material/Form": form, "Solver/Name": solver}, ranks)
            # The vertices at y = 0, 0.1, 0.2 and 0.3 have two sides; at the tip both hang together.
            expect(len(solution["points"]) == 117 + 4, f"{case}: {len(solution['points'])} points, not 121")
            at_mouth = [u[0] for point, u in zip(solution["points"], solution["point"]["displacement"])
                        if abs(point[0] - 0.6) < 1e-6 and abs(point[1]) < 1e-6]
            expect(len(at_mouth) == 2, f"{case}: {len(at_mouth)} points at the mouth")
            # A crack of half the width opens by more than twice 4 s a/E of a centre crack: 1.6e-4 here.
            opening = abs(at_mouth[0] - at_mouth[1])
            expect(1.6e-4 < opening < 8e-4, f"{case}: opens by {opening}")


def check_growth(scenes):
    """Bonds that break open more points, in the frames that follow."""
    for ranks in (1, 2):
        frames, _, _ = scenes.run(TORN, {}, ranks)
        numbers = [len(frame["points"]) for frame in frames]
        expect(len(frames) == 8, f"{len(frames)} frames")
        expect(numbers[0] == 21 * 11 + 2, f"{ranks} ranks: {numbers[0]} points at first, not 233")
        expect(numbers == sorted(numbers), f"{ranks} ranks: points {numbers}")
        expect(numbers[-1] >= 21 * 11 + 11, f"{ranks} ranks: {numbers[-1]} points when it is torn")
        # The right part goes as a whole: no cell is drawn out between the parts.
        last = frames[-1]
        for cell in last["cells"]:
            u = [last["point"]["displacement"][point][0] for point in cell]
            expect(max(u) - min(u) < 1e-3, f"{ranks} ranks: a cell is stretched by {max(u) - min(u)}")


def check_pieces(scenes):
    """A file for each rank."""
    whole, _, _ = scenes.run(SCENE, CONSISTENT)
    pieces, names, _ = scenes.run(SCENE, CONSISTENT | {"Output/Format": "pvtu"}, 2)
    expect("solution.pvtu" in names and "solution_0000.vtu" in names and "solution_0001.vtu" in names, f"files {names}")
    expect(sum(len(piece["cells"]) for piece in pieces) == 96, "cells of the pieces")
    for piece in pieces:
        expect(max(max(cell) for cell in piece["cells"]) == len(piece["points"]) - 1, "points of a piece")
        expect_tension(piece, "piece", 1e-5, 0)
    stress = sorted(round(s) for piece in pieces for s in piece["cell"]["stress_xx"])
    expect(len(stress) == len(whole[0]["cell"]["stress_xx"]), "stresses of the pieces")


def main():
    parser = argparse.ArgumentParser(description="checks displacements at the points of solution files")
    parser.add_argument("--program", required=True, type=Path)
    parser.add_argument("--mpirun", default="mpirun --bind-to none --oversubscribe")
    arguments = parser.parse_args()
    scenes = Scenes(str(arguments.program.resolve()), arguments.mpirun)
    checks = (check_tension, check_hanging, check_other_forms, check_crack, check_growth, check_pieces)
    return 1 if count_failures([(check.__doc__, lambda _, check=check: check(scenes)) for check in checks]) else 0


if __name__ == "__main__":
    sys.exit(main())
