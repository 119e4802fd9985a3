# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plots and tables of what work_precision.py measured."""

import math
import os
import shutil
import subprocess
from pathlib import Path

from runs import PAGE, markdown_table

# Below this an error is that of the solver's tolerance, and of no interest beside others.
SMALLEST_DRAWN = 1e-11
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c564b", "#7f7f00", "#9467bd"]
# What serves which situation: what to set, and the scene and methods whose figures show it, the choice first.
CHOICES = [
    ("linear statics, isotropic", "nothing: `extended ordinary`, `consistent`, `static` are the defaults",
     "plate_with_hole", ["consistent form", "FEM Q1", "paper form, mirror", "ordinary, mirror"]),
    ("a regular mesh for it", "`Mesh/Refinements` = 1 or more of fewer cells: what the preconditioner takes from elements is "
     "then on their parents", "plate_with_hole", ["consistent form", "consistent form, without parents"]),
    ("the same in 3-D", "nothing", "block_with_hole", ["consistent form", "FEM Q1", "energy form, mirror"]),
    ("thin parts that bend", "nothing; three layers of cells are enough", "thin_cantilever",
     ["consistent form", "FEM Q1", "energy form, layer"]),
    ("CAD parts, meshed by dividing tetrahedra", "nothing", "drilled_block", ["consistent form", "FEM Q1"]),
    ("linear statics of fibres and crystals", "`Model = tensor involved`", "laminate_with_hole",
     ["consistent form", "FEM Q1", "surface cure, collar", "one point, collar"]),
    ("bonds between nodes in linear statics", "`Form = energy`, `Treatment = taylor ghosts`", "plate_with_hole",
     ["energy form, ghosts", "energy form, mirror", "energy form, layer"]),
    ("equilibria with cracks (`quasi static`), which know no ghosts", "`Form = energy`, `Treatment = layer`",
     "pdbc_1_mixed", ["energy form, layer", "energy form, balanced", "springs, printed"]),
    ("springs", "`Quadrature/Scheme = exact` or `partial volume`; several Gauss points take longer to the same",
     "graded_square", ["springs, exact", "springs, partial volume", "springs, gauss 2", "springs, one point"]),
    ("springs with free surfaces in linear statics", "that, with `Treatment = taylor ghosts`", "tension_column",
     ["springs, exact, ghosts", "springs, exact", "springs, one point"]),
    ("bonds with tensors, in motion or with cracks", "`Form = moment corrected` (the default there)",
     "tensor_manufactured_2d", ["moment corrected", "one point", "one point, exact parts"]),
    ("large strain", "`Model = correspondence`, `Form = consistent`", "hyperelastic_bar",
     ["consistent form", "FEM Q1", "correspondence, families"]),
    ("motion", "`Form = energy`, one point (the defaults there); `Form = consistent` has a third of the error on the same "
     "mesh, and about the same time to the same error", "standing_wave",
     ["energy form", "consistent form", "ordinary", "springs, exact parts", "springs"]),
]
STYLES = {"FEM Q1": 'linewidth 4 linecolor rgb "black" pointtype 5 dashtype 1',
          "FEM Q2": 'linewidth 4 linecolor rgb "#909090" pointtype 7 dashtype "_"'}
PAPER_STYLE = 'linewidth 4 linecolor rgb "red" pointtype 9 dashtype "-"'


def lines_of(rows):
    """(seconds, error) of each resolution by method, those that failed left out."""
    result = {}
    for row in rows:
        result.setdefault(row["method"], [])
        if not math.isnan(row["error"]):
            result[row["method"]].append((row["seconds"], row["error"]))
    return result


def draw(scene, rows, path):
    """Error against time, a line a method; nothing without gnuplot."""
    if shutil.which("gnuplot") is None:
        print(f"no {path.name}: gnuplot is missing")
        return
    lines = lines_of(rows)
    drawn = [method for method in scene.methods if method.drawn and lines.get(method.name)]
    script = ['set terminal pngcairo size 820,460 font "DejaVu Sans,10" background "white"', f'set output "{path}"',
              "set logscale xy", 'set format x "10^{%L}"', 'set format y "10^{%L}"',
              'set grid xtics ytics linetype 1 linewidth 0.5 linecolor rgb "#d8d8d8"',
              "set key outside right top Left reverse noenhanced samplen 2.5 spacing 1.2",
              'set xlabel "run time [s]"', 'set ylabel "relative error"']
    plots, colours = [], iter(COLOURS)
    for k, method in enumerate(drawn):
        points = "\n".join(f"{seconds} {max(error, SMALLEST_DRAWN)}" for seconds, error in lines[method.name])
        script.append(f"$method{k} << EOD\n{points}\nEOD")
        style = (STYLES[method.name] if method.name in STYLES else PAPER_STYLE if method.kind == "paper" else
                 f'linewidth 2 linecolor rgb "{next(colours)}" pointtype {6 + k % 9}')
        plots.append(f'$method{k} using 1:2 with linespoints {style} title "{method.name}"')
    script.append("plot " + ", ".join(plots))
    subprocess.run(["gnuplot"], input="\n".join(script), text=True, check=True)


def time_to(line, target):
    """Seconds to an error on a line of (seconds, error), interpolated between resolutions in logarithms, and whether
    the coarsest is better already; None: not reached, or lost again on a finer mesh."""
    above = [k for k, (_, error) in enumerate(line) if error > target]
    if not line or len(line) - 1 in above:
        return None
    if not above:
        return line[0][0], True
    (before_seconds, before), (seconds, error) = line[above[-1]:above[-1] + 2]
    share = math.log(before / target) / math.log(before / error)
    return before_seconds * (seconds / before_seconds) ** share, False


def ratio(line, base, target):
    """Time to an error over that of the base, as text: in brackets where a coarsest mesh is better already."""
    own, other = time_to(line, target), time_to(base, target)
    if own is None:
        return "not reached"
    if other is None:
        return f"{number(own[0])} s, base not"
    value = number(own[0] / other[0])
    return f"({value})" if own[1] or other[1] else value


def number(value):
    return f"{value:.0f}" if value >= 99.5 else f"{value:.3g}" if value >= 9.95 else f"{value:.2g}"


def scene_section(name, scene, rows, output):
    """Plot and table of one scene as Markdown."""
    lines = lines_of(rows)
    base = lines.get(scene.base, [])
    table = []
    for method in scene.methods:
        line = lines.get(method.name)
        if line is None:
            continue
        finest = f"{line[-1][1]:.1e}" if line else "-"
        table.append([method.name, *(ratio(line, base, target) for target in scene.targets), finest])
    headings = ["method", *(f"to {target:g}" for target in scene.targets), "error on its finest mesh"]
    return "\n\n".join([f"### {name}", scene.about,
                        f"![Run time against error, {name}]({picture(name, output)})",
                        markdown_table(headings, table), remarks(rows)]).strip()


def picture(name, output):
    """The plot's path as the page links it."""
    return Path(os.path.relpath(output / f"work_precision_{name}.png", PAGE.parent)).as_posix()


def remarks(rows):
    """What stopped."""
    stopped = {}
    for row in rows:
        if row["remark"]:
            stopped.setdefault((row["method"], row["remark"]), []).append(row["cells"])
    return "\n".join(f"- {method} at {', '.join(cells)} cells stopped: {remark}"
                     for (method, remark), cells in stopped.items())


def evidence(rows, methods):
    """Errors of methods at the finest resolution they share, times over that of the first."""
    found = {method: {row["cells"]: row for row in rows if row["method"] == method and not math.isnan(row["error"])}
             for method in methods}
    shared = [cells for cells in found[methods[0]] if all(cells in found[method] for method in methods)]
    if not shared:
        return "-"
    points = [found[method][shared[-1]] for method in methods]
    first = points[0]
    others = [f"{point['method']} {point['error']:.1e}, time {number(point['seconds'] / first['seconds'])}"
              for point in points[1:]]
    return f"{shared[-1]} cells: " + "; ".join([f"{first['method']} {first['error']:.1e}", *others])


def choices(tables):
    """What to choose when, as a Markdown table."""
    return markdown_table(["situation", "set", "scene", "figures"],
                          [[situation, choice, name, evidence(tables[name], methods)]
                           for situation, choice, name, methods in CHOICES if name in tables])


def asked_of_consistent(tables):
    """Time of the consistent form to 1e-3 over that of Q1 elements."""
    rows = []
    for name in ("plate_with_hole", "block_with_hole"):
        if name not in tables:
            continue
        lines = lines_of(tables[name])
        own, fem = (time_to(lines.get(method, []), 1e-3) for method in ("consistent form", "FEM Q1"))
        if own is None or fem is None:
            rows.append([f"{name}: consistent form to 1e-3 over FEM Q1", "not reached", "<= 2", "no"])
            continue
        value = own[0] / fem[0]
        rows.append([f"{name}: consistent form to 1e-3 over FEM Q1", number(value), "<= 2", met(value <= 2)])
    return rows


def asked_of_paper(scenes, tables):
    """Time of the paper's way to its smallest error over that of the consistent form to the same."""
    rows = []
    for name, table in tables.items():
        paper = [method.name for method in scenes[name].methods if method.kind == "paper"]
        lines = lines_of(table)
        if not paper or not lines.get(paper[0]) or not lines.get("consistent form"):
            continue
        seconds, error = min(lines[paper[0]], key=lambda point: point[1])
        own = time_to(lines["consistent form"], error)
        what = f"{name}: paper's way to {error:.1e} over consistent form"
        if own is None:
            rows.append([what, "not reached", ">= 100", "no"])
            continue
        value = seconds / own[0]
        rows.append([what, ("at least " if own[1] else "") + number(value), ">= 100", met(value >= 100)])
    return rows


def met(condition):
    return "yes" if condition else "no"


def section(scenes, tables, output):
    """The whole section as Markdown."""
    asked = asked_of_consistent(tables) + asked_of_paper(scenes, tables)
    parts = [markdown_table(["what", "ratio of times", "asked", "met"], asked)] if asked else []
    parts += [scene_section(name, scenes[name], rows, output) for name, rows in tables.items()]
    return "\n\n".join(parts)
