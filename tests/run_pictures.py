#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Holds pictures and reports to what a run has computed: PNGs that show something, figures in report.html.

    run_pictures.py --program build/perideal --scenes tests/scenes

Ends with exit status 77 where Debian's python3-vtk9 or python3-matplotlib are missing: ctest then skips the test.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import zlib
from html.parser import HTMLParser
from pathlib import Path

from checks import count_failures, expect
from execute import execute

SKIPPED = 77
MODULES = "vtkmodules.vtkIOXML, matplotlib, numpy"
SOLID = """set Dimension = 3
subsection Mesh
  set Generator = box
  set Cells = 8, 4, 4
  set Size = 2, 1, 1
end
subsection Material
  set Young modulus = 70e9
  set Poisson ratio = 0.3
end
subsection Boundary conditions
  subsection wall
    set Boundary = left
    set u_x = 0
    set u_y = 0
    set u_z = 0
  end
  subsection tip
    set Boundary = right
    set t_z = 1e6
  end
end
subsection Output
  set Fields = displacement, stress
end
"""
LACKING = "#!/bin/sh\necho vtkmodules >&2\nexit 3\n"


def pixels(path):
    """Rows of (red, green, blue) of a PNG of 8 bits a channel, and whether its end is there."""
    data = path.read_bytes()
    expect(data[:8] == b"\x89PNG\r\n\x1a\n", f"{path.name} is no PNG")
    at, packed, header = 8, b"", None
    while at < len(data):
        length, kind = int.from_bytes(data[at : at + 4], "big"), data[at + 4 : at + 8]
        body = data[at + 8 : at + 8 + length]
        header = body if kind == b"IHDR" else header
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    width, height, depth, colour = int.from_bytes(header[:4], "big"), int.from_bytes(header[4:8], "big"), header[8], header[9]
    expect(depth == 8 and colour in (2, 6), f"{path.name} has not 8 bits of red, green and blue")
    n = 4 if colour == 6 else 3
    raw, rows, above = zlib.decompress(packed), [], bytearray(width * n)
    for y in range(height):
        kind, line = raw[y * (width * n + 1)], bytearray(raw[y * (width * n + 1) + 1 : (y + 1) * (width * n + 1)])
        for x in range(len(line)):
            left, up, corner = line[x - n] if x >= n else 0, above[x], above[x - n] if x >= n else 0
            if kind == 4:
                near = left + up - corner
                distance = (abs(near - left), abs(near - up), abs(near - corner))
                predicted = (left, up, corner)[distance.index(min(distance))]
            else:
                predicted = (0, left, up, (left + up) // 2)[kind]
            line[x] = (line[x] + predicted) & 255
        rows.append([tuple(line[x : x + 3]) for x in range(0, len(line), n)])
        above = line
    return rows


def check_picture(path):
    """A body in colours on white ground: neither blank nor full, and what it shows is no single colour."""
    flat = [pixel for row in pixels(path) for pixel in row]
    white = sum(pixel == (255, 255, 255) for pixel in flat) / len(flat)
    coloured = {pixel for pixel in flat if max(pixel) - min(pixel) > 40}
    expect(0.2 < white < 0.97, f"{path.name}: {100 * white:.0f} % of it is white")
    expect(len(coloured) > 50, f"{path.name} has {len(coloured)} colours")
    return white


class Page(HTMLParser):
    """Text and references of a page."""

    def __init__(self, text):
        super().__init__()
        self.references, self.tags, self.words = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.references += [value for name, value in attrs if name in ("src", "href", "data", "srcset", "action")]

    def handle_data(self, data):
        self.words.append(data)


def dump_in_browser(browser, address):
    """(exit status, document after loading, messages) of a page in a browser without a window.

    The browser keeps a socket among its temporary files, whose path the system allows 108 characters: they stand in /tmp,
    not in the test's own folder, which may be deep.
    """
    with tempfile.TemporaryDirectory(prefix="page-", dir="/tmp", ignore_cleanup_errors=True) as own:
        return execute(["env", f"TMPDIR={own}", browser, "--headless", "--no-sandbox", "--disable-gpu",
                        "--disable-dev-shm-usage", f"--user-data-dir={own}/user", "--dump-dom", address], own, 120)


def check_in_browser(path, n_pictures):
    """Opens a report in a browser without a window, where there is one that starts: every picture is drawn."""
    browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if browser is None:
        return
    status, out, err = dump_in_browser(browser, "data:text/html,<title>starts</title>")
    if status != 0 or "<title>starts</title>" not in out:
        print(f"the report was not opened: {browser} does not start here:\n{err}")
        return
    count = "document.title = 'drawn ' + [...document.images].filter(i => i.naturalWidth > 100).length"
    counting = path.with_name("counting.html")
    counting.write_text(path.read_text(encoding="utf-8").replace(
        "</body>", f"<script>addEventListener('load', () => {{ {count}; }});</script></body>"), encoding="utf-8")
    status, out, err = dump_in_browser(browser, counting.resolve().as_uri())
    expect(status == 0 and f"<title>drawn {n_pictures}</title>" in out, f"the browser does not draw {n_pictures} pictures:\n{err}")


def check_report(directory, n_pictures, words):
    text = (directory / "report.html").read_text(encoding="utf-8")
    page = Page(text)
    expect(page.references and all(r.startswith("data:image/") for r in page.references), "the report refers to other files")
    expect(not {"script", "link", "iframe"} & set(page.tags) and "@import" not in text and "url(" not in text,
           "the report loads something")
    expect(sum(r.startswith("data:image/png;base64,") for r in page.references) == n_pictures,
           f"the report has not {n_pictures} pictures")
    content = " ".join(page.words)
    for word in words:
        expect(word in content, f"the report does not say {word!r}")
    check_in_browser(directory / "report.html", len(page.references))


class Bench:
    """Runs the program in a folder of its own."""

    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def run(self, *arguments, status=0, python=None):
        command = [self.program, *arguments]
        if python:
            command = ["env", f"PERIDEAL_PYTHON={python}", *command]
        code, out, err = execute(command, self.folder)
        expect(code == status, f"{' '.join(arguments)}: exit status {code}, not {status}\n{out}{err}")
        return out + err


def plate(bench, scenes):
    """Pictures and report of a run that compares with finite elements."""
    out = bench.run(str(scenes / "plate_small.prm"), "--set", "Output directory=plate", "--set", "Output/Pictures=displacement, von mises",
                    "--set", "Output/Report=true")
    expect("pictures    picture_displacement.png, picture_von_mises_stress.png, report.html" in out, f"does not name its pictures:\n{out}")
    directory = bench.folder / "plate"
    for name in ("picture_displacement.png", "picture_von_mises_stress.png"):
        check_picture(directory / name)
    summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
    expect(summary["changed_from"]["Material/Form"] == "automatic", "summary.json does not tell the default of a changed parameter")
    check_report(directory, 2, [f"{summary['nodes']:,}", f"{summary['errors']['fem']['l2']:.4g}", f"{summary['energy']['strain']:.4g}",
                                f"{summary['seconds']['total']:.4g}", "Material/Form", "energy", "Mesh/Cells", "15, 16", "plate_small.prm",
                                *summary["warnings"]])


def plot(bench, scenes):
    """Pictures of a run that made none, from outside; as many as it has fields."""
    bench.run(str(scenes / "plate_small.prm"), "--set", "Output directory=later", "--set", "Output/Fields=displacement, strain")
    directory = bench.folder / "later"
    expect(not list(directory.glob("*.png")), "a run draws what it was not asked for")
    out = bench.run("--plot", "later")
    for name in ("displacement", "strain_xx", "strain_yy", "strain_zz", "strain_xy"):
        expect(f"picture_{name}.png" in out, f"--plot does not draw {name}:\n{out}")
    check_picture(directory / "picture_strain_xx.png")
    check_report(directory, 5, ["displacement", "strain xx"])
    out = bench.run("--plot", "later", "--set", "Output/Pictures=velocity", status=1)
    expect("has not written the field velocity" in out and "strain_xx" in out, f"says not what there is:\n{out}")
    out = bench.run("--plot", "later", "--set", "Output/Frames=3", status=1)
    expect("Frames" in out and "Pictures" in out, f"takes a parameter that it has no use for:\n{out}")


def solid(bench, _):
    """The surface of a body, from two sides."""
    (bench.folder / "solid.prm").write_text(SOLID, encoding="utf-8")
    bench.run("solid.prm", "--set", "Output directory=solid", "--set", "Output/Pictures=displacement")
    picture = bench.folder / "solid" / "picture_displacement.png"
    check_picture(picture)
    first = picture.read_bytes()
    bench.run("--plot", "solid")
    expect(picture.read_bytes() == first, "the same run has another picture")
    bench.run("--plot", "solid", "--set", "Output/View=-1, 0, 0")
    check_picture(picture)
    expect(picture.read_bytes() != first, "another view shows the same")


def curves(bench, scenes):
    """Load over displacement of load steps."""
    out = bench.run(str(scenes / "plate_small.prm"), "--set", "Output directory=steps", "--set", "Output/Report=true",
                    "--set", "Solver/Load steps=3", "--set", "Boundary conditions/right/u_x=1e-3*t")
    expect("curve_load.svg" in out, f"draws no load over displacement:\n{out}")
    text = (bench.folder / "steps" / "curve_load.svg").read_text(encoding="utf-8")
    expect("<path" in text and "displacement [m]" in text and "reaction [N]" in text, "the curve is none")
    expect("data:image/svg+xml;base64," in (bench.folder / "steps" / "report.html").read_text(encoding="utf-8"), "no curve in the report")


def missing_modules(bench, scenes):
    """One clear line, and a run that is done all the same."""
    python = bench.folder / "python"
    python.write_text(LACKING, encoding="utf-8")
    python.chmod(0o755)
    for interpreter in (python, "absent/python"):
        out = bench.run(str(scenes / "plate_small.prm"), "--set", "Output directory=bare", "--set", "Output/Pictures=displacement", python=interpreter)
        lines = [line for line in out.splitlines() if line.startswith("pictures ")]
        expect(len(lines) == 1 and "apt-get install python3-vtk9 python3-matplotlib" in lines[0], f"says not what is missing:\n{out}")
        out = bench.run("--plot", "bare", python=interpreter, status=2)
        expect("apt-get install python3-vtk9 python3-matplotlib" in out, f"says not what is missing:\n{out}")
        expect(not (bench.folder / "bare" / "report.html").exists(), "a report without the means for it")


def main():
    parser = argparse.ArgumentParser(description="draws runs and looks at the pictures")
    parser.add_argument("--program", required=True, type=os.path.abspath)
    parser.add_argument("--scenes", required=True, type=lambda name: Path(name).resolve())
    arguments = parser.parse_args()
    found = subprocess.run(["/usr/bin/python3", "-c", f"import {MODULES}"], capture_output=True, check=False) \
        if Path("/usr/bin/python3").exists() else None
    draws = found is not None and found.returncode == 0
    tests = (missing_modules, plate, plot, solid, curves) if draws else (missing_modules,)
    n_failed = count_failures([(test.__doc__, lambda path, test=test: test(Bench(arguments.program, path), arguments.scenes)) for test in tests])
    if not draws:
        print("skipped: /usr/bin/python3 lacks vtk, matplotlib or numpy: apt-get install python3-vtk9 python3-matplotlib python3-numpy")
    return 1 if n_failed else 0 if draws else SKIPPED


if __name__ == "__main__":
    sys.exit(main())
