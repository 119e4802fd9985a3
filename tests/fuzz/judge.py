# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the program on an input and tells what a user must never see."""

import re
import resource
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from execute import environment, execute

# What is not ours, in anything that is printed.
FOREIGN = re.compile(r"HDF5-DIAG|An error occurred in|terminate called|[Ss]tack ?trace|Exception on processing|muParser|"
                     r"internal error|dealii::|deal\.II exception|Assertion|what\(\):|\[json\.exception|MPI_ABORT|Segmentation|"
                     r"Parser error|Unexpected token|basic_string|vector::_M|std::|Epetra|ML::|#\d+ +0x|Backtrace|bad_alloc|sh: \d")
MEMORY = 6 << 30  # bytes of addresses, so that a mistake does not fill the machine


class Result:
    """What a run left: status (None: did not end), what it printed."""

    def __init__(self, status, out, err):
        self.status, self.out, self.err = status, out, err

    def complaints(self):
        """What is wrong with it, as texts."""
        if self.status is None:
            return ["did not end"]
        found = []
        if self.status < 0 or self.status > 128:
            found.append(f"ended by signal {-self.status if self.status < 0 else self.status - 128}")
        elif self.status not in (0, 1, 2):
            found.append(f"exit status {self.status}")
        text = self.out + self.err
        # What the user gave may stand in a message.
        for match in FOREIGN.finditer(text):
            line = text[text.rfind("\n", 0, match.start()) + 1 :].split("\n", 1)[0]
            if not line.strip().startswith(("given:", "parameter:")):
                found.append(f"prints {line.strip()[:150]!r}")
                break
        if self.status in (1, 2):
            says = re.search(r"^perideal: (input error|computation failed|stopped): (.{8,})", self.err, re.MULTILINE)
            if not says:
                found.append(f"exit status {self.status} without a message of ours: {self.err.strip()[:150]!r}")
            elif self.err.count("perideal: ") > 1 and self.err.count("\nperideal: ") > 0:
                found.append("tells more than one error")
        return found


def run(command, folder, seconds):
    """Runs a command in a folder of its own."""
    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    return Result(*execute(command, folder, seconds, preexec_fn=limit))
