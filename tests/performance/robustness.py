#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the forms stop working: error and iterations of prm/verification/robustness.prm as Poisson's
ratio, the aspect ratio, the distortion and the size differences of its cells grow.

    robustness.py --program build/perideal [--forms consistent energy]

Prints one Markdown table: relative l2 error against the exact displacement, iterations, beside those of
Q1 finite elements on the same mesh, and what --check warns about before the run.
"""

import argparse
import json
import subprocess
import tempfile
from pathlib import Path

SCENE = Path(__file__).resolve().parents[2] / "prm" / "verification" / "robustness.prm"
SHEAR_MODULUS = 1e9
# Words of the warnings of --check that belong to these studies.
WARNINGS = ("incompressible", "aspect ratio", "distorted cells", "cell sizes differ")


def field(wave):
    """Displacement and traction of a harmonic gradient with a wave number, as parameters."""
    u_x, u_y = f"1e-3*exp({wave}*x)*cos({wave}*y)", f"-1e-3*exp({wave}*x)*sin({wave}*y)"
    strain = f"2*{SHEAR_MODULUS}*{wave}e-3*exp({wave}*x)"
    return [f"Boundary conditions/held/u_x={u_x}", f"Boundary conditions/held/u_y={u_y}",
            f"Comparison/Exact u_x={u_x}", f"Comparison/Exact u_y={u_y}",
            f"Boundary conditions/top/t_x=-{strain}*sin({wave}*y)",
            f"Boundary conditions/top/t_y=-{strain}*cos({wave}*y)"]


def cases():
    """Title and parameters of each run."""
    for nu in (0.3, 0.4, 0.45, 0.49, 0.499, 0.4999):
        yield f"nu = {nu}", [f"Material/Poisson ratio={nu}", f"Material/Young modulus={2 * SHEAR_MODULUS * (1 + nu)}"]
    for ratio in (1, 2, 5, 10, 20, 50):
        yield f"aspect ratio {ratio}", [f"Mesh/Size={ratio}, 1", *field(2 / ratio)]
    for distortion in (0, 0.1, 0.2, 0.3, 0.4, 0.45):
        yield f"distortion {distortion}", [f"Mesh/Distortion={distortion}"]
    for times in (0, 2, 4, 7, 10):
        refined = ["Mesh/Refine at=right", f"Mesh/Refine times={times}"] if times > 0 else []
        yield f"sizes 1:{2**times}", ["Mesh/Cells=16, 16", *refined]


def run(program, sets, directory):
    """Figures of one run: error, iterations, Q1's, warnings; or the reason why there are none."""
    command = [program, str(SCENE), "--set", f"Output directory={directory}"]
    for name in sets:
        command += ["--set", name]
    check = subprocess.run([*command, "--check"], capture_output=True, text=True)
    warned = [line for line in check.stdout.splitlines()
              if line.startswith("warning") and any(word in line for word in WARNINGS)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        message = (done.stderr or done.stdout).strip().splitlines()
        return ["-", "-", "-", "-", f"exit {done.returncode}: {message[0] if message else ''}", bool(warned)]
    summary = json.loads((Path(directory) / "summary.json").read_text())
    return [f"{summary['errors']['exact']['l2']:.1e}", summary["solver"]["iterations"][0],
            f"{summary['errors']['fem']['own error against exact']['l2']:.1e}", summary["fem"]["iterations"][0],
            "yes" if warned else "", bool(warned)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--forms", nargs="+", default=["consistent", "energy"])
    arguments = parser.parse_args()
    print("| case | form | l2 | iterations | Q1 l2 | Q1 iterations | --check warns |\n|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as directory:
        for title, sets in cases():
            for form in arguments.forms:
                figures = run(arguments.program, [*sets, f"Material/Form={form}"], directory)
                print(f"| {title} | {form} | {' | '.join(str(figure) for figure in figures[:5])} |", flush=True)


if __name__ == "__main__":
    main()
