# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cracks that run: where they branch or turn to, how fast, and what they dissipate."""

from cracks import MODELS
from page import Row, judged
from scenes import slope

# By name, the models and horizons whose cracks branch.
BRANCHING = {**{f"{model}, horizon 3.01": settings for model, settings in MODELS.items()},
             **{f"{model}, horizon 5.01": [*MODELS[model], "Nodes/Horizon factor=5.01"]
                for model in ("energy form", "springs")}}
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
