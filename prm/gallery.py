#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the examples and draws the pictures of the gallery, prm/pictures/NAME.png.

    prm/gallery.py --program build/perideal [NAME...]

Needs the packages python3-vtk9 and python3-matplotlib, like Output/Pictures. All examples take ten minutes.
"""

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

HERE = Path(__file__).resolve().parent
WIDTH = 480  # pixels
COLOURS = 128
# What each example shows, and what is set to draw it.
SCENES = {
    "plate_with_hole": ("von mises", []),
    "hole_in_wide_plate": ("von mises", []),
    "block_with_hole": ("von mises", ["Mesh/Cells=8, 9, 5", "Comparison/FEM=false", "Comparison/Reference=false"]),
    "drilled_block": ("von mises", ["Comparison/Reference=false"]),
    "l_domain": ("von mises", []),
    "laminate_with_hole": ("strain", []),
    "tensor_manufactured_2d": ("displacement", []),
    "tensor_manufactured_3d": ("displacement", []),
    "pdbc_1_mixed": ("displacement", []),
    "pdbc_2_cantilever": ("displacement", []),
    "pdbc_3_displacement": ("displacement", []),
    "pdbc_4_tension": ("displacement", []),
    "pdbc_5_bending": ("displacement", []),
    "tension_column": ("displacement", []),
    "stress_states": ("displacement", []),
    "notched_strip": ("damage", []),
    "slit_square": ("damage", ["Mesh/Cells=64, 64"]),
    "notched_specimen": ("damage", []),
    "l_panel": ("damage", []),
    "kalthoff_winkler": ("damage", []),
    "kalthoff_winkler_solid": ("damage", ["Material/Form=energy"]),
    "glass_branching": ("damage", []),
    "adapted_branching": ("damage", []),
    "fragmenting_block": ("damage", []),
    "wave_in_bar": ("velocity", []),
    "tension_column_damping": ("displacement", []),
    "hyperelastic_bar": ("displacement", []),
}


def draw(program, name, target):
    """Runs an example; returns what went wrong, or nothing."""
    field, settings = SCENES[name]
    with tempfile.TemporaryDirectory(prefix="perideal-gallery-") as folder:
        command = [program, str(HERE / "examples" / f"{name}.prm")]
        for setting in [*settings, f"Output/Pictures={field}", f"Output directory={folder}/output"]:
            command += ["--set", setting]
        environment = {"OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", **os.environ}
        done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
        if done.returncode != 0:
            return done.stdout[-1000:] + done.stderr
        pictures = sorted(Path(folder, "output").glob("picture_*.png"))
        if not pictures:
            return f"draws nothing of {field}\n" + done.stdout[-500:]
        picture = Image.open(pictures[0]).convert("RGB")
        picture = picture.resize((WIDTH, WIDTH * picture.height // picture.width), Image.LANCZOS)
        picture.quantize(COLOURS).save(target, optimize=True)
    return ""


def main():
    parser = argparse.ArgumentParser(description="draws the pictures of the gallery")
    parser.add_argument("--program", required=True, type=os.path.abspath)
    parser.add_argument("names", nargs="*", metavar="NAME", help="examples; default: all")
    arguments = parser.parse_args()
    (HERE / "pictures").mkdir(exist_ok=True)
    failed = 0
    for name in arguments.names or SCENES:
        problem = draw(arguments.program, name, HERE / "pictures" / f"{name}.png")
        failed += bool(problem)
        print(f"{name}: {problem or 'drawn'}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
