#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Holds stress intensity factors of the specimens of this folder against handbooks and prints a table.

    run.py --program build/perideal

Of each specimen K_I on 40 and 80 cells across its width, by the energy and the consistent form of extended ordinary and by
ordinary, over the handbook's, with the precrack's tip as drawn, at a corner of cells, and a hair short of it: bonds through
a tip are cut, and in the second case those through the corner are whole. Nothing is fitted.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent

# By specimen: K_I of the handbook [Pa m^0.5], the two meshes, and the crack a hair short of the corner.
SPECIMENS = {
    "edge_crack": (1.115792e6, ("40, 80", "80, 160"), "0, 0.1; 0.049999, 0.1"),
    "centre_crack": (3.324416e5, ("40, 80", "80, 160"), "0.025001, 0.1; 0.074999, 0.1"),
    "compact_tension": (3.415326e6, ("50, 48", "100, 96"), "-0.02, 0; 0.039999, 0"),
    "double_cantilever": (1.144647e6, ("140, 40", "280, 80"), "0, 0; 0.079999, 0"),
}
MODELS = {"energy form": [], "ordinary": ["Material/Model=ordinary"], "consistent form": ["Material/Form=consistent"]}


def intensity(program, specimen, settings):
    """K_I of the first crack of a specimen."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, str(HERE / f"{specimen}.prm")]
        for setting in [*settings, f"Output directory={folder}"]:
            command += ["--set", setting]
        result = subprocess.run(command, capture_output=True, text=True, timeout=600)
        if result.returncode != 0:
            sys.exit(f"{' '.join(command)}\n{result.stdout}{result.stderr}")
        cracks = json.loads((Path(folder) / "summary.json").read_text(encoding="utf-8"))["cracks"]
        return next(iter(cracks.values()))["K_I"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True)
    program = str(Path(parser.parse_args().program).resolve())
    print("| specimen | model | K_I of the handbook | 40 cells | 80 cells | short of the corner: 40 | 80 |")
    print("|---|---|---|---|---|---|---|")
    for specimen, (handbook, meshes, short) in SPECIMENS.items():
        for model, of_model in MODELS.items():
            row = []
            for precrack in ([], [f"Precracks/crack/Points={short}"]):
                for cells in meshes:
                    settings = [*of_model, f"Mesh/Cells={cells}", *precrack]
                    row.append(f"{100 * (intensity(program, specimen, settings) / handbook - 1):+.1f} %")
            name = specimen.replace("_", " ")
            print(f"| {name} | {model} | {handbook:.4e} | {' | '.join(row)} |", flush=True)


if __name__ == "__main__":
    main()
