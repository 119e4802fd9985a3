#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks pairs of choices with the program itself: each is accepted, or refused by a rule of its table.

    run_rules.py --program build/perideal [--pairs N]

Parameters with a list of choices come from --parameters, the rules from --rules. All pairs are walked by the unit test
Rules.RefuseWhateverIsRefusedOfAllPairs; here a sample of them builds the scene too (--check).
"""

import argparse
import concurrent.futures
import itertools
import json
import os
import random
import re
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from execute import execute

ISOTROPIC = "  set Young modulus = 70e9\n  set Poisson ratio = 0.33\n"
SCENE = """
subsection Mesh
  set Generator = box
  set Cells = {cells}
  set Refinements = 1
end
subsection Material
  set Young modulus = 70e9
  set Poisson ratio = 0.33
  set Density = 2700
end
subsection Boundary conditions
  subsection clamp
    set Boundary = left
    set u_x = 0
    set u_y = 0
    {depth}
  end
  subsection pull
    set Boundary = right
    set t_x = 1e6
  end
end
"""
SCENES = {"2": SCENE.format(cells="3, 3", depth=""), "3": SCENE.format(cells="2, 2, 2", depth="set u_z = 0")}

# What a choice needs beside it, lest it be refused for a value that is missing.
NEEDED = {"Solver/Name=dynamics": ["Solver/End time=1e-5"],
          "Material/Failure criterion=maximum tensile stress": ["Material/Tensile strength=1e6"],
          "Material/Failure criterion=Mohr-Coulomb": ["Material/Tensile strength=1e6", "Material/Compressive strength=1e7"],
          "Material/Failure criterion=Drucker-Prager": ["Material/Tensile strength=1e6", "Material/Compressive strength=1e7"],
          "Material/Symmetry=cubic": ["Material/Young moduli=1e11", "Material/Poisson ratios=0.2",
                                      "Material/Shear moduli=4e10"],
          "Material/Symmetry=transversely isotropic": ["Material/Young moduli=1e11, 1e10", "Material/Poisson ratios=0.2, 0.3",
                                                       "Material/Shear moduli=4e9"],
          "Material/Symmetry=orthotropic": ["Material/Young moduli=1e11, 1e10, 1e10", "Material/Poisson ratios=0.2, 0.2, 0.3",
                                            "Material/Shear moduli=4e9, 4e9, 3e9"],
          "Material/Symmetry=anisotropic": ["Material/Stiffness=3e11, 1e11, 1e11, 0, 0, 0, 3e11, 1e11, 0, 0, 0, 3e11, 0, 0, 0, "
                                            "1e11, 0, 0, 1e11, 0, 1e11"]}
# Values that make no sense alone, and what only the built scene shows.
OTHERS = ["no use for this", "families that are not whole", "no family is whole"]


def run(program, *arguments, folder="."):
    return execute([program, *arguments], folder)


def choices(program):
    """{path: [value]} of all selections outside of sections that the user names."""
    entries = json.loads(run(program, "--parameters", "json")[1])
    return {entry["path"]: entry["choices"] for entry in entries
            if entry["choices"] and not any(name in entry["path"] for name in ("ANY NAME", "ANY_NAME", "PHYSICAL GROUP"))}


def messages(program):
    """Patterns of the messages of all rules that refuse."""
    table = run(program, "--rules")[1].split("## Refused")[1].split("## Warned of")[0]
    rows = [re.split(r"(?<!\\) \| ", line) for line in table.splitlines() if line.startswith("| `")]
    return [re.compile(re.escape(row[2].replace("\\|", "|")).replace(r"\.\.\.", ".*")) for row in rows]


def check(program, rules, settings, dimension):
    """What is wrong with a pair, as texts; and whether it was refused."""
    scene = f"set Dimension = {dimension}\n" + SCENES[dimension]
    if any(setting.startswith("Material/Symmetry=") and setting != "Material/Symmetry=isotropic" for setting in settings):
        scene = scene.replace(ISOTROPIC, "")
    with tempfile.TemporaryDirectory(prefix="perideal-rules-") as name:
        folder = Path(name)
        (folder / "case.prm").write_text(scene, encoding="utf-8")
        words = [word for setting in settings for word in ("--set", setting)]
        status, _, err = run(program, "--check", "case.prm", *words, folder=folder)
    if status == 0:
        return [], False
    if status != 1:
        return [f"exit status {status}: {err.strip()}"], False
    mistakes = re.split(r"\n\(\d+\) ", err[err.index("input error:"):])
    mistakes = mistakes[1:] if len(mistakes) > 1 else mistakes
    return [f"no rule says: {mistake.strip()}" for mistake in mistakes
            if not any(rule.search(mistake) for rule in rules) and not any(words in mistake for words in OTHERS)], True


def main():
    parser = argparse.ArgumentParser(description="checks pairs of choices")
    parser.add_argument("--program", required=True, type=os.path.abspath)
    parser.add_argument("--pairs", type=int, default=60, help="of all pairs, the same ones each time; default: %(default)s")
    parser.add_argument("--jobs", type=int, default=2, help="runs side by side; default: %(default)s")
    arguments = parser.parse_args()
    selections, rules = choices(arguments.program), messages(arguments.program)
    single = [f"{path}={value}" for path, values in selections.items() for value in values]
    pairs = [pair for pair in itertools.combinations(single, 2) if pair[0].split("=")[0] != pair[1].split("=")[0]]
    sample = random.Random(1).sample(pairs, min(arguments.pairs, len(pairs)))

    def judge(job):
        pair, dimension = job
        settings = [setting for choice in pair for setting in [choice, *NEEDED.get(choice, [])]]
        return (*job, *check(arguments.program, rules, settings, dimension))

    jobs = [(pair, "23"[number % 2]) for number, pair in enumerate(sample)]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = list(pool.map(judge, jobs))
    n_deviating = 0
    for pair, dimension, found, _ in results:
        n_deviating += bool(found)
        for text in found:
            print(f"DEVIATES  {dimension}-D, {', '.join(pair)}\n    {text}")
    n_refused = sum(result[3] for result in results)
    print(f"{len(selections)} selections, {len(rules)} rules, {len(pairs)} pairs; {len(results)} runs, {n_refused} refused, "
          f"{n_deviating} deviate")
    # A table that is not read must not make the test pass.
    return 1 if n_deviating or len(selections) < 15 or len(rules) < 40 or n_refused == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
