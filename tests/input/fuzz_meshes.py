#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Damages Gmsh files and shows them to the program: each must be read or refused in words.

    fuzz_meshes.py --program build/perideal [--cases 400] [--seed 1] [--only NUMBER] [--keep FOLDER]

Every case takes a good mesh (2-D and 3-D, formats 2.2 and 4.1), damages it once or twice (a line left out, doubled or
moved, fields swapped, numbers changed, negative or huge, foreign bytes, the file cut off) and runs --check on it. Wrong
are: a signal, no end within the time, another status than 0 or 1, and words that are not ours.
"""

import argparse
import concurrent.futures
import random
import re
import shutil
import sys
import tempfile
from pathlib import Path

from run_bad_input import HERE, execute

PLANE = """set Dimension = 2
set Output directory = output
subsection Mesh
  set File = part.msh
end
subsection Material
  set Young modulus = 70e9
  set Poisson ratio = 0.3
end
subsection Boundary conditions
  subsection pull
    set Boundary = 0, 1, left, right
    set u_x = 0
    set u_y = 0
  end
end
"""
SQUARE_41 = """$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
1 7 "left"
1 8 "right"
2 9 "body"
$EndPhysicalNames
$Entities
2 2 1 0
1 0 0 0 0
2 1 0 0 0
1 0 0 0 0 1 0 1 7 2 1 -2
2 2 0 0 2 1 0 1 8 2 1 -2
1 0 0 0 2 1 0 1 9 2 1 2
$EndEntities
$Nodes
2 9 1 9
1 1 0 3
1
4
7
0 0 0
0 1 0
0 2 0
2 1 0 6
2
3
5
6
8
9
1 0 0
2 0 0
1 1 0
2 1 0
1 2 0
2 2 0
$EndNodes
$Elements
3 8 1 8
1 1 1 2
1 1 4
2 4 7
1 2 1 2
3 3 6
4 6 9
2 1 3 4
5 1 2 5 4
6 2 3 6 5
7 4 5 8 7
8 5 6 9 8
$EndElements
"""
NUMBERS = ["0", "-1", "1", "7", "2147483647", "2147483648", "4294967295", "18446744073709551615", "99999999999999999999",
           "1e308", "-1e308", "1e-320", "nan", "inf", "0x10", "1,5", "", "a", "1e", "\u00e9"]
WORDS_OF_OTHERS = re.compile(r"dealii|deal\.II|p4est|Exc[A-Z]|terminate called|Assertion|std::|MPI_|HDF5|internal error")
OWN_LINE = re.compile(r"^(perideal: |\(\d+\) |  [a-z ]+:  *)")


def cube_22():
    nodes = [(x, y, z) for z in range(3) for y in range(3) for x in range(3)]
    number = {node: i + 1 for i, node in enumerate(nodes)}
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    cells = [[number[x + a, y + b, z + c] for a, b, c in corners]
             for z in range(2) for y in range(2) for x in range(2)]
    faces = [[number[x, y + a, z + b] for a, b in [(0, 0), (1, 0), (1, 1), (0, 1)]]
             for x in (0, 2) for y in range(2) for z in range(2)]
    elements = [f"3 2 {7 if k < 4 else 8} 1 " + " ".join(map(str, face)) for k, face in enumerate(faces)]
    elements += ["5 2 9 1 " + " ".join(map(str, cell)) for cell in cells]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "3", '2 7 "left"', '2 8 "right"', '3 9 "body"',
             "$EndPhysicalNames", "$Nodes", str(len(nodes))]
    lines += [f"{number[node]} {node[0]} {node[1]} {node[2]}" for node in nodes] + ["$EndNodes", "$Elements"]
    lines += [str(len(elements))] + [f"{k + 1} {element}" for k, element in enumerate(elements)] + ["$EndElements"]
    return "\n".join(lines) + "\n"


def change_number(lines, chance):
    k = chance.randrange(len(lines))
    words = lines[k].split(" ")
    words[chance.randrange(len(words))] = chance.choice(NUMBERS)
    lines[k] = " ".join(words)


def swap_fields(lines, chance):
    k = chance.randrange(len(lines))
    words = lines[k].split(" ")
    i, j = chance.randrange(len(words)), chance.randrange(len(words))
    words[i], words[j] = words[j], words[i]
    lines[k] = " ".join(words)


def shift_number(lines, chance):
    k = chance.randrange(len(lines))
    words = lines[k].split(" ")
    i = chance.randrange(len(words))
    if re.fullmatch("-?[0-9]+", words[i]):
        words[i] = str(int(words[i]) + chance.choice([-2, -1, 1, 2]))
    lines[k] = " ".join(words)


def leave_out(lines, chance):
    del lines[chance.randrange(len(lines))]


def double(lines, chance):
    lines.insert(chance.randrange(len(lines)), chance.choice(lines))


def move(lines, chance):
    line = lines.pop(chance.randrange(len(lines)))
    lines.insert(chance.randrange(len(lines) + 1), line)


def foreign_byte(lines, chance):
    k = chance.randrange(len(lines))
    i = chance.randrange(len(lines[k]) + 1)
    lines[k] = lines[k][:i] + chance.choice("\0\x1b\xff\t\r\"$#") + lines[k][i:]


def cut_off(lines, chance):
    text = "\n".join(lines)
    lines[:] = text[: chance.randrange(len(text))].split("\n")


def section_twice(lines, chance):
    starts = [k for k, line in enumerate(lines) if line.startswith("$") and not line.startswith("$End")]
    if starts:
        start = chance.choice(starts)
        end = next((k for k in range(start, len(lines)) if lines[k].startswith("$End")), len(lines) - 1)
        place = chance.choice(starts + [len(lines)])
        lines[place:place] = lines[start:end + 1]


DAMAGES = [change_number, change_number, swap_fields, shift_number, shift_number, leave_out, double, move, foreign_byte,
           cut_off, section_twice]


def damaged(case, seed):
    """The scene and the text of the mesh."""
    chance = random.Random(f"{seed}-{case}")
    meshes = [(2, (HERE / "square.msh").read_text(encoding="utf-8")), (2, SQUARE_41), (3, cube_22())]
    dimension, text = meshes[case % len(meshes)]
    lines = text.rstrip("\n").split("\n")
    # the first cases cut the files off at every fiftieth
    if case < 50 * len(meshes) and case % 5 == 0:
        lines = text[: len(text) * (case // len(meshes)) // 50].split("\n")
    else:
        for _ in range(chance.choice([1, 1, 2])):
            if lines:
                chance.choice(DAMAGES)(lines, chance)
    scene = PLANE.replace("Dimension = 2", f"Dimension = {dimension}")
    if dimension == 3:
        scene = scene.replace("0, 1, left", "0, left").replace("set u_y = 0", "set u_y = 0\n    set u_z = 0")
    return scene, "\n".join(lines) + "\n"


def run_case(case, arguments):
    with tempfile.TemporaryDirectory(prefix="perideal-fuzz-") as name:
        folder = Path(name)
        scene, mesh = damaged(case, arguments.seed)
        (folder / "case.prm").write_text(scene, encoding="utf-8")
        (folder / "part.msh").write_text(mesh, encoding="latin-1", newline="")
        status, out, err = execute([arguments.program, "--check", "case.prm"], folder, arguments.timeout)
        found = []
        if status is None:
            found.append(f"did not end within {arguments.timeout:g} s")
        elif status not in (0, 1):
            found.append(f"exit status {status}")
        found += [f"foreign words: {line}" for line in (out + err).splitlines() if WORDS_OF_OTHERS.search(line)]
        if status == 1:
            found += [f"foreign line: {line!r}" for line in err.splitlines() if not OWN_LINE.match(line)]
        if any(ord(letter) < 32 and letter != "\n" for letter in err):
            found.append("control characters")
        if found and arguments.keep:
            shutil.copytree(folder, Path(arguments.keep) / str(case), dirs_exist_ok=True)
    return case, status, found, err


def main():
    parser = argparse.ArgumentParser(description="shows damaged meshes to the program")
    parser.add_argument("--program", required=True, type=lambda path: str(Path(path).resolve()))
    parser.add_argument("--cases", type=int, default=400, help="default: %(default)s")
    parser.add_argument("--seed", type=int, default=1, help="default: %(default)s")
    parser.add_argument("--only", type=int, help="number of the one case to run")
    parser.add_argument("--keep", help="folder for the cases that went wrong")
    parser.add_argument("--timeout", type=float, default=60, help="seconds a run; default: %(default)s")
    parser.add_argument("--jobs", type=int, default=2, help="runs side by side; default: %(default)s")
    arguments = parser.parse_args()
    cases = range(arguments.cases) if arguments.only is None else [arguments.only]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = list(pool.map(lambda case: run_case(case, arguments), cases))
    n_wrong = 0
    for case, status, found, err in results:
        n_wrong += bool(found)
        if found or arguments.only is not None:
            print(f"case {case}, exit status {status}")
            print("".join(f"    {line}\n" for line in found + err.splitlines()), end="")
    n_read = sum(status == 0 for _, status, _, _ in results)
    print(f"{len(results)} damaged meshes: {n_read} could be read, {len(results) - n_read} could not, {n_wrong} went wrong")
    return 1 if n_wrong or not results else 0


if __name__ == "__main__":
    sys.exit(main())
