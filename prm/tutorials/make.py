#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the commands of the tutorials, as they stand on the pages, and brings the pages up to date or compares them.

    prm/tutorials/make.py --program build/perideal [--check] [--pictures] [PAGE...]

--pictures draws the pictures of the pages, which needs python3-vtk9 and python3-matplotlib. --check writes nothing, and sees
that each page is short to run and has its scene beside it.
"""

import argparse
import os
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "manual"))

from pages import Sandbox, broken_links, check_page, self_test

# The program of the page on the library is built by the test "consumer".
BUILT_ELSEWHERE = "12_library.md"
N_PAGES = 13
# Seconds a page may take, four times as long where machines are slow.
LONGEST = 4 * 60


def main():
    parser = argparse.ArgumentParser(description="makes or checks the tutorials")
    parser.add_argument("--program", required=True, type=os.path.abspath)
    parser.add_argument("--check", action="store_true", help="compare, write nothing")
    parser.add_argument("--pictures", action="store_true", help="draw the pictures, too")
    parser.add_argument("pages", nargs="*", help="names of pages; default: all but that on the library")
    arguments = parser.parse_args()
    self_test()
    pages = sorted(HERE.glob("[0-9][0-9]_*.md"))
    found = [] if len(pages) == N_PAGES else [f"there are {len(pages)} pages, not {N_PAGES}"]
    names = arguments.pages or [page.name for page in pages if page.name != BUILT_ELSEWHERE]
    for page in [HERE / name for name in names]:
        old = page.read_text(encoding="utf-8")
        began = time.monotonic()
        with Sandbox(arguments.program) as sandbox:
            new, deviations = check_page(old, sandbox)
            seconds = time.monotonic() - began
            if arguments.pictures:
                from pictures import draw
                draw(page.stem, sandbox.folder / "output", HERE)
        if seconds > LONGEST:
            deviations.append(f"takes {seconds:.0f} s")
        if not page.with_suffix(".prm").exists() and page.name != BUILT_ELSEWHERE:
            deviations.append("has no scene beside it")
        found += [f"{page.name}: {text}" for text in deviations + broken_links(page)]
        print(f"{page.name}: {seconds:.1f} s", flush=True)
        if not arguments.check and new != old:
            page.write_text(new, encoding="utf-8")
            print(f"wrote {page.name}")
    for text in found:
        print(text)
    print(f"{len(found)} deviations")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
