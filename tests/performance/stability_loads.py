# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cases of stability.py in statics and quasi statics: units, large rotations, reversed loads, bodies apart, loose nodes."""

import itertools
from pathlib import Path

from stability_cases import GOOD, MODELS, SAID, SQUARE, Case, Study, exact_error, harmonic, on_square, shear_stiff

LARGE_STRAIN = {
    "ordinary": MODELS["ordinary"],
    "energy": MODELS["energy"],
    "paper": MODELS["paper"],
    "bond based": MODELS["bond based"],
    "tensor involved": MODELS["tensor involved"],
    "correspondence": [*MODELS["correspondence"], "Material/Law=Saint Venant-Kirchhoff"],
    "neo-Hookean": [*MODELS["correspondence"], "Material/Law=neo-Hookean"],
    "family": [*MODELS["family"], "Material/Law=Saint Venant-Kirchhoff"],
}
UNITS = {"m, Pa": (1., 1.), "mm, Pa": (1e3, 1.), "km, Pa": (1e-3, 1.), "µm, Pa": (1e6, 1.), "m, GPa": (1., 1e-9),
         "mm, GPa": (1e3, 1e-9), "km, GPa": (1e-3, 1e-9)}


def invariants(run, length, stress):
    """Strain energy, reactions of "held" and errors, without units."""
    force = stress * length**2
    errors = run.summary.get("errors", {}).get("exact", {"l2": 1.})
    return (run.summary["energy"]["strain"] / (force * length),
            [value / force for value in run.summary["reactions"]["held"]], errors["l2"])


def scaled(length, stress):
    """The figure: largest relative difference to the base; 1 where iterations differ by more than one."""
    def figure(run, base):
        energy, reactions, error = invariants(run, length, stress)
        energy_0, reactions_0, error_0 = invariants(base, 1., 1.)
        difference = max(abs(a - b) for a, b in zip(reactions, reactions_0)) / max(map(abs, reactions_0))
        iterations, iterations_0 = (one.summary["solver"]["iterations"] for one in (run, base))
        same = all(abs(a - b) <= 1 for a, b in zip(iterations, iterations_0))
        return max(abs(energy / energy_0 - 1), difference, abs(error / error_0 - 1), 0. if same else 1.)
    return figure


def units(_options):
    for model, (name, (length, stress)) in itertools.product(MODELS, UNITS.items()):
        material = [f"Material/Young modulus={2.6e9 * stress if model != 'bond based' else 2.5e9 * stress!r}",
                    f"Mesh/Size={length!r}, {length!r}", f"Mesh/Thickness={length!r}", "Mesh/Cells=20, 20"]
        yield Case(name, model, [*on_square(model), *material, *harmonic(2., length, stress), "Solver/Tolerance=1e-12",
                                 "Comparison/FEM=false"],
                   bound=1e-9, figure=scaled(length, stress), base=name == "m, Pa", must=GOOD,
                   quick=name in ("m, Pa", "km, GPa") and model in ("consistent", "bond based"))
    for model, (name, (length, stress)) in itertools.product(LARGE_STRAIN, UNITS.items()):
        yield Case(name, f"{model}, shear of 0.1", [
            *LARGE_STRAIN[model], *shear_stiff(0.25), f"Material/Young modulus={1e9 * stress!r}",
            f"Mesh/Size={length!r}, {length!r}", f"Mesh/Thickness={length!r}", "Solver/Name=quasi static",
            "Solver/Tolerance=1e-12", *held("held", "left", "0", "0"),
            *held("moved", "right", "0", f"{0.1 * length!r}*t")],
            SQUARE, bound=1e-9, figure=scaled(length, stress), base=name == "m, Pa", must=GOOD)


def held(name, boundary, u_x, u_y):
    """A condition on displacements; nothing where a component is None."""
    section = f"Boundary conditions/{name}"
    return [f"{section}/Boundary={boundary}",
            *(f"{section}/u_{axis}={value}" for axis, value in (("x", u_x), ("y", u_y)) if value is not None)]


def rotations(_options):
    """Two ends are turned about the middle: the body must follow as it is."""
    for model, degrees in itertools.product(LARGE_STRAIN, (30, 90, 180)):
        angle = f"{degrees}/180*pi"
        x, y = "(x-0.5)", "(y-0.5)"
        turned = [[f"(cos({angle}*{t})-1)*{x}-sin({angle}*{t})*{y}", f"sin({angle}*{t})*{x}+(cos({angle}*{t})-1)*{y}"]
                  for t in ("t", "1")]
        yield Case(f"{degrees} degrees", model, [
            *LARGE_STRAIN[model], "Mesh/Cells=12, 12", "Solver/Name=quasi static", f"Solver/Load steps={degrees // 15}",
            "Solver/Tolerance=1e-10", *held("ends", "left, right", *turned[0]),
            # Values at the nodes themselves, where nodes are held.
            *([] if "Material/Form=consistent" in LARGE_STRAIN[model] else ["Boundary conditions/Layers=2"]),
            f"Comparison/Exact u_x={turned[1][0]}", f"Comparison/Exact u_y={turned[1][1]}"],
            SQUARE, bound=1e-6, words=("small rotations",), quick=degrees == 90 and model in ("energy", "bond based"))


def bends(_options):
    """A slender bar bent by more than half its length: one load step against ten."""
    def energy_difference(run, base):
        return abs(run.summary["energy"]["strain"] / base.summary["energy"]["strain"] - 1)
    for model, steps in itertools.product(LARGE_STRAIN, (10, 3, 1)):
        yield Case(f"{steps} load steps", model, [*LARGE_STRAIN[model], f"Solver/Load steps={steps}"],
                   "tests/scenes/cantilever_bent_far.prm", bound=1e-6, base=steps == 10, figure=energy_difference)


def reversal(run, _base):
    """A shear there, back, to the other side and back: how far the reactions are from odd, and from nothing at its ends."""
    names = [name for name in run.history if name.startswith("reaction of held")]
    rows = [[run.history[name][step] for name in names] for step in (1, 3, 5, 7)]
    there, back, other, end = rows
    # The mirror image of the shear has the same force along x.
    odd = max(abs(there[0] - other[0]), abs(there[1] + other[1]))
    return max(odd, *map(abs, back), *map(abs, end)) / max(map(abs, there))


def reversals(_options):
    for model, method in itertools.product(LARGE_STRAIN, ("quasi static", "dynamic relaxation")):
        if method == "dynamic relaxation" and "Material/Model=correspondence" in LARGE_STRAIN[model]:
            continue
        yield Case(f"shear of 0.05, {method}", model, [
            *LARGE_STRAIN[model], f"Solver/Name={method}", "Solver/Load steps=8", "Solver/Tolerance=1e-10",
            "Solver/Maximum iterations=20000", *held("held", "left", "0", "0"),
            *held("moved", "right", "0", "0.05*sin(2*pi*t)")],
            SQUARE, bound=1e-7, must=GOOD, quick=method == "quasi static" and model in ("energy", "bond based"))


def write_two_bodies(path, cells, gap):
    """A mesh file of two unit squares of cells x cells, a gap apart along x."""
    points, quads, lines = [], [], []
    for corner, sides in ((0., ("left", "inner")), (1. + gap, ("inner", "right"))):
        first = len(points) + 1
        points += [(corner + i / cells, j / cells) for j in range(cells + 1) for i in range(cells + 1)]
        at = lambda i, j: first + i + j * (cells + 1)  # noqa: E731
        quads += [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for j in range(cells) for i in range(cells)]
        lines += [(side, at(i, j), at(i, j + 1)) for i, side in zip((0, cells), sides) for j in range(cells)]
        lines += [("bottom", at(i, 0), at(i + 1, 0)) for i in range(cells)]
    names = ["left", "inner", "right", "bottom"]
    text = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names) + 1),
            *(f'1 {k} "{name}"' for k, name in enumerate(names, 1)), f'2 {len(names) + 1} "bodies"', "$EndPhysicalNames",
            "$Nodes", str(len(points)), *(f"{k} {x!r} {y!r} 0" for k, (x, y) in enumerate(points, 1)), "$EndNodes",
            "$Elements", str(len(lines) + len(quads))]
    for k, (side, a, b) in enumerate(lines, 1):
        tag = names.index(side) + 1
        text.append(f"{k} 1 2 {tag} {tag} {a} {b}")
    for k, corners in enumerate(quads, len(lines) + 1):
        text.append(f"{k} 3 2 {len(names) + 1} 1 {' '.join(map(str, corners))}")
    Path(path).write_text("\n".join([*text, "$EndElements", ""]), encoding="utf-8")


def two_bodies(options):
    """Two squares, pulled towards each other by the tractions of a uniform strain, or one held and one loose."""
    strain, cells = 1e-4, 12
    for gap_cells, model in itertools.product((8, 1), MODELS):
        gap = gap_cells / cells
        path = Path(options.folder) / f"two_bodies_{gap_cells}.msh"
        write_two_bodies(path, cells, gap)
        middle, end = 1 + gap / 2, 2 + gap
        mesh = [*MODELS[model], "Mesh/Generator=", f"Mesh/File={path}", "Material/Assumption=plane stress",
                f"Material/Poisson ratio={1 / 3!r}", *held("floor", "bottom", None, "0"), *held("left", "left", "0", None),
                "Boundary conditions/inner/Boundary=inner",
                f"Boundary conditions/inner/t_x=if(x<{middle!r},1,-1)*{1e9 * strain!r}",
                f"Comparison/Exact u_x={strain}*(x-if(x<{middle!r},0,{end!r}))",
                f"Comparison/Exact u_y=-{strain / 3!r}*y"]
        near = f"{gap_cells} cell{'s' * (gap_cells > 1)} apart"
        yield Case(f"both held, {near}", model, [*mesh, *held("right", "right", "0", None)], SQUARE, bound=0.2,
                   words=("share no face",), must=GOOD if gap_cells > 3 else (),
                   quick=model == "consistent")
        yield Case(f"one loose, {near}", model, mesh, SQUARE, bound=0., words=("share no face",),
                   must=("refused",) if gap_cells > 3 else SAID, quick=model == "consistent")


def missing_reaction(run, _base):
    """Share of the load that the support does not bear."""
    return abs(run.summary["reactions"]["held"][0] / 1e4 + 1)


def loose_nodes(_options):
    """Corner cells that precracks cut off all others, without a load of their own or pulled away."""
    for model, solver in itertools.product(("ordinary", "energy", "paper", "bond based", "tensor involved", "family"),
                                           ("quasi static", "dynamic relaxation")):
        if model == "family" and solver == "dynamic relaxation":
            continue
        for name, boundary in (("loose corner", "bottom"), ("pulled corner", "right")):
            section = "Boundary conditions/pulled"
            yield Case(f"{name}, {solver}", model, [
                *MODELS[model], f"Solver/Name={solver}", "Precracks/corner/Points=0.7, 1; 0.7, 0.7; 1, 0.7",
                *held("held", "left", "0", "0"), f"{section}/Boundary={boundary}", f"{section}/t_x=1e4"],
                SQUARE, bound=1e-5, words=("disconnected from the supports",), must=SAID if name == "pulled corner" else (),
                quick=solver == "quasi static" and model in ("energy", "bond based"))


STUDIES = [
    Study("units", "difference to m, Pa", "1e-9: solved to 1e-12", None, units),
    Study("held rotation", "l2 error", "1e-6: solved to 1e-10, rigid rotation is exact", exact_error, rotations),
    Study("far bending", "energy to that of ten load steps", "1e-6: solved to 1e-8", None, bends),
    Study("load reversal", "reactions' share that is not odd or left", "1e-7: solved to 1e-10", reversal, reversals),
    Study("two bodies", "l2 error", "20 %: surfaces of few cells; a loose body must be refused",
          exact_error, two_bodies),
    Study("loose nodes", "share of the load that the support does not bear", "1e-5; loads on loose nodes must be told",
          missing_reaction, loose_nodes),
]
