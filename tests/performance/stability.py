#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the models stop working: runs that vary one thing until it is absurd, each with a figure and a verdict.

    stability.py --program build/perideal                                     # all; stability.csv and the page's table
    stability.py --program build/perideal --studies "aspect ratio" noise --no-page
    stability.py --program build/perideal --quick --no-page                   # what ctest performance_stability runs

Verdicts are computed: ok: the figure is within its bound; warned: it is not, and the run named the trouble; refused:
exit 1 with a message; stopped: exit 2 with a message. All else fails: crash (a signal, another exit status, no message,
an internal error), silent (a wrong answer without a word), hangs, and any of these where the study asks for another one.
Exit status 1 when a run fails. Times mean nothing here.
"""

import argparse
import math
import re
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import runs
import stability_cases
import stability_loads
import stability_motion
import stability_spectrum


STUDIES = stability_cases.STUDIES + stability_loads.STUDIES + stability_motion.STUDIES
FAILURES = ("crash", "silent", "hangs", "not as asked")
ROUGH = 0.2  # error of a base case that any model stays below
LIMIT = 300  # seconds a run, on a machine that is busy


@dataclass
class Row:
    """What came out of a case."""
    study: str
    case: object
    verdict: str
    figure: float | None
    bound: float
    says: str

    def fails(self):
        return self.verdict in FAILURES or self.verdict.startswith("not as asked")


def judge(case, run, figure, bound):
    """The verdict on a run and what the program said of the trouble."""
    if run.status is None:
        return "hangs", run.output
    if run.status in (1, 2):
        word = {1: "input error:", 2: "computation failed:"}[run.status]
        lines = [line for line in run.output.splitlines() if word in line]
        if not lines:
            return "crash", run.message()
        said = lines[0].split(word, 1)[1].strip()
        return {1: "refused", 2: "stopped"}[run.status], re.sub(r"^\S+\.prm: ", "", said)
    if run.status != 0:
        return "crash", f"exit status {run.status}: {run.message()}"
    if figure <= bound:  # not so of NaN
        return "ok", ""
    named = [line for word in case.words for line in run.warnings() if word in line]
    return ("warned", named[0].removeprefix("warning").strip()) if named else ("silent", "")


def run_case(options, study, case, bases):
    """The row of a case; its run becomes the base of its model when it is one."""
    run = runs.run(options, case.scene, case.settings, timeout=LIMIT, may_fail=True)
    base_run, base_figure = bases.get(case.model, (run, 0.))
    figure = None
    if run.status == 0:
        try:
            figure = float((case.figure or study.figure)(run, base_run))
        except TypeError:  # summaries have null where a number is not finite
            figure = math.nan
    if case.base:
        bases[case.model] = (run, figure if figure is not None else math.nan)
        base_figure = bases[case.model][1]
    bound = max(case.bound, ROUGH if case.base and case.growth else case.growth * base_figure)
    if case.beside_fem and run.status == 0:
        bound = max(bound, 2 * run.summary["errors"]["fem"]["own error against exact"]["l2"])
    verdict, says = judge(case, run, figure, bound)
    if case.must and verdict not in case.must and verdict not in FAILURES:
        verdict, says = f"not as asked: {verdict}", says or f"asked for: {', '.join(case.must)}"
    return Row(study.name, case, verdict, figure, bound, says)


def run_study(options, study):
    """The rows of a study, in its own order; base cases run first."""
    cases = [case for case in study.cases(options) if case.quick or not options.quick]
    bases, rows = {}, {}
    for case in sorted(cases, key=lambda case: not case.base):
        row = rows[id(case)] = run_case(options, study, case, bases)
        text = "-" if row.figure is None else f"{row.figure:.2e}"
        print(f"{study.name}: {case.value}, {case.model}: {text}, {row.verdict} {row.says}".rstrip(), flush=True)
    return [rows[id(case)] for case in cases]


def ranges(rows):
    """Neighbouring rows of one model with the same verdict: (model, first value, last value, verdict) -> rows."""
    result = {}
    previous = None
    for row in rows:
        key = (row.case.model, row.verdict)
        if key != previous:
            group = result[len(result)] = []
        group.append(row)
        previous = key
    return list(result.values())


def summarise(rows):
    """Lines of the page: what was varied, over which values, verdict, models with their worst figures, what is said."""
    lines = {}
    for model in dict.fromkeys(row.case.model for row in rows):
        for part in ranges([row for row in rows if row.case.model == model]):
            values = part[0].case.value if len(part) == 1 else f"{part[0].case.value} … {part[-1].case.value}"
            figures = [row.figure for row in part if row.figure is not None]
            text = model + (f" {max(figures):.1e}" if figures else "")
            says = sorted({row.says for row in part if row.says}, key=len)
            models, said = lines.setdefault((values, part[0].verdict), ([], []))
            models.append(text)
            said += [text for text in says if text not in said]
    for (values, verdict), (models, said) in lines.items():
        yield [rows[0].study, values, verdict, ", ".join(models), shortened(said[0]) if said else ""]


def shortened(text, length=110):
    text = text.replace("|", "/")
    return text if len(text) <= length else text[:length].rsplit(" ", 1)[0] + " …"


def page(all_rows, studies):
    """The section of the page."""
    lines = [line for study in studies for line in summarise([row for row in all_rows if row.study == study.name])]
    table = runs.markdown_table(["study", "values", "verdict", "models and their worst figure", "what the program says"], lines)
    bounds = runs.markdown_table(["study", "figure", "bound"],
                                 [[study.name, study.measures, study.why] for study in studies])
    return f"{table}\n\nWhat is ok, by study:\n\n{bounds}"


def main():
    names = [study.name for study in STUDIES]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    runs.add_arguments(parser, repeat=None)
    parser.add_argument("--spectrum", help="performance_spectrum; default: where the build has it beside the program")
    parser.add_argument("--studies", nargs="+", choices=[*names, "eigenvalues"], metavar="NAME", default=[*names, "eigenvalues"],
                        help="of " + ", ".join([*names, "eigenvalues"]))
    parser.add_argument("--quick", action="store_true", help="a few cases of each study, no eigenvalues")
    parser.add_argument("--output", type=Path, default=Path(__file__).resolve().parent / "results",
                        help="directory of stability.csv")
    parser.add_argument("--no-page", action="store_true", help="leave the page as it is")
    options = parser.parse_args()
    studies = [study for study in STUDIES if study.name in options.studies]
    with tempfile.TemporaryDirectory() as options.folder:
        rows = [row for study in studies for row in run_study(options, study)]
    # Unit tests have the eigenvalues that a quick look would ask for.
    if "eigenvalues" in options.studies and not options.quick:
        studies.append(stability_spectrum.STUDY)
        rows += stability_spectrum.rows(options, Row)
    options.output.mkdir(parents=True, exist_ok=True)
    runs.write_csv(options.output / "stability.csv",
                   ["study", "value", "model", "figure", "bound", "verdict", "says"],
                   [[row.study, row.case.value, row.case.model, "" if row.figure is None else f"{row.figure:.6g}",
                     f"{row.bound:.6g}", row.verdict, row.says] for row in rows])
    text = page(rows, studies)
    print(text)
    if not options.no_page:
        runs.replace_section("stability", text)
    failed = [row for row in rows if row.fails()]
    for row in failed:
        print(f"FAILS {row.study}: {row.case.value}, {row.case.model}: {row.verdict} {row.says}")
    print(f"{len(rows)} runs, {len(failed)} fail")
    return 1 if failed or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
