#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs one plate in metres and newtons and in millimetres and newtons: strains must not know the unit.

    run_units.py --program build/perideal
"""

import argparse
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

# A plate that is pressed along x, by tractions, and pulled along y, by displacements.
SCENE = """
set Output directory = {directory}
subsection Mesh
  set Generator = box
  set Cells     = 40, 20
  set Size      = {size[0]}, {size[1]}
  set Corner    = {corner[0]}, {corner[1]}
  set Thickness = {thickness}
end
subsection Nodes
  set Horizon factor = 3.015
end
subsection Material
  set Assumption    = plane stress
  set Young modulus = {modulus}
  set Poisson ratio = 0.3
end
subsection Solver
  set Tolerance = 1e-13
end
subsection Boundary conditions
  set Rigid body motions = remove
  subsection top
    set Boundary = top
    set u_y      = {displacement}
  end
  subsection bottom
    set Boundary = bottom
    set u_y      = -{displacement}
  end
  subsection right
    set Boundary = right
    set t_x      = -{traction}
  end
  subsection left
    set Boundary = left
    set t_x      = {traction}
  end
end
subsection Comparison
  set Profiles = top, right
end
"""

# Treatment, its settings, whether strains are the same in both units.
TREATMENTS = [
    ("consistent form", ["Material/Model=extended ordinary", "Material/Form=consistent"], True),
    ("balanced", ["Material/Model=ordinary", "Boundary conditions/Treatment=balanced"], True),
    ("taylor ghosts", ["Material/Model=ordinary", "Boundary conditions/Treatment=taylor ghosts"], True),
    ("printed, without L", ["Material/Model=ordinary", "Boundary conditions/Treatment=printed",
                            "Boundary conditions/Transfer lambda=0"], True),
    # lambda = 1 N/m^11 makes of L 3e+12 times the traction in millimetres.
    ("printed", ["Material/Model=ordinary", "Boundary conditions/Treatment=printed"], False),
]

# What the solver's tolerance leaves, times what the plate makes of residuals.
TOLERANCE = 1e-10
LIMIT = 120  # seconds, for a machine that is busy


def write_scene(folder, millimetres):
    """The scene in the unit of length that is asked for; returns its path."""
    length = 1000 if millimetres else 1
    stress = 1e-6 if millimetres else 1
    path = folder / ("mm.prm" if millimetres else "m.prm")
    path.write_text(
        SCENE.format(directory=folder / path.stem, size=(length, 0.5 * length), corner=(-0.5 * length, -0.25 * length),
                     thickness=0.01 * length, modulus=200e9 * stress, displacement=0.25e-3 * length, traction=180e6 * stress),
        encoding="utf-8")
    return path


def displacements(program, scene, settings):
    """Those along the profiles of a run, or None where it came to no solution."""
    command = [program, str(scene)] + [word for setting in settings for word in ("--set", setting)]
    result = subprocess.run(command, capture_output=True, text=True, check=False, timeout=LIMIT)
    if result.returncode == 2:
        return None
    if result.returncode != 0:
        sys.exit(f"exit status {result.returncode}: {' '.join(command)}\n{result.stdout}{result.stderr}")
    values = []
    for name in ("top", "right"):
        with open(scene.with_suffix("") / f"profile_{name}.csv", encoding="utf-8", newline="") as file:
            for row in csv.DictReader(file):
                values += [float(row["perideal_u_x"]), float(row["perideal_u_y"])]
    return values


def difference(program, folder, settings):
    """Of the displacements over the length of the plate, relative to the largest; infinite without a solution."""
    metres = displacements(program, write_scene(folder, False), settings)
    millimetres = displacements(program, write_scene(folder, True), settings)
    if metres is None:
        sys.exit("no solution in metres")
    if millimetres is None:
        return float("inf")
    return max(abs(a - 1e-3 * b) for a, b in zip(metres, millimetres)) / max(map(abs, metres))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    arguments = parser.parse_args()
    n_deviating = 0
    with tempfile.TemporaryDirectory(prefix="perideal-units-") as name:
        for treatment, settings, same in TREATMENTS:
            found = difference(arguments.program, Path(name), settings)
            fits = found <= TOLERANCE if same else found > 0.1
            n_deviating += not fits
            print(f"{'ok' if fits else 'DEVIATES':8}  {treatment}: {found:.2g}, {'the same' if same else 'others'} expected")
    return 1 if n_deviating else 0


if __name__ == "__main__":
    sys.exit(main())
