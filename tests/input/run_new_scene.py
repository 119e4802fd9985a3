#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Has scenes written beside mesh files by --new, and runs them as they are.

    run_new_scene.py --program build/perideal --mpirun "mpirun --bind-to none"
"""

import argparse
import json
import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from execute import execute

ROOT = Path(__file__).resolve().parents[2]

# A plate whose groups have no names, and a curve in it that may become a precrack.
NAMELESS = """Mesh.RecombineAll = 1;
Mesh.SubdivisionAlgorithm = 1;
Point(1) = {0, 0, 0, 20};
Point(2) = {100, 0, 0, 20};
Point(3) = {100, 50, 0, 20};
Point(4) = {0, 50, 0, 20};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
"""

# File, what it is copied from or its text, words of the scene, words that the scene must not have.
CASES = [
    ("bracket.geo", ROOT / "prm/tutorials/10_bracket.geo",
     ["set Dimension        = 2", "end, top, 0 (faces in no group)", "Materials of the mesh:  bracket", "set Boundary = end", "set Boundary = top"],
     ["millimetres?", "subsection bracket"]),
    ("block.msh", ROOT / "meshes/block.msh", ["set Dimension        = 3", "hexahedra", "u_z = 0"], ["Thickness", "Assumption"]),
    ("two_materials.msh", ROOT / "tests/scenes/two_materials.msh", ["of its own; what it does not say"], []),
    ("precracked_plate.geo", ROOT / "tests/scenes/precracked_plate.geo", ["# subsection Precracks"], []),
    ("nameless.geo", NAMELESS, ["set Boundary = 0", "names no boundary", "was it drawn in millimetres?", "set b_y"], ["t_x"]),
]
# Displacements beside those of finite elements on these coarse meshes.
LARGEST_DIFFERENCE = 0.1


def deviations(arguments, folder, name, source, words, others):
    """What is wrong with the scene of one file, as texts."""
    (folder / name).write_text(source if isinstance(source, str) else source.read_text(encoding="utf-8"), encoding="utf-8")
    scene = folder / Path(name).with_suffix(".prm")
    status, out, err = execute([*arguments.mpirun.split(), "-n", "2", arguments.program, "--new", name], folder, 120)
    if status != 0 or not scene.exists():
        return [f"--new: exit status {status}: {err}"]
    text = scene.read_text(encoding="utf-8")
    found = [f"the scene does not say {word!r}" for word in words if word not in text]
    found += [f"the scene says {word!r}" for word in others if word in text]
    if scene.name not in out:
        found.append(f"says {out!r}")
    status, _, err = execute([arguments.program, "--check", scene.name], folder, 120)
    if status != 0:
        found.append(f"--check: exit status {status}: {err}")
    status, out, err = execute([arguments.program, scene.name], folder, 120)
    if status != 0:
        return found + [f"the scene does not run: exit status {status}: {err}"]
    summary = json.loads((folder / "output" / scene.stem / "summary.json").read_text(encoding="utf-8"))
    if not summary["errors"]["fem"]["l2"] < LARGEST_DIFFERENCE:
        found.append(f"is {summary['errors']['fem']['l2']} off finite elements")
    if not summary["energy"]["strain"] > 0:
        found.append("nothing is loaded")
    # What a user made of it stays.
    scene.write_text(text + "# mine\n", encoding="utf-8")
    status, _, err = execute([arguments.program, "--new", name], folder, 120)
    if status != 1 or "is there already" not in err or scene.name not in err:
        found.append(f"overwriting: exit status {status}: {err}")
    if scene.read_text(encoding="utf-8") != text + "# mine\n":
        found.append("the scene was overwritten")
    return found


def main():
    parser = argparse.ArgumentParser(description="checks scenes that --new writes")
    parser.add_argument("--program", required=True, type=os.path.abspath)
    parser.add_argument("--mpirun", default="mpirun")
    arguments = parser.parse_args()
    n_deviating = 0
    for name, source, words, others in CASES:
        with tempfile.TemporaryDirectory(prefix="perideal-new-") as folder:
            found = deviations(arguments, Path(folder), name, source, words, others)
        n_deviating += bool(found)
        print(f"{'DEVIATES' if found else 'ok':8}  {name}")
        for text in found:
            print(f"    {text}")
    print(f"{len(CASES)} files, {n_deviating} deviate")
    return 1 if n_deviating else 0


if __name__ == "__main__":
    sys.exit(main())
