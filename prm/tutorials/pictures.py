# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pictures of the tutorials, from what their runs left; needs python3-vtk9 and python3-matplotlib."""

import csv

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy
from matplotlib.collections import PolyCollection
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

# Page: directory of its run, file, field, factor on the displacement, label, largest value of the colour bar (None: its own).
FIELDS = {
    "02_plate_with_hole": ("solution.vtu", "von_mises_stress", 100, "von Mises stress [Pa], displacements times 100", None),
    "05_crack_in_a_strip": ("last", "damage", 20, "damage, displacements times 20", 0.5),
    "07_kalthoff": ("last", "damage", 1, "damage", 0.5),
    "08_branching": ("last", "damage", 20, "damage", 0.5),
    "10_own_part": ("solution.vtu", "von_mises_stress", 100, "von Mises stress [Pa], displacements times 100", None),
}
# Page: columns of history.csv, factors and labels.
CURVES = {
    "06_load_cmod": (("elongation of mouth [m]", 1e6, "opening of the mouth [µm]"),
                     ("reaction of top along y [N]", 1e-3, "load [kN]")),
}


def values(data, name, corners):
    """A field by cell, whether it is one of cells or of points."""
    array = data.GetCellData().GetArray(name)
    if array is not None:
        return vtk_to_numpy(array)
    return numpy.array([vtk_to_numpy(data.GetPointData().GetArray(name))[cell].mean(axis=0) for cell in corners])


def draw_field(page, directory, target):
    name, field, factor, label, largest = FIELDS[page]
    file = sorted(directory.glob("solution*.vtu"))[-1] if name == "last" else directory / name
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    data = reader.GetOutput()
    corners = [[data.GetCell(c).GetPointId(k) for k in range(4)] for c in range(data.GetNumberOfCells())]
    points = vtk_to_numpy(data.GetPoints().GetData())[:, :2]
    moved = vtk_to_numpy(data.GetPointData().GetArray("displacement"))[:, :2]
    shown = values(data, field, corners)
    shown = shown[:, 0] if shown.ndim > 1 else shown
    polygons = [(points + factor * moved)[cell] for cell in corners]
    figure, axes = plt.subplots(figsize=(8, 4.5))
    cells = PolyCollection(polygons, array=shown, cmap="viridis" if largest is None else "inferno_r", edgecolors="face", linewidths=0.1)
    if largest is not None:
        cells.set_clim(0, largest)
    axes.add_collection(cells)
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_axis_off()
    figure.colorbar(cells, ax=axes, label=label, shrink=0.8)
    figure.savefig(target, dpi=90, bbox_inches="tight")
    plt.close(figure)


def draw_curve(page, directory, target):
    with open(directory / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    figure, axes = plt.subplots(figsize=(6, 4))
    (x, x_factor, x_label), (y, y_factor, y_label) = CURVES[page]
    axes.plot([0] + [x_factor * float(row[x]) for row in rows], [0] + [y_factor * float(row[y]) for row in rows], ".-")
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    axes.grid(alpha=0.3)
    figure.savefig(target, dpi=90, bbox_inches="tight")
    plt.close(figure)


def draw(page, output, folder):
    """Draws the picture of a page, where it has one."""
    if page in FIELDS:
        draw_field(page, output / page, folder / f"{page}.png")
    if page in CURVES:
        draw_curve(page, output / page, folder / f"{page}.png")
