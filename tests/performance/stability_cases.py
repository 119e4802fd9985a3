# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cases of stability.py in statics, each with an exact answer: meshes, materials, horizons, thin parts, units, bodies."""

import functools
import itertools
from dataclasses import dataclass

HARMONIC = "prm/verification/robustness.prm"
SQUARE = "tests/performance/stability.prm"
SHEAR_MODULUS = 1e9
GOOD = ("ok",)
SAID = ("warned", "refused", "stopped")

MODELS = {
    "consistent": ["Material/Model=extended ordinary", "Material/Form=consistent"],
    "energy": ["Material/Model=extended ordinary", "Material/Form=energy"],
    "paper": ["Material/Model=extended ordinary", "Material/Form=paper"],
    "ordinary": ["Material/Model=ordinary"],
    "bond based": ["Material/Model=bond based"],
    "tensor involved": ["Material/Model=tensor involved", "Material/Form=moment corrected"],
    "correspondence": ["Material/Model=correspondence", "Material/Form=consistent"],
    "family": ["Material/Model=correspondence", "Material/Form=family"],
}


@dataclass
class Case:
    """One run and what is asked of it."""
    value: str              # of what the study varies
    model: str
    settings: list
    scene: str = HARMONIC
    bound: float = 0.       # of the study's figure
    growth: float = 0.      # the bound is at least so many times the figure of the model's base case
    beside_fem: bool = False  # the bound is at least twice the error of Q1 finite elements
    base: bool = False
    words: tuple = ()       # of the warnings that name the trouble
    must: tuple = ()        # the verdicts that are right; empty: all but failures
    quick: bool = False
    figure: object = None   # of the run and of the base case's; the study's when there is none


@dataclass
class Study:
    """Runs that vary one thing. figure: number of a run and the base case's, small when all is well."""
    name: str
    measures: str
    why: str                # of the bound
    figure: object
    cases: object           # of the options, an iterable


def exact_error(run, _base):
    """Relative l2 error of the displacement against the exact one."""
    return run.summary["errors"]["exact"]["l2"]


def own_poisson_ratio(model, nu, in_plane_stress):
    """That of springs, where it has a value of its own."""
    return nu if model != "bond based" else 1 / 3 if in_plane_stress else 0.25


def shear_stiff(nu):
    """A material of the shear modulus that the scene's tractions belong to."""
    return [f"Material/Poisson ratio={nu}", f"Material/Young modulus={2 * SHEAR_MODULUS * (1 + nu)}"]


def harmonic(wave=2., length=1., stress=1.):
    """Displacement and traction of a harmonic gradient, in units of length and stress, as parameters."""
    phase = [f"({wave / length!r}*{axis})" for axis in "xy"]
    size = 1e-3 * length
    u_x, u_y = f"{size!r}*exp{phase[0]}*cos{phase[1]}", f"-{size!r}*exp{phase[0]}*sin{phase[1]}"
    traction = f"-{2 * SHEAR_MODULUS * stress * wave * 1e-3!r}*exp{phase[0]}"
    return [f"Boundary conditions/held/u_x={u_x}", f"Boundary conditions/held/u_y={u_y}",
            f"Comparison/Exact u_x={u_x}", f"Comparison/Exact u_y={u_y}",
            f"Boundary conditions/top/t_x={traction}*sin{phase[1]}",
            f"Boundary conditions/top/t_y={traction}*cos{phase[1]}"]


def on_square(model, nu=0.3):
    """The settings of a model on the square; finite elements beside the consistent form."""
    return [*MODELS[model], *shear_stiff(own_poisson_ratio(model, nu, False)),
            f"Comparison/FEM={str(model == 'consistent').lower()}"]


def series(values, base, easy, growth, settings, words, quick=()):
    """Cases of all models for each value: the easy values must be right, as right as the base times a factor."""
    for model, value in itertools.product(MODELS, values):
        yield Case(str(value), model, [*on_square(model), *settings(value)], growth=growth, base=value == base,
                   words=words, must=GOOD if value in easy else (), bound=0.01,
                   quick=value in (base, *quick) and model in ("consistent", "energy"))


def distortions(_options):
    yield from series((0, 0.1, 0.2, 0.3, 0.35, 0.4, 0.45, 0.49), 0, (0, 0.1, 0.2), 2.,
                      lambda value: [f"Mesh/Distortion={value}"], ("distorted",), (0.49,))


def aspect_ratios(_options):
    yield from series((1, 2, 5, 10, 20, 50, 100), 1, (1, 2), 2.,
                      lambda value: [f"Mesh/Size={value}, 1", *harmonic(2 / value)],
                      ("aspect ratio", "smallest family", "moment condition"), (100,))


def sizes(_options):
    def settings(times):
        return ["Mesh/Cells=16, 16", *(["Mesh/Refine at=right", f"Mesh/Refine times={times}"] if times else [])]
    for case in series((0, 2, 4, 7, 10), 0, (0, 2, 4), 1.5, settings, ("cell sizes",), (10,)):
        case.value = f"1:{2**int(case.value)}"
        if case.model in ("paper", "ordinary", "bond based") and not case.base:
            case.must = ()  # they count whole cells
        yield case


def horizons(_options):
    for case in series((1.5, 2.01, 2.5, 3.01, 4, 5, 6), 3.01, (3.01, 4), 2., lambda value: [f"Nodes/Horizon factor={value}"],
                       ("smallest family", "horizon factor of", "moment condition", "surface correction"), (1.5,)):
        # Forms with errors at surfaces have as many horizons along the square at every factor.
        if case.model not in ("consistent", "correspondence"):
            cells = round(40 * float(case.value) / 3.01)
            case.settings.append(f"Mesh/Cells={cells}, {cells}")
        yield case


def poisson_ratios(_options):
    values = (0.3, 0.4, 0.45, 0.49, 0.499, 0.4999)
    for case in series(values, 0.3, (0.3, 0.4), 2., shear_stiff, ("push sideways", "incompressible"), (0.4999,)):
        if case.model == "tensor involved" and not case.base:
            case.must = ()  # bonds push sideways
        if case.model != "bond based":
            yield case
    yield Case("0.25", "bond based", on_square("bond based"), base=True, growth=1., must=GOOD)
    for nu in values:
        yield Case(str(nu), "bond based", [*on_square("bond based"), *shear_stiff(nu)], growth=2.,
                   words=("Poisson's ratio",))


def plate(dimension, layers, model, state, length):
    """A free plate of layers of unit cells in tension or bending, strain 1e-4 at its surface."""
    nu = own_poisson_ratio(model, 0.3, dimension == 2)
    counts = [length, layers] if dimension == 2 else [length, length, layers]
    corner = ", ".join(repr(-count / 2) for count in counts)
    strain = 1e-4 if state == "tension" else 2e-4 / layers
    stress = 1e9 * strain
    depth = "y" if dimension == 2 else "z"
    if state == "tension":
        exact = [f"{strain}*x"] + [f"-{nu * strain!r}*{axis}" for axis in "yz"[:dimension - 1]]
    elif dimension == 2:
        exact = [f"{strain!r}*x*y", f"-{strain / 2!r}*(x^2+{nu!r}*y^2)"]
    else:
        exact = [f"{strain!r}*x*z", f"-{nu * strain!r}*y*z", f"-{strain / 2!r}*(x^2+{nu!r}*(z^2-y^2))"]
    traction = f"{stress!r}" + ("" if state == "tension" else f"*{depth}")
    text = ", ".join(map(str, counts))
    return [*MODELS[model], f"Dimension={dimension}", f"Mesh/Cells={text}", f"Mesh/Size={text}", f"Mesh/Corner={corner}",
            f"Material/Poisson ratio={nu!r}", *(["Material/Assumption=plane stress"] if dimension == 2 else []),
            "Boundary conditions/Rigid body motions=remove", "Comparison/FEM=true",
            "Boundary conditions/right/Boundary=right", f"Boundary conditions/right/t_x={traction}",
            "Boundary conditions/left/Boundary=left", f"Boundary conditions/left/t_x=-{traction}",
            *(f"Comparison/Exact u_{axis}={formula}" for axis, formula in zip("xyz", exact))]


THIN = ("one cell thick", "two horizons thick", "smallest family", "surface correction")


def thin_plates(dimension, state, _options):
    for model, layers in itertools.product(MODELS, range(1, 6)):
        yield Case(f"{layers} layers" if layers > 1 else "1 layer", model,
                   plate(dimension, layers, model, state, 40 if dimension == 2 else 12), SQUARE, bound=0.1, beside_fem=True,
                   words=THIN, must=GOOD if model == "consistent" and layers > 1 else (),
                   quick=dimension == 2 and layers in (1, 4) and model in ("consistent", "bond based"))


def few_cells(_options):
    for model, counts in itertools.product(MODELS, ((1, 1), (2, 1), (2, 2), (1, 1, 1), (2, 1, 1))):
        settings = plate(len(counts), 1, model, "tension", 1)
        text = ", ".join(map(str, counts))
        sets = [f"Mesh/Cells={text}", f"Mesh/Size={text}", f"Mesh/Corner={', '.join(repr(-n / 2) for n in counts)}"]
        yield Case(" x ".join(map(str, counts)), model, [*settings, *sets], SQUARE, bound=0.1, words=THIN,
                   quick=len(counts) == 2 and model in ("consistent", "bond based"))


STUDIES = [
    Study("distortion", "l2 error", "twice that of squares, or 1 %", exact_error, distortions),
    Study("aspect ratio", "l2 error", "twice that of squares, or 1 %", exact_error, aspect_ratios),
    Study("sizes", "l2 error", "1.5 times that of equal cells, or 1 %",
          exact_error, sizes),
    Study("horizon factor", "l2 error", "twice that at 3.01, on as many horizons, or 1 %",
          exact_error, horizons),
    Study("Poisson's ratio", "l2 error", "twice that at 0.3, or 1 %", exact_error, poisson_ratios),
    *(Study(f"thin plates, {dimension}-D {state}", "l2 error", "10 %, or twice that of Q1 elements", exact_error,
            functools.partial(thin_plates, dimension, state))
      for dimension in (2, 3) for state in ("tension", "bending")),
    Study("few cells", "l2 error", "10 % of a uniform strain", exact_error, few_cells),
]
