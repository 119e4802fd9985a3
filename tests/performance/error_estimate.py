#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Holds the estimated error of the linear consistent form against the true one, scene by scene, as a Markdown table.

    error_estimate.py --program build/perideal [--scenes NAME ...]
"""

import argparse
import tempfile
from pathlib import Path

from runs import ROOT, add_arguments, markdown_table, run

SINE = "tests/scenes/sine_field.prm"
BEAM = "tests/scenes/thin_cantilever.prm"
STRIP = "tests/scenes/thin_strip.prm"
PLATE = "prm/examples/plate_with_hole.prm"
BLOCK = "prm/examples/block_with_hole.prm"
LAMINATE = "prm/examples/laminate_with_hole.prm"
UNSTRUCTURED = "tests/scenes/plate_unstructured.prm"
SQUARE = "prm/verification/graded_square.prm"
CONSISTENT = ["Material/Model=extended ordinary", "Material/Form=consistent"]
REFINED = ["Comparison/Reference=true", "Comparison/Reference refinements=2"]
# Name, scene, settings; the true error is against its exact solution, else its reference.
SCENES = [
    *((f"sine field, {n} x {n}", SINE, [f"Mesh/Cells={n}, {n}"]) for n in (6, 12, 24, 48)),
    *((f"the same distorted, {n} x {n}", SINE, [f"Mesh/Cells={n}, {n}", "Mesh/Distortion=0.3"]) for n in (12, 24)),
    *((f"cantilever 2 x 0.1, {x} x {y}", BEAM, [f"Mesh/Cells={x}, {y}"])
      for x, y in ((10, 3), (10, 4), (20, 2), (20, 4), (40, 3), (40, 4), (80, 4), (160, 8))),
    *((f"strip 2 x 0.5 x 0.05, {cells}, nu .3", STRIP,
       ["Material/Poisson ratio=0.3", f"Mesh/Cells={cells}", *REFINED]) for cells in ("20, 5, 2", "20, 5, 3")),
    *((f"plate with a hole, {cells}", PLATE, [f"Mesh/Cells={cells}"]) for cells in ("10, 8", "15, 16", "30, 32", "60, 64")),
    ("the same, 15, 16, nu .4999", PLATE,
     ["Mesh/Cells=15, 16", "Material/Assumption=plane strain", "Material/Poisson ratio=0.4999"]),
    ("unstructured, 2,400 cells", UNSTRUCTURED, CONSISTENT),
    ("unstructured, 9,000 cells", UNSTRUCTURED, [*CONSISTENT, "Mesh/File=meshes/plate_unstructured_fine.geo"]),
    ("graded square", SQUARE, [*CONSISTENT, "Quadrature/Scheme=one point", "Boundary conditions/Layers=1"]),
    *((f"laminate, fibres at {angle}", LAMINATE, [f"Material/Orientation={angle}"]) for angle in (0, 30, 45, 90)),
    ("block with a hole, 8, 8, 5", BLOCK, ["Mesh/Cells=8, 8, 5", "Mesh/Refinements=0", *REFINED[:1], "Comparison/Reference refinements=1"]),
    *((f"angle, {size} m", None, size) for size in (0.1, 0.05, 0.025, 0.0125)),
]
ANGLE = """Size = {size};
Point(1) = {{0, 0, 0, Size}}; Point(2) = {{1, 0, 0, Size}}; Point(3) = {{1, 0.5, 0, Size}};
Point(4) = {{0.5, 0.5, 0, Size}}; Point(5) = {{0.5, 1, 0, Size}}; Point(6) = {{0, 1, 0, Size}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 5}}; Line(5) = {{5, 6}}; Line(6) = {{6, 1}};
Curve Loop(1) = {{1, 2, 3, 4, 5, 6}}; Plane Surface(1) = {{1}}; Recombine Surface {{1}};
Mesh.Algorithm = 6; Mesh.RecombinationAlgorithm = 1; Mesh.MshFileVersion = 2.2;
Physical Curve("left") = {{5}}; Physical Curve("right") = {{2}}; Physical Surface("body") = {{1}};
"""


def measure(options, scene, settings, directory):
    """Cells, true and estimated error of a scene; an angle by its size of cells."""
    if scene is None:
        mesh = Path(directory) / "angle.geo"
        mesh.write_text(ANGLE.format(size=settings), encoding="utf-8")
        text = (ROOT / BEAM).read_text(encoding="utf-8")
        scene = Path(directory) / "angle.prm"
        scene.write_text(text.replace("set Generator = box", f"set File = {mesh}").replace("  set Size      = 2, 0.1\n", "")
                         .replace("  set Cells     = 20, 4\n", ""), encoding="utf-8")
        settings = ["Material/Assumption=plane strain", "Comparison/Reference refinements=2"]
    summary = run(options, scene, [*settings, "Comparison/FEM=false", "Comparison/Profiles=", "Output/Fields=displacement"]).summary
    errors = summary["errors"]
    return summary["mesh"]["cells"], errors.get("exact", errors.get("reference"))["l2"], summary["estimated_error"]["l2"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_arguments(parser, repeat=None)
    parser.add_argument("--scenes", nargs="+", default=[""], help="beginnings of their names")
    options = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as directory:
        for name, scene, settings in SCENES:
            if name.startswith(tuple(options.scenes)):
                cells, error, estimate = measure(options, scene, settings, directory)
                rows.append([name, f"{cells:,}", f"{error:.1e}", f"{estimate:.1e}", f"{estimate / error:.2f}"])
    print(markdown_table(["scene", "cells", "error (l2)", "estimate", "estimate over error"], rows))


if __name__ == "__main__":
    main()
