# SPDX-License-Identifier: LGPL-2.1-or-later
"""What work_precision.py runs: scenes, their resolutions, and the methods that suit each."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial


@dataclass(frozen=True)
class Method:
    """A way to solve a scene. kind: bonds, paper (one point, the published form, dynamic relaxation) or fem.

    The finite elements are solved beside the scene's consistent form, with its settings.
    coarse: how many resolutions it is run at, from the coarsest on; None: all. accurate: whether its errors are so
    small that they need the best reference there is.
    """
    name: str
    settings: tuple = ()
    kind: str = "bonds"
    coarse: int | None = None
    drawn: bool = True
    accurate: bool = False


@dataclass(frozen=True)
class Resolution:
    """settings make the mesh, or sized_mesh, a Gmsh file of the project with its parameter Size. truth: the best
    reference; rough: one that takes less time, for large errors; empty: the same."""
    name: str
    settings: tuple
    truth: tuple = ()
    rough: tuple = ()
    sized_mesh: tuple = ()


def errors_of_field(summary, fem, truth, _finest):
    """Of the displacement: the relative l2 error and the largest."""
    errors = summary["errors"]
    own = errors["fem"][f"own error against {truth}"] if fem else errors[truth]
    return own["l2"], own["max"]


@dataclass(frozen=True)
class Scene:
    """truth: exact or reference, what errors are against. carrier: the settings beside which finite elements are
    solved, None: there are none. base: the method that others are compared with. finest: settings of the run that
    errors are against where neither an exact solution nor a reference is there."""
    file: str
    about: str
    resolutions: tuple
    methods: tuple
    targets: tuple
    truth: str = "exact"
    common: tuple = ()
    carrier: tuple | None = None
    base: str = "FEM Q1"
    finest: tuple = ()
    errors: Callable = field(default=errors_of_field)


ONE_POINT = "Quadrature/Scheme=one point"
GAUSS = "Quadrature/Scheme=gauss points"
EXTENDED = "Material/Model=extended ordinary"
ORDINARY = "Material/Model=ordinary"
SPRINGS = "Material/Model=bond based"
TENSORS = "Material/Model=tensor involved"
CORRESPONDENCE = "Material/Model=correspondence"
RELAXATION = "Solver/Name=dynamic relaxation"
OWN_INFLUENCE = "Nodes/Influence function=automatic"
CONSISTENT = (EXTENDED, "Material/Form=consistent", OWN_INFLUENCE)


def treated(treatment):
    return f"Boundary conditions/Treatment={treatment}"


def held(treatment):
    return f"Boundary conditions/Displacement treatment={treatment}"


# The reference is solved for what is prescribed too.
TAKES_REFERENCE = held("reference")


def scheme(name):
    return f"Quadrature/Scheme={name}"


def refined(times):
    return (f"Comparison/Reference refinements={times}",)


def finite_elements(carrier, coarse=None, reference=()):
    """Those on the same mesh; coarse: resolutions of Q2, for which a reference can be finer; reference: that of Q2."""
    return (Method("FEM Q1", carrier, "fem", accurate=True),
            Method("FEM Q2", (*carrier, "Comparison/FEM degree=2", *reference), "fem", coarse, accurate=True))


# Plates and blocks with a hole, pulled by displacements of their ends. Relaxation takes the deformed body: a pull of a
# thousandth leaves it in the linear range, and relative errors what they are.
SMALL_PULL = ("Boundary conditions/right/u_x=5e-7", "Boundary conditions/left/u_x=-5e-7")


def hole_methods(paper, coarse, coarse_of_q2):
    """paper: the published form's settings; coarse: resolutions of bonds between nodes; coarse_of_q2: those of Q2."""
    bonds = partial(Method, coarse=coarse)
    consistent = (*CONSISTENT, held("automatic"))
    energy = (EXTENDED, "Material/Form=energy")
    ghosts = treated("taylor ghosts")
    return (
        *finite_elements(consistent, coarse_of_q2, refined(1)),
        Method("consistent form", consistent, accurate=True),
        Method("consistent form, without parents", (*consistent, "Solver/Auxiliary mesh=same"), accurate=True, drawn=False),
        bonds("energy form, mirror", (*energy, held("mirror"))),
        bonds("energy form, layer", (*energy, held("layer"))),
        bonds("energy form, ghosts", (*energy, held("automatic"), ghosts)),
        bonds("paper form, mirror", (*paper, held("mirror"))),
        bonds("paper form, layer", (*paper, held("layer")), drawn=False),
        bonds("ordinary, mirror", (ORDINARY, held("mirror"))),
        bonds("ordinary, ghosts", (ORDINARY, held("automatic"), ghosts), drawn=False),
        bonds("springs, mirror", (SPRINGS, held("mirror")), drawn=False),
        bonds("springs, exact parts", (SPRINGS, scheme("exact"), held("layer")), drawn=False),
        bonds("correspondence, families", (CORRESPONDENCE, "Material/Form=family", OWN_INFLUENCE, held("layer"))),
        bonds("paper's way", (*paper, ONE_POINT, held("layer"), RELAXATION, *SMALL_PULL), "paper"),
    )


def mesh(name, cells, *more, truth=(), rough=()):
    return Resolution(name, (f"Mesh/Cells={cells}", *more), tuple(truth), tuple(rough))


PAPER = (EXTENDED, "Material/Form=paper")
ONCE = "Mesh/Refinements=1"
CONSISTENT_AT_FACES = (*CONSISTENT, held("automatic"))

PLATE = Scene(
    "prm/verification/plate_with_hole_convergence.prm",
    "A plate with a hole, pulled; against a converged reference.",
    # Made by a refinement: the preconditioner is made on the parents of the cells.
    tuple(mesh(name, cells, ONCE, truth=refined(0)) for name, cells in (
        ("512", "4, 4"), ("2,048", "8, 8"), ("7,680", "15, 16"), ("30,720", "30, 32"), ("122,880", "60, 64"))),
    hole_methods(PAPER, coarse=4, coarse_of_q2=4),
    (3e-2, 1e-2, 1e-3, 1e-4), "reference", carrier=CONSISTENT_AT_FACES)

# Families of 3.01 spacings have no neighbours along z where cells are long in z, and the published form stops.
PAPER_IN_3D = (*PAPER, "Nodes/Horizon factor=4.01")
# References on the mesh of half as many cells each way where the body leaves no room for more.
PARENTS = refined(-1)
LONG_IN_3D = ("energy form, layer", "paper form, layer", "ordinary, ghosts", "springs, mirror", "springs, exact parts",
              "correspondence, families")
BLOCK = Scene(
    "prm/examples/block_with_hole.prm",
    "The plate as a thick block; against a converged reference.",
    (mesh("1,536", "3, 4, 2", ONCE, truth=refined(0)),
     mesh("3,840", "4, 5, 3", ONCE, truth=refined(0)),
     mesh("10,752", "6, 7, 4", ONCE, truth=refined(0), rough=PARENTS),
     mesh("23,040", "8, 9, 5", ONCE, truth=refined(0), rough=PARENTS),
     mesh("174,080", "16, 17, 10", ONCE, truth=PARENTS)),
    tuple(method for method in hole_methods(PAPER_IN_3D, coarse=4, coarse_of_q2=1) if method.name not in LONG_IN_3D),
    (5e-2, 1e-2, 1e-3), "reference", carrier=CONSISTENT_AT_FACES)


def collar(cells, layers, free):
    """A square about the same middle, free [m] wide in a collar of so many layers, of cells x cells."""
    spacing = free / (cells - 2 * layers)
    return Resolution(f"{cells * cells:,}", (f"Mesh/Cells={cells}, {cells}",
                                             f"Mesh/Size={cells * spacing}, {cells * spacing}",
                                             f"Mesh/Corner={-cells * spacing / 2}, {-cells * spacing / 2}"))


NO_COLLAR = ("Boundary conditions/Layers=1", held("automatic"))
TENSORS_AT_FACES = (TENSORS, "Material/Form=consistent", *NO_COLLAR)
MANUFACTURED = Scene(
    "prm/examples/tensor_manufactured_2d.prm",
    "A manufactured field in a plate without elastic symmetry; against the exact field. Bonds are held in a collar, "
    "finite elements and the consistent forms at the faces around it.",
    tuple(collar(cells, 6, 0.5) for cells in (24, 37, 62, 112, 212)),
    (*finite_elements(TENSORS_AT_FACES),
     Method("consistent form", TENSORS_AT_FACES, accurate=True),
     Method("moment corrected", (TENSORS, "Material/Form=moment corrected")),
     Method("moment corrected, partial volume", (TENSORS, "Material/Form=moment corrected", scheme("partial volume")),
            drawn=False),
     Method("surface cure", (TENSORS, "Material/Form=surface cure"), drawn=False),
     Method("one point", (TENSORS, "Material/Form=one point")),
     Method("one point, partial volume", (TENSORS, "Material/Form=one point", scheme("partial volume"))),
     Method("one point, exact parts", (TENSORS, "Material/Form=one point", scheme("exact"))),
     Method("correspondence, families", (CORRESPONDENCE, "Material/Form=family")),
     Method("paper's way", (TENSORS, "Material/Form=one point", ONE_POINT, RELAXATION), "paper", 4)),
    (1e-2, 1e-3, 1e-4), carrier=TENSORS_AT_FACES)


def laminate(name, size, rough):
    return Resolution(name, (), ("Comparison/Reference mesh=meshes/laminate_with_hole_fine.geo", *refined(0)),
                      refined(rough), ("meshes/laminate_with_hole.geo", size))


IN_COLLAR = (TAKES_REFERENCE, "Boundary conditions/Layers=3")
LAMINATE_AT_FACES = (TENSORS, "Material/Form=consistent", held("automatic"))
LAMINATE = Scene(
    "prm/examples/laminate_with_hole.prm",
    "A laminate with a hole, fibres at 30 degrees, clamped and pulled; against a converged reference. Collar: "
    "three layers of cells at the ends are given the reference's values.",
    (laminate("1,200", 2.5e-3, 1), laminate("4,760", 1.25e-3, 0), laminate("7,440", 1e-3, 0),
     laminate("29,760", 5e-4, 0)),
    (*finite_elements(LAMINATE_AT_FACES, coarse=3),
     Method("consistent form", LAMINATE_AT_FACES, accurate=True),
     Method("surface cure, collar", (TENSORS, "Material/Form=surface cure", *IN_COLLAR)),
     Method("surface cure, layer", (TENSORS, "Material/Form=surface cure", held("layer"))),
     Method("moment corrected, collar", (TENSORS, "Material/Form=moment corrected", *IN_COLLAR)),
     Method("one point, collar", (TENSORS, "Material/Form=one point", *IN_COLLAR)),
     Method("one point, layer", (TENSORS, "Material/Form=one point", held("layer")), drawn=False),
     Method("correspondence, families, collar", (CORRESPONDENCE, "Material/Form=family", *IN_COLLAR)),
     Method("paper's way", (TENSORS, "Material/Form=one point", held("layer"), ONE_POINT, RELAXATION), "paper")),
    (5e-2, 1e-2, 1e-3), "reference", carrier=LAMINATE_AT_FACES)


def pdbc(scene, about, resolutions, exact=(), truth="exact"):
    """A plate of the paper on boundary conditions. exact: the solution for a Poisson ratio of 0.3, where it differs
    from that of springs, whose own is 1/3."""
    solid = ("Material/Poisson ratio=0.3", *exact)
    consistent = (*CONSISTENT, treated("automatic"), *solid)
    models = {"springs": (SPRINGS,), "ordinary": (ORDINARY, *solid),
              "energy form": (EXTENDED, "Material/Form=energy", OWN_INFLUENCE, *solid)}
    treatments = {"printed": "printed", "balanced": "balanced", "layer": "layer", "ghosts": "taylor ghosts"}
    drawn = {("energy form", "layer"), ("energy form", "ghosts")}
    bonds = tuple(Method(f"{model}, {short}", (*settings, treated(treatment)),
                         drawn=model == "springs" or (model, short) in drawn,
                         accurate=(model, short) == ("energy form", "ghosts"))
                  for model, settings in models.items() for short, treatment in treatments.items())
    paper = (SPRINGS, treated("printed"), "Boundary conditions/Transfer lambda=0", ONE_POINT, RELAXATION)
    return Scene(f"prm/examples/{scene}.prm", about, resolutions,
                 (*finite_elements(consistent), Method("consistent form", consistent, accurate=True), *bonds,
                  Method("paper's way", paper, "paper")),
                 (1e-1, 1e-2, 1e-3, 1e-4), truth, carrier=consistent)


PLATES = (mesh("800", "40, 20"), mesh("3,200", "80, 40"), mesh("7,200", "120, 60"), mesh("20,000", "200, 100"))
CLAMPED_PLATES = (mesh("800", "40, 20", truth=refined(2), rough=refined(1)),
                  mesh("3,200", "80, 40", truth=refined(1), rough=refined(0)),
                  mesh("7,200", "120, 60", truth=refined(1), rough=refined(0)),
                  mesh("20,000", "200, 100", truth=refined(1), rough=refined(0)))
PDBC = {
    "pdbc_1_mixed": pdbc(
        "pdbc_1_mixed", "A plate under tractions and displacements, uniform strain; against the exact solution.",
        PLATES, ("Comparison/Exact u_x=x*(-180e6*(1-0.09)/200e9-0.3e-3)",)),
    "pdbc_2_cantilever": pdbc(
        "pdbc_2_cantilever", "A plate that is clamped and pressed; against a converged reference.", CLAMPED_PLATES,
        truth="reference"),
    "pdbc_3_displacement": pdbc(
        "pdbc_3_displacement", "A plate under displacements, uniform strain; against the exact solution.", PLATES),
    "pdbc_4_tension": pdbc(
        "pdbc_4_tension", "A plate under tension, uniform strain; against the exact solution.", PLATES,
        ("Comparison/Exact u_x=-0.3e-3*x",)),
    "pdbc_5_bending": pdbc(
        "pdbc_5_bending", "A plate under bending, a field of second degree; against the exact solution.", PLATES,
        ("Comparison/Exact u_y=-2e-3*(x^2+0.3*y^2)",)),
}


def schemes_of_springs(*, gauss_2, gauss_4, relaxed, consistent):
    """Every quadrature scheme, and what makes up for surfaces. gauss_2, gauss_4, relaxed: resolutions that these are
    run at; relaxed also the settings of the published way."""
    ghosts = (treated("taylor ghosts"), *NO_COLLAR)
    coarse, published = relaxed

    def gauss(points):
        return SPRINGS, GAUSS, f"Quadrature/Gauss points={points}"

    return (
        *finite_elements(consistent),
        Method("consistent form", consistent, accurate=True),
        Method("springs, one point", (SPRINGS, ONE_POINT)),
        Method("springs, cubic cell", (SPRINGS, scheme("cubic cell")), drawn=False),
        Method("springs, partial volume", (SPRINGS, scheme("partial volume"))),
        Method("springs, adaptive", (SPRINGS, scheme("adaptive")), drawn=False),
        Method("springs, exact", (SPRINGS, scheme("exact"))),
        Method("springs, gauss 1", gauss(1), coarse=gauss_2, drawn=False),
        Method("springs, gauss 2", gauss(2), coarse=gauss_2),
        Method("springs, gauss 3", gauss(3), coarse=gauss_4, drawn=False),
        Method("springs, gauss 4", gauss(4), coarse=gauss_4, drawn=False),
        Method("springs, exact, energy of the sphere",
               (SPRINGS, scheme("exact"), "Material/Boundary compensation=sphere")),
        Method("springs, exact, ghosts", (SPRINGS, scheme("exact"), *ghosts)),
        Method("springs, gauss 2, ghosts", (*gauss(2), *ghosts), coarse=gauss_4, drawn=False),
        Method("energy form", (EXTENDED, "Material/Form=energy", ONE_POINT), drawn=False),
        Method("paper's way", (SPRINGS, ONE_POINT, RELAXATION, *published), "paper", coarse),
    )


CONSISTENT_NO_COLLAR = (*CONSISTENT, ONE_POINT, *NO_COLLAR)
COLUMN = Scene(
    "prm/examples/tension_column.prm",
    "A column in tension, held in three layers at its ends, its sides free; against the exact solution. All schemes of "
    "springs have the error of the soft sides.",
    (mesh("1,024", "8, 16, 8"), mesh("3,456", "12, 24, 12"), mesh("8,192", "16, 32, 16"), mesh("16,000", "20, 40, 20")),
    schemes_of_springs(gauss_2=4, gauss_4=2, relaxed=(4, ()), consistent=CONSISTENT_NO_COLLAR),
    (5e-2, 2e-2, 1e-2, 1e-3), common=("Solver/Tolerance=1e-8",), carrier=CONSISTENT_NO_COLLAR)

# The field made small, since relaxation takes the deformed body.
SMALL_FIELD = tuple(f"{name}=1e-6*{formula}" for name, formula in (
    ("Boundary conditions/collar/u_x", "sin(pi*x)*sin(pi*y)"), ("Comparison/Exact u_x", "sin(pi*x)*sin(pi*y)"),
    ("Body force/b_x", "12*pi^2*sin(pi*x)*sin(pi*y)"), ("Body force/b_y", "(-6)*pi^2*cos(pi*x)*cos(pi*y)")))
GRADED = Scene(
    "prm/verification/graded_square.prm",
    "A manufactured field on a graded mesh, held in a collar of four layers; against the exact field. Springs stop at "
    "the error of their quadrature over a horizon of three cells, which refinement does not change.",
    tuple(Resolution(f"{400 * 4 ** times:,}", (f"Mesh/Refinements={times}",)) for times in range(4)),
    schemes_of_springs(gauss_2=4, gauss_4=4, relaxed=(4, SMALL_FIELD), consistent=CONSISTENT_NO_COLLAR),
    (1e-1, 1e-2, 1e-3, 1e-4), common=("Solver/Tolerance=1e-8",), carrier=CONSISTENT_NO_COLLAR)


FORMS_UNDER_TRACTIONS = (
    Method("consistent form", CONSISTENT_AT_FACES, accurate=True),
    Method("energy form, layer", (EXTENDED, "Material/Form=energy", held("layer"))),
    Method("energy form, ghosts", (EXTENDED, "Material/Form=energy", held("automatic"), treated("taylor ghosts"))),
    Method("paper form, layer", (*PAPER, held("layer"))),
    Method("springs, layer", (SPRINGS, held("layer")), drawn=False))
SINE = Scene(
    "tests/scenes/sine_field.prm",
    "A manufactured field in a square, one side held, tractions on the others and a body force; against the exact field.",
    tuple(mesh(f"{cells * cells:,}", f"{cells}, {cells}") for cells in (6, 12, 24, 48, 96)),
    (*finite_elements(CONSISTENT_AT_FACES), *FORMS_UNDER_TRACTIONS[:-1]),
    (1e-2, 1e-3, 1e-4, 1e-5), carrier=CONSISTENT_AT_FACES)
CANTILEVER = Scene(
    "tests/scenes/thin_cantilever.prm",
    "A thin cantilever, twenty times as long as thick, bent; against a converged reference.",
    (mesh("40", "20, 2", truth=refined(4)), mesh("160", "40, 4", truth=refined(3)),
     mesh("640", "80, 8", truth=refined(2)), mesh("2,560", "160, 16", truth=refined(2))),
    (*finite_elements(CONSISTENT_AT_FACES, coarse=3), *FORMS_UNDER_TRACTIONS),
    (1e-1, 1e-2, 1e-3), "reference", carrier=CONSISTENT_AT_FACES)


def drilled(name, size):
    return Resolution(name, (), refined(0), (), ("meshes/drilled_block.geo", size))


DRILLED = Scene(
    "prm/examples/drilled_block.prm",
    "A block with a bore, drawn by OpenCASCADE and meshed by dividing tetrahedra into hexahedra, bent; against quadratic "
    "elements on the mesh itself.",
    (drilled("3,996", 0.2), drilled("5,460", 0.15), drilled("10,732", 0.1)),
    (*finite_elements(CONSISTENT_AT_FACES)[:1], FORMS_UNDER_TRACTIONS[0], *FORMS_UNDER_TRACTIONS[1:2]),
    (5e-2, 1e-2, 1e-3), "reference", carrier=CONSISTENT_AT_FACES)


def errors_of_bar(summary, fem, _truth, finest):
    """The largest of the relative errors of the pull and of the strains at the middle, and how far the lateral stretch
    there is from that which goes with the axial one in a long bar."""
    def figures(report, of_fem):
        gauges = report["gauges"]
        pull = (report["fem"] if of_fem else report)["reactions"]["right"][0]
        return [pull, *(gauges[name]["fem" if of_fem else "stretch"][-1] - 1. for name in ("width", "length"))]

    own = figures(summary, fem)
    free = math.sqrt(1. - 0.33 * ((1. + own[2])**2 - 1.))
    return max(abs(each / best - 1.) for each, best in zip(own, figures(finest, True))), abs(1. + own[1] - free)


BAR_AT_FACES = (CORRESPONDENCE, "Material/Form=consistent")
BAR = Scene(
    "prm/examples/hyperelastic_bar.prm",
    "A clamped bar of Saint Venant-Kirchhoff material, pulled to 1.3 times its length in three load steps; the largest "
    "error of the pull and of the strains at the middle, against finite elements of 360 x 84 cells. There the lateral "
    "stretch is that of a long bar, sqrt(1 - nu (l^2 - 1)), to 5e-5 (other_error in the .csv). The paper's Newton's "
    "method is the program's own: dynamic relaxation has no correspondence model.",
    (mesh("156", "26, 6"), mesh("600", "50, 12"), mesh("2,400", "100, 24"), mesh("5,400", "150, 36")),
    (Method("FEM Q1", BAR_AT_FACES, "fem"),
     Method("consistent form", BAR_AT_FACES),
     Method("correspondence, families", (CORRESPONDENCE, "Material/Form=family")),
     Method("correspondence, families, no penalty",
            (CORRESPONDENCE, "Material/Form=family", "Material/Stabilisation=0"))),
    (1e-2, 1e-3), common=("Solver/Load steps=3", "Boundary conditions/right/u_x=0.3*t"), carrier=BAR_AT_FACES,
    finest=("Mesh/Cells=360, 84", "Comparison/FEM=true"), errors=errors_of_bar)

WAVE = Scene(
    "prm/verification/standing_wave.prm",
    "A standing wave, a period and an eighth of explicit dynamics, held in a collar; against the exact field at the "
    "end. The program has no finite elements in motion: ratios are to the energy form. The published form with one "
    "point is the paper's way.",
    tuple(collar(cells + 14, 7, 1.) for cells in (25, 50, 100, 200)),
    (Method("consistent form", (*CONSISTENT, *NO_COLLAR), accurate=True),
     Method("energy form", (EXTENDED, "Material/Form=energy")),
     Method("energy form, exact parts", (EXTENDED, "Material/Form=energy", scheme("exact")), drawn=False),
     Method("paper's way", PAPER, "paper"),
     Method("ordinary", (ORDINARY,)),
     Method("ordinary, partial volume", (ORDINARY, scheme("partial volume"))),
     Method("springs", (SPRINGS,)),
     Method("springs, partial volume", (SPRINGS, scheme("partial volume"))),
     Method("springs, exact parts", (SPRINGS, scheme("exact"))),
     Method("tensors, one point", (TENSORS, "Material/Form=one point"), drawn=False),
     Method("tensors, moment corrected", (TENSORS, "Material/Form=moment corrected"))),
    (1e-1, 1e-2, 1e-3), base="energy form")

SCENES = {"plate_with_hole": PLATE, "block_with_hole": BLOCK, "tensor_manufactured_2d": MANUFACTURED,
          "laminate_with_hole": LAMINATE, **PDBC, "tension_column": COLUMN, "graded_square": GRADED,
          "sine_field": SINE, "thin_cantilever": CANTILEVER, "drilled_block": DRILLED,
          "hyperelastic_bar": BAR, "standing_wave": WAVE}
