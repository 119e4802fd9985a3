# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rows of the validation page, kept by specimen in results/, and README.md, which is made of all of them."""

import csv
from dataclasses import astuple, dataclass, fields
from pathlib import Path

HERE = Path(__file__).resolve().parent
RESULTS = HERE / "results"

OPENING = """# Validation: what a crack costs

Specimens with a solution or an experiment, and what the program makes of them. Constants were fixed beforehand, as the
head of each scene says, and none was fitted. Misses stay; what is known of them stands below the table. The page is
generated from the rows of `results/`, which these runs write; some of the finest meshes take `--long`:

    tests/validation/run.py --program build/perideal [--only NAME] [--long]
"""


@dataclass
class Row:
    """One line of the table. within: yes, no, or - where nothing is asked."""
    specimen: str
    source: str
    mesh: str
    figure: str
    asked: str
    read: str
    within: str = "-"


def judged(values, low, high):
    """yes where all values are from low to high."""
    return "yes" if all(value is not None and low <= value <= high for value in values) else "no"


def keep(name, rows):
    """Writes the rows of a specimen to results/NAME.csv."""
    RESULTS.mkdir(exist_ok=True)
    with (RESULTS / f"{name}.csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(field.name for field in fields(Row))
        writer.writerows(astuple(row) for row in rows)


def kept(name):
    """The rows of results/NAME.csv, none where it is missing."""
    path = RESULTS / f"{name}.csv"
    if not path.exists():
        return []
    with path.open(encoding="utf-8", newline="") as file:
        return [Row(**row) for row in csv.DictReader(file)]


def write(specimens):
    """Writes README.md; specimens has, by name, what is known of the misses of each."""
    lines = [OPENING, "| specimen | source | mesh | figure | asked | read | within |", "|---|---|---|---|---|---|---|"]
    misses = []
    for name, why in specimens.items():
        rows = kept(name)
        lines += ["| " + " | ".join(astuple(row)) + " |" for row in rows]
        if any(row.within == "no" for row in rows):
            misses.append(f"- **{name.replace('_', ' ')}**: {why}")
    if misses:
        lines += ["", "## Misses", "", *misses]
    (HERE / "README.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
