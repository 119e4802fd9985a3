#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes every generated part of README.md, one measurement after the other.

    tests/performance/report.py --program build/perideal [--repeat N]

--repeat: runs of each case that is timed, for medians.
"""

import argparse
import subprocess
import sys
from pathlib import Path

MEASUREMENTS = {"work_precision.py": True, "stability.py": False, "skip.py": True, "peers.py": True}  # timed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--repeat", default="1")
    options = parser.parse_args()
    here, failed = Path(__file__).resolve().parent, []
    for name, is_timed in MEASUREMENTS.items():
        command = [sys.executable, here / name, "--program", options.program]
        if subprocess.run(command + (["--repeat", options.repeat] if is_timed else []), check=False).returncode != 0:
            failed.append(name)
    if failed:
        sys.exit("failed: " + ", ".join(failed))


if __name__ == "__main__":
    main()
