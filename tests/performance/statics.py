#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solves the plate with a hole at several sizes and prints accuracy, time and memory.

    statics.py --program build/perideal [--ranks N] [--repeat N] [--sizes 1920 7680 ...]
               [--variants ordinary paper energy consistent] [--treatments mirror "face value"] [--reference REFINEMENTS]
               [--set "Section/Name=value"]...

Every run also solves with Q1 finite elements on the same mesh; "PD/FEM" are ratios of times of that one run:
"total" is (neighbours + setup + solve) over all of the finite elements, "solve" one linear solve over the other.
Figures are medians of --repeat runs. "l2 error" and its order in the cell size need --reference (or the
displacement treatment "reference"); without, runs are shorter.
"""

import argparse
import math

from runs import add_arguments, medians

SCENE = "prm/verification/plate_with_hole_convergence.prm"
# Cells of the whole plate: those around and across each of the eight blocks.
SIZES = {1920: "15, 16", 7680: "30, 32", 30720: "60, 64", 122880: "120, 128", 491520: "240, 256"}
VARIANTS = {
    "ordinary": ["Material/Model=ordinary"],
    "paper": ["Material/Model=extended ordinary", "Material/Form=paper"],
    "energy": ["Material/Model=extended ordinary", "Material/Form=energy"],
    "consistent": ["Material/Form=consistent", "Nodes/Influence function=automatic"],
}
TREATMENTS = ["layer", "reference", "mirror", "face value"]
COLUMNS = [  # heading, key of figures(), format
    ("cells", "cells", "{:,.0f}"), ("variant", "variant", "{}"), ("treatment", "treatment", "{}"),
    ("iterations", "iterations", "{:.0f}"), ("l2 error", "l2", "{:.2e}"), ("order", "order", "{:.2f}"),
    ("FEM l2 error", "fem l2", "{:.2e}"),
    ("families s", "neighbours", "{:.3f}"), ("weights s", "weights", "{:.3f}"),
    ("preconditioner s", "preconditioner", "{:.3f}"), ("solve s", "solve", "{:.3f}"),
    ("PD/FEM total", "total ratio", "{:.2f}"), ("PD/FEM solve", "solve ratio", "{:.2f}"),
    ("bytes a node", "bytes", "{:.0f}"),
]


def figures(summary):
    """The figures of one run; times in seconds."""
    seconds = summary["seconds"]
    errors = summary["errors"]
    perideal = seconds["neighbours"] + seconds["setup"] + seconds["solve"]
    return {
        "cells": summary["mesh"]["cells"],
        "iterations": summary["solver"]["iterations"][0],
        "l2": errors.get("reference", {}).get("l2", math.nan),
        "fem l2": errors["fem"].get("own error against reference", {}).get("l2", math.nan),
        "neighbours": seconds["neighbours"],
        "weights": seconds["setup: weights"],
        "preconditioner": seconds["setup: preconditioner"],
        "solve": seconds["solve"],
        "total ratio": perideal / seconds["fem"],
        "solve ratio": seconds["solve"] / seconds["fem: solve"],
        "bytes": summary["operator_bytes"] / summary["nodes"],
    }


def measure(arguments, size, variant, treatment):
    """Medians of the figures of repeated runs of one case."""
    settings = [f"Mesh/Cells={SIZES[size]}", *VARIANTS[variant],
                f"Boundary conditions/Displacement treatment={treatment}"]
    with_reference = arguments.reference is not None or treatment == "reference"
    settings.append(f"Comparison/Reference={str(with_reference).lower()}")
    if arguments.reference is not None:
        settings.append(f"Comparison/Reference refinements={arguments.reference}")
    return medians(arguments, figures, SCENE, [*settings, *arguments.set])


def order(coarse, fine):
    """Observed order of the error in the cell size."""
    if coarse is None:
        return math.nan
    return math.log(coarse["l2"] / fine["l2"]) / math.log(math.sqrt(fine["cells"] / coarse["cells"]))


def print_row(cells):
    """One line of a markdown table that is also easy to read as it is."""
    print("| " + " | ".join(f"{cell:>{len(heading)}}" for cell, (heading, _, _) in zip(cells, COLUMNS)) + " |",
          flush=True)


def text(figure, form):
    return "-" if isinstance(figure, float) and math.isnan(figure) else form.format(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_arguments(parser, repeat=1)
    parser.add_argument("--sizes", type=int, nargs="+", default=[1920, 7680, 30720], choices=SIZES)
    parser.add_argument("--variants", nargs="+", default=list(VARIANTS), choices=VARIANTS)
    parser.add_argument("--treatments", nargs="+", default=["mirror", "face value"], choices=TREATMENTS)
    parser.add_argument("--reference", type=int, help="refinements of the mesh for the reference")
    parser.add_argument("--set", action="append", default=[], help="as of perideal")
    arguments = parser.parse_args()

    print_row([heading for heading, _, _ in COLUMNS])
    print("|" + "|".join("-" * (len(heading) + 1) + ":" for heading, _, _ in COLUMNS) + "|")
    for treatment in arguments.treatments:
        for variant in arguments.variants:
            # Mirrored nodes have no faces; faces have values in the consistent form only.
            if (variant, treatment) == ("consistent", "mirror") or (variant != "consistent" and treatment == "face value"):
                continue
            previous = None
            for size in sorted(arguments.sizes):
                row = measure(arguments, size, variant, treatment)
                row.update(variant=variant, treatment=treatment, order=order(previous, row))
                print_row([text(row[key], form) for _, key, form in COLUMNS])
                previous = row


if __name__ == "__main__":
    main()
