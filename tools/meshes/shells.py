# SPDX-License-Identifier: Apache-2.0
"""
Make the shells of the humanoid, the meshes of `src/humanoid_description/meshes`, from a few sizes.

    python3 tools/meshes/shells.py          # writes them all; the same bytes on every run

A shell is a closed surface around an axis. A row of the table below gives its cross-section at
one height: a superellipse, which is an ellipse with the exponent 2 and a rounded box with 4. In
between, the sizes are interpolated, and the ends are rounded. All is in m, in the frame of the
link, at scale 1; each shell is symmetrical in y, so that it fits the left side and the right one.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

FOLDER = Path(__file__).resolve().parents[2] / 'src' / 'humanoid_description' / 'meshes'
STEP_M = 1e-5
"""To what the vertices are rounded, so that other machines write the same bytes."""
_FACET = np.dtype([('normal', '<f4', 3), ('corners', '<f4', (3, 3)), ('attribute', '<u2')])
_HEADER_BYTES = 80


@dataclass(frozen=True)
class Shell:
    """
    A closed surface around an axis.

    Attributes
    ----------
    rows
        Position along the axis, middle in the first direction across, half size in the first and
        in the second one: (n, 4), in increasing order of the positions.
    ends
        The lengths over which the first and the last end are rounded.
    exponent
        The exponent of the superellipse.
    axis
        `z`, with x and y across; `x`, with z and y across.
    around, along
        The number of vertices around the axis, and of rings along it.

    """

    rows: tuple[tuple[float, float, float, float], ...]
    ends: tuple[float, float] = (0.01, 0.01)
    exponent: float = 2.0
    axis: str = 'z'
    around: int = 24
    along: int = 14


SHELLS = {
    'pelvis': Shell(
        ((-0.052, -0.004, 0.058, 0.070), (-0.02, -0.003, 0.078, 0.094),
         (0.02, 0.0, 0.080, 0.102), (0.062, 0.0, 0.072, 0.092)),
        ends=(0.025, 0.022), exponent=2.8,
    ),
    'crotch': Shell(
        ((-0.088, 0.0, 0.034, 0.034), (-0.05, 0.0, 0.052, 0.060), (0.0, 0.0, 0.060, 0.070)),
        ends=(0.025, 0.02), exponent=2.4, along=10,
    ),
    'abdomen': Shell(
        ((-0.038, 0.0, 0.060, 0.078), (0.02, 0.002, 0.060, 0.078), (0.07, 0.002, 0.066, 0.088),
         (0.12, 0.004, 0.070, 0.094)),
        ends=(0.02, 0.02), exponent=2.3, along=12,
    ),
    'laser_window': Shell(
        ((-0.001, 0.001, 0.066, 0.084), (0.021, 0.001, 0.066, 0.084)),
        ends=(0.005, 0.005), exponent=2.3, around=36, along=6,
    ),
    'chest': Shell(
        ((0.072, 0.004, 0.066, 0.088), (0.12, 0.005, 0.080, 0.106), (0.20, 0.008, 0.090, 0.124),
         (0.27, 0.010, 0.094, 0.140), (0.325, 0.004, 0.080, 0.138), (0.372, -0.006, 0.050, 0.078)),
        ends=(0.02, 0.028), exponent=2.7, around=36, along=20,
    ),
    'backpack': Shell(
        ((0.11, -0.078, 0.032, 0.074), (0.20, -0.080, 0.038, 0.088), (0.31, -0.076, 0.034, 0.080)),
        ends=(0.025, 0.025), exponent=3.6, along=14,
    ),
    'chest_ring': Shell(
        ((0.07, 0.255, 0.030, 0.030), (0.1085, 0.255, 0.030, 0.030)),
        ends=(0.003, 0.004), axis='x', along=8,
    ),
    'chest_lamp': Shell(
        ((0.08, 0.255, 0.020, 0.020), (0.1120, 0.255, 0.020, 0.020)),
        ends=(0.003, 0.006), axis='x', along=8,
    ),
    'head': Shell(
        ((0.002, 0.014, 0.046, 0.044), (0.03, 0.010, 0.072, 0.064), (0.075, 0.007, 0.080, 0.074),
         (0.11, 0.004, 0.078, 0.072), (0.14, 0.0, 0.070, 0.066)),
        ends=(0.016, 0.052), exponent=2.5, around=36, along=20,
    ),
    'visor': Shell(
        ((0.036, 0.030, 0.058, 0.054), (0.075, 0.030, 0.063, 0.066), (0.116, 0.026, 0.060, 0.060)),
        ends=(0.016, 0.016), exponent=2.5, around=36, along=12,
    ),
    'eye': Shell(
        ((0.068, 0.086, 0.0082, 0.0115), (0.094, 0.086, 0.0082, 0.0115)),
        ends=(0.0125, 0.0125), around=20, along=12,
    ),
    'shoulder_cap': Shell(
        ((-0.012, 0.0, 0.060, 0.058), (0.0, 0.0, 0.060, 0.058), (0.061, 0.0, 0.060, 0.058)),
        ends=(0.008, 0.058), around=28, along=14,
    ),
    'upper_arm': Shell(
        ((-0.212, 0.0, 0.036, 0.035), (-0.17, 0.0, 0.040, 0.038), (-0.10, 0.001, 0.046, 0.042),
         (-0.04, 0.001, 0.047, 0.044), (0.0, 0.0, 0.042, 0.041)),
        ends=(0.010, 0.016), exponent=2.2,
    ),
    'forearm': Shell(
        ((-0.202, 0.0, 0.028, 0.027), (-0.16, 0.0, 0.032, 0.031), (-0.10, 0.001, 0.038, 0.036),
         (-0.05, 0.001, 0.041, 0.038), (-0.012, 0.0, 0.035, 0.034)),
        ends=(0.008, 0.014), exponent=2.2,
    ),
    'fist': Shell(
        ((-0.255, 0.002, 0.032, 0.024), (-0.225, 0.001, 0.035, 0.027), (-0.19, 0.0, 0.029, 0.026)),
        ends=(0.024, 0.012), exponent=2.4, along=12,
    ),
    'palm': Shell(
        ((-0.0425, 0.0, 0.026, 0.060), (-0.028, 0.0, 0.026, 0.061), (-0.014, 0.0, 0.024, 0.044),
         (0.0, 0.0, 0.022, 0.026)),
        ends=(0.006, 0.01), exponent=3.6, along=14,
    ),
    'finger': Shell(
        ((-0.075, 0.0, 0.009, 0.006), (-0.06, 0.0, 0.012, 0.006), (0.0, 0.0, 0.012, 0.006)),
        ends=(0.008, 0.002), exponent=4.5, around=24, along=12,
    ),
    'thigh': Shell(
        ((-0.290, 0.001, 0.047, 0.046), (-0.25, 0.003, 0.052, 0.050), (-0.17, 0.006, 0.063, 0.057),
         (-0.09, 0.006, 0.070, 0.061), (-0.04, 0.002, 0.064, 0.058), (-0.015, 0.0, 0.056, 0.053)),
        ends=(0.010, 0.020), exponent=2.2, around=28, along=16,
    ),
    'shank': Shell(
        ((-0.296, 0.0, 0.033, 0.032), (-0.25, -0.001, 0.037, 0.036), (-0.17, -0.004, 0.047, 0.044),
         (-0.10, -0.005, 0.056, 0.05), (-0.05, -0.001, 0.053, 0.049), (-0.012, 0.0, 0.046, 0.045)),
        ends=(0.008, 0.014), exponent=2.2, around=28, along=16,
    ),
    'sole': Shell(
        ((-0.086, -0.0575, 0.0125, 0.042), (-0.04, -0.0580, 0.0120, 0.047),
         (0.04, -0.0585, 0.0115, 0.052), (0.09, -0.0575, 0.0125, 0.055),
         (0.137, -0.0560, 0.0140, 0.050)),
        ends=(0.020, 0.030), exponent=4.0, axis='x', along=16,
    ),
    'instep': Shell(
        ((-0.074, -0.050, 0.014, 0.036), (-0.045, -0.042, 0.024, 0.041),
         (0.0, -0.033, 0.033, 0.044), (0.04, -0.037, 0.029, 0.046),
         (0.085, -0.048, 0.018, 0.047), (0.118, -0.052, 0.010, 0.043)),
        ends=(0.020, 0.030), exponent=2.6, axis='x', along=16,
    ),
}  # fmt: skip
"""The shells, by the names of their files."""


def mesh_of(shell: Shell) -> tuple[Array, NDArray[np.int64]]:
    """
    Compute the vertices and the triangles of a shell.

    Parameters
    ----------
    shell
        Its sizes.

    Returns
    -------
    tuple
        The vertices (n, 3) in m, and the indices of the vertices of each triangle (m, 3),
        anticlockwise as seen from outside.

    """
    at = _positions(shell)
    middle, first, second = (_between(shell.rows, at, column) for column in (1, 2, 3))
    shrink = _rounding(shell, at)
    across = _superellipse(shell)
    rings = np.empty((len(at), shell.around, 3))
    rings[..., 0] = middle[:, None] + (first * shrink)[:, None] * across[:, 0]
    rings[..., 1] = (second * shrink)[:, None] * across[:, 1]
    rings[..., 2] = at[:, None]
    poles = [(middle[end], 0.0, shell.rows[end][0]) for end in (0, -1)]
    vertices = np.vstack([poles, rings.reshape(-1, 3)])
    faces = _faces(len(at), shell.around)
    if shell.axis == 'x':  # exchanges two directions, which turns the surface inside out
        vertices, faces = vertices[:, ::-1], faces[:, ::-1]
    return np.round(vertices / STEP_M) * STEP_M, faces


def _positions(shell: Shell) -> Array:
    """Place the rings along the axis, closer to each other where the ends are rounded."""
    low, high = shell.rows[0][0], shell.rows[-1][0]
    bottom, top = shell.ends
    ends = max(3, shell.along // 4)
    angles = np.linspace(0.0, np.pi / 2, ends + 1)[1:]
    middle = np.linspace(low + bottom, high - top, max(2, shell.along - 2 * ends + 2))
    lower = low + bottom * (1.0 - np.cos(angles))
    upper = high - top * (1.0 - np.cos(angles[::-1]))
    return np.concatenate([lower, middle[1:-1], upper])


def _between(rows: tuple[tuple[float, ...], ...], at: Array, column: int) -> Array:
    """Interpolate a column of the rows by cubics that do not overshoot (Fritsch and Butland)."""
    x, y = (np.array([row[index] for row in rows]) for index in (0, column))
    steps = np.diff(x)
    slopes = np.diff(y) / steps
    tangents = np.zeros(len(x))
    product = slopes[:-1] * slopes[1:]
    same = product > 0.0
    total = np.where(same, slopes[:-1] + slopes[1:], 1.0)
    tangents[1:-1] = np.where(same, 2.0 * product / total, 0.0)
    tangents[0], tangents[-1] = slopes[0], slopes[-1]
    index = np.clip(np.searchsorted(x, at, side='right') - 1, 0, len(steps) - 1)
    h, t = steps[index], (at - x[index]) / steps[index]
    left, right = y[index], y[index + 1]
    cubic: Array = (
        (1 + 2 * t) * (1 - t) ** 2 * left
        + t * (1 - t) ** 2 * h * tangents[index]
        + t**2 * (3 - 2 * t) * right
        + t**2 * (t - 1) * h * tangents[index + 1]
    )
    return cubic


def _rounding(shell: Shell, at: Array) -> Array:
    """Compute the factors by which the cross-sections shrink towards the rounded ends."""
    (bottom, top), low, high = shell.ends, shell.rows[0][0], shell.rows[-1][0]
    inside = np.minimum((at - low) / bottom, (high - at) / top)
    factors: Array = np.sqrt(1.0 - (1.0 - np.clip(inside, 0.0, 1.0)) ** 2)
    return factors


def _superellipse(shell: Shell) -> Array:
    """Compute points (around, 2) of the cross-section, with half sizes of 1."""
    angles = 2.0 * np.pi * np.arange(shell.around) / shell.around
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    size = np.sum(np.abs(circle) ** shell.exponent, axis=1) ** (-1.0 / shell.exponent)
    points: Array = circle * size[:, None]
    return points


def _faces(rings: int, around: int) -> NDArray[np.int64]:
    """Return the triangles between the rings, and between them and the poles, 0 and 1."""
    now = np.arange(around)
    after = (now + 1) % around
    first = 2 + np.arange(rings - 1)[:, None] * around
    a, b = (first + now).ravel(), (first + after).ravel()
    last = 2 + (rings - 1) * around
    return np.vstack(
        [
            np.column_stack([np.zeros(around, dtype=np.int64), 2 + after, 2 + now]),
            np.column_stack([a, b, b + around]),
            np.column_stack([a, b + around, a + around]),
            np.column_stack([last + now, last + after, np.ones(around, dtype=np.int64)]),
        ]
    )


def stl_of(vertices: Array, faces: NDArray[np.int64]) -> bytes:
    """
    Encode a mesh as binary STL.

    Parameters
    ----------
    vertices
        The vertices (n, 3).
    faces
        The indices of the vertices of each triangle (m, 3).

    """
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    facets = np.zeros(len(faces), dtype=_FACET)
    facets['corners'], facets['normal'] = corners, np.round(normals, 4)
    count = len(faces).to_bytes(4, 'little')
    return bytes(_HEADER_BYTES) + count + facets.tobytes()


def main() -> None:
    """Write all shells."""
    FOLDER.mkdir(exist_ok=True)
    for name, shell in SHELLS.items():
        (FOLDER / f'{name}.stl').write_bytes(stl_of(*mesh_of(shell)))


if __name__ == '__main__':
    main()
