#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes every generated part of README.md, one measurement after the other.

    tests/performance/report.py --program build/perideal [--repeat N] [--quick]

Arguments go to each of them.
"""

import subprocess
import sys
from pathlib import Path

MEASUREMENTS = ["work_precision.py", "stability.py", "skip.py", "peers.py"]


def main():
    if {"-h", "--help"} & set(sys.argv[1:]) or len(sys.argv) == 1:
        sys.exit(__doc__)
    here = Path(__file__).resolve().parent
    failed = [name for name in MEASUREMENTS
              if subprocess.run([sys.executable, here / name, *sys.argv[1:]], check=False).returncode != 0]
    if failed:
        sys.exit("failed: " + ", ".join(failed))


if __name__ == "__main__":
    main()
