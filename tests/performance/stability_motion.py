# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cases of stability.py in dynamics: time steps, many steps, noise, spin, bonds that all break."""

import itertools
import math

import runs
from stability_cases import GOOD, MODELS, SQUARE, Case, Study

MOVING = {name: MODELS[name] for name in ("bond based", "ordinary", "energy", "paper", "tensor involved")}
WAVE_SPEED = 1e3  # sqrt(E/rho) of the scene, m/s


def velocities(v_x, v_y):
    return [f"Initial conditions/v_x={v_x}", f"Initial conditions/v_y={v_y}"]


def stable_step(options, settings):
    """The largest stable time step of a model."""
    if settings is None:
        return None
    key = tuple(settings)
    known = options.__dict__.setdefault("stable_steps", {})
    if key not in known:
        run = runs.run(options, SQUARE, [*settings, "Solver/Name=dynamics", "Solver/End time=1e-9"])
        known[key] = run.summary["solver"]["stable_time_step"]
    return known[key]


def motion(options, model, cells, share, steps, rows=100):
    """Settings of a free square that moves in steps of a share of the largest stable one."""
    body = [*MOVING[model], f"Mesh/Cells={cells}, {cells}"]
    step = share * stable_step(options, body)
    return [*body, "Solver/Name=dynamics", f"Solver/Time step={step!r}", f"Solver/End time={step * steps!r}",
            f"Output/History steps={max(1, steps // rows)}"]


def drift(run, _base):
    """Largest difference of the energy that is there to that put in, relative to the largest there was."""
    return abs(run.summary["energy"]["drift"])


NO_ENERGY = ("follow from no energy",)
VIBRATION = velocities("sin(3*x)*cos(2*y)", "cos(2*x)*sin(3*y)")


def time_steps(options):
    for model, share in itertools.product(MOVING, (0.5, 0.8, 0.9, 0.95, 0.99, 1.01, 1.05, 1.1, 1.2)):
        yield Case(f"{share}", model, [*motion(options, model, 16, share, 4000), *VIBRATION], SQUARE, bound=1e-3,
                   # The largest stable step is estimated with a margin: 1.01 times it may be stable.
                   words=NO_ENERGY, must=() if model == "paper" or share == 1.01 else GOOD if share < 1 else ("stopped",),
                   quick=share in (0.95, 1.01) and model == "energy")


def long_runs(options):
    for model in MOVING:
        steps = 10000 if options.quick else 1000000
        yield Case(f"{steps:,} steps", model, [*motion(options, model, 8, 0.9, steps), *VIBRATION], SQUARE, bound=1e-3,
                   words=NO_ENERGY, must=GOOD if model != "paper" else (), quick=model == "energy")


NOISE = velocities("sin(1e5*x+3e4*y)+0.3*sin(7e4*x*y)", "sin(5e4*x-9e4*y)+0.3*cos(8e4*x*y)")


def noises(options):
    for model, size in itertools.product(MOVING, (0.1, 1, 10)):
        noise = [setting.replace("=", f"={size}*(", 1) + ")" for setting in NOISE]
        yield Case(f"velocities of {size / WAVE_SPEED:g} c", model, [*motion(options, model, 16, 0.9, 5000), *noise], SQUARE,
                   bound=size / WAVE_SPEED, words=NO_ENERGY, quick=size == 1 and model == "energy")


def strain_and_drift(run, _base):
    """Largest stretch of the diagonals, share of strain in the energy, or drift of the energy."""
    strain = [value / run.history["external work [J]"][-1] for value in run.history["strain energy [J]"]]
    lines = [values for name, values in run.history.items() if name.startswith("stretch of")]
    return max(max(abs(value - 1) for values in lines for value in values), *strain, drift(run, None))


def spins(options):
    """A free square turns about its middle; its edges at a hundredth of the speed of waves."""
    rate = 0.01 * WAVE_SPEED / math.sqrt(0.5)
    for model, turns in itertools.product(MOVING, (0.1, 1, 3)):
        body = [*MOVING[model], "Mesh/Cells=10, 10"]
        step = 0.8 * stable_step(options, body)
        steps = math.ceil(2 * math.pi * turns / rate / step)
        yield Case(f"{turns} turns", model, [
            *motion(options, model, 10, 0.8, steps), *velocities(f"-{rate!r}*(y-0.5)", f"{rate!r}*(x-0.5)"),
            "Gauges/rising/From=0.1, 0.1", "Gauges/rising/To=0.9, 0.9",
            "Gauges/falling/From=0.1, 0.9", "Gauges/falling/To=0.9, 0.1"],
            SQUARE, bound=1e-3, words=("rotation", *NO_ENERGY), quick=turns == 0.1 and model == "energy")


def momentum_and_drift(run, _base):
    """Momentum that came or went, over that put in, or drift of the energy."""
    start = 1000. * 0.01 * 100.  # density, a cell of the square, its velocity
    return max(abs(run.summary["momentum"][0] - start) / start, abs(run.summary["momentum"][1]) / start, drift(run, None))


def breaks(options):
    corner = velocities("if(x>0.9, if(y>0.9, 100, 0), 0)", "0")
    for model in MOVING:
        yield Case("a corner cell shot off", model, [
            *motion(options, model, 10, 0.5, 2000), *corner, "Material/Critical stretch=1e-3", "Contact/Enabled=false"],
            SQUARE, bound=1e-2, figure=momentum_and_drift, words=NO_ENERGY,
            must=GOOD if model != "paper" else (), quick=model == "energy")
        yield Case("every bond breaks", model, [
            *MOVING[model], "Mesh/Cells=8, 8, 4", "Material/Fracture energy=1e-6",
            *(f"Initial conditions/v_{axis}=1000*{axis}" for axis in "xyz")],
            "prm/examples/fragmenting_block.prm", must=("stopped",), figure=drift, quick=model == "energy")
        yield Case("a torn strip", model, MOVING[model], "tests/scenes/torn_strip.prm", bound=1e-2, figure=drift)


STUDIES = [
    Study("time step", "energy drift", "1e-3; beyond the stable step the run must stop", drift, time_steps),
    Study("many steps", "energy drift", "1e-3", drift, long_runs),
    Study("noise", "energy drift", "v/c: what of the force is not linear", drift, noises),
    Study("spin", "stretch, strain's share of the energy, or its drift", "1e-3: centrifugal forces strain by 1e-4",
          strain_and_drift, spins),
    Study("breaking", "energy drift, momentum", "1e-2; a body of which nothing is left stops the run", drift, breaks),
]
