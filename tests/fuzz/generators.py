# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wrong inputs by chance: each generator makes files and a command line from a random number generator."""

import json

STATIC = """set Dimension = 2
set Output directory = output
subsection Mesh
  set Generator = box
  set Cells = 4, 3
end
subsection Nodes
  set Horizon factor = 3.01
end
subsection Material
  set Young modulus = 70e9
  set Poisson ratio = 0.3
  set Density = 2700
end
subsection Boundary conditions
  subsection a
    set Boundary = left
    set u_x = 0
    set u_y = 0
  end
  subsection b
    set Boundary = right
    set t_x = 1e6*t
  end
end
"""
# Two lines more, then three dimensions, then meshes from files.
SOLVERS = {
    "static": "subsection Solver\n  set Name = static\nend\n",
    "quasi static": "subsection Solver\n  set Name = quasi static\n  set Load steps = 3\nend\n"
                    "subsection Material\n  set Form = energy\n  set Critical stretch = 1e-3\nend\n",
    "dynamic relaxation": "subsection Solver\n  set Name = dynamic relaxation\n  set Load steps = 3\n  set Tolerance = 1e-6\nend\n"
                          "subsection Material\n  set Form = energy\nend\n",
    "dynamics": "subsection Solver\n  set Name = dynamics\n  set End time = 1e-3\nend\n"
                "subsection Material\n  set Form = energy\n  set Critical stretch = 1e-5\nend\n"
                "subsection Output\n  set History steps = 1\nend\n",
}
BOX = STATIC.replace("Dimension = 2", "Dimension = 3").replace("Cells = 4, 3", "Cells = 3, 2, 2").replace(
    "set u_y = 0", "set u_y = 0\n    set u_z = 0").replace("3.01", "2.01")
FROM_FILE = STATIC.replace("set Generator = box\n  set Cells = 4, 3", "set File = part.msh")
SCENES = [STATIC + text for text in SOLVERS.values()] + [BOX, FROM_FILE]
# What checkpoints are made of, and how often they are written.
RESUMED = [STATIC + SOLVERS[name] for name in ("quasi static", "dynamic relaxation", "dynamics")]

HOSTILE = ["", " ", "nan", "-nan", "inf", "-inf", "1e999", "-1", "0", "-0", "1e300", "1e-300", "1,5", "1;2", "0x10", "1e", "1 2 3",
           "2147483648", "-2147483649", "99999999999999999999", "1.5", "three", "\u00e9\u4e2d", "%s%n%d", "a" * 300, "$(touch x)",
           "`touch x`", "'\"", "\\", "/", ".", "../nothing", "/dev/null", "case.prm", "#", "|", "*", "=", "x y", "true", "yes",
           "left", "left, right", "left,left", ",", ", ,", "0, 0", "0, 0; 1, 1", "0, 0, 0; 1, 1, 1", "1e6", "t", "x", "z", "sin(x",
           "sqrt(-1)", "1/0", "1/x", "1/(t-1)", "log(t-0.5)", "x=1", "x^y^t", "if(x>0,1", "rand()", "u_x", "t_x", "_pi", "pi*x",
           "displacement", "displacement,displacement", "box", "hole", "ANY NAME", "set", "end", "subsection b", "-x.geo", "part.msh",
           "nothing.msh", "none.geo", "0.5, 0.5", "0, 1", "1, 0", "1e-9, 1e-9", "-1, -1", "0.1, 0.2, 0.3, 0.4, 0.5"]
# Counts that only take long.
COUNTS = ["-1", "0", "1", "2", "3", "1.5", "nan", "", "1e300", "2147483648", "-2147483649", "99999999999999999999", "two", "0x2", "1 2"]
# A run that takes very many steps is what was asked for.
LONG = ["Solver/Time step", "Solver/End time", "Solver/Time step safety", "Mesh/Grading"]

SQUARE = (3, 3)


def square(version):
    """The lines of a mesh of a unit square in Gmsh's format 2.2 or 4.1."""
    nx, ny = SQUARE
    node = {(i, j): 1 + i + j * (nx + 1) for j in range(ny + 1) for i in range(nx + 1)}
    names = ["$PhysicalNames", "5", '1 1 "left"', '1 2 "right"', '1 3 "bottom"', '1 4 "top"', '2 5 "plate"', "$EndPhysicalNames"]
    sides = [(1, [(node[0, j], node[0, j + 1]) for j in range(ny)]), (2, [(node[nx, j], node[nx, j + 1]) for j in range(ny)]),
             (3, [(node[i, 0], node[i + 1, 0]) for i in range(nx)]), (4, [(node[i, ny], node[i + 1, ny]) for i in range(nx)])]
    cells = [(node[i, j], node[i + 1, j], node[i + 1, j + 1], node[i, j + 1]) for j in range(ny) for i in range(nx)]
    places = [(f"{i / nx:.16g}", f"{j / ny:.16g}") for (i, j) in node]
    lines = ["$MeshFormat", "2.2 0 8" if version == "2.2" else "4.1 0 8", "$EndMeshFormat", *names]
    if version == "2.2":
        lines += ["$Nodes", str(len(places)), *[f"{k + 1} {x} {y} 0" for k, (x, y) in enumerate(places)], "$EndNodes", "$Elements"]
        elements = [f"1 2 {side} {side} {a} {b}" for side, edges in sides for a, b in edges]
        elements += [f"3 2 5 1 {' '.join(map(str, cell))}" for cell in cells]
        lines += [str(len(elements)), *[f"{k + 1} {text}" for k, text in enumerate(elements)], "$EndElements"]
        return lines
    lines += ["$Entities", "0 4 1 0", *[f"{side} 0 0 0 1 1 0 1 {side} 0" for side, _ in sides], "1 0 0 0 1 1 0 1 5 4 1 2 3 4", "$EndEntities"]
    lines += ["$Nodes", f"1 {len(places)} 1 {len(places)}", f"2 1 0 {len(places)}", *[str(k + 1) for k in range(len(places))],
              *[f"{x} {y} 0" for x, y in places], "$EndNodes", "$Elements"]
    number = 2 * (nx + ny) + nx * ny
    lines += [f"5 {number} 1 {number}"]
    count = 0
    for side, edges in sides:
        lines += [f"1 {side} 1 {len(edges)}"]
        for a, b in edges:
            count += 1
            lines += [f"{count} {a} {b}"]
    lines += [f"2 1 3 {len(cells)}"]
    for cell in cells:
        count += 1
        lines += [f"{count} {' '.join(map(str, cell))}"]
    return lines + ["$EndElements"]


def parameters(listed):
    """[(path, kind, choices)] of what --parameters json lists; names that the user gives are a and b."""
    result = []
    for entry in json.loads(listed):
        path = entry["path"].replace("Boundary conditions/ANY NAME", "Boundary conditions/b")
        choices = ["true", "false"] if entry["kind"] == "boolean" else entry["choices"]
        result.append((path.replace("ANY NAME", "a").replace("ANY_NAME", "a").replace("PHYSICAL GROUP", "plate"), entry["kind"], choices))
    return result


def plain(text):
    """Files and settings of a case: a scene with its mesh."""
    return {"files": {"case.prm": text.encode(), "part.msh": "\n".join(square("2.2")).encode() + b"\n"}, "set": [], "check": False}


def hostile(random, kind, choices, path):
    """A text for a parameter of this kind."""
    if kind == "whole number" or path in ("Mesh/Cells",):
        return random.choice(COUNTS)
    if path == "Output directory":
        return random.choice(["", " ", "a" * 300, "/dev/null/x", "/proc/x", "case.prm", "x/y/z", "o p", "\u00e9"])
    if kind == "choice" and random.random() < 0.7:
        return random.choice(choices)
    return random.choice(HOSTILE)


def value(random, known):
    """A hostile value of one parameter, sometimes of two."""
    case = plain(random.choice(SCENES))
    for _ in range(random.choice((1, 1, 1, 2))):
        path, kind, choices = random.choice(known)
        text = hostile(random, kind, choices, path)
        if path in LONG and text in ("1e-300", "1e300", "inf", "1e6", "1e-9, 1e-9", "99999999999999999999", "2147483648"):
            text = "-1"
        case["set"].append(f"{path}={text}")
    case["check"] = random.random() < 0.3
    return case


def pair(random, known):
    """Two or three choices that need not go together."""
    case = plain(random.choice(SCENES))
    selections = [(path, choices) for path, _, choices in known if choices and "plate/" not in path]
    for path, choices in random.sample(selections, random.choice((2, 2, 3))):
        choice = random.choice(choices)
        case["set"].append(f"{path}={choice}")
    return case


def damaged_lines(random, lines):
    """Lines of a mesh with one to three mistakes."""
    lines = list(lines)
    for _ in range(random.choice((1, 1, 2, 3))):
        k = random.randrange(len(lines))
        how = random.randrange(8)
        words = lines[k].split(" ")
        w = random.randrange(len(words))
        if how == 0:
            del lines[k]
        elif how == 1:
            lines.insert(k, lines[k])
        elif how == 2:
            other = random.randrange(len(lines))
            lines[k], lines[other] = lines[other], lines[k]
        elif how == 3:
            words[w] = random.choice(["0", "-1", "1", "2", "99", "99999999", "1e300", "nan", "inf", "x", "", "0.5", "4294967297", "1e-300"])
        elif how == 4:
            words.insert(w, random.choice(["0", "1", "-1", "x"]))
        elif how == 5:
            del words[w]
        elif how == 6:
            other = random.randrange(len(words))
            words[w], words[other] = words[other], words[w]
        elif how == 7 and random.random() < 0.5:
            lines = lines[: max(k, 1)]
            continue
        if how in (3, 4, 5, 6) or how == 7:
            lines[min(k, len(lines) - 1)] = " ".join(words)
        if not lines:
            lines = [""]
    return lines


def mesh(random, known):
    """A damaged mesh file."""
    del known
    case = plain(FROM_FILE)
    text = ("\n".join(damaged_lines(random, square(random.choice(("2.2", "4.1"))))) + "\n").encode()
    if random.random() < 0.15:
        text = damaged_bytes(random, text)
    case["files"]["part.msh"] = text
    case["check"] = random.random() < 0.3
    return case


def damaged_bytes(random, data):
    """Bytes with a few of them flipped, lost, doubled or cut off."""
    data = bytearray(data)
    for _ in range(random.choice((1, 1, 2, 5))):
        k = random.randrange(max(len(data), 1))
        how = random.randrange(6)
        if how == 0 and data:
            data[k] ^= 1 << random.randrange(8)
        elif how == 1 and data:
            data[k] = random.randrange(256)
        elif how == 2:
            del data[k : k + random.choice((1, 2, 10, 40))]
        elif how == 3:
            data[k:k] = bytes(random.randrange(256) for _ in range(random.choice((1, 3, 20))))
        elif how == 4:
            data[k:k] = data[k : k + 60]
        elif random.random() < 0.3:
            del data[k:]
    return bytes(data)


def prm(random, known):
    """Damaged bytes of a parameter file."""
    del known
    case = plain(random.choice(SCENES))
    case["files"]["case.prm"] = damaged_bytes(random, case["files"]["case.prm"])
    case["check"] = random.random() < 0.3
    return case


def flipped(random, data):
    """A file of results with one bit flipped, or cut short."""
    data = bytearray(data)
    if random.random() < 0.85 and data:
        data[random.randrange(len(data))] ^= 1 << random.randrange(8)
        return bytes(data)
    return bytes(data[: random.randrange(len(data) + 1)])


GENERATORS = {"value": value, "pair": pair, "mesh": mesh, "prm": prm}
