# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks of a script, one after the other: all are made, each that fails is told."""

import tempfile
from pathlib import Path


class Failure(Exception):
    """What was expected and is not so."""


def expect(holds, text):
    if not holds:
        raise Failure(text)


def count_failures(checks):
    """Makes each of the checks, (label, function), in an empty folder that it is given; the number of those that fail."""
    n_failed = 0
    for label, check in checks:
        with tempfile.TemporaryDirectory(prefix="perideal-check-") as name:
            try:
                check(Path(name))
                print(f"ok        {label}", flush=True)
            except Failure as failure:
                n_failed += 1
                print(f"DEVIATES  {label}\n    {failure}", flush=True)
    return n_failed
