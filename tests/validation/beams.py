# SPDX-License-Identifier: LGPL-2.1-or-later
"""Notched beams of concrete in three-point bending: peak and tail of one, and how strength falls with size."""

import csv
import importlib.util

from page import Row, judged
from scenes import HERE, Failed, at, peak

FOLDER = HERE / "three_point_bending"
SOURCE = "Gregoire et al. 2013"


def three_point_bending(runner, long):
    """Beams of 50 mm by softening and mesh, and of 50 to 400 mm in cells of one size, beside cohesive cracks."""
    spec = importlib.util.spec_from_file_location("cohesive_crack", FOLDER / "cohesive_crack.py")
    cohesive_crack = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(cohesive_crack)

    def reference(depth, law):
        """Peak [N], its opening [m] and the load at 100 um [N] of a cohesive crack with the same constants."""
        openings, loads = cohesive_crack.curve(cohesive_crack.Beam(depth=depth, rows=100, law=law))
        place, most = peak(openings, loads)
        return most, place, at(openings, loads, 1e-4)

    rows = []
    for law in ("bilinear", "exponential"):
        most, place, tail = reference(.05, law)
        for n_rows in (18, 30, *([50] if long and law == "bilinear" else [])):
            mesh = f"{law}, {50 / n_rows:.2f} mm"
            try:
                mouth, load = bend(runner, .05, n_rows, law)
            except Failed as failure:
                rows.append(Row("notched beam", SOURCE, mesh, "a run to its end", "", str(failure), "no"))
                continue
            (opening, largest), end = peak(mouth, load), at(mouth, load, 1e-4)
            for figure, asked, read, within in (
                    ("peak [N]", "933-1,114", f"{largest:.0f}", judged([largest], 933, 1114)),
                    ("opening at the peak [um]", "18-23", f"{1e6 * opening:.1f}", judged([1e6 * opening], 18, 23)),
                    ("load at 100 um [N]", "380-644", f"{end:.0f}", judged([end], 380, 644)),
                    ("peak over that of a cohesive crack of these constants", "1.00 +- .05",
                     f"{largest / most:.3f} ({most:.0f} N at {1e6 * place:.1f} um)", judged([largest / most], .95, 1.05)),
                    ("load at 100 um over that of a cohesive crack", "1.00 +- .05", f"{end / tail:.3f} ({tail:.0f} N)",
                     judged([end / tail], .95, 1.05))):
                rows.append(Row("notched beam", SOURCE, mesh, figure, asked, read, within))
    return rows + size_effect(runner, long, reference)


def size_effect(runner, long, reference):
    """Peaks of beams of several depths over those of cohesive cracks, and their distance from Bazant's law."""
    sizes = []
    for depth, n_rows in ((.05, 18), (.1, 38), (.2, 74), *([(.4, 146)] if long else [])):
        _, largest = peak(*bend(runner, depth, n_rows, "bilinear"))
        sizes.append((depth, largest, reference(depth, "bilinear")[0]))
    # Of bending without a notch, with the whole depth: 1.5 P S/(b D^2), S = 2.5 D.
    nominal = [3.75 * largest / (.05 * depth) for depth, largest, _ in sizes]
    # 1/s^2 = (1 + D/D_0)/(B f_t)^2 is a line over D.
    depths, squares = [depth for depth, _, _ in sizes], [1 / stress**2 for stress in nominal]
    middle, height = sum(depths) / len(sizes), sum(squares) / len(sizes)
    rise = (sum((x - middle) * (y - height) for x, y in zip(depths, squares)) /
            sum((x - middle)**2 for x in depths))
    of_law = [(height + rise * (depth - middle))**-.5 for depth in depths]
    with (runner.output / "size_effect.csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("depth [m]", "nominal stress [Pa]", "cohesive crack [Pa]", "Bazant's law [Pa]"))
        writer.writerows((depth, stress, 3.75 * most / (.05 * depth), law)
                         for (depth, _, most), stress, law in zip(sizes, nominal, of_law))
    runner.draw(FOLDER / "plot_size_effect.sh", runner.output)
    ratios = [largest / most for _, largest, most in sizes]
    apart = [abs(stress / law - 1) for stress, law in zip(nominal, of_law)]
    mesh = f"bilinear, depths {', '.join(f'{1e3 * depth:.0f}' for depth in depths)} mm, cells of 2.7 mm"
    return [Row("notched beam", SOURCE, mesh, "peaks [N]", "", ", ".join(f"{largest:.0f}" for _, largest, _ in sizes)),
            Row("notched beam", SOURCE, mesh, "peaks over those of a cohesive crack", "1.00 +- .05",
                ", ".join(f"{ratio:.3f}" for ratio in ratios), judged(ratios, .95, 1.05)),
            Row("notched beam", "Bazant 1984", mesh, "strength apart from the law of size effect by up to", "",
                f"{100 * max(apart):.1f} %; D_0 = {1e3 * (height / rise - middle):.0f} mm")]


def bend(runner, depth, n_rows, law):
    """Openings of the mouth [m] and loads [N] of a beam, in load steps of 2 um."""
    name = f"beam_{1e3 * depth:.0f}_{n_rows}"
    mesh = runner.mesh("three_point_bending/beam.geo", name, Depth=depth, Rows=n_rows)
    # Larger beams bear most at wider openings.
    end = 1.1e-4 if depth < .4 else 1.6e-4
    support, notch = 1.25 * depth, depth / 2
    run = runner.run("three_point_bending/beam.prm", f"beam/{law} {name}",
                     [f"Mesh/File={mesh}", f"Material/Softening={law}", f"Solver/Control end={end}",
                      f"Solver/Load steps={round(end / 2e-6)}", f"Precracks/notch/Points=0, 0; 0, {notch}",
                      f"Cracks/notch/Origin=0, {notch}",
                      f"No-fail zones/left support/Box={-support - .01}, 0; {-support + .01}, .01",
                      f"No-fail zones/right support/Box={support - .01}, 0; {support + .01}, .01"])
    runner.plot("plot_reaction.sh", run, "load", "y", "mouth")
    return run.column("elongation of mouth"), [-force for force in run.column("reaction of load along y")]
