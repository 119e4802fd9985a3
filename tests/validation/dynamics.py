# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cracks that run: where they branch or turn to, how fast, and what they dissipate."""

from cracks import MODELS
from page import Row, judged
from scenes import slope

# By name, the models and horizons whose cracks branch.
BRANCHING = {**{f"{model}, horizon 3.01": settings for model, settings in MODELS.items()},
             **{f"{model}, horizon 5.01": [*MODELS[model], "Nodes/Horizon factor=5.01"]
                for model in ("energy form", "springs")},
             "consistent form, horizon 5.01": ["Material/Model=extended ordinary", "Material/Form=consistent",
                                               "Nodes/Horizon factor=5.01"]}
# Speed of Rayleigh waves of branching/branching.prm [m/s].
RAYLEIGH = 2119


def fastest(times, reach, way):
    """The largest speed over a way [m/s]."""
    speeds = []
    for time, start in zip(times, reach):
        later = next((k for k, length in enumerate(reach) if length >= start + way), None)
        if later is not None and times[later] > time:
            speeds.append((reach[later] - start) / (times[later] - time))
    return max(speeds)


def branching(runner, long):
    """The plate of Borden et al.: place of the branches, speed before, and energy of the straight part, on two meshes."""
    source, rows = "Borden et al. 2012", []
    for model, settings in BRANCHING.items():
        places = {}
        for columns in (200, 400, *([800] if long and "3.01" in model else [])):
            size = 100 / columns
            mesh = f"{model}, {size:g} mm"
            run = runner.run("branching/branching.prm", f"branching/{model} {columns}",
                             [*settings, f"Mesh/Cells={columns}, {columns * 2 // 5}"])
            branches = run.summary["cracks"]["crack"]["branching"]
            if branches:
                places[size] = 1e3 * branches["reach"] + 50
            # Well before any branches, and before cracks widen that try to.
            reach, dissipated = run.column("reach of"), run.column("dissipated energy [J]")
            straight = [k for k, length in enumerate(reach) if .0015 <= length <= .01]
            early = [k for k, length in enumerate(reach) if length <= .022]
            speed = fastest([run.column("time")[k] for k in early], [reach[k] for k in early], .004) / RAYLEIGH
            taken = slope([reach[k] for k in straight], [dissipated[k] for k in straight]) / 3
            for figure, asked, read, within in (
                    ("branches: number, from x [mm] on, at [us], over [degrees]", "2",
                     f"{branches['branches']}, {places[size]:.1f}, {1e6 * branches['time']:.1f}, {branches['full_angle']:.0f}"
                     if branches else "none", judged([branches["branches"] if branches else 0], 2, 2)),
                    ("largest speed over 4 mm, before x = 72 mm, over that of Rayleigh waves", "< 0.6", f"{speed:.2f}", judged([speed], 0, .6)),
                    ("dissipated over G0 times new length, straight on", "1.00 +- .05", f"{taken:.3f}",
                     judged([taken], .95, 1.05))):
                rows.append(Row("branching", source, mesh, figure, asked, read, within))
        apart = [abs(places[.5] - places[.25])] if {.5, .25} <= places.keys() else [None]
        rows.append(Row("branching", source, f"{model}, 0.5 and 0.25 mm", "places of the branches apart by", "<= 3 mm",
                        "no branches on one or both" if apart[0] is None else f"{apart[0]:.1f} mm", judged(apart, 0, 3)))
    return rows


def kalthoff(runner, long):
    """The plate of Kalthoff and Winkler, with bonds that break at once, by the published stretch, and that soften."""
    source, rows = "Kalthoff and Winkler 1987", []
    for model in ("energy form", "ordinary", "springs"):
        for softening in ("none", "linear"):
            for refinements in (1, *([2] if long else [])):
                run = runner.run("../../prm/examples/kalthoff_winkler.prm", f"kalthoff/{model} {softening} {refinements}",
                                 [*MODELS[model], f"Material/Softening={softening}", f"Mesh/Refinements={refinements}",
                                  f"Solver/Time step={160e-9 / 2**refinements}"])
                mesh = f"{model}, {'brittle bonds' if softening == 'none' else 'softening'}, {2.5 / 2**refinements:g} mm"
                lower, upper, rear = (run.summary["cracks"][name] for name in ("lower", "upper", "rear"))
                angles = [lower["angle"], upper["angle"]]
                arrivals = ", ".join(f"{1e6 * time:.1f}" for time in lower["arrivals"] if time is not None)
                drift = run.summary["energy"]["drift"]
                for figure, asked, told, within in (
                        ("angle of the cracks [degrees]", "66-70", ", ".join(f"{angle:.1f}" for angle in angles),
                         judged(angles, 66, 70)),
                        ("damage from [us] on; tip at 20, 40 mm [us]; speed [m/s]", "",
                         f"{1e6 * lower['first_time']:.1f}; {arrivals}; {lower['speed']:.0f}", "-"),
                        ("damage at the rear from [us] on", "",
                         f"{1e6 * rear['first_time']:.1f}" if rear["first_time"] is not None else "none", "-"),
                        ("error of the energy over the work", "<= 1e-3", f"{drift:.1e}", judged([abs(drift)], 0, 1e-3))):
                    rows.append(Row("Kalthoff and Winkler", source, mesh, figure, asked, told, within))
    return rows
