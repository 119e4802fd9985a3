#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages with commands, what these print, and files: brought up to date, or compared.

A block that begins with ```console holds commands, after "$ ", each with what it prints; a line "..." stands for lines that
are left out. Commands run one after the other, as a user types them in the top folder, in a copy of the folders prm and
meshes, so that what they write stays there. The block below a comment <!-- file: PATH --> holds that file.

Numbers before a unit of run time or memory do not count, others may differ by 2 %, small counts by 2.
"""

import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NUMBER = re.compile(r"(?<![\w.])[-+]?\d[\d,]*(?:\.\d+)?(?:[eE][-+]?\d+)?")
MEASURED = re.compile(r"(?<![\w.])\d[\d,.]*(?:e[-+]?\d+)? ?(?:s|ms|min|h|kB|MB|GB|bytes|seconds)\b")
CONSOLE = re.compile(r"```console\n(.*?)```", re.DOTALL)
EMBEDDED = re.compile(r"(<!-- file: (\S+) -->\n+```\w*\n)(.*?)(```)", re.DOTALL)
RELATIVE, SMALL_COUNT, ROUND_OFF = 0.02, 2, 1e-9


class Sandbox:
    """A folder with copies of prm, meshes and tests/scenes, and the build folder as "build"."""

    def __init__(self, program):
        self.program = Path(program).absolute()

    def __enter__(self):
        self.folder = Path(tempfile.mkdtemp(prefix="perideal-pages-"))
        for name in ("prm", "meshes", "tests/scenes", "tests/consumer"):
            shutil.copytree(ROOT / name, self.folder / name)
        (self.folder / "build").symlink_to(self.program.parent)
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.folder)

    def run(self, command):
        """(lines on stdout, exit status, lines on stderr) of a command."""
        environment = {**os.environ, "OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_MCA_mpi_yield_when_idle": "1",
                       "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1", "LC_ALL": "C.UTF-8"}
        done = subprocess.run(["bash", "-c", command], cwd=self.folder, env=environment, capture_output=True, check=False)
        # Progress is written over and over into one line.
        lines = [line.rstrip().split("\r")[-1].rstrip() for line in done.stdout.decode().split("\n")]
        return [line for line in lines if line], done.returncode, done.stderr.decode().splitlines()


def without_measurements(line):
    return MEASURED.sub("(measured)", line)


def skeleton(line):
    """A line without its numbers, and with single blanks."""
    return " ".join(NUMBER.sub("#", without_measurements(line)).split())


def numbers(line):
    return [float(text.replace(",", "")) for text in NUMBER.findall(without_measurements(line))]


def agree(a, b):
    close = abs(a - b) <= RELATIVE * max(abs(a), abs(b)) or max(abs(a), abs(b)) < ROUND_OFF
    counts = a == int(a) and b == int(b) and abs(a) < 1e9
    return close or counts and abs(a - b) <= SMALL_COUNT


def same(shown, printed):
    """Whether a shown line is what was printed, as far as that is to be the same everywhere."""
    if skeleton(shown) != skeleton(printed):
        return False
    return all(agree(a, b) for a, b in zip(numbers(shown), numbers(printed)))


def follow(shown, printed):
    """(the shown lines as they are printed now, deviations). Each is looked for behind the one before."""
    result, deviations, at = [], [], 0
    leaves_out = True
    for line in shown:
        if line.strip() == "...":
            result.append(line)
            leaves_out = True
            continue
        later = range(at, len(printed)) if leaves_out else range(at, min(at + 1, len(printed)))
        found = next((k for k in later if same(line, printed[k])), None)
        if found is None:
            found = next((k for k in later if skeleton(line) == skeleton(printed[k])), None)
            if found is None:
                deviations.append(f"is not printed: {line!r}; there is: {[printed[k] for k in later][:3]}")
                result.append(line)
                continue
            deviations.append(f"shows {line!r}, printed is {printed[found]!r}")
        result.append(printed[found])
        at, leaves_out = found + 1, False
    return result, deviations


def commands_of(block):
    """[(command, shown lines)] of a console block; a command goes on after a backslash, and until its quotes are closed."""
    result, continues = [], False
    for line in block.splitlines():
        if continues or line.startswith("$ "):
            if continues:
                result[-1][0] += "\n" + line
            else:
                result.append([line[2:], []])
            continues = line.endswith("\\") or result[-1][0].count('"') % 2 == 1
        else:
            result[-1][1].append(line)
    return result


def check_page(text, sandbox, say=lambda _: None):
    """(the text brought up to date, deviations) of one page."""
    deviations = []

    def console(match):
        lines = ["```console"]
        for command, shown in commands_of(match.group(1)):
            say(command)
            printed, status, complaints = sandbox.run(command)
            if status != 0:
                deviations.append(f"{command}: exit status {status}: {complaints[-3:]}")
            new, found = follow(shown, printed)
            deviations.extend(f"{command}: {what}" for what in found)
            lines += ["$ " + command, *new]
        return "\n".join(lines) + "\n```"

    def embedded(match):
        content = (ROOT / match.group(2)).read_text(encoding="utf-8")
        content = re.sub(r"\A(?:(?:#|//) SPDX[^\n]*\n)?", "", content)
        if content != match.group(3):
            deviations.append(f"{match.group(2)} is not what the page shows")
        return match.group(1) + content + match.group(4)

    text = EMBEDDED.sub(embedded, text)
    return CONSOLE.sub(console, text), deviations


def anchors(text):
    """Anchors of the headings of a page, as they are made by the sites that show it."""
    headings = re.findall(r"^#+ (.*)$", re.sub(r"```.*?```", "", text, flags=re.DOTALL), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-") for heading in headings}


def broken_links(page):
    """Relative links of a page that lead nowhere, as texts."""
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    found = []
    for link in re.findall(r"\]\(([^)\s]+)\)", text):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        if not target.exists():
            found.append(f"{page.relative_to(ROOT)}: {link} leads nowhere")
        elif anchor and anchor not in anchors(target.read_text(encoding="utf-8")):
            found.append(f"{page.relative_to(ROOT)}: {link} has no such heading")
    return found


def self_test():
    """Shows what is told apart and what is not."""
    good = [("solved 52 iterations in 3.1 s", "solved 53 iterations in 9 s"), ("error 3.787e-05", "error 3.79e-05"),
            ("mesh  7,680 quads", "mesh 7,680 quads"), ("1e-12", "3e-15"), ("memory 12 MB", "memory 80 MB")]
    bad = [("error 3.787e-05", "error 4.2e-05"), ("mesh 7,680 quads", "mesh 8,680 quads"), ("done", "failed"), ("1e-3", "2e-3")]
    wrong = [pair for pair in good if not same(*pair)] + [pair for pair in bad if same(*pair)]
    assert not wrong, wrong
    assert follow(["a 1", "...", "c 2"], ["a 1", "b", "c 2"]) == (["a 1", "...", "c 2"], [])
    assert follow(["a 1", "c 2"], ["a 1", "b", "c 2"])[1]
    assert follow(["c 3.5"], ["c 4.5"]) [0] == ["c 4.5"]
    assert commands_of('$ a "b\nc" d\ne\n') == [['a "b\nc" d', ["e"]]]
    assert commands_of("$ a \\\n  b\nout\n$ c\n") == [["a \\\n  b", ["out"]], ["c", []]]
