#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a scene and compares what it leaves with the expected figures beside it.

    run_scene.py --program build/perideal [--ranks N] SCENE.json
    run_scene.py --self-test

SCENE.json:
    {"why":    "what the scene guards",
     "scene":  "../other.prm",             what to run, relative to the .json (default SCENE.prm)
     "ranks":  [1, 2],                     rank counts that ctest runs
     "set":    ["Section/Name=value"],     overrides (optional)
     "exit":   0,                          exit status (optional)
     "checks": [...]}
Every check has a "why" (above all the reason of its tolerance) and is one of
    {"figure": PATH, "value": V, "relative": R}     |read - V| <= R |V|; or "absolute": A
    {"figure": PATH, "min": V} or "max" or both     a range
    {"figure": PATH, "equals": V}                   any JSON value
    {"same_on_all_ranks": PATH, "relative": R}      as the first rank count read it; or "absolute": A
    {"files": ["solution.pvd", ...]}                present and not empty in the output directory
    {"says": ["word", ...]}                         printed by the run
PATH is the way into summary.json: names and list indices with dots between them.
"""

import argparse
import json
import os
import shlex
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

from execute import environment

TOLERANCE = {"relative", "absolute"}
# By the key that tells the kind of a check: the keys that it may have besides "why".
KINDS = {
    "value": {"figure", "value"} | TOLERANCE,
    "min": {"figure", "min", "max"},
    "max": {"figure", "min", "max"},
    "equals": {"figure", "equals"},
    "same_on_all_ranks": {"same_on_all_ranks"} | TOLERANCE,
    "files": {"files"},
    "says": {"says"},
}
ABSENT = object()


class BadExpectations(Exception):
    """The .json file of the scene itself is wrong."""


def kind_of(check):
    """The key of KINDS that a check has; raises BadExpectations when the check is malformed."""
    kinds = [kind for kind in KINDS if kind in check]
    if not kinds or (len(kinds) > 1 and kinds != ["min", "max"]):
        raise BadExpectations(f"need one of {', '.join(KINDS)} in {check}")
    unknown = set(check) - KINDS[kinds[0]] - {"why"}
    if unknown:
        raise BadExpectations(f"unknown {', '.join(sorted(unknown))} in {check}")
    if not check.get("why"):
        raise BadExpectations(f'no "why" in {check}')
    if kinds[0] in ("value", "min", "max", "equals") and "figure" not in check:
        raise BadExpectations(f'no "figure" in {check}')
    if kinds[0] in ("value", "same_on_all_ranks") and len(TOLERANCE & set(check)) != 1:
        raise BadExpectations(f'one of "relative", "absolute" is needed in {check}')
    if kinds[0] == "value" and check["value"] == 0 and "relative" in check:
        raise BadExpectations(f"a relative tolerance of zero is zero in {check}")
    if kinds[0] in ("files", "says") and not check[kinds[0]]:
        raise BadExpectations(f"an empty list in {check}")
    return kinds[0]


def read_expectations(path):
    expectations = json.loads(path.read_text(encoding="utf-8"))
    unknown = set(expectations) - {"why", "scene", "ranks", "set", "exit", "checks"}
    if unknown:
        raise BadExpectations(f"unknown {', '.join(sorted(unknown))}")
    for needed in ("why", "ranks", "checks"):
        if not expectations.get(needed):
            raise BadExpectations(f'no "{needed}"')
    for check in expectations["checks"]:
        kind_of(check)
    return expectations


def scene_of(path, expectations):
    """The parameter file that the expectations at path are about."""
    scene = Path(os.path.normpath(path.parent / expectations.get("scene", path.with_suffix(".prm").name)))
    if not scene.is_file():
        raise BadExpectations(f"no scene {scene}")
    return scene


def look_up(summary, path):
    """The value at a dotted path, or ABSENT."""
    place = summary
    for part in path.split("."):
        if isinstance(place, dict) and part in place:
            place = place[part]
        elif isinstance(place, list) and part.isdigit() and int(part) < len(place):
            place = place[int(part)]
        else:
            return ABSENT
    return place


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def show(value):
    if value is ABSENT:
        return "absent"
    return f"{value:.6g}" if isinstance(value, float) else json.dumps(value)


def within(check, expected, read):
    """Not a number is never within anything."""
    tolerance = check["absolute"] if "absolute" in check else check["relative"] * abs(expected)
    return is_number(read) and abs(read - expected) <= tolerance


def tolerance_text(check):
    return f"+- {check['absolute']:g}" if "absolute" in check else f"+- {100 * check['relative']:g} %"


def judge(check, run):
    """(figure, expected, read, passed) of a check."""
    kind = kind_of(check)
    if kind == "files":
        files = [Path(run["output"], name) for name in check["files"]]
        lacking = [file.name for file in files if not file.is_file() or file.stat().st_size == 0]
        return "files", " ".join(check["files"]), f"lacks {' '.join(lacking)}" if lacking else "all there", not lacking
    if kind == "says":
        lacking = [word for word in check["says"] if word not in run["text"]]
        return "says", str(check["says"]), f"lacks {lacking}" if lacking else "all there", not lacking
    if kind == "same_on_all_ranks":
        figure = check[kind]
        read = look_up(run["summary"], figure)
        expected = read if run["reference"] is None else look_up(run["reference"], figure)
        passed = is_number(expected) and within(check, expected, read)
        return figure, f"{show(expected)} {tolerance_text(check)} (first ranks)", show(read), passed
    figure = check["figure"]
    read = look_up(run["summary"], figure)
    if kind == "value":
        expected = f"{show(check['value'])} {tolerance_text(check)}"
        return figure, expected, show(read), within(check, check["value"], read)
    if kind == "equals":
        return figure, show(check["equals"]), show(read), read is not ABSENT and read == check["equals"]
    passed = is_number(read) and check.get("min", read) <= read <= check.get("max", read)
    expected = " and ".join(f"{word} {check[key]:g}" for key, word in (("min", ">="), ("max", "<=")) if key in check)
    return figure, expected, show(read), passed


def report(checks, run):
    """Prints the table of all checks; the number of failures."""
    rows = [("figure", "expected", "read", "verdict")]
    reasons = []
    for check in checks:
        figure, expected, read, passed = judge(check, run)
        rows.append((figure, expected, read, "ok" if passed else "FAILED"))
        if not passed:
            reasons.append(f"{figure}: {check['why']}")
    widths = [max(len(row[column]) for row in rows) for column in range(3)]
    for row in rows:
        print("  ".join([cell.ljust(width) for cell, width in zip(row, widths)] + [row[3]]))
    for reason in reasons:
        print(f"expected because: {reason}")
    return len(reasons)


def execute(command, seconds):
    """(exit status, all that was printed); the status is None when the time is over."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               env=environment(), start_new_session=True)
    try:
        text, _ = process.communicate(timeout=seconds)
        status = process.returncode
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)  # the group of our own child: mpirun and its ranks
        text, _ = process.communicate()
        status = None
    return status, text.decode(errors="replace")


def run_scene(arguments):
    expectations_file = Path(arguments.expectations)
    expectations = read_expectations(expectations_file)
    scene = scene_of(expectations_file, expectations)
    compares = any("same_on_all_ranks" in check for check in expectations["checks"])
    if compares and arguments.ranks != expectations["ranks"][0] and not arguments.compare_with:
        raise BadExpectations('"same_on_all_ranks" needs --compare-with and the --save-summary of '
                              f"{expectations['ranks'][0]} ranks")
    with tempfile.TemporaryDirectory(prefix="perideal-scene-") as output:
        command = [arguments.program, str(scene)]
        for override in expectations.get("set", []) + [f"Output directory={output}"]:
            command += ["--set", override]
        if arguments.ranks > 1:
            command = shlex.split(arguments.mpirun) + ["-n", str(arguments.ranks)] + command
        print(f"{expectations_file.stem} on {arguments.ranks} ranks: {expectations['why']}")
        print(shlex.join(command), flush=True)
        status, text = execute(command, arguments.timeout)
        if status != expectations.get("exit", 0):
            got = f"no end within {arguments.timeout:g} s" if status is None else f"exit status {status}"
            print(f"{text}\n{got}, expected exit status {expectations.get('exit', 0)}")
            return 1
        summary_file = Path(output, "summary.json")
        summary = json.loads(summary_file.read_text(encoding="utf-8")) if summary_file.exists() else {}
        reference = json.loads(Path(arguments.compare_with).read_text(encoding="utf-8")) if compares and \
            arguments.compare_with else None
        run = {"summary": summary, "text": text, "output": output, "reference": reference}
        failures = report(expectations["checks"], run)
        if failures:
            print(f"\nthe run printed:\n{text}")
        if arguments.save_summary:
            Path(arguments.save_summary).write_text(json.dumps(summary), encoding="utf-8")
    return 1 if failures else 0


def self_test():
    """Every kind of check passes on the right figure, fails on a wrong one, and is rejected when malformed."""
    with tempfile.TemporaryDirectory() as output:
        Path(output, "full").write_text("1", encoding="utf-8")
        Path(output, "empty").write_text("", encoding="utf-8")
        run = {"summary": {"a": {"list": [1.0, 2.0]}, "nan": float("nan"), "none": None, "word": "done", "yes": True},
               "reference": {"a": {"list": [1.0, 2.1]}, "nan": float("nan")}, "text": "two words", "output": output}
        cases = [
            (True, {"figure": "a.list.1", "value": 2.1, "relative": 0.1}),
            (False, {"figure": "a.list.1", "value": 2.1, "relative": 0.01}),
            (True, {"figure": "a.list.0", "value": 0, "absolute": 1}),
            (False, {"figure": "a.list.0", "value": 0, "absolute": 0.5}),
            (False, {"figure": "a.list.2", "value": 2, "relative": 1}),
            (False, {"figure": "nan", "value": 1, "absolute": 1e9}),
            (False, {"figure": "none", "value": 1, "absolute": 1e9}),
            (False, {"figure": "yes", "value": 1, "absolute": 1e9}),
            (True, {"figure": "a.list.1", "min": 1, "max": 3}),
            (False, {"figure": "a.list.1", "min": 3}),
            (False, {"figure": "a.list.1", "max": 1}),
            (False, {"figure": "nan", "max": 1}),
            (False, {"figure": "absent", "max": 1}),
            (True, {"figure": "word", "equals": "done"}),
            (False, {"figure": "word", "equals": "failed"}),
            (True, {"same_on_all_ranks": "a.list.0", "relative": 1e-12}),
            (False, {"same_on_all_ranks": "a.list.1", "relative": 1e-3}),
            (False, {"same_on_all_ranks": "nan", "relative": 1e-3}),
            (False, {"same_on_all_ranks": "word", "relative": 1e-3}),
            (True, {"files": ["full"]}),
            (False, {"files": ["full", "empty"]}),
            (False, {"files": ["absent"]}),
            (True, {"says": ["two", "words"]}),
            (False, {"says": ["two", "three"]}),
            (None, {"figure": "word"}),
            (None, {"figure": "a.list.0", "value": 1}),
            (None, {"figure": "a.list.0", "value": 0, "relative": 1}),
            (None, {"figure": "a.list.0", "value": 1, "relative": 1, "mx": 2}),
            (None, {"value": 1, "relative": 1}),
            (None, {"files": []}),
        ]
        surprises = 0
        for expected, check in cases:
            try:
                verdict = judge({"why": "self-test", **check}, run)[3]
            except BadExpectations:
                verdict = None
            if verdict != expected:
                surprises += 1
                print(f"{check}: verdict {verdict} instead of {expected}")
        try:
            kind_of({"figure": "word", "equals": "done"})
            surprises += 1
            print('a check without "why" was accepted')
        except BadExpectations:
            pass
        try:
            scene_of(Path(output, "variant.json"), {"scene": "absent.prm"})
            surprises += 1
            print("an absent scene was accepted")
        except BadExpectations:
            pass
        Path(output, "empty.prm").touch()
        for name, expectations in (("empty.json", {}), ("variant.json", {"scene": "absent/../empty.prm"})):
            if scene_of(Path(output, name), expectations) != Path(output, "empty.prm"):
                surprises += 1
                print(f"{name} does not run empty.prm")
    n_cases = len(cases) + 4
    print(f"self-test: {n_cases - surprises} of {n_cases} cases as expected")
    return 1 if surprises else 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    parser = argparse.ArgumentParser(description="runs a scene and checks its figures")
    parser.add_argument("expectations", help="the .json file of the scene")
    parser.add_argument("--program", required=True)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--mpirun", default="mpirun --bind-to none --oversubscribe", help="default: %(default)s")
    parser.add_argument("--timeout", type=float, default=280, help="seconds; default: %(default)s")
    parser.add_argument("--save-summary", help="file to keep the figures in")
    parser.add_argument("--compare-with", help='the --save-summary of another run, for "same_on_all_ranks"')
    arguments = parser.parse_args()
    try:
        return run_scene(arguments)
    except BadExpectations as error:
        print(f"{arguments.expectations}: {error}")
        return 1


if __name__ == "__main__":
    sys.exit(main())
