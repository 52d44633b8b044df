# SPDX-License-Identifier: Apache-2.0
"""The boxes of what is visible in a picture, and which part of each thing that is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import cv2
from humanoid_simulation.camera.pinhole import Pinhole
from humanoid_simulation.scene import Thing
from humanoid_simulation.scene.meshes import PROFILES, SEGMENTS
from humanoid_simulation.scene.parts import MESH, Part
import numpy as np
from numpy.typing import NDArray
from pictures import COLUMNS, Labels

Array = NDArray[np.float64]
NEAREST_M = 0.05
_SUB_PIXEL_BITS = 4
_DRAWN_PX = 200.0
"""The longer edge of what an area is measured on."""


@dataclass(frozen=True)
class Seen:
    """Pose of a thing in the optical frame: z forward, x right, y down."""

    thing: Thing
    number: int
    """Of its class."""
    position_m: Array
    rotation: Array
    """(3, 3), from the axes of the thing to the optical frame."""


def labels_of(owners: NDArray[np.int32], seen: Mapping[int, Seen], pinhole: Pinhole) -> Labels:
    """
    Compute the labels of a picture from the things that its pixels show.

    Parameters
    ----------
    owners
        (height, width), for each pixel the number of the thing that it shows, or -1.
    seen
        The things that get a label, by their number in `owners`.
    pinhole
        The camera.

    Returns
    -------
    Labels
        (n, 8), a row for each thing of which at least one pixel is visible.

    """
    rows = []
    for number in np.unique(owners[owners >= 0]):
        if int(number) not in seen:
            continue
        each = seen[int(number)]
        y_px, x_px = np.nonzero(owners == number)
        outline_px = silhouette_area_px(each, pinhole)
        rows.append(
            (
                each.number,
                x_px.min(), y_px.min(), x_px.max() + 1, y_px.max() + 1,
                min(1.0, len(x_px) / max(outline_px, 1.0)),
                len(x_px),
                float(np.linalg.norm(each.position_m)),
            )
        )  # fmt: skip
    return np.array(rows, dtype=np.float32).reshape(-1, COLUMNS)


def silhouette_area_px(seen: Seen, pinhole: Pinhole) -> float:
    """
    Compute the area that a thing would cover if nothing hid it, beyond the borders too.

    Parameters
    ----------
    seen
        The thing and its pose in the optical frame.
    pinhole
        The camera.

    Returns
    -------
    float
        The number of pixels, at least 1.

    """
    outlines = [_projected(points, seen, pinhole) for points in _convex_pieces(seen.thing)]
    corners = np.concatenate(outlines)
    low, high = corners.min(axis=0), corners.max(axis=0)
    # Small things are drawn larger: a polygon that is filled covers half a pixel too much.
    scale = float(np.clip(_DRAWN_PX / max(high - low), 0.2, 16.0))
    size = (np.ceil((high - low) * scale) + 3).astype(int)
    mask = np.zeros((size[1], size[0]), dtype=np.uint8)
    for outline in outlines:
        hull = cv2.convexHull(((outline - low) * scale + 1).astype(np.float32))
        fixed = np.rint(hull * (1 << _SUB_PIXEL_BITS)).astype(np.int32)
        cv2.fillConvexPoly(mask, fixed, 1, shift=_SUB_PIXEL_BITS)
    return max(float(np.count_nonzero(mask)) / scale**2, 1.0)


def _projected(points: Array, seen: Seen, pinhole: Pinhole) -> Array:
    """Return where points in the axes of a thing are in the picture, (n, 2) in pixels."""
    there = points @ seen.rotation.T + seen.position_m
    depth_m = np.maximum(there[:, 2:], NEAREST_M)
    return np.asarray(there[:, :2] / depth_m * pinhole.focal_px + pinhole.centre_px)


def _convex_pieces(thing: Thing) -> Iterator[Array]:
    """Yield the corners of convex shapes, (n, 3), that together cover what a thing shows."""
    for part in thing.parts:
        if part.is_shown:
            for points in _pieces_of(part):
                yield points @ _rotation(part.orientation_rpy_rad).T + part.position_m


def _pieces_of(part: Part) -> Iterator[Array]:
    """Yield the corners of convex shapes that cover a part, in its own axes."""
    if part.shape == MESH:
        profile = PROFILES[part.mesh]
        for low, high in zip(profile, profile[1:]):
            rings = [_ring(*low), _ring(*high)]
            yield np.concatenate(rings) * part.size_m
    elif part.shape == 'sphere':
        yield np.concatenate(
            [
                part.size_m[0] * _ring(np.cos(angle), np.sin(angle))
                for angle in np.linspace(-np.pi / 2, np.pi / 2, 9)
            ]
        )
    elif part.shape == 'cylinder':
        radius, height = part.size_m
        yield np.concatenate([_ring(radius, side * height / 2) for side in (-1, 1)])
    else:
        signs = np.stack(np.meshgrid([-1, 1], [-1, 1], [-1, 1]), axis=-1).reshape(-1, 3)
        yield signs * np.array(part.size_m) / 2


def _ring(radius: float, height: float) -> Array:
    """Return the corners of a circle about the z axis."""
    angles = 2 * np.pi * np.arange(SEGMENTS) / SEGMENTS
    return np.column_stack(
        [radius * np.cos(angles), radius * np.sin(angles), np.full(SEGMENTS, height)]
    )


def _rotation(rpy_rad: Sequence[float]) -> Array:
    """Return the matrix of roll, pitch and yaw about fixed axes."""
    (cr, sr), (cp, sp), (cy, sy) = ((np.cos(angle), np.sin(angle)) for angle in rpy_rad)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )
