#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Holds the reference, --parameters in all its formats, against what a reader may expect of it.

    run_reference.py --program build/perideal

Every parameter has a meaning, a unit, allowed values in words, and a default that they allow or none.
"""

import argparse
import json
import os
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from execute import execute

FORMATS = ["text", "prm", "markdown", "json"]
# Words of programs, and bounds that bound nothing.
FOREIGN = ["MAX_DOUBLE", "MIN_DOUBLE", "4294967295", "2147483647", "-2147483648", "inclusive", "[Double", "[Integer", "[List",
           "[Map", "[Anything", "[Selection", "[Bool", "1.79769", "e+308"]
UNITS = {"-", "m", "s", "1/s", "m/s", "m/s^2", "Pa", "J", "J/m^2", "kg/m^3", "N", "N/m^3", "N/m^11", "degrees", "rad", "K", "1/K", "Pa m^0.5"}
NUMBERS = ("number", "whole number")


def listing(program, form):
    status, out, err = execute([program, "--parameters", form], ".", 60)
    if status != 0:
        sys.exit(f"--parameters {form}: exit status {status}: {err}")
    return out


def is_allowed(value, words):
    """Whether a number is in the range that words tell, such as "number > 0" or "whole number, 1 to 15"."""
    tests = [(r"> (-?[\d.e-]+)", lambda bound: value > bound), (r"< (-?[\d.e-]+)", lambda bound: value < bound),
             (r"at least (-?[\d.e-]+)", lambda bound: value >= bound), (r"at most (-?[\d.e-]+)", lambda bound: value <= bound),
             (r"(-?[\d.e-]+) to ", lambda bound: value >= bound), (r" to (-?[\d.e-]+)", lambda bound: value <= bound)]
    if words.endswith(", or 0") and value == 0:
        return True
    return all(test(float(bound)) for pattern, test in tests for bound in re.findall(pattern, words))


def deviations_of_entry(entry):
    """What is wrong with what is said of a parameter, as texts."""
    found = []
    if len(entry["meaning"]) < 10:
        found.append("has no meaning")
    if not entry["allowed"].strip() or entry["allowed"] == "text" and not entry["meaning"]:
        found.append("does not say what is allowed")
    units = entry["unit"].split(" or ")
    if any(unit not in UNITS for unit in units):
        found.append(f"unit {entry['unit']!r}")
    if entry["kind"] == "number" and "[" not in entry["meaning"]:
        found.append("a number without a unit")
    if not entry["default in words"].strip():
        found.append("says nothing of a default")
    default = entry["default"]
    if default is None:
        if entry["default in words"] != "none":
            found.append("must be given and has a default")
        return found
    if entry["kind"] in NUMBERS:
        if default != "" and entry["default in words"] != "none" and not is_allowed(float(default), entry["allowed"]):
            found.append(f"default {default} is not one of {entry['allowed']!r}")
    if entry["kind"] == "choice" and default not in entry["choices"]:
        found.append(f"default {default} is no choice")
    if entry["kind"] == "boolean" and default not in ("true", "false"):
        found.append(f"default {default} is neither true nor false")
    return found


def deviations(program):
    texts = {form: listing(program, form) for form in FORMATS}
    found = [f"--parameters {form} says {word!r}" for form, text in texts.items() for word in FOREIGN if word in text]
    entries = json.loads(texts["json"])
    if len(entries) < 100:
        found.append(f"{len(entries)} parameters only")
    for entry in entries:
        found += [f"{entry['path']}: {text}" for text in deviations_of_entry(entry)]
        name = entry["path"].split("/")[-1]
        if f"| `{name}` |" not in texts["markdown"] or f"set {name} =" not in texts["prm"] or entry["path"] + "\n" not in texts["text"]:
            found.append(f"{entry['path']}: is not in all formats")
    first = texts["markdown"].split("\n## ")[1]
    rows = re.findall(r"^\| `([^`]*)` \|", first, re.MULTILINE)
    if len(rows) != 15 or set(rows) != {entry["path"] for entry in entries if entry["first"]}:
        found.append(f"the first section has {len(rows)} rows: {rows}")
    if rows and (rows[0] != "Dimension" or rows[-1] != "Output/Fields"):
        found.append("the first section is not in the order of a scene")
    return found


def self_test():
    """Shows that each kind of mistake is found."""
    good = {"path": "A/b", "kind": "number", "meaning": "A length of some kind > 0 [m]", "unit": "m", "allowed": "number > 0",
            "default": "1", "default in words": "1", "choices": []}
    if deviations_of_entry(good):
        sys.exit("a good entry is refused")
    bad = [{"meaning": ""}, {"unit": "yard"}, {"meaning": "A length of some kind"}, {"default": "0"}, {"default in words": ""},
           {"default": None}, {"allowed": ""}, {"kind": "choice"}, {"kind": "boolean"}, {"allowed": "number, 2 to 3"},
           {"allowed": "number, at least 2"}, {"allowed": "number > -1 and < 0.5"}]
    for change in bad:
        if not deviations_of_entry({**good, **change}):
            sys.exit(f"{change} is not found")


def main():
    parser = argparse.ArgumentParser(description="checks the reference of parameters")
    parser.add_argument("--program", required=True, type=os.path.abspath)
    arguments = parser.parse_args()
    self_test()
    found = deviations(arguments.program)
    for text in found:
        print(text)
    print(f"{len(found)} deviations")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
