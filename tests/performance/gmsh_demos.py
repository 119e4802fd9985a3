#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes parts of Gmsh's own demos with quadrilaterals or hexahedra only and loads each: every part must be solved, or be
refused with a cause and a remedy.

    gmsh_demos.py --program build/perideal [--parts NAME]... [--output DIRECTORY]

The parts come with the package gmsh-doc. Gmsh meshes each with recombination and subdivision; the sides of cells near
the lower end of the part's longest axis are then held, those near the upper end pulled by 1 MPa. The table goes to
results/gmsh_demos.csv: cells, what came out (solved, refused or WRONG), iterations or the message.
"""

import argparse
import collections
import gzip
import subprocess
import sys
import tempfile
from pathlib import Path

import runs

DEMOS = Path("/usr/share/doc/gmsh-doc/doc/gmsh")
# Dimension and factor on the sizes of cells, so that none has more than some 20,000 cells.
PARTS = {
    "tutorial/t1.geo": (2, 1), "tutorial/t3.geo": (3, 1), "tutorial/t4.geo": (2, 1), "tutorial/t5.geo": (3, 5),
    "tutorial/t6.geo": (2, 1), "tutorial/t11.geo": (2, 2), "tutorial/t16.geo": (3, 4), "tutorial/t18.geo": (3, 6),
    "demos/boolean/boolean.geo": (3, 4), "demos/boolean/chamfer.geo": (3, 4), "demos/boolean/compsolid.geo": (3, 5),
    "demos/boolean/extrude.geo": (3, 4), "demos/boolean/fillet.geo": (3, 4), "demos/boolean/pipe.geo": (3, 4),
    "demos/boolean/primitives.geo": (3, 4), "demos/boolean/simple.geo": (3, 4), "demos/simple_geo/cube.geo": (3, 2),
    "demos/simple_geo/cone.geo": (3, 3), "demos/simple_geo/hex.geo": (3, 1), "demos/simple_geo/piece.geo": (3, 3),
    "demos/simple_geo/piece-extr-rec.geo": (3, 4), "demos/simple_geo/sphere.geo": (3, 3),
    "demos/simple_geo/square_regular.geo": (2, 1), "demos/simple_geo/tower.geo": (3, 3),
    "demos/simple_geo/transfinite.geo": (3, 1)}
# Gmsh's numbers of element types: dimension and corners of the sides of those that the program reads.
DIMENSIONS = {1: 1, 2: 2, 3: 2, 4: 3, 5: 3, 6: 3, 7: 3, 15: 0}
SIDES = {3: [(0, 1), (1, 2), (2, 3), (3, 0)],
         5: [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]}
SCENE = """set Dimension = {dimension}
set Output directory = output
subsection Mesh
  set File = loaded.msh
end
subsection Material
  set Young modulus = 210e9
  set Poisson ratio = 0.3
end
subsection Solver
  set Name = static
end
subsection Boundary conditions
  subsection held
    set Boundary = held
    set u_x = 0
    set u_y = 0
{third}  end
  subsection pulled
    set Boundary = pulled
    set t_{axis} = 1e6
  end
end
"""


def mesh_part(name, dimension, factor, folder, recombines=True):
    """Has Gmsh mesh a part; the path of the mesh, or what Gmsh said."""
    source = DEMOS / name
    if not source.exists():
        source = DEMOS / (name + ".gz")
    if not source.exists():
        return None, "the package gmsh-doc does not have it"
    # beside the others of its folder, which it may include
    for other in source.parent.iterdir():
        if other.is_file() and not (folder / other.name).exists():
            (folder / other.name).symlink_to(other)
    text = gzip.decompress(source.read_bytes()) if source.suffix == ".gz" else source.read_bytes()
    (folder / "part.geo").write_bytes(
        text + f"\nMesh.RecombineAll = {int(recombines)}; Mesh.RecombinationAlgorithm = 1; Mesh.SubdivisionAlgorithm = {dimension - 1};\n"
               f"Mesh.ElementOrder = 1; Mesh.SaveAll = 1; Mesh.Algorithm = 6; Mesh.Binary = 0;\n".encode())
    command = ["gmsh", "part.geo", f"-{dimension}", "-format", "msh22", "-clscale", str(factor), "-o", "whole.msh", "-v", "2"]
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, timeout=90, check=False, stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        return None, "gmsh takes more than 90 s"
    path = folder / "whole.msh"
    if not path.exists():
        output = (done.stdout + done.stderr).decode(errors="replace").strip().splitlines()
        return None, "gmsh: " + (output[-1] if output else f"exit status {done.returncode}")
    return path, ""


def read_mesh(path):
    lines = path.read_text(encoding="utf-8").split("\n")
    start = lines.index("$Nodes")
    n_nodes = int(lines[start + 1])
    nodes = {}
    for line in lines[start + 2: start + 2 + n_nodes]:
        words = line.split()
        nodes[int(words[0])] = tuple(map(float, words[1:4]))
    start = lines.index("$Elements")
    elements = []
    for line in lines[start + 2: start + 2 + int(lines[start + 1])]:
        words = list(map(int, line.split()))
        elements.append((words[1], tuple(words[3 + words[2]:])))
    return nodes, elements


def write_loaded(path, dimension, target):
    """The cells of a mesh, with groups at both ends of its longest axis; their number and that axis."""
    nodes, elements = read_mesh(path)
    cells = [element for element in elements if DIMENSIONS.get(element[0], dimension) == dimension]
    used = {node for _, corners in cells for node in corners}
    if not used:
        return 0, 0
    lower = [min(nodes[node][d] for node in used) for d in range(3)]
    upper = [max(nodes[node][d] for node in used) for d in range(3)]
    axis = max(range(dimension), key=lambda d: upper[d] - lower[d])
    length = upper[axis] - lower[axis]
    sides = collections.defaultdict(list)
    for kind, corners in cells:
        for side in SIDES.get(kind, []):
            face = tuple(corners[k] for k in side)
            sides[tuple(sorted(face))].append(face)
    written = []
    for faces in sides.values():
        if len(faces) == 1:
            place = sum(nodes[node][axis] for node in faces[0]) / len(faces[0])
            group = 1 if place < lower[axis] + 0.1 * length else 2 if place > upper[axis] - 0.1 * length else 0
            if group:
                written.append(f"{1 if dimension == 2 else 3} 2 {group} {group} " + " ".join(map(str, faces[0])))
    written += [f"{kind} 2 3 3 " + " ".join(map(str, corners)) for kind, corners in cells]
    text = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "3", f'{dimension - 1} 1 "held"',
            f'{dimension - 1} 2 "pulled"', f'{dimension} 3 "body"', "$EndPhysicalNames", "$Nodes", str(len(used))]
    text += [f"{node} " + " ".join(map(repr, nodes[node])) for node in sorted(used)] + ["$EndNodes", "$Elements"]
    text += [str(len(written))] + [f"{k + 1} {element}" for k, element in enumerate(written)] + ["$EndElements", ""]
    target.write_text("\n".join(text), encoding="utf-8")
    return len(cells), axis


def run_part(options, name, dimension, factor):
    """A row of the table."""
    with tempfile.TemporaryDirectory(prefix="perideal-demo-") as folder_name:
        folder = Path(folder_name)
        path, problem = mesh_part(name, dimension, factor, folder)
        if path is None and dimension == 3:
            path, problem = mesh_part(name, dimension, factor, folder, recombines=False)
        if path is None:
            return [name, dimension, "", "no mesh", "", problem]
        n_cells, axis = write_loaded(path, dimension, folder / "loaded.msh")
        if n_cells == 0 and dimension == 3:
            # tetrahedra, which subdivision makes hexahedra of, do not grow on quadrilaterals
            path.unlink()
            path, problem = mesh_part(name, dimension, factor, folder, recombines=False)
            n_cells, axis = write_loaded(path, dimension, folder / "loaded.msh") if path else (0, 0)
        if n_cells == 0:
            return [name, dimension, 0, "no mesh", "", "Gmsh made no cells"]
        third = "    set u_z = 0\n" if dimension == 3 else ""
        (folder / "part.prm").write_text(SCENE.format(dimension=dimension, third=third, axis="xyz"[axis]), encoding="utf-8")
        status, output = runs.execute([*runs.launcher(options), options.program, "part.prm"], timeout=options.limit,
                                      directory=folder)
    lines = [line.strip() for line in output.splitlines()]
    if status == 0:
        iterations = next((line.split()[1] for line in lines if line.startswith("solved ")), "")
        moved = next((line for line in lines if line.startswith("moved ")), "")
        return [name, dimension, n_cells, "solved", iterations, " ".join(moved.split())]
    message = " ".join(line.removeprefix("perideal: ") for line in lines if line.startswith(("perideal: ", "advice:")))
    good = status == 1 and "input error:" in message and "advice:" in message
    if status is None:
        message = f"did not end within {options.limit} s"
    return [name, dimension, n_cells, "refused" if good else "WRONG", "", message or f"exit status {status}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    runs.add_arguments(parser, repeat=None)
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=list(PARTS), metavar="NAME", help="default: all")
    parser.add_argument("--limit", type=float, default=300, help="seconds a run; default: %(default)s")
    parser.add_argument("--output", type=Path, default=Path(__file__).resolve().parent / "results")
    options = parser.parse_args()
    rows = []
    for name in options.parts:
        rows.append(run_part(options, name, *PARTS[name]))
        print("  ".join(map(str, rows[-1])), flush=True)
    options.output.mkdir(parents=True, exist_ok=True)
    runs.write_csv(options.output / "gmsh_demos.csv", ["part", "dimension", "cells", "outcome", "iterations", "says"], rows)
    n_met = sum(row[3] in ("solved", "refused") for row in rows)
    n_wrong = sum(row[3] == "WRONG" for row in rows)
    print(f"{len(rows)} parts: {n_met} solved or refused with a remedy, {n_wrong} wrong")
    return 1 if n_wrong or not n_met else 0


if __name__ == "__main__":
    sys.exit(main())
