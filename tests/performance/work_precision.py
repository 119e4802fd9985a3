#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run time against error: every model, quadrature scheme and boundary treatment that suits a scene, finite elements of
the same mesh beside them, and the papers' own way (one point, the published form, dynamic relaxation).

    tests/performance/work_precision.py --program build/perideal [--scenes NAME...] [--quick] [--repeat N] [--ranks N]
                                        [--output DIRECTORY] [--no-page]

Leaves work_precision_SCENE.csv with all figures and work_precision_SCENE.png (by gnuplot) in the output directory, and
writes the sections choices and work_precision of tests/performance/README.md from the .csv files there, those of
earlier calls too. Exits with 1 where a run stopped without a solution.

Seconds are those of the method alone: neighbours, set-up and solve of peridynamics; assembly, multigrid and solve of
finite elements. Errors come from a run with what they are against, seconds and memory from runs without, medians of
--repeat.
"""

import argparse
import csv
import math
import statistics
import sys
import tempfile
from pathlib import Path

from runs import PAGE, add_arguments, replace_section, run, sized_mesh, write_csv
from work_precision_page import choices, draw, section
from work_precision_scenes import SCENES, TAKES_REFERENCE

# error is the relative l2 error, other_error the largest, unless the scene has others.
COLUMNS = ["method", "kind", "cells", "nodes", "error", "other_error", "seconds", "neighbours", "setup", "solve",
           "iterations", "operator_bytes", "memory_bytes", "remark"]


def is_true(condition):
    return str(condition).lower()


class Runs:
    """The runs of one scene, each error found once."""

    def __init__(self, options, scene):
        self.options, self.scene, self.compared, self.truth = options, scene, {}, {}
        self.meshes = tempfile.TemporaryDirectory()
        if scene.finest:
            self.truth = run(options, scene.file, [*scene.common, *scene.finest]).summary

    def run(self, resolution, method, fem, truth):
        """One run; fem, truth: whether finite elements and the reference are solved too."""
        settings = [*self.scene.common, *resolution.settings]
        if resolution.sized_mesh:
            settings.append(f"Mesh/File={sized_mesh(self.meshes.name, *resolution.sized_mesh)}")
        if self.scene.carrier is not None:
            settings.append(f"Comparison/FEM={is_true(fem)}")
        if self.scene.truth == "reference":
            asked = truth or TAKES_REFERENCE in method.settings
            reference = resolution.truth if method.accurate else resolution.rough or resolution.truth
            settings += [f"Comparison/Reference={is_true(asked)}", *(reference if asked else ())]
        result = run(self.options, self.scene.file, [*settings, *method.settings], may_fail=True)
        if result.status not in (0, 2):
            sys.exit(f"exit status {result.status} of {self.scene.file} with {settings}\n{result.output}")
        return result

    def measure(self, resolution, method):
        """A row of figures by name."""
        is_fem = method.kind == "fem"
        carries = is_fem or method.settings == self.scene.carrier
        key = (resolution.name, method.settings)
        if key not in self.compared:
            self.compared[key] = self.run(resolution, method, carries, True)
        compared = self.compared[key]
        row = dict.fromkeys(COLUMNS, "")
        row.update(method=method.name, kind=method.kind, cells=resolution.name)
        alone = is_fem or not (carries or self.scene.truth == "reference")
        timed = [compared] if alone else []
        while compared.status == 0 and len(timed) < self.options.repeat:
            timed.append(self.run(resolution, method, is_fem, False))
        failed = [each for each in [compared, *timed] if each.status != 0]
        if failed:
            row["remark"] = failed[0].message()
            return row
        row["error"], row["other_error"] = self.scene.errors(compared.summary, is_fem, self.scene.truth, self.truth)
        rows = [(figures_of_fem if is_fem else figures)(each.summary) for each in timed]
        for name in rows[0]:
            row[name] = statistics.median(each[name] for each in rows)
        return row


def figures(summary):
    """Of peridynamics; the peak of memory is that of a run that solves nothing else, or not told."""
    phases = {name: summary["seconds"].get(name, 0.) for name in ("neighbours", "setup", "solve")}
    solver = summary["solver"]
    iterations = sum(solver.get("linear_iterations") or solver.get("iterations") or [solver["steps"]])
    return {"nodes": summary["nodes"], "seconds": sum(phases.values()), **phases, "iterations": iterations,
            "operator_bytes": summary["operator_bytes"],
            "memory_bytes": math.nan if "reference" in summary["seconds"] else summary["memory_bytes"]}


def figures_of_fem(summary):
    """Of finite elements; what they hold in memory is not told apart from the rest of the run."""
    seconds, fem = summary["seconds"], summary["fem"]
    solve = seconds.get("fem: solve", seconds["fem"])
    return {"nodes": summary["nodes"], "seconds": seconds["fem"], "setup": seconds["fem"] - solve, "solve": solve,
            "iterations": sum(fem.get("linear_iterations") or fem["iterations"])}


def measure_scene(options, scene):
    """Rows of all methods at all resolutions."""
    runs, rows = Runs(options, scene), []
    resolutions = scene.resolutions[:2] if options.quick else scene.resolutions
    for method in scene.methods:
        if options.quick and not method.drawn:
            continue
        for resolution in resolutions[:method.coarse]:
            row = runs.measure(resolution, method)
            rows.append(row)
            print("  ".join(f"{text(row[name]):>10}" for name in ("cells", "error", "seconds", "iterations")),
                  f" {method.name}  {row['remark']}", flush=True)
    return rows


def text(figure):
    if not isinstance(figure, float):
        return str(figure)
    if math.isnan(figure):
        return ""
    return str(int(figure)) if figure.is_integer() and abs(figure) >= 1 else f"{figure:.4g}"


def read_rows(path):
    """Rows of a .csv file, their figures as numbers."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        for name in ("error", "seconds", "nodes"):
            row[name] = float(row[name]) if row[name] else math.nan
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_arguments(parser, repeat=1)
    parser.add_argument("--scenes", nargs="+", choices=SCENES, default=list(SCENES), metavar="NAME",
                        help="any of " + ", ".join(SCENES))
    parser.add_argument("--quick", action="store_true", help="the two coarsest resolutions of the methods in the plots")
    parser.add_argument("--output", type=lambda path: Path(path).resolve(), default=PAGE.parent / "results")
    parser.add_argument("--no-page", action="store_true", help="leave README.md as it is")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    for name in options.scenes:
        print(f"\n{name}\n" + "  ".join(f"{head:>10}" for head in ("cells", "error", "s", "iterations")), flush=True)
        rows = measure_scene(options, SCENES[name])
        write_csv(options.output / f"work_precision_{name}.csv", COLUMNS,
                  [[text(row[column]) for column in COLUMNS] for row in rows])
    tables = {name: read_rows(path) for name in SCENES
              if (path := options.output / f"work_precision_{name}.csv").exists()}
    for name in options.scenes:
        draw(SCENES[name], tables[name], options.output / f"work_precision_{name}.png")
    if not options.no_page:
        replace_section("choices", choices(tables))
        replace_section("work_precision", section(SCENES, tables, options.output))
    stopped = [f"{name}, {row['method']}, {row['cells']} cells: {row['remark']}"
               for name in options.scenes for row in tables[name] if row["remark"]]
    if stopped:
        sys.exit("\n".join(["stopped:", *stopped]))


if __name__ == "__main__":
    main()
