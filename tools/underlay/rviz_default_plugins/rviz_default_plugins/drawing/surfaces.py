# SPDX-License-Identifier: Apache-2.0
"""Triangle meshes of simple bodies."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ['Surface', 'arrow', 'cone', 'cube', 'revolved', 'sphere']


class Surface(NamedTuple):
    """Vertices in metres, and the indices of those of each triangle."""

    vertices: NDArray[Any]
    faces: NDArray[Any]


def revolved(profile: Sequence[tuple[float, float]], segments: int = 12) -> Surface:
    """
    Make the surface of revolution of a profile about the x axis.

    Parameters
    ----------
    profile
        Pairs of x and radius, in m, in order of increasing x.
    segments
        The number of vertices around the axis for each pair.

    """
    turns = np.linspace(0.0, 2.0 * np.pi, segments, endpoint=False)
    rings = [
        np.stack([np.full(segments, x), radius * np.cos(turns), radius * np.sin(turns)], axis=1)
        for x, radius in profile
    ]
    here = np.arange(segments)
    beside = (here + 1) % segments
    faces = []
    for ring in range(len(profile) - 1):
        low, high = ring * segments, (ring + 1) * segments
        faces.append(np.stack([low + here, low + beside, high + here], axis=1))
        faces.append(np.stack([low + beside, high + beside, high + here], axis=1))
    return Surface(
        np.concatenate(rings).astype(np.float32), np.concatenate(faces).astype(np.uint32)
    )


@lru_cache(maxsize=64)
def arrow(
    shaft_length: float, shaft_radius: float, head_length: float, head_radius: float
) -> Surface:
    """
    Make an arrow along the x axis, whose tail is at the origin.

    Parameters
    ----------
    shaft_length, shaft_radius
        The size of the shaft, in m.
    head_length, head_radius
        The size of the head, which is a cone, in m.

    """
    end = shaft_length + head_length
    return revolved(
        (
            (0.0, 0.0),
            (0.0, shaft_radius),
            (shaft_length, shaft_radius),
            (shaft_length, head_radius),
            (end, 0.0),
        )
    )


@lru_cache(maxsize=64)
def cone(length: float, radius: float) -> Surface:
    """
    Make a cone with its tip at the origin that opens along the x axis.

    Parameters
    ----------
    length
        From the tip to the base, in m.
    radius
        The radius of the base, in m.

    """
    return revolved(((0.0, 0.0), (length, radius), (length, 0.0)), 24)


@lru_cache(maxsize=64)
def sphere(rings: int = 8) -> Surface:
    """
    Make a sphere of diameter 1 around the origin.

    Parameters
    ----------
    rings
        The number of rings of faces along the x axis.

    """
    angles = np.linspace(0.0, np.pi, rings + 1)
    return revolved([(-0.5 * float(np.cos(a)), 0.5 * float(np.sin(a))) for a in angles])


@lru_cache(maxsize=64)
def cube() -> Surface:
    """Make a cube with edges of length 1 around the origin."""
    corners = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
    squares = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    faces = [face for a, b, c, d in squares for face in ((a, b, c), (a, c, d))]
    return Surface(np.array(corners, dtype=np.float32), np.array(faces, dtype=np.uint32))
