# SPDX-License-Identifier: Apache-2.0
"""Predict whether a remembered object is visible in a view, and check its place by depth."""

from __future__ import annotations

from dataclasses import dataclass
import enum

from humanoid_description.rotations import about_z
import numpy as np
import numpy.typing as npt

__all__ = ['Evidence', 'View', 'evidence_at']

Array = npt.NDArray[np.float64]
DepthImage = npt.NDArray[np.float32]

_SAMPLES = 12
"""Largest number of pixels that are sampled along each side of a box in the image."""
_FOOT = 0.3
"""The lower fraction of a box that is left out, as it may contain the supporting surface."""
_BORDER_PX = 3.0
"""Smallest distance of a box from the image border for a detection to be expected."""
_MARGIN_M = 0.03
"""Tolerance around a box; points nearer to the camera than that occlude the object."""


class Evidence(enum.Enum):
    """Evidence that a view gives about a remembered object that was not detected in it."""

    NONE = 'none'
    """No evidence: the object is outside the image, too far, too small, or occluded."""
    UNKNOWN = 'unknown'
    """The object should be visible; without depth, nothing more is known."""
    SOMETHING = 'something'
    """There is something at its place."""
    EMPTY = 'empty'
    """Its place is empty: the background is visible."""


@dataclass(frozen=True)
class View:
    """
    A camera view: pose, intrinsics and depth image, in the frame of the memory.

    Attributes
    ----------
    time_s
        The stamp of the image.
    position_m
        The position of the camera (3,).
    rotation
        The rotation (3, 3) of its optical frame (z forward, x right, y down) in the frame of the
        memory.
    width_px, height_px, fx_px, fy_px, cx_px, cy_px
        The image size and the camera matrix.
    depth_m
        The depth image, along the optical axis, non-finite or zero where depth is unknown; it may
        have another size than the image, and may be missing.
    turn_rad_s
        The turn rate of the camera, which makes its pose less certain.

    """

    time_s: float
    position_m: Array
    rotation: Array
    width_px: int
    height_px: int
    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float
    depth_m: DepthImage | None = None
    turn_rad_s: float = 0.0

    def in_camera(self, points_m: Array) -> Array:
        """
        Transform points from the frame of the memory into the optical frame.

        Parameters
        ----------
        points_m
            The points (N, 3) in m; the result has the same shape.

        """
        return np.asarray((points_m - self.position_m) @ self.rotation)

    def project(self, points_m: Array) -> tuple[Array, Array]:
        """
        Project points into the image.

        Parameters
        ----------
        points_m
            The points (N, 3) in m, in the frame of the memory.

        Returns
        -------
        tuple of Array
            Their pixels (N, 2), column and row, and their depths (N,) in m along the optical axis.
            Pixels of points behind the camera, whose depth is negative, are meaningless.

        """
        x, y, depth = self.in_camera(points_m).T
        ahead = np.maximum(depth, 1e-6)
        columns = self.fx_px * x / ahead + self.cx_px
        rows = self.fy_px * y / ahead + self.cy_px
        return np.stack([columns, rows], axis=1), depth

    def range_to(self, point_m: Array) -> float:
        """
        Compute the distance in m of a point from the camera.

        Parameters
        ----------
        point_m
            The point (3,) in the frame of the memory.

        """
        return float(np.linalg.norm(point_m - self.position_m))


def corners_of(position_m: Array, size_m: Array, yaw_rad: float) -> Array:
    """
    Compute the corners (8, 3) in m of an upright box.

    Parameters
    ----------
    position_m, size_m, yaw_rad
        Its centre (3,), its edge lengths (3,), and its rotation about the z axis.

    """
    signs = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
    return np.asarray(position_m + (0.5 * signs * size_m) @ about_z(yaw_rad).T)


def evidence_at(
    view: View,
    position_m: Array,
    size_m: Array,
    yaw_rad: float = 0.0,
    *,
    sigma_m: float = 0.02,
    max_range_m: float = 3.5,
    min_size_px: float = 8.0,
) -> Evidence:
    """
    Evaluate the evidence of a view about an object that was not detected in it.

    Parameters
    ----------
    view
        The view.
    position_m, size_m, yaw_rad
        The upright bounding box of the object, in the frame of the view: centre (3,), edge lengths
        (3,), and yaw.
    sigma_m
        The standard deviation of its position.
    max_range_m, min_size_px
        The largest distance, and the smallest size in the image, at which a detection is expected.

    Returns
    -------
    Evidence
        The evidence. With depth, points within the box, expanded by the uncertainty, show that
        something is there; the lowest part of the box is ignored, as it may contain the table.

    """
    if view.range_to(position_m) > max_range_m:
        return Evidence.NONE
    pixels, depths = view.project(corners_of(position_m, size_m, yaw_rad))
    if depths.min() < 0.05:
        return Evidence.NONE
    low, high = pixels.min(axis=0), pixels.max(axis=0)
    border = np.array([view.width_px, view.height_px]) - 1.0 - _BORDER_PX
    if (low < _BORDER_PX).any() or (high > border).any() or (high - low).min() < min_size_px:
        return Evidence.NONE
    if view.depth_m is None:
        return Evidence.UNKNOWN
    return _measured(view, position_m, size_m, yaw_rad, sigma_m, low, high)


def _measured(
    view: View,
    position_m: Array,
    size_m: Array,
    yaw_rad: float,
    sigma_m: float,
    low_px: Array,
    high_px: Array,
) -> Evidence:
    """Evaluate the evidence from the depths within the image rectangle of a box."""
    columns = np.linspace(low_px[0], high_px[0], min(_SAMPLES, int(high_px[0] - low_px[0]) + 1))
    rows = np.linspace(low_px[1], high_px[1], min(_SAMPLES, int(high_px[1] - low_px[1]) + 1))
    rays, depths = _rays(view, columns, rows)
    is_measured = np.isfinite(depths) & (depths > 0.0)
    points = (view.position_m + rays * np.where(is_measured, depths, 0.0)[:, None]) - position_m
    inside = points @ about_z(yaw_rad)
    half = 0.5 * size_m
    grown = half + _MARGIN_M + sigma_m
    above = inside[:, 2] > half[2] * (2.0 * _FOOT - 1.0)
    is_there = is_measured & above & (np.abs(inside) <= grown).all(axis=1)
    forward = view.rotation[:, 2]
    reach = float((np.abs(forward) @ np.maximum(half, 0.0)) + _MARGIN_M + sigma_m)
    distance = float(forward @ (position_m - view.position_m))
    is_hidden = is_measured & (depths < distance - reach)
    count = len(depths)
    if is_there.sum() >= 0.12 * count:
        return Evidence.SOMETHING
    # Missing depth may mean free space, or a surface that the camera cannot measure.
    is_unknown = ~is_measured & ~np.isposinf(depths)
    if is_hidden.sum() + is_unknown.sum() > 0.3 * count:
        return Evidence.NONE
    return Evidence.EMPTY


def _rays(view: View, columns: Array, rows: Array) -> tuple[Array, Array]:
    """Compute rays (N, 3) of depth 1 through pixels, in the memory frame, and depths (N,)."""
    assert view.depth_m is not None
    u, v = (each.ravel() for each in np.meshgrid(columns, rows))
    height, width = view.depth_m.shape
    at = (
        np.clip((v * height / view.height_px).round().astype(int), 0, height - 1),
        np.clip((u * width / view.width_px).round().astype(int), 0, width - 1),
    )
    x, y = (u - view.cx_px) / view.fx_px, (v - view.cy_px) / view.fy_px
    rays = np.stack([x, y, np.ones_like(x)], axis=1) @ view.rotation.T
    return rays, view.depth_m[at].astype(float)
