#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a cohesive crack makes of the notched beam: a reference for the same constants, without peridynamics.

    tests/validation/three_point_bending/cohesive_crack.py [--depth 0.05] [--rows 50] [--law bilinear]
        [--strength 3.9e6] [--energy 143]

Half of the beam stands in bilinear finite elements with incompatible modes (Taylor, Beresford and Wilson 1976), condensed
onto the nodes of the ligament. The crack opens along it by the softening law (Hillerborg, Modeer and Petersson 1976): for
each place of its tip, the node where the stress has just reached the strength, the load and the openings behind it follow
from one linear system a branch of the law. Needs numpy and scipy (Debian: python3-scipy).
"""

import argparse
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

# Openings over G_f/f_t, and stresses over f_t: those of Material/Softening.
LAWS = {"linear": ([0, 2], [1, 0]), "bilinear": ([0, .8, 3.6], [1, 1 / 3, 0])}


@dataclass
class Beam:
    """The beam and its concrete, in m, N, Pa, J/m^2: notched to half of its depth, its span 2.5 depths."""
    depth: float = .05
    rows: int = 50
    width: float = .05
    young_modulus: float = 37e9
    poisson_ratio: float = .2
    strength: float = 3.9e6
    energy: float = 143.
    law: str = "bilinear"


def element_stiffness(young_modulus, poisson_ratio):
    """The stiffness of a square in plane stress, a unit thick, its corners counter-clockwise from the lower left."""
    nu = poisson_ratio
    elasticity = young_modulus / (1 - nu**2) * np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]])
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    whole, mixed, inner = np.zeros((8, 8)), np.zeros((8, 4)), np.zeros((4, 4))
    for point in corners / np.sqrt(3):
        gradients = corners * (1 + corners * point)[:, ::-1] / 2
        strain = np.zeros((3, 8))
        strain[0, ::2] = strain[2, 1::2] = gradients[:, 0]
        strain[1, 1::2] = strain[2, ::2] = gradients[:, 1]
        bubbles = np.zeros((3, 4))
        bubbles[0, 0] = bubbles[2, 1] = -4 * point[0]
        bubbles[2, 2] = bubbles[1, 3] = -4 * point[1]
        whole += strain.T @ elasticity @ strain / 4
        mixed += strain.T @ elasticity @ bubbles / 4
        inner += bubbles.T @ elasticity @ bubbles / 4
    return whole - mixed @ np.linalg.solve(inner, mixed.T)


def condense(beam, gauge):
    """Half of the beam as the nodes of its ligament see it, from the notch up.

    Returns S, g and two rows: with the displacements u of these nodes along the axis and the load P, their forces are
    S u - g P, and the half opening of the mouth, read at the gauge's distance from it, is row . u + factor P.
    """
    size = beam.depth / beam.rows
    support, columns = round(1.25 * beam.depth / size), round((1.25 * beam.depth + .025) / size)
    number = np.arange((columns + 1) * (beam.rows + 1)).reshape(columns + 1, beam.rows + 1)
    nodes = np.stack([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]], -1).reshape(-1, 4)
    unknowns = np.stack([2 * nodes, 2 * nodes + 1], -1).reshape(-1, 8)
    stiffness = beam.width * element_stiffness(beam.young_modulus, beam.poisson_ratio)
    matrix = coo_matrix((np.tile(stiffness.ravel(), len(nodes)),
                         (np.repeat(unknowns, 8, 1).ravel(), np.tile(unknowns, (1, 8)).ravel()))).tocsr()
    ligament = 2 * number[0, beam.rows // 2:]
    free = np.setdiff1d(np.arange(2 * number.size), np.append(ligament, 2 * number[support, 0] + 1))
    load = np.zeros(2 * number.size)
    load[2 * number[0, -1] + 1] = -.5
    factors = splu(matrix[free][:, free].tocsc())
    coupling = matrix[free][:, ligament].toarray()
    moved, loaded = factors.solve(coupling), factors.solve(load[free])
    mouth = np.searchsorted(free, 2 * number[round(gauge / size), 0])
    return (matrix[ligament][:, ligament].toarray() - coupling.T @ moved, -coupling.T @ loaded, -moved[mouth],
            loaded[mouth])


def softening(beam):
    """Openings [m] and stresses [Pa] of the corners of the softening law."""
    if beam.law == "exponential":
        stresses = (np.exp(-np.linspace(0, np.log(100), 25)) - .01) / .99
        openings = np.linspace(0, 1, 25)
        openings = openings / np.trapz(stresses, openings)
    else:
        openings, stresses = (np.array(values, float) for values in LAWS[beam.law])
    return openings * beam.energy / beam.strength, stresses * beam.strength


def curve(beam, gauge=.005):
    """Openings of the mouth [m] and loads [N] as the tip goes up the ligament, from the first that opens on."""
    matrix, of_load, mouth_row, mouth_load = condense(beam, gauge)
    corners, stresses = softening(beam)
    slopes = np.append(np.diff(stresses) / np.diff(corners), 0.)
    n = len(of_load)
    area = np.full(n, beam.width * beam.depth / beam.rows)
    area[[0, -1]] /= 2
    opening, result = np.zeros(n), []
    for tip in range(n - 1):
        # Unknown: openings below the tip, forces above it, the load; at the tip the opening is 0, the stress f_t.
        for _ in range(100):
            branch = np.searchsorted(corners, opening[:tip], side="right") - 1
            system, right = np.zeros((n, n)), np.zeros(n)
            system[:, :tip] = matrix[:, :tip] / 2
            system[range(tip), range(tip)] += area[:tip] * slopes[branch]
            right[:tip] = -area[:tip] * (stresses[branch] - slopes[branch] * corners[branch])
            system[range(tip + 1, n), range(tip, n - 1)] = 1
            system[:, -1] = -of_load
            right[tip] = -area[tip] * beam.strength
            solution = np.linalg.solve(system, right)
            change = np.abs(solution[:tip] - opening[:tip]).max(initial=0)
            opening[:tip] = np.maximum(solution[:tip], 0)
            if change < 1e-12:
                break
        result.append((2 * (mouth_row @ opening / 2 + mouth_load * solution[-1]), solution[-1]))
    return np.array(result).T


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--depth", type=float, default=Beam.depth)
    parser.add_argument("--rows", type=int, default=Beam.rows, help="elements over the depth, even")
    parser.add_argument("--law", choices=[*LAWS, "exponential"], default=Beam.law)
    parser.add_argument("--strength", type=float, default=Beam.strength)
    parser.add_argument("--energy", type=float, default=Beam.energy)
    openings, loads = curve(Beam(**vars(parser.parse_args())))
    peak = loads.argmax()
    print(f"peak {loads[peak]:.0f} N at {1e6 * openings[peak]:.1f} um; "
          f"{np.interp(1e-4, openings[peak:], loads[peak:]):.0f} N at 100 um")


if __name__ == "__main__":
    main()
