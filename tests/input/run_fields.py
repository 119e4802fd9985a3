#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes every field of every model with every solver: each is in the file, or a rule says why it is not.

    run_fields.py --program build/perideal [--jobs N]

Solvers, models and forms come from --parameters and --rules, the fields from the description of Output/Fields. All fields
that a scene may have are written together, with each model and form; then each alone, with two models.
"""

import argparse
import concurrent.futures
import itertools
import json
import re
import sys
import tempfile
from pathlib import Path

from run_rules import choices, run

SCENE = """
set Dimension = {dimension}
set Output directory = output
subsection Mesh
  set Generator = box
  set Cells = {cells}
end
subsection Nodes
  set Horizon factor = {factor}
end
subsection Material
  set Model = {model}
  set Form = {form}
  set Young modulus = 70e9
  set Poisson ratio = 0.3
  set Density = 2700
end
subsection Solver
  set Name = {solver}
  {end}
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
subsection Output
  set Fields = {fields}
end
"""
# Names of arrays, where they are not those of the fields.
ARRAYS = {"strain": "strain_xx", "stress": "stress_xx", "von mises": "von_mises_stress",
          "principal stress": "smallest_principal_stress", "strain energy density": "strain_energy_density",
          "family status": "family_status", "fem": "fem_displacement", "reference": "reference_displacement",
          "exact": "exact_displacement", "error": "error_against_", "fem stress": "fem_stress_xx",
          "stress error": "stress_error_xx"}
# What fields need beside them.
NEEDED = {**dict.fromkeys(("fem", "fem stress", "stress error"), ["Comparison/FEM=true"]), "reference": ["Comparison/Reference=true"],
          "exact": [f"Comparison/Exact u_{axis}=1e-5*x" for axis in "xyz"]}
NEEDED["error"] = NEEDED["exact"]
# The rule that may refuse a scene of one field.
FIELDS_RULE = "Output/Fields"
LEFT_OUT = "a comparison that is not asked for"
FOREIGN = ("terminate called", "Stacktrace", "An error occurred", "HDF5-DIAG", "internal error", "Exception")


def field_names(program):
    entries = json.loads(run(program, "--parameters", "json")[1])
    meaning = next(entry["meaning"] for entry in entries if entry["path"] == "Output/Fields")
    return [name.strip() for name in meaning.split("separated by commas: ")[1].split(". ")[0].split("|")]


def forms(program):
    """{model: [form]} as the rule on forms tells them; models that have one form only are left without."""
    table = run(program, "--rules")[1]
    row = next(line for line in table.splitlines() if "this is no form of the model" in line)
    cell = re.split(r"(?<!\\) \| ", row)[3]
    found = {}
    for part in cell.split(";"):
        if ":" in part:
            model, names = part.split(":")
            found[model.strip()] = [name.strip() for name in names.split("\\|") if name.strip() != "automatic"]
    return found


def write(program, model, form, solver, dimension, fields, needs=NEEDED):
    """(exit status, text, arrays of solution.vtu) of a scene with some fields."""
    scene = SCENE.format(model=model, form=form, solver=solver, dimension=dimension, fields=", ".join(fields),
                         end="set End time = 1e-5" if solver == "dynamics" else "",
                         cells="5, 4" if dimension == 2 else "4, 3, 3", factor="2.51" if dimension == 3 else "3.01",
                         depth="set u_z = 0" if dimension == 3 else "")
    needed = [setting for field in fields for setting in needs.get(field, [])
              if dimension == 3 or not setting.startswith("Comparison/Exact u_z")]
    with tempfile.TemporaryDirectory(prefix="perideal-fields-") as name:
        folder = Path(name)
        (folder / "case.prm").write_text(scene, encoding="utf-8")
        status, out, err = run(program, "case.prm", *[word for setting in dict.fromkeys(needed) for word in ("--set", setting)],
                               folder=folder)
        files = sorted((folder / "output").glob("solution*.vtu"))
        arrays = set(re.findall(rb'Name="([^"]*)"', files[-1].read_bytes())) if files else set()
    return status, out + err, {name.decode() for name in arrays}


def refused(text, field):
    """Whether the rules refuse this field, or the comparison that it shows."""
    mistakes = text[text.index("input error:"):]
    return FIELDS_RULE in mistakes or any(setting.split("=")[0] in mistakes for setting in NEEDED.get(field, []))


def judge(program, model, form, solver, dimension, fields):
    """What is wrong, as texts; the fields of the file; why the scene is refused, without its fields."""
    status, text, arrays = write(program, model, form, solver, dimension, fields)
    found = [f"prints {word!r}" for word in FOREIGN if word in text]
    if status not in (0, 1):
        found.append(f"exit status {status}")
    if status == 1 and not (len(fields) == 1 and refused(text, fields[0])):
        found.append("is refused")
    # The state has arrays only where something lasts that may be shown.
    missing = [field for field in fields
               if field != "state" and not any(ARRAYS.get(field, field) in name for name in arrays)]
    if status == 0 and missing:
        found.append(f"no array of {', '.join(missing)} in the file, and nobody says why")
    return [f"{line}\n{text.strip()}" for line in found], status


def main():
    parser = argparse.ArgumentParser(description="writes every field with every solver and model")
    parser.add_argument("--program", required=True, type=Path)
    parser.add_argument("--jobs", type=int, default=2, help="runs side by side; default: %(default)s")
    arguments = parser.parse_args()
    program = str(arguments.program.resolve())
    selections, fields, of_model = choices(program), field_names(program), forms(program)
    solvers, models = selections["Solver/Name"], selections["Material/Model"]
    kinds = [(model, form) for model in models for form in of_model.get(model, ["automatic"])]
    bodies = [(*kind, solver, 2) for kind, solver in itertools.product(kinds, solvers)]
    bodies += [("extended ordinary", "automatic", solver, 3) for solver in solvers]

    def alone(solver):
        """Writes each field alone; returns those that the solver has, and what is wrong."""
        has, found = [], []
        for field in fields:
            messages, status = judge(program, "extended ordinary", "energy", solver, 2, [field])
            found += [f"{field} with {solver}: {message}" for message in messages]
            has += [field] if status == 0 else []
            if status == 0 and field in NEEDED:
                _, text, _ = write(program, "extended ordinary", "energy", solver, 2, [field], {})
                found += [] if LEFT_OUT in text else [f"{field} with {solver} is left out without a word"]
        return has, found

    def together(body):
        """Writes all fields that the solver has; returns whether the model has this solver, and what is wrong."""
        status, text, _ = write(program, *body, ["displacement"])
        if status == 1 and ("Solver/Name" in text or "Material/Form" in text):
            return False, []
        return True, [f"all fields of {body}: {message}" for message in judge(program, *body, of_solver[body[2]])[0]]

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        singles = list(pool.map(alone, solvers))
        of_solver = {solver: has for solver, (has, _) in zip(solvers, singles)}
        results = list(pool.map(together, bodies))
    found = [text for _, texts in singles + results for text in texts]
    for text in found:
        print(f"DEVIATES  {text}")
    n_served = sum(served for served, _ in results)
    print(f"{len(fields)} fields, {len(kinds)} models and forms, {len(solvers)} solvers, {n_served} combinations of "
          f"these; {len(found)} deviate")
    # Lists that are not read must not make the test pass.
    return 1 if found or len(fields) < 20 or len(kinds) < 8 or n_served < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
