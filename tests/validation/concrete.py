# SPDX-License-Identifier: LGPL-2.1-or-later
"""Specimens of concrete, with a strength and a fracture energy: held against experiments."""

from math import asin, pi

from cracks import ALONG_LOAD_STEPS, DEFAULT
from page import Row, judged
from scenes import Failed, at, peak

# Bonds of the zone in the consistent form, which a stress starts.
BY_STRESS = ["Material/Model=correspondence", "Material/Form=automatic", "Material/Compressive strength=30e6"]
CRITERIA = ("maximum tensile stress", "Mohr-Coulomb", "Drucker-Prager")


def bar(runner, _):
    """The largest stress of a bar over the tensile strength, gripped at its ends or in collars of its own strain."""
    rows = []
    collars = ["Boundary conditions/Layers=4",
               "Boundary conditions/left/u_x=3e-4*t*x", "Boundary conditions/right/u_x=3e-4*t*x"]
    for model, settings in ALONG_LOAD_STEPS.items():
        for grips, more in (("gripped at the ends", []), ("in collars of a horizon", collars)):
            # The consistent form is held at faces, not in layers.
            if model == DEFAULT and more:
                continue
            strengths = []
            for columns in (20, 40, 80):
                run = runner.run("bar/bar.prm", f"bar/{model} {grips} {columns}",
                                 [f"Mesh/Cells={columns}, {columns // 2}", *settings, *more])
                strengths.append(max(run.column("reaction of right along x")) / .05 / 3.9e6)
            rows.append(Row("bar in tension", "definition of f_t", f"{model}; 20, 40, 80 cells; {grips}",
                            "largest stress over f_t", "1.00 +- .05",
                            ", ".join(f"{strength:.3f}" for strength in strengths), judged(strengths, .95, 1.05)))
    return rows


def brazilian_disc(runner, long):
    """The strength that the splitting test of a disc would tell, over that of the material, by model and mesh."""
    rows = []
    for model in ("energy form", "springs", DEFAULT):
        for size in (3.75, *([1.875] if long else [])):
            mesh = f"{model}, {size} mm"
            file = runner.mesh("brazilian_disc/disc.geo", f"disc_{size}", Size=1e-3 * size)
            try:
                run = runner.run("brazilian_disc/disc.prm", f"disc/{model} {size}", [*ALONG_LOAD_STEPS[model], f"Mesh/File={file}"])
            except Failed as failure:
                rows.append(Row("Brazilian disc", "ASTM C496; Tang 1994", mesh, "a run to its end", "", str(failure), "no"))
                continue
            # t = 1 is 100 MPa on the arc under a strip of a sixth of the diameter.
            place, most = peak(run.column("elongation of"), run.column("time"))
            force = 1e8 * most * 2 * asin(1 / 6) * .075
            nominal = 2 * force / (pi * .15) / 3.9e6
            strength = nominal * (1 - 1 / 36)**1.5
            for figure, asked, read, within in (
                    ("2 P/(pi D L) over f_t", "", f"{nominal:.3f} ({1e-3 * force:.0f} kN/m at {1e6 * place:.1f} um)", "-"),
                    ("the same, corrected for the strips", "1.00 +- .05", f"{strength:.3f}", judged([strength], .95, 1.05))):
                rows.append(Row("Brazilian disc", "ASTM C496; Tang 1994", mesh, figure, asked, read, within))
    return rows


def settings_of(model):
    return ALONG_LOAD_STEPS[model] if model in ALONG_LOAD_STEPS else [*BY_STRESS, f"Material/Failure criterion={model}"]


def stress_onset(runner, long):
    """Bonds that a stress starts: the strength of a bar, by criterion and mesh, and the L-shaped panel."""
    rows = []
    for criterion in CRITERIA:
        strengths = []
        for columns in (20, 40):
            run = runner.run("bar/bar.prm", f"bar/{criterion} {columns}",
                             [f"Mesh/Cells={columns}, {columns // 2}", *settings_of(criterion)])
            strengths.append(max(run.column("reaction of right along x")) / .05 / 3.9e6)
        rows.append(Row("bar in tension", "definition of f_t", f"{criterion}; 20, 40 cells", "largest stress over f_t",
                        "1.00 +- .05", ", ".join(f"{strength:.3f}" for strength in strengths),
                        judged(strengths, .95, 1.05)))
    return rows + l_panel(runner, long, CRITERIA[:2])


def l_panel(runner, long, models=("energy form", "springs", DEFAULT)):
    """The L-shaped panel: peak and tail by model, mesh and fracture energy, and how far apart the meshes are."""
    rows = []
    for model in models:
        for energy in (90, 65):
            peaks = []
            for size in (20, 10, *([5] if long else [])):
                mesh = f"{model}, {size} mm, G_f {energy} J/m^2"
                name = f"l_panel/{model} {size} {energy}"
                file = runner.mesh("../../meshes/l_panel.geo", f"l_panel_{size}", Size=1e-3 * size)
                try:
                    run = runner.run("l_panel/l_panel.prm", name, [*settings_of(model), f"Mesh/File={file}",
                                                                   f"Material/Fracture energy={energy}"])
                except Failed as failure:
                    rows.append(Row("L-panel", "Winkler et al. 2004", mesh, "a run to its end", "", str(failure), "no"))
                    continue
                runner.plot("plot_reaction.sh", run, "load", "y")
                moved, load = run.column("displacement of load along y"), run.column("reaction of load along y")
                place, most = peak(moved, load)
                peaks.append(most)
                rows.append(Row("L-panel", "Winkler et al. 2004", mesh, "peak", "7.22 kN +- 5 %",
                                f"{1e-3 * most:.2f} kN", judged([most], .95 * 7219, 1.05 * 7219)))
                for figure, asked, read in (
                        ("at [mm]", "published .208", f"{1e3 * place:.3f}"),
                        ("load at .40 mm, at 1.0 mm [kN]", "published 3.53, 1.04",
                         f"{1e-3 * at(moved, load, 4e-4):.2f}, {1e-3 * load[-1]:.2f}")):
                    rows.append(Row("L-panel", "Winkler et al. 2004", mesh, figure, asked, read))
            if len(peaks) > 1:
                apart = max(peaks) / min(peaks) - 1
                rows.append(Row("L-panel", "Winkler et al. 2004", f"{model}, all, G_f {energy} J/m^2",
                                "peaks of the meshes apart by", "<= 3 %", f"{100 * apart:.1f} %", judged([apart], 0, .03)))
    return rows
