#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the program on every wrong input of bad_input.json and checks what it says.

    run_bad_input.py --program build/perideal [--only NAME]... [--show]

A case:
    {"name":      "what is wrong",
     "base":      "good.prm" of this folder, or a list of lines,
     "replace":   [[old, new], ...]        on the base; each old must occur exactly once
     "set":       ["Section/Name=value"],  as --set
     "files":     {NAME: CONTENT},         beside the scene; CONTENT is a text, a list of lines, or
                                           {"base": FILE, "replace": [...], "keep_lines": N}
     "arguments": ["case.prm"],            the command line instead of "case.prm" and the --set
     "ranks":     [1, 2],                  default [1]
     "exit":      1,                       default 1; 0 for the good scenes that guard the table itself
     "says":      ["word", ...]}           stderr contains all of them (stdout too where exit is 0)
A rejected run leaves no file in the output directory, ends by itself, and tells the user once, not once a rank.
"""

import argparse
import concurrent.futures
import json
import os
import shlex
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from execute import execute

KEYS = {"name", "base", "replace", "set", "files", "arguments", "ranks", "exit", "says"}


def replaced(text, pairs, name):
    for old, new in pairs:
        if text.count(old) != 1:
            sys.exit(f"{name}: {old!r} occurs {text.count(old)} times in the base, not once")
        text = text.replace(old, new)
    return text


def content(description, name):
    """The text of a file as a case describes it."""
    if isinstance(description, str):
        return description
    if isinstance(description, list):
        return "\n".join(description) + "\n"
    text = (HERE / description["base"]).read_text(encoding="utf-8")
    text = replaced(text, description.get("replace", []), name)
    if "keep_lines" in description:
        text = "".join(text.splitlines(keepends=True)[: description["keep_lines"]])
    return text


def write_files(case, folder):
    base = case.get("base", "good.prm")
    text = content(base if isinstance(base, list) else {"base": base}, case["name"])
    files = {"square.msh": {"base": "square.msh"}, **case.get("files", {})}
    (folder / "case.prm").write_text(replaced(text, case.get("replace", []), case["name"]), encoding="utf-8")
    for name, description in files.items():
        # one byte a character, so that binary files can be written too
        (folder / name).write_text(content(description, case["name"]), encoding="latin-1", newline="")


def command_line(case, ranks, program, mpirun):
    arguments = case.get("arguments")
    if arguments is None:
        arguments = ["case.prm"]
        for override in case.get("set", []):
            arguments += ["--set", override]
    launcher = shlex.split(mpirun) + ["-n", str(ranks)] if ranks > 1 else []
    return launcher + [program] + arguments


def deviations(case, status, out, err, folder, seconds):
    """What differs from the case's expectation, as texts."""
    expected = case.get("exit", 1)
    found = []
    if status is None:
        found.append(f"did not end within {seconds:g} s")
    elif status < 0 or status > 128:
        found.append(f"died of signal {-status if status < 0 else status - 128}")
    elif status != expected:
        found.append(f"exit status {status}, expected {expected}")
    text = err if expected != 0 else out + err
    found += [f"does not say {word!r}" for word in case["says"] if word not in text]
    if expected == 1:
        left = sorted(str(path.relative_to(folder)) for path in (folder / "output").rglob("*") if path.is_file())
        if left:
            found.append(f"left files behind: {', '.join(left)}")
        if err.count("input error:") > 1:
            found.append(f"says it {err.count('input error:')} times")
    return found


def run_case(case, ranks, arguments):
    with tempfile.TemporaryDirectory(prefix="perideal-input-") as name:
        folder = Path(name)
        write_files(case, folder)
        command = command_line(case, ranks, arguments.program, arguments.mpirun)
        status, out, err = execute(command, folder, arguments.timeout)
        found = deviations(case, status, out, err, folder, arguments.timeout)
    return case["name"], ranks, found, err.strip() or out.strip()


def check_table(cases):
    """A slip in the table must not turn a case into one that always passes."""
    names = [case.get("name") for case in cases]
    for case in cases:
        unknown = set(case) - KEYS
        if unknown or not case.get("name") or not case.get("says") or names.count(case["name"]) > 1:
            sys.exit(f"{case.get('name')}: needs a name of its own and \"says\"; unknown keys: {sorted(unknown)}")
        if "arguments" in case and "set" in case:
            sys.exit(f"{case['name']}: \"arguments\" take the place of \"set\"")


def indented(text):
    return "\n".join("    | " + line for line in text.splitlines())


def main():
    parser = argparse.ArgumentParser(description="runs the table of wrong inputs")
    parser.add_argument("--program", required=True, type=os.path.abspath)
    parser.add_argument("--mpirun", default="mpirun --bind-to none --oversubscribe", help="default: %(default)s")
    parser.add_argument("--only", action="append", help="name of a case; may be repeated")
    parser.add_argument("--show", action="store_true", help="print every message, not only the unexpected")
    parser.add_argument("--timeout", type=float, default=60, help="seconds a run; default: %(default)s")
    parser.add_argument("--jobs", type=int, default=2, help="runs side by side; default: %(default)s")
    arguments = parser.parse_args()

    cases = json.loads((HERE / "bad_input.json").read_text(encoding="utf-8"))
    check_table(cases)
    runs = [(case, ranks) for case in cases for ranks in case.get("ranks", [1])
            if not arguments.only or case["name"] in arguments.only]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = list(pool.map(lambda run: run_case(*run, arguments), runs))
    n_deviating = 0
    for name, ranks, found, text in results:
        n_deviating += bool(found)
        print(f"{'DEVIATES' if found else 'ok':8}  {name}{f' ({ranks} ranks)' if ranks > 1 else ''}")
        for deviation in found:
            print(f"    {deviation}")
        if found or arguments.show:
            print(indented(text))
    print(f"{len(results)} runs, {n_deviating} deviate")
    return 1 if n_deviating or not results else 0


if __name__ == "__main__":
    sys.exit(main())
