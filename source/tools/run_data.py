# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads what a run leaves in its output directory: summary.json, history.csv, the last fields of solution.pvd."""

import csv
import json
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy

# Sides of the cells as VTK numbers their corners.
SIDES_OF_QUAD = ((0, 1), (1, 2), (2, 3), (3, 0))
SIDES_OF_HEX = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
QUAD, HEX = 9, 12  # of VTK's cell types

# Units of the fields by the beginnings of their names; the first that fits.
UNITS = (("displacement", "m"), ("fem_displacement", "m"), ("reference_displacement", "m"), ("exact_displacement", "m"),
         ("error_against", "m"), ("velocity", "m/s"), ("strain_energy_density", "J/m$^3$"), ("stress", "Pa"),
         ("von_mises", "Pa"), ("largest_principal", "Pa"), ("smallest_principal", "Pa"), ("fem_stress", "Pa"),
         ("volume", "m$^3$"), ("horizon", "m"), ("temperature", "K"))


class Unreadable(Exception):
    """What was asked for is not there, in words."""


def unit_of(field):
    """The unit of a field, '-' where it has none."""
    return next((unit for start, unit in UNITS if field.startswith(start)), "-")


def read_summary(directory):
    """summary.json of a run; empty where it has none."""
    path = Path(directory) / "summary.json"
    if not path.is_file():
        return {}
    return json.loads(path.read_text(encoding="utf-8"))


def read_history(directory):
    """history.csv as {column: array}; empty where it has no rows."""
    path = Path(directory) / "history.csv"
    if not path.is_file():
        return {}
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    if len(rows) < 2:
        return {}
    values = numpy.array([[float(word) for word in row] for row in rows[1:] if len(row) == len(rows[0])])
    return dict(zip(rows[0], values.T)) if values.size else {}


def last_frame(directory):
    """(path, time) of the last fields that solution.pvd lists."""
    directory = Path(directory)
    pvd = directory / "solution.pvd"
    if not pvd.is_file():
        raise Unreadable(f"there is no {pvd}: the run has written no fields")
    sets = ElementTree.parse(pvd).getroot().iter("DataSet")
    frames = [(float(entry.get("timestep", 0)), entry.get("file")) for entry in sets]
    if not frames:
        raise Unreadable(f"{pvd} lists no fields")
    time, name = max(frames, key=lambda frame: frame[0])
    return directory / name, time


class Body:
    """The cells of a run with their fields.

    points: (n, 3) where the corners are [m], each once, but for those where a crack parts the cells
    displacement: (n, 3) of these points [m]
    cells: (m, 4) or (m, 8) corners by number; dimension: 2 or 3
    fields: {name: (m,) or (m, 3)} values of the cells
    """

    def __init__(self, points, cells, displacement, fields):
        self.points, self.cells, self.displacement, self.fields = points, cells, displacement, fields
        self.dimension = 2 if cells.shape[1] == 4 else 3

    def size(self):
        """Length of the diagonal of the body's box [m]."""
        return float(numpy.linalg.norm(self.points.max(axis=0) - self.points.min(axis=0)))

    def sides(self):
        """(corners, cell) of the sides that belong to one cell only."""
        sides = SIDES_OF_QUAD if self.dimension == 2 else SIDES_OF_HEX
        corners = self.cells[:, sides].reshape(-1, len(sides[0]))
        cell = numpy.repeat(numpy.arange(len(self.cells)), len(sides))
        # A side is known by a sum of random numbers of its corners, whatever their order.
        marks = numpy.random.default_rng(1).integers(0, 2**62, len(self.points), dtype=numpy.uint64)
        _, first, counts = numpy.unique(marks[corners].sum(axis=1, dtype=numpy.uint64), return_index=True, return_counts=True)
        alone = first[counts == 1]
        corners, cell = corners[alone], cell[alone]
        outer = ~self.beside_finer(corners)
        return corners[outer], cell[outer]

    def beside_finer(self, corners):
        """Of sides that belong to one cell each: which lie inside the body, between cells of two sizes.

        Such a side has a point in its middle, which is a corner of all the finer sides on it.
        """
        middle = self.points[corners].mean(axis=1)
        longest = numpy.linalg.norm(self.points[corners[:, 0]] - self.points[corners[:, corners.shape[1] // 2]], axis=1)
        candidates = numpy.unique(corners)
        found = nearest_points(self.points[candidates], middle)
        gap = numpy.linalg.norm(self.points[candidates[found]] - middle, axis=1)
        coarse = gap < 1e-3 * longest
        hanging = numpy.zeros(len(self.points), dtype=bool)
        hanging[candidates[found[coarse]]] = True
        return coarse | hanging[corners].any(axis=1)


def nearest_points(points, places):
    """The number of the point nearest to each place."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticPointLocator

    grid = vtkPolyData()
    grid.SetPoints(vtkPoints())
    grid.GetPoints().SetData(numpy_to_vtk(numpy.ascontiguousarray(points, dtype=numpy.float64), deep=True))
    locator = vtkStaticPointLocator()
    locator.SetDataSet(grid)
    locator.BuildLocator()
    return numpy.array([locator.FindClosestPoint(place) for place in places], dtype=numpy.int64)


def positions_by_number(points):
    """The number of each point's position; equal positions are equal in every bit."""
    bits = numpy.ascontiguousarray(points + 0.0, dtype=numpy.float64).view(numpy.uint64)
    factors = numpy.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], dtype=numpy.uint64)
    with numpy.errstate(over="ignore"):
        mixed = (bits ^ (bits >> numpy.uint64(29))) * factors
        mixed = ((mixed ^ (mixed >> numpy.uint64(32))) * factors).sum(axis=1, dtype=numpy.uint64)
    return numpy.unique(mixed, return_inverse=True)[1]


def join_points(points, cells, displacement):
    """Makes one point of those that lie and move together, so that only cracks part cells."""
    place = positions_by_number(points)
    n_places = place.max() + 1
    largest = numpy.abs(displacement).max() if displacement.size else 0.0
    spread = numpy.zeros(n_places)
    for component in displacement.T:
        upper, lower = numpy.full(n_places, -numpy.inf), numpy.full(n_places, numpy.inf)
        numpy.maximum.at(upper, place, component)
        numpy.minimum.at(lower, place, component)
        spread = numpy.maximum(spread, upper - lower)
    parted = spread[place] > 1e-4 * largest
    # What a crack parts is told by where it has moved to.
    moved = numpy.round(displacement / (1e-4 * largest if largest > 0 else 1.0)) * parted[:, None]
    key = positions_by_number(numpy.column_stack([place.astype(float), moved[:, :2] @ [1.0, 1e8], moved[:, 2]]))
    _, first, inverse = numpy.unique(key, return_index=True, return_inverse=True)
    return points[first], inverse[cells], displacement[first]


def at_corners(cells, points, values):
    """Values of cells, taken to the points as the mean over the cells that meet there."""
    place = positions_by_number(points)
    n_places = place.max() + 1
    corners = place[cells].ravel()
    number = numpy.bincount(corners, minlength=n_places)
    result = [numpy.bincount(corners, numpy.repeat(component, cells.shape[1]), n_places) / number for component in values.T]
    return numpy.array(result).T[place]


def split(arrays, cells):
    """(fields of cells, fields of points) of arrays of points: what is constant in every cell is of the cells."""
    of_cells, of_points = {}, {}
    for name, values in arrays.items():
        corners = values[cells]
        if numpy.all(corners == corners[:, :1]):
            of_cells[name] = corners[:, 0]
        else:
            of_points[name] = values
    return of_cells, of_points


def read_grid(path):
    """(points, cells, arrays of points, arrays of cells) of a .vtu or .pvtu file."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader

    if not path.is_file():
        raise Unreadable(f"there is no {path}")
    reader = vtkXMLPUnstructuredGridReader() if path.suffix == ".pvtu" else vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    if grid.GetNumberOfCells() == 0:
        raise Unreadable(f"{path} has no cells")
    types = set(numpy.unique(vtk_to_numpy(grid.GetCellTypesArray())))
    if types not in ({QUAD}, {HEX}):
        raise Unreadable(f"{path} has cells other than quadrilaterals or hexahedra (VTK's types {sorted(types)})")
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(grid.GetNumberOfCells(), -1)

    def arrays(data):
        found = (data.GetArray(k) for k in range(data.GetNumberOfArrays()))
        return {array.GetName(): vtk_to_numpy(array).astype(float) for array in found}

    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    return points, cells, arrays(grid.GetPointData()), arrays(grid.GetCellData())


def read_body(directory):
    """(Body, time) of the last fields of a run."""
    path, time = last_frame(directory)
    points, cells, of_points, of_cells = read_grid(path)
    constant, varying = split(of_points, cells)
    fields = {**{name: values[cells].mean(axis=1) for name, values in varying.items()}, **constant, **of_cells}
    if "displacement" in varying:
        displacement = varying["displacement"]
    elif "displacement" in fields:
        displacement = at_corners(cells, points, fields["displacement"])
    else:
        displacement = numpy.zeros_like(points)
    return Body(*join_points(points, cells, displacement), fields), time
