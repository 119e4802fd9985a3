# SPDX-License-Identifier: LGPL-2.1-or-later
"""Vibrations whose frequency free surfaces decide."""

from cracks import MODELS
from page import Row, judged

FORMS = {"consistent form": [], "energy form": MODELS["energy form"]}
# Over sqrt(G/rho), for nu = 1/4.
RAYLEIGH = .9194017


def frequency(run):
    """Of a vibration that begins where its gauge has no elongation, from the last time at which it has none again [1/s]."""
    times, values = run.column("time"), run.column("elongation")
    passed = [t0 - u0 * (t1 - t0) / (u1 - u0) for t0, t1, u0, u1 in zip(times, times[1:], values, values[1:]) if u0 * u1 < 0]
    return .5 * len(passed) / passed[-1]


def waves(runner, long):
    """A standing Rayleigh wave of 12 and 24 cells a wavelength, and the lowest vibration of a bar 4 cells wide."""
    rows = []
    for form, settings in FORMS.items():
        for cells, asked in ((12, .005), (24, .0015)):
            run = runner.run("waves/rayleigh.prm", f"waves/rayleigh {form} {cells}",
                             [*settings, f"Mesh/Cells={cells // 2}, {3 * cells}"])
            off = frequency(run) / RAYLEIGH - 1
            rows.append(Row("Rayleigh wave", "Rayleigh 1885", f"{form}, {cells} cells a wavelength", "speed over exact, less one",
                            f"+- {100 * asked:g} %", f"{100 * off:.3f} %", judged([off], -asked, asked)))
        run = runner.run("waves/bar.prm", f"waves/bar {form}", settings)
        off = 4 * frequency(run) - 1
        rows.append(Row("vibrating bar", "Love 1927", f"{form}, 80 x 4 cells", "frequency over exact, less one", "+- 0.1 %",
                        f"{100 * off:.3f} %", judged([off], -.001, .001)))
    return rows
