# SPDX-License-Identifier: LGPL-2.1-or-later
"""Specimens of concrete, with a strength and a fracture energy: held against experiments."""

from cracks import MODELS
from page import Row, judged
from scenes import Failed, at, peak


def bar(runner, _):
    """The largest stress of a bar over the tensile strength, gripped at its ends or in collars of its own strain."""
    rows = []
    collars = ["Boundary conditions/Layers=4",
               "Boundary conditions/left/u_x=3e-4*t*x", "Boundary conditions/right/u_x=3e-4*t*x"]
    for model, settings in MODELS.items():
        for grips, more in (("gripped at the ends", []), ("in collars of a horizon", collars)):
            strengths = []
            for columns in (20, 40, 80):
                run = runner.run("bar/bar.prm", f"bar/{model} {grips} {columns}",
                                 [f"Mesh/Cells={columns}, {columns // 2}", *settings, *more])
                strengths.append(max(run.column("reaction of right along x")) / .05 / 3.9e6)
            rows.append(Row("bar in tension", "definition of f_t", f"{model}; 20, 40, 80 cells; {grips}",
                            "largest stress over f_t", "1.00 +- .05",
                            ", ".join(f"{strength:.3f}" for strength in strengths), judged(strengths, .95, 1.05)))
    return rows


def l_panel(runner, long):
    """The L-shaped panel: peak and tail by model, mesh and fracture energy, and how far apart the meshes are."""
    rows = []
    for model in ("energy form", "springs"):
        for energy in (90, 65):
            peaks = []
            for size in (20, 10, *([5] if long else [])):
                mesh = f"{model}, {size} mm, G_f {energy} J/m^2"
                name = f"l_panel/{model} {size} {energy}"
                file = runner.mesh("../../meshes/l_panel.geo", f"l_panel_{size}", Size=1e-3 * size)
                try:
                    run = runner.run("l_panel/l_panel.prm", name, [*MODELS[model], f"Mesh/File={file}",
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
