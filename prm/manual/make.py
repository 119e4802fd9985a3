#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Brings the pages of the manual up to date with what the program prints, or compares them.

    prm/manual/make.py --program build/perideal [--check] [PAGE...]

The pages of parameters and combinations are what --parameters markdown and --rules print. --check also follows the links
of all pages of the repository, and sees that the README is short and the gallery whole, with a picture of every example.
"""

import argparse
import os
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from pages import ROOT, Sandbox, broken_links, check_page, self_test

HERE = Path(__file__).resolve().parent
MADE_BY = "<!-- made by prm/manual/make.py from perideal {} -->\n\n"
GENERATED = {"parameters.md": ["--parameters", "markdown"], "combinations.md": ["--rules"]}
LONGEST_README = 120


def generated(program, options):
    done = subprocess.run([program, *options], capture_output=True, text=True, check=True,
                          env={**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"})
    return MADE_BY.format(" ".join(options)) + done.stdout.rstrip() + "\n"


def deviations_of_repository():
    """Broken links, a README that is too long, examples that the gallery leaves out; as texts."""
    pages = [page for folder in ("", "prm", "prm/manual", "prm/tutorials", "source", "meshes", "tests/performance", "tests/validation")
             for page in sorted((ROOT / folder).glob("*.md"))]
    found = [text for page in pages for text in broken_links(page)]
    n_lines = len((ROOT / "README.md").read_text(encoding="utf-8").splitlines())
    if n_lines > LONGEST_README:
        found.append(f"README.md has {n_lines} lines, {LONGEST_README} at most are allowed")
    gallery = (ROOT / "prm" / "README.md").read_text(encoding="utf-8")
    found += [f"prm/README.md leaves out {scene.name}" for folder in ("examples", "verification")
              for scene in sorted((ROOT / "prm" / folder).glob("*.prm")) if f"({folder}/{scene.name})" not in gallery]
    found += [f"prm/README.md shows no picture of {scene.name}" for scene in sorted((ROOT / "prm" / "examples").glob("*.prm"))
              if f'"pictures/{scene.stem}.png"' not in gallery or not (ROOT / "prm" / "pictures" / f"{scene.stem}.png").exists()]
    manual = (HERE / "README.md").read_text(encoding="utf-8")
    found += [f"prm/manual/README.md leaves out {page.name}" for page in sorted(HERE.glob("*.md"))
              if page.name != "README.md" and f"({page.name})" not in manual]
    return found


def main():
    parser = argparse.ArgumentParser(description="makes or checks the pages of the manual")
    parser.add_argument("--program", required=True, type=os.path.abspath)
    parser.add_argument("--check", action="store_true", help="compare, write nothing")
    parser.add_argument("pages", nargs="*", help="names of pages; default: all")
    arguments = parser.parse_args()
    self_test()
    found = []
    for page in sorted(HERE.glob("*.md")) + [ROOT / "README.md"] + [HERE / name for name in GENERATED if not (HERE / name).exists()]:
        if arguments.pages and page.name not in arguments.pages:
            continue
        old = page.read_text(encoding="utf-8") if page.exists() else ""
        if page.parent == HERE and page.name in GENERATED:
            new = generated(arguments.program, GENERATED[page.name])
            deviations = [] if new == old else ["is not what the program prints"]
        else:
            with Sandbox(arguments.program) as sandbox:
                new, deviations = check_page(old, sandbox)
        found += [f"{page.name}: {text}" for text in deviations]
        if not arguments.check and new != old:
            page.write_text(new, encoding="utf-8")
            print(f"wrote {page.name}")
    found += deviations_of_repository()
    for text in found:
        print(text)
    print(f"{len(found)} deviations")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
