# SPDX-License-Identifier: Apache-2.0
"""
Where a detected object is and how large, from the depth of its pixels.

Depth shows the front of an object only. The points of its surface are taken in a frame whose z
axis points up: its height is seen, its width is seen, and its extent along the line of sight is
estimated. What is round seen from above (a mug, a ball) is as deep as it is wide. For other
objects it is what is seen of their top, or at least a usual part of their width. The centre is
half of it behind the front.
"""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_perception.detection import Box, Box3, Depth
import numpy as np
import numpy.typing as npt

__all__ = [
    'UPRIGHT',
    'CameraInfoError',
    'PinholeCamera',
    'Surface',
    'camera_of',
    'lift',
    'surface_of',
]

Array = npt.NDArray[np.float64]

ROUND = frozenset(
    {
        *('mug', 'cup', 'bottle', 'can', 'bowl', 'ball', 'apple', 'orange', 'sports ball'),
        *('wine glass', 'vase'),
    }
)
"""Classes that are as deep as wide."""
_DEPTH_OF_WIDTH = {'person': 0.55, 'book': 0.7, 'box': 0.7, 'cube': 0.95}
"""How deep others are at least, as a part of the width that is seen; else `_USUAL_DEPTH`."""
_USUAL_DEPTH = 0.6
_LEAST_POINTS = 6
_MOST_POINTS = 1500
_LEAST_RANGE_M = 0.05
_SEED_PERCENTILE = 30.0
_LOW, _HIGH = 2.0, 98.0
UPRIGHT = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
"""The rotation of an optical frame in the frame of the same camera by REP 103: x forward, z up."""
_STEEP = 0.97
"""A line of sight whose vertical part is larger than this looks straight down (or up)."""


class CameraInfoError(Exception):
    """A `camera_info` cannot be used; the text says why, and what to do."""


@dataclass(frozen=True)
class PinholeCamera:
    """The intrinsics of a rectified camera; whole pixel coordinates are the centres of pixels."""

    width_px: int
    height_px: int
    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float


def camera_of(
    k: npt.ArrayLike, width_px: int, height_px: int, picture: tuple[int, int]
) -> PinholeCamera:
    """
    Check the intrinsics of a `sensor_msgs/CameraInfo`.

    Parameters
    ----------
    k
        The nine numbers of K, row by row.
    width_px, height_px
        The size that they are for.
    picture
        The size (height, width) of the pictures.

    Raises
    ------
    CameraInfoError
        If they cannot be right.

    """
    values = np.asarray(k, dtype=np.float64).reshape(-1)
    if (height_px, width_px) != picture:
        raise CameraInfoError(
            f'camera_info is for pictures of {width_px} x {height_px} pixels, but they have '
            f'{picture[1]} x {picture[0]}. Have the camera publish the camera_info of these '
            'pictures.'
        )
    fits = values.size == 9 and bool(np.isfinite(values).all())
    if fits:
        fx, fy, cx, cy = values[0], values[4], values[2], values[5]
        fits = (
            0.05 * width_px < fx < 50.0 * width_px
            and 0.05 * height_px < fy < 50.0 * height_px
            and 0.0 < cx < width_px
            and 0.0 < cy < height_px
        )
    if not fits:
        shown = [round(float(value), 3) for value in values[:9]]
        raise CameraInfoError(
            f'The K of camera_info, {shown}, is not that of a camera with {width_px} x '
            f'{height_px} pixels: it needs focal lengths above zero and a centre inside the '
            'picture. Calibrate the camera, or correct its camera_info.'
        )
    return PinholeCamera(width_px, height_px, float(fx), float(fy), float(cx), float(cy))


@dataclass(frozen=True, eq=False)
class Surface:
    """What depth shows of an object."""

    points_m: Array
    """(n, 3) in the optical frame of the camera"""
    mask: npt.NDArray[np.bool_]
    """Which pixels of the picture show it, (height, width)."""


def surface_of(box_px: Box, depth_m: Depth, camera: PinholeCamera) -> Surface | None:
    """
    Return the surface of an object in a box, without what is behind or in front of it.

    Parameters
    ----------
    box_px
        Where the object is in the picture.
    depth_m
        (height, width), NaN or infinite where nothing was measured.
    camera
        What the picture was taken with.

    Returns
    -------
    None if too little of it was measured.

    """
    rows = _within(box_px[1], box_px[3], camera.height_px)
    columns = _within(box_px[0], box_px[2], camera.width_px)
    part = depth_m[rows, columns]
    if part.size < _LEAST_POINTS:
        return None
    inside = _foreground(part, box_px, camera)
    if np.count_nonzero(inside) < _LEAST_POINTS:
        return None
    mask = np.zeros(depth_m.shape, dtype=np.bool_)
    mask[rows, columns] = inside
    return Surface(_points(part, inside, rows.start, columns.start, camera), mask)


def lift(
    class_id: str,
    surface: Surface,
    camera: PinholeCamera,
    rotation: Array = UPRIGHT,
    translation_m: Array | None = None,
) -> Box3:
    """
    Return the 3-D box of a detected object.

    Parameters
    ----------
    class_id
        Its class, which says whether it is round.
    surface
        What depth shows of it.
    camera
        What the picture was taken with.
    rotation, translation_m
        The pose (3, 3), (3,) of the optical frame in a frame whose z axis points up.

    """
    origin = np.zeros(3) if translation_m is None else np.asarray(translation_m)
    return _box_of(class_id, surface.points_m @ rotation.T, origin, camera)


def _within(low: float, high: float, size: int) -> slice:
    """Return the whole pixels between two edges, as far as they are in a picture of a size."""
    first, last = (min(max(round(edge), 0), size) for edge in (low, high))
    return slice(first, last)


def _foreground(part: Depth, box_px: Box, camera: PinholeCamera) -> npt.NDArray[np.bool_]:
    """Return which pixels of a box show the object, not what is behind or before it."""
    is_known = np.isfinite(part) & (part > _LEAST_RANGE_M)
    height, width = part.shape
    inner = (
        slice(height // 4, max(height - height // 4, height // 4 + 1)),
        slice(width // 4, max(width - width // 4, width // 4 + 1)),
    )
    core = part[inner][is_known[inner]]
    if core.size < 3:
        core = part[is_known]
    if core.size < 3:
        return np.zeros(part.shape, dtype=np.bool_)
    seed_m = float(np.percentile(core, _SEED_PERCENTILE))
    extent = max((box_px[2] - box_px[0]) / camera.fx_px, (box_px[3] - box_px[1]) / camera.fy_px)
    band_m = 0.03 + 0.75 * extent * seed_m
    with np.errstate(invalid='ignore'):
        return np.asarray(is_known & (np.abs(part - seed_m) < band_m))


def _points(
    part: Depth, mask: npt.NDArray[np.bool_], top: int, left: int, camera: PinholeCamera
) -> Array:
    """Return the points (n, 3) of the pixels of a mask in the optical frame."""
    v, u = np.nonzero(mask)
    if len(v) > _MOST_POINTS:
        chosen = np.linspace(0, len(v) - 1, _MOST_POINTS).astype(np.intp)
        v, u = v[chosen], u[chosen]
    z = part[v, u].astype(np.float64)
    x = (u + left - camera.cx_px) / camera.fx_px * z
    y = (v + top - camera.cy_px) / camera.fy_px * z
    return np.stack([x, y, z], axis=1)


def _box_of(class_id: str, offsets: Array, origin: Array, camera: PinholeCamera) -> Box3:
    """Return the box of points (n, 3) of a surface, given from the camera, z up."""
    sight = np.median(offsets, axis=0)
    distance = float(np.linalg.norm(sight))
    if abs(sight[2]) > _STEEP * distance:
        return _box_from_above(offsets, origin)
    ahead = np.array([sight[0], sight[1]]) / math.hypot(sight[0], sight[1])
    along = offsets[:, :2] @ ahead
    across = offsets[:, :2] @ np.array([-ahead[1], ahead[0]])
    low, high = _extent(offsets[:, 2])
    upper = offsets[:, 2] > low + 0.3 * (high - low)
    body = upper if np.count_nonzero(upper) >= _LEAST_POINTS else np.ones_like(upper)
    near, far = _extent(along[body])
    right, left = _extent(across[body])
    pixel_m = distance / camera.fx_px
    width = left - right + pixel_m
    middle = (left + right) / 2.0
    is_round = class_id in ROUND
    usual = 1.0 if is_round else _DEPTH_OF_WIDTH.get(class_id, _USUAL_DEPTH)
    depth = width if is_round else max(far - near, usual * width)
    centre = ahead * (near + depth / 2.0) + np.array([-ahead[1], ahead[0]]) * middle
    yaw = 0.0 if is_round else math.atan2(ahead[1], ahead[0])
    return Box3(
        origin + np.array([centre[0], centre[1], (low + high) / 2.0]),
        np.array([depth, width, max(high - low, pixel_m)]),
        yaw,
    )


def _box_from_above(offsets: Array, origin: Array) -> Box3:
    """Return the box of an object of which only the top is seen: it is as high as narrow."""
    edges = [_extent(offsets[:, axis]) for axis in range(3)]
    length, width = (high - low for low, high in edges[:2])
    top = edges[2][1]
    height = max(edges[2][1] - edges[2][0], min(length, width))
    middle = [(low + high) / 2.0 for low, high in edges[:2]]
    return Box3(
        origin + np.array([*middle, top - height / 2.0]), np.array([length, width, height])
    )


def _extent(values: Array) -> tuple[float, float]:
    """Return the ends of values, without the few that stick out."""
    low, high = np.percentile(values, (_LOW, _HIGH))
    return float(low), float(high)
