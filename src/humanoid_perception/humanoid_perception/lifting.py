# SPDX-License-Identifier: Apache-2.0
"""
Estimate the 3-D box of a detected object from the depth of its pixels.

Depth shows only the front of an object. The points of its surface are transformed to a frame whose
z axis points up: height and width are measured, and the extent along the line of sight is
estimated. An object that is round seen from above (a mug, a ball) is as deep as it is wide. For
other objects, the extent is the visible part of their top, or at least a typical fraction of their
width. The centre is half of the extent behind the front.
"""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_common.errors import UserError
from humanoid_perception.detection import Box, Box3, Depth
import numpy as np
import numpy.typing as npt

__all__ = [
    'UPRIGHT',
    'CameraInfoError',
    'PinholeCamera',
    'VisibleSurface',
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
"""Classes of objects that are as deep as wide."""
_DEPTH_OF_WIDTH = {'person': 0.55, 'book': 0.7, 'box': 0.7, 'cube': 0.95}
"""Least depth of other classes, as a fraction of the visible width; else `_USUAL_DEPTH`."""
_USUAL_DEPTH = 0.6
_LEAST_POINTS = 6
_MOST_POINTS = 1500
_LEAST_RANGE_M = 0.05
_SEED_PERCENTILE = 30.0
_LOW, _HIGH = 2.0, 98.0
UPRIGHT = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
"""The rotation of an optical frame in the frame of the same camera by REP 103: x forward, z up."""
_STEEP = 0.97
"""A line of sight with a larger vertical component points straight down (or up)."""


class CameraInfoError(UserError):
    """A `camera_info` cannot be used; the message states why, and what to do."""


@dataclass(frozen=True)
class PinholeCamera:
    """Intrinsics of a rectified camera; integer pixel coordinates are the centres of pixels."""

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
    Validate the intrinsics of a `sensor_msgs/CameraInfo`.

    Parameters
    ----------
    k
        The nine elements of the camera matrix K, row by row.
    width_px, height_px
        The image size of the intrinsics.
    picture
        The size (height, width) of the images.

    Raises
    ------
    CameraInfoError
        The intrinsics are implausible, or for another image size.

    """
    values = np.asarray(k, dtype=np.float64).reshape(-1)
    if (height_px, width_px) != picture:
        raise CameraInfoError(
            f'camera_info is for images of {width_px} x {height_px} pixels, but the images have '
            f'{picture[1]} x {picture[0]}. Configure the camera to publish the camera_info of '
            'these images.'
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
            f'The K of camera_info, {shown}, is not valid for a camera with {width_px} x '
            f'{height_px} pixels: it needs focal lengths above zero and a principal point inside '
            'the image. Calibrate the camera, or correct its camera_info.'
        )
    return PinholeCamera(width_px, height_px, float(fx), float(fy), float(cx), float(cy))


@dataclass(frozen=True, eq=False)
class VisibleSurface:
    """The visible surface of an object."""

    points_m: Array
    """(n, 3) in the optical frame of the camera"""
    mask: npt.NDArray[np.bool_]
    """The pixels of the image that show it, (height, width)."""


def surface_of(box_px: Box, depth_m: Depth, camera: PinholeCamera) -> VisibleSurface | None:
    """
    Segment the surface of an object in a box from the background and the foreground.

    Parameters
    ----------
    box_px
        The box of the object in the image.
    depth_m
        The depth (height, width), NaN or infinite where nothing was measured.
    camera
        The intrinsics of the camera.

    Returns
    -------
    The surface; None if too little of it was measured.

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
    return VisibleSurface(_points(part, inside, rows.start, columns.start, camera), mask)


def lift(
    class_id: str,
    surface: VisibleSurface,
    camera: PinholeCamera,
    rotation: Array = UPRIGHT,
    translation_m: Array | None = None,
) -> Box3:
    """
    Estimate the 3-D box of a detected object.

    Parameters
    ----------
    class_id
        Its class, which determines whether it is round.
    surface
        Its visible surface.
    camera
        The intrinsics of the camera.
    rotation, translation_m
        The pose (3, 3), (3,) of the optical frame in a frame whose z axis points up.

    """
    origin = np.zeros(3) if translation_m is None else np.asarray(translation_m)
    return _box_of(class_id, surface.points_m @ rotation.T, origin, camera)


def _within(low: float, high: float, size: int) -> slice:
    """Round two edges of a box to a pixel range, clipped to an image size."""
    first, last = (min(max(round(edge), 0), size) for edge in (low, high))
    return slice(first, last)


def _foreground(part: Depth, box_px: Box, camera: PinholeCamera) -> npt.NDArray[np.bool_]:
    """Compute the mask of the pixels in a box whose depth is near that of the object."""
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
    """Back-project the pixels of a mask to points (n, 3) in the optical frame."""
    v, u = np.nonzero(mask)
    if len(v) > _MOST_POINTS:
        chosen = np.linspace(0, len(v) - 1, _MOST_POINTS).astype(np.intp)
        v, u = v[chosen], u[chosen]
    z = part[v, u].astype(np.float64)
    x = (u + left - camera.cx_px) / camera.fx_px * z
    y = (v + top - camera.cy_px) / camera.fy_px * z
    return np.stack([x, y, z], axis=1)


def _box_of(class_id: str, offsets: Array, origin: Array, camera: PinholeCamera) -> Box3:
    """Fit a box to surface points (n, 3), relative to the camera, in axes with z up."""
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
    """Fit a box to the visible top of an object: its height is at least its smaller edge."""
    edges = [_extent(offsets[:, axis]) for axis in range(3)]
    length, width = (high - low for low, high in edges[:2])
    top = edges[2][1]
    height = max(edges[2][1] - edges[2][0], min(length, width))
    middle = [(low + high) / 2.0 for low, high in edges[:2]]
    return Box3(
        origin + np.array([*middle, top - height / 2.0]), np.array([length, width, height])
    )


def _extent(values: Array) -> tuple[float, float]:
    """Return the range of values, without outliers."""
    low, high = np.percentile(values, (_LOW, _HIGH))
    return float(low), float(high)
