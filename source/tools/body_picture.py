# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws a field on the deformed body: its cells, outline, cracks and a colour bar, as PNG."""

import math

import numpy
from matplotlib import cm, colors
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure

from run_data import unit_of

# Cells that have lost this share of their bonds lie at a crack: a crack along a line of cells takes about as much.
DAMAGE_OF_CRACKS = 0.35
# Lines of the mesh are drawn up to this number of cells or faces.
MOST_CELLS_WITH_LINES = 4000
# Faces that meet at a larger angle [degrees] meet at an edge of the body.
ANGLE_OF_EDGES = 30.0
# Width of a picture, and room below and above the body [inch].
WIDTH, BELOW, ABOVE = 8.0, 0.6, 0.85


def magnification(body):
    """The factor on displacements, 1, 2 or 5 times a power of ten, that makes them visible: 1 where they are anyway."""
    largest, size = float(numpy.linalg.norm(body.displacement, axis=1).max()), body.size()
    if not largest > 0 or largest > 0.02 * size:
        return 1.0
    wanted = 0.06 * size / largest
    power = 10.0 ** math.floor(math.log10(wanted))
    return max(factor * power for factor in (1, 2, 5) if factor * power <= wanted * (1 + 1e-9))


def values_to_show(body, field):
    """(m,) numbers of a field: its values, or the magnitudes of a vector."""
    values = body.fields[field]
    return values if values.ndim == 1 else numpy.linalg.norm(values, axis=1)


class Colours:
    """From values to colours: range, map and where the bar has arrows."""

    def __init__(self, field, values):
        finite = values[numpy.isfinite(values)]
        lower, upper = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
        if field in ("damage", "precracks"):
            lower, upper, name, self.extend = 0.0, 1.0, "Reds", "neither"
        else:
            # A few cells at a notch must not leave the rest in one colour.
            low, high = numpy.percentile(finite, [0.5, 99.5]) if finite.size else (lower, upper)
            cut_low, cut_high = low - lower > 2 * (high - low) > 0, upper - high > 2 * (high - low) > 0
            lower, upper = float(low) if cut_low else lower, float(high) if cut_high else upper
            self.extend = {(False, False): "neither", (True, False): "min", (False, True): "max",
                           (True, True): "both"}[cut_low, cut_high]
            name = "viridis"
            if lower < 0 < upper and min(-lower, upper) > 0.05 * max(-lower, upper):
                lower, upper, name = min(lower, -upper), max(-lower, upper), "coolwarm"
        if not upper > lower:
            middle, around = lower, abs(lower) * 1e-3 or 1.0
            lower, upper = middle - around, middle + around
        self.map = cm.ScalarMappable(colors.Normalize(lower, upper), name)

    def of(self, values):
        return self.map.to_rgba(values)


def title_of(field, body, factor, time, is_series):
    words = field.replace("_", " ")
    if body.fields[field].ndim > 1:
        words += ", magnitude"
    shown = "true to scale" if factor == 1 else f"displacements magnified {factor:,.0f} times" if factor >= 1 else f"displacements times {factor:g}"
    return f"{words}\n{shown}" + (f", t = {time:.4g}" if is_series else "")


def draw_plane(axes, body, positions, colours, damage):
    """The cells of a two-dimensional body, the outline it had, the one it has, and its cracks."""
    polygons = positions[body.cells][:, :, :2]
    has_lines = len(body.cells) <= MOST_CELLS_WITH_LINES
    axes.add_collection(PolyCollection(polygons, facecolors=colours, edgecolors=(0, 0, 0, 0.25) if has_lines else colours,
                                       linewidths=0.3 if has_lines else 0.2))
    sides, _ = body.sides()
    axes.add_collection(LineCollection(body.points[sides][:, :, :2], colors="0.6", linewidths=0.6, linestyles="dashed"))
    axes.add_collection(LineCollection(positions[sides][:, :, :2], colors="black", linewidths=0.8))
    if damage is not None and numpy.any(damage > DAMAGE_OF_CRACKS):
        axes.add_collection(PolyCollection(polygons[damage > DAMAGE_OF_CRACKS], facecolors=(0, 0, 0, 0.65), edgecolors="none"))
    both = numpy.concatenate([positions[:, :2], body.points[:, :2]])
    return both


def axes_of_view(view):
    """(3, 3) unit vectors of the picture: to the right, up, towards who looks; z is up where it can be."""
    towards = numpy.asarray(view, dtype=float)
    towards /= numpy.linalg.norm(towards)
    up = numpy.array([0.0, 0.0, 1.0]) if abs(towards[2]) < 0.99 else numpy.array([0.0, 1.0, 0.0])
    right = numpy.cross(up, towards)
    right /= numpy.linalg.norm(right)
    return numpy.array([right, numpy.cross(towards, right), towards])


def edges_of_faces(faces, normals):
    """(corners, face) of the edges of the surface: where faces meet at an angle, or where a face meets none."""
    edges = numpy.stack([faces, numpy.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)
    face = numpy.repeat(numpy.arange(len(faces)), 4)
    edges.sort(axis=1)
    order = numpy.lexsort((edges[:, 1], edges[:, 0]))
    edges, face = edges[order], face[order]
    same = numpy.all(edges[1:] == edges[:-1], axis=1)
    cosine = numpy.einsum("ij,ij->i", normals[face[1:]], normals[face[:-1]])
    smooth = same & (cosine > math.cos(math.radians(ANGLE_OF_EDGES)))
    kept = numpy.ones(len(edges), dtype=bool)
    kept[1:] &= ~smooth
    kept[:-1] &= ~smooth
    return edges[kept], face[kept]


def draw_solid(axes, body, positions, colours, damage, view):
    """The surface of a three-dimensional body as it is seen from afar, what is nearer drawn later."""
    turned = positions @ axes_of_view(view).T
    faces, cell = body.sides()
    corners = turned[faces]
    normals = numpy.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normals /= numpy.maximum(numpy.linalg.norm(normals, axis=1), 1e-300)[:, None]
    seen = normals[:, 2] > 0
    # Light comes from above the left shoulder.
    light = numpy.array([-0.35, 0.45, 0.82])
    shade = (0.55 + 0.45 * numpy.clip(normals @ (light / numpy.linalg.norm(light)), 0, 1))[:, None]
    face_colours = colours[cell].copy()
    face_colours[:, :3] *= shade
    if damage is not None:
        face_colours[damage[cell] > DAMAGE_OF_CRACKS, :3] *= 0.3
    edges, face = edges_of_faces(faces, normals)
    edges = edges[seen[face]]
    depth = numpy.concatenate([corners[seen][:, :, 2].mean(axis=1),
                               turned[edges][:, :, 2].max(axis=1) + 1e-3 * body.size()])
    order = numpy.argsort(depth, kind="stable")
    has_lines = seen.sum() <= MOST_CELLS_WITH_LINES
    polygons = list(corners[seen][:, :, :2]) + list(turned[edges][:, :, :2])
    black, fill = (0.0, 0.0, 0.0, 1.0), [tuple(colour) for colour in face_colours[seen]]
    # Not transparent, lest what is behind be seen between two faces.
    line = [(*(0.75 * colour[:3]), 1.0) for colour in face_colours[seen]] if has_lines else fill
    fill, line = fill + [(0, 0, 0, 0)] * len(edges), line + [black] * len(edges)
    width = [0.3] * int(seen.sum()) + [0.8] * len(edges)
    axes.add_collection(PolyCollection([polygons[k] for k in order], facecolors=[fill[k] for k in order],
                                       edgecolors=[line[k] for k in order], linewidths=[width[k] for k in order]))
    return turned[:, :2]


def draw_directions(axes, view):
    """A small cross of x, y, z in the corner."""
    right_and_up = axes_of_view(view)[:2]
    for k, name in enumerate("xyz"):
        tip = right_and_up[:, k] * 0.36
        if numpy.hypot(*tip) < 0.05:
            continue
        axes.annotate("", xy=(0.5 + tip[0], 0.5 + tip[1]), xytext=(0.5, 0.5), xycoords="axes fraction",
                      arrowprops={"arrowstyle": "->", "linewidth": 0.8})
        axes.text(0.5 + 1.25 * tip[0], 0.5 + 1.25 * tip[1], name, transform=axes.transAxes, ha="center", va="center", fontsize=8)


def set_sizes(figure, axes, extent):
    """Makes a figure as high as the body asks for, within limits; returns its height [inch]."""
    width = 0.72 * WIDTH
    height = width * float(numpy.clip(extent[1] / extent[0], 0.35, 1.1)) + BELOW + ABOVE
    figure.set_size_inches(WIDTH, height)
    axes.set_position([0.09, BELOW / height, 0.72, 1 - (BELOW + ABOVE) / height])
    return height


def body_picture(path, body, field, time=0.0, is_series=False, view=(1.0, -2.0, 1.0)):
    """Writes the picture of a field."""
    values = values_to_show(body, field)
    colours = Colours(field, values)
    factor = magnification(body)
    positions = body.points + factor * body.displacement
    damage = body.fields.get("damage") if field not in ("damage", "precracks") else None
    figure = Figure(dpi=150)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes([0, 0, 1, 1])
    if body.dimension == 2:
        extent = draw_plane(axes, body, positions, colours.of(values), damage)
        axes.set_xlabel("x [m]")
        axes.set_ylabel("y [m]")
        axes.ticklabel_format(scilimits=(-2, 4))  # long numbers would push the label out
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
    else:
        extent = draw_solid(axes, body, positions, colours.of(values), damage, view)
        axes.set_axis_off()
    lower, upper = extent.min(axis=0), extent.max(axis=0)
    room = 0.04 * float((upper - lower).max())
    axes.set_xlim(lower[0] - room, upper[0] + room)
    axes.set_ylim(lower[1] - room, upper[1] + room)
    axes.set_aspect("equal", anchor="C")
    height = set_sizes(figure, axes, (upper - lower + 2 * room))
    if body.dimension == 3:
        frame = figure.add_axes([0.01, 0.02, 1.1 / WIDTH, 1.1 / height], frameon=False)
        frame.set_axis_off()
        draw_directions(frame, view)
    title = title_of(field, body, factor, time, is_series)
    if damage is not None and numpy.any(damage > DAMAGE_OF_CRACKS):
        title += f"; dark: damage above {DAMAGE_OF_CRACKS:g}"
    figure.suptitle(title, fontsize=11, y=1 - 0.12 / height, verticalalignment="top")
    bar = figure.colorbar(colours.map, cax=figure.add_axes([0.86, BELOW / height, 0.025, 1 - (BELOW + ABOVE) / height]), extend=colours.extend)
    bar.set_label(f"[{unit_of(field)}]")
    bar.formatter.set_powerlimits((-2, 4))
    bar.update_ticks()
    canvas.print_png(str(path), metadata={"Software": None})
