#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the program's options that write nothing and checks what they print and write.

    run_command_line.py --program build/perideal --example prm/examples/plate_with_hole.prm
"""

import argparse
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from execute import execute, start


def run(program, *arguments, folder):
    return execute([program, *arguments], folder, 60)


def without_surroundings(err):
    """What is left of stderr without what MPI and hwloc say about the machine: framed notes and [bracketed] lines."""
    err = re.sub(r"^([-*])\1{19,}\n.*?^\1{20,}\n?", "", err, flags=re.DOTALL | re.MULTILINE)
    return "\n".join(line for line in err.splitlines() if line.strip() and not line.startswith("["))


def deviations(program, folder, arguments, words):
    """What differs from: exit status 0, all words on stdout, nothing on stderr, no file written; as texts."""
    before = set(folder.rglob("*"))
    status, out, err = run(program, *arguments, folder=folder)
    found = [f"exit status {status}"] if status != 0 else []
    found += [f"does not say {word!r}" for word in words if word not in out]
    found += [f"wrote {path.name}" for path in sorted(set(folder.rglob("*")) - before)]
    if without_surroundings(err):
        found.append(f"stderr: {without_surroundings(err)}")
    return found


# What a machine without /sys, or of a peculiar network, makes MPI print; then an error of the program.
FRAME = "-" * 74
SURROUNDINGS = ("[hwloc/linux] failed to find sysfs cpu topology directory, aborting linux discovery.\n"
                f"{FRAME}\nWARNING: There is no network.\n\n  Local host: here\n{FRAME}\n"
                "[here:00042] 1 more process has sent a help message\n")
COMPLAINT = "perideal: input error: no such file"


def listed_scene(program, folder):
    """The list of parameters as a scene: without the material of a named group, and its one condition filled in."""
    listing = run(program, "--parameters", "prm", folder=folder)[1]
    listing, n_groups = re.subn(r"\n  subsection PHYSICAL GROUP\n.*?\n  end\n", "\n", listing, flags=re.DOTALL)
    (folder / "listed.prm").write_text(listing, encoding="utf-8")
    (folder / "listed.csv").write_text("time,value\n0,0\n1,1\n", encoding="utf-8")
    condition = "Boundary conditions/ANY NAME/"
    load = "Point loads/ANY NAME/"
    values = ["Material/Young modulus=1e9", "Material/Poisson ratio=0.3", "Material/Density=1000", "Mesh/Generator=box", condition + "Boundary=left", condition + "u_x=0", condition + "u_y=0",
              load + "Point=1, 0.5", load + "F_x=1",
              "Comparison/ANY NAME/From=0, 0.5", "Comparison/ANY NAME/To=1, 0.5",
              "Solver/Name=dynamics", "Solver/End time=1e-4",
              "Precracks/ANY NAME/Points=0, 0.5; 0.5, 0.5", "Cracks/ANY NAME/Origin=0.5, 0.5",
              "No-fail zones/ANY NAME/Box=0, 0; 0.5, 0.5",
              "Areal force densities/ANY NAME/Point=0.5, 0.5", "Areal force densities/ANY NAME/Normal=1, 0",
              "Gauges/ANY NAME/From=0, 0.5", "Gauges/ANY NAME/To=1, 0.5",
              "Probes/ANY NAME/Point=0.5, 0.5", "Tables/ANY_NAME/File=listed.csv"]
    return n_groups, [argument for value in values for argument in ("--set", value)]


# Solids that --check warns of, with the words of the warning.
TENSORS = """
subsection Mesh
  set Generator = box
end
subsection Material
  set Model = tensor involved
  set Form = one point
  set Assumption = plane strain
end
subsection Boundary conditions
  subsection left
    set Boundary = left
    set u_x = 0
    set u_y = 0
  end
end
"""
WARNINGS = [(["Material/Young modulus=70e9", "Material/Poisson ratio=0.45", "Nodes/Horizon factor=2"], ["unstable at a horizon factor of 2"]),
            (["Material/Young modulus=70e9", "Material/Poisson ratio=0.4"], ["push sideways"]),
            (["Material/Symmetry=anisotropic", "Material/Stiffness=1e9, 2e9, 0, 1e9, 0, 1e9"], ["not positive definite"])]

# Beams, and what --check says of their mesh.
BEAM = """
subsection Mesh
  set Generator = box
  set Cells = 40, 4
  set Size = 1, 0.1
end
subsection Material
  set Young modulus = 70e9
  set Poisson ratio = 0.3
end
subsection Boundary conditions
  subsection left
    set Boundary = left
    set u_x = 0
    set u_y = 0
  end
  subsection right
    set Boundary = right
    set t_y = 1e5
  end
end
"""
TOO_COARSE = ["for 1 % take cells about", "in place of 18 (Mesh/Refinements = 1)", "nothing was written"]
BEAMS = [([], ["% of error in the displacement (l2, estimated, mostly within a factor of three)", "as long as they show the body's shape"]),
         (["Mesh/Cells=6, 3"], TOO_COARSE),
         (["Mesh/Cells=500, 320"], ["not estimated: 160,000 cells take long to solve for", "nothing was solved"]),
         (["Boundary conditions/Displacement treatment=reference"], ["not estimated: nodes are held where a reference puts"]),
         (["Material/Form=energy"], ["parts are 4 cells thick", "is off by about 19 %", "that takes Material/Form = consistent"]),
         (["Material/Form=paper"], ["is off by about 33 %"]),
         (["Material/Model=ordinary"], ["is off by about 54 %"]),
         (["Material/Model=correspondence", "Material/Form=family"], ["is too stiff by about 75 %"]),
         (["Material/Form=energy", "Mesh/Distortion=0.1"], ["cells are irregular in parts 4 cells thick", "by 7 to 47 %"])]


def interrupted_gmsh(program, folder):
    """What differs when the run is interrupted while it waits for gmsh, which is to be ended too; as texts."""
    (folder / "gmsh").write_text("#!/bin/sh\necho $$ > started\nexec sleep 100\n", encoding="utf-8")
    (folder / "gmsh").chmod(0o755)
    (folder / "part.geo").write_text("Point(1) = {0, 0, 0};\n", encoding="utf-8")
    (folder / "gmsh.prm").write_text(TENSORS.replace("set Generator = box", "set File = part.geo"), encoding="utf-8")
    command = ["env", f"PATH={folder}:{os.environ['PATH']}", program, "gmsh.prm"]
    process = start([*command, "--set", "Material/Young modulus=1e9", "--set", "Material/Poisson ratio=0.3"], folder, folder)
    started = folder / "started"
    for _ in range(300):
        if started.exists() and started.read_text(encoding="utf-8").strip():
            break
        time.sleep(0.1)
    process.send_signal(signal.SIGINT)
    try:
        err = process.communicate(timeout=30)[1].decode()
    except subprocess.TimeoutExpired:
        process.kill()
        return ["does not stop"]
    found = [] if process.returncode == 2 else [f"exit status {process.returncode}"]
    found += [f"does not say {word!r}" for word in ("stopped: while gmsh meshed", "part.geo") if word not in err]
    if Path(f"/proc/{started.read_text(encoding='utf-8').strip()}").exists():
        found.append("leaves gmsh running")
    return found


def main():
    parser = argparse.ArgumentParser(description="runs the options that write nothing")
    parser.add_argument("--program", required=True, type=os.path.abspath)
    parser.add_argument("--example", required=True, type=os.path.abspath)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="perideal-command-") as name:
        folder = Path(name)
        n_groups, values = listed_scene(arguments.program, folder)
        checked = ["nodes", "bonds", "neighbours", "memory", "time step"]
        cases = [(["--help"], ["--check", "--parameters", "--set", "mpirun", "Exit status"]),
                 (["--version"], ["perideal", "deal.II", "Trilinos"]),
                 (["--parameters"], ["Horizon factor"]),
                 (["--parameters", "text"], ["Horizon factor"]),
                 (["--parameters", "prm"], ["set Horizon factor", "subsection Nodes"]),
                 (["--parameters", "markdown"], ["Horizon factor", "|"]),
                 (["--parameters", "json"], ['"path": "Nodes/Horizon factor"']),
                 (["--rules"], ["## Accepted", "| bond based |", "## Refused", "mirrored nodes have no cells", "## Without effect", "`Solver/End time`"]),
                 (["--check", arguments.example],
                  checked + ["7,680", "the mesh leaves about 0.004", "some 480 in place of 7,680", "nothing was written"]),
                 (["--check", arguments.example, "--set", "Solver/Name=quasi static", "--set", "Material/Form=energy"], checked + ["nothing was solved"]),
                 (["--check", "listed.prm"] + values, checked + ["nothing was solved"])]
        (folder / "beam.prm").write_text(BEAM, encoding="utf-8")
        for settings, words in BEAMS:
            cases.append((["--check", "beam.prm"] + [word for value in settings for word in ("--set", value)], checked + words))
        (folder / "tensors.prm").write_text(TENSORS, encoding="utf-8")
        for settings, warning in WARNINGS:
            cases.append((["--check", "tensors.prm"] + [word for value in settings for word in ("--set", value)],
                          checked + ["nothing was solved"] + warning))
        n_deviating = 0
        for options, words in cases:
            found = deviations(arguments.program, folder, options, words)
            n_deviating += bool(found)
            print(f"{'DEVIATES' if found else 'ok':8}  {' '.join(options)}")
            for deviation in found:
                print(f"    {deviation}")
        found = interrupted_gmsh(arguments.program, folder)
        n_deviating += bool(found)
        print(f"{'DEVIATES' if found else 'ok':8}  a run that is interrupted while gmsh works")
        for deviation in found:
            print(f"    {deviation}")
    if without_surroundings(SURROUNDINGS) or without_surroundings(SURROUNDINGS + COMPLAINT) != COMPLAINT:
        n_deviating += 1
        print("what MPI prints about its surroundings is not told from what the program says")
    if n_groups != 1:
        n_deviating += 1
        print(f"the list of parameters has {n_groups} materials of named groups, not 1")
    print(f"{len(cases)} runs, {n_deviating} deviate")
    return 1 if n_deviating else 0


if __name__ == "__main__":
    sys.exit(main())
