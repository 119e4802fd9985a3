#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws the pictures and curves of a run, and writes its report, into its output directory.

    plot.py DIRECTORY [--fields "displacement, damage"] [--view "1, -2, 1"] [--report]

Without --fields, all fields that the run has written are drawn. Prints the names of the files that it wrote, one a line.
Exit status: 0 done; 3 a module is missing, its name on stderr; 4 what is to be drawn is not there, said on stderr.
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

# Arrays of the fields that are not called like the field, or begin with something else.
ARRAYS_OF_FIELDS = {"principal_stress": ["largest_principal_stress", "smallest_principal_stress"],
                    "von_mises": ["von_mises_stress"], "fem": ["fem_displacement"], "reference": ["reference_displacement"],
                    "exact": ["exact_displacement"]}
COMPONENTS = ("", "_xx", "_yy", "_zz", "_xy", "_yz", "_zx")


def arrays_of(field, present):
    """The arrays of the file that show a field of Output/Fields."""
    name = field.strip().replace(" ", "_")
    names = ARRAYS_OF_FIELDS.get(name, [name + component for component in COMPONENTS])
    found = [candidate for candidate in names if candidate in present]
    return found or [candidate for candidate in present if candidate.startswith(name + "_")]


def draw_fields(directory, fields, view, is_series):
    """[(file name, title)] of the pictures of fields; of all where the list is empty."""
    from body_picture import body_picture
    from run_data import Unreadable, read_body

    body, time = read_body(directory)
    wanted = {}
    for field in fields or list(body.fields):
        arrays = arrays_of(field, body.fields) if fields else [field]
        if not arrays:
            raise Unreadable(f"the run has not written the field {field.strip()}; it has {', '.join(body.fields)}")
        wanted.update(dict.fromkeys(arrays))
    written = []
    for array in wanted:
        name = f"picture_{array}.png"
        body_picture(directory / name, body, array, time, is_series, view)
        written.append((name, array.replace("_", " ")))
    return written


def main():
    parser = argparse.ArgumentParser(description="draws a run")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--fields", default="", help="fields to draw, with commas between; default: all that were written")
    parser.add_argument("--view", default="1, -2, 1", help="where a 3-D body is seen from: x, y, z; default: %(default)s")
    parser.add_argument("--report", action="store_true", help="write report.html too")
    arguments = parser.parse_args()
    try:
        from curves import write_curves
        from run_data import Unreadable, read_history, read_summary
        import vtkmodules.vtkIOXML
    except ImportError as error:
        print(error.name, file=sys.stderr)
        return 3
    directory = arguments.directory
    view = [float(word) for word in arguments.view.split(",")]
    fields = [field for field in arguments.fields.split(",") if field.strip()]
    try:
        if not directory.is_dir():
            raise Unreadable(f"there is no directory {directory}")
        summary, history = read_summary(directory), read_history(directory)
        if not summary and not history and not (directory / "solution.pvd").is_file():
            raise Unreadable(f"{directory} holds no results of a run")
        pictures = []
        if (directory / "solution.pvd").is_file():
            pictures = draw_fields(directory, fields, view, len(history.get("step", [])) > 1)
        curves = write_curves(directory, history)
        names = [name for name, _ in pictures + curves]
        if arguments.report:
            from report import write_report
            names.append(write_report(directory, summary, pictures, curves))
    except Unreadable as error:
        print(error, file=sys.stderr)
        return 4
    print("\n".join(names))
    return 0


if __name__ == "__main__":
    sys.exit(main())
