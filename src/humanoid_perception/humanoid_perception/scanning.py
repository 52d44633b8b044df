# SPDX-License-Identifier: Apache-2.0
"""Plan head poses that cover the surroundings with a camera, and track the coverage."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math

import numpy as np
import numpy.typing as npt

__all__ = ['Coverage', 'FieldOfView', 'head_sweep', 'stances']

Array = npt.NDArray[np.float64]
_CELL_RAD = math.radians(5.0)
_OVERLAP = 0.85
"""Largest spacing of views as a fraction of the field of view: an object that the border of one
view cuts is whole in the next."""


@dataclass(frozen=True)
class FieldOfView:
    """Field of view of a camera: the angles from its optical axis to the image borders, in rad."""

    left_rad: float
    right_rad: float
    up_rad: float
    down_rad: float

    @classmethod
    def of(
        cls, width: int, height: int, fx: float, fy: float, cx: float, cy: float
    ) -> FieldOfView:
        """
        Compute the field of view of a pinhole camera.

        Parameters
        ----------
        width, height
            The size of the image in pixels.
        fx, fy, cx, cy
            The focal lengths and the principal point in pixels, as in K of a `camera_info`.

        Raises
        ------
        ValueError
            The size or a focal length is not positive.

        """
        if not (width > 0 and height > 0 and 0.0 < fx < math.inf and 0.0 < fy < math.inf):
            raise ValueError('The camera_info has no size or no focal length.')
        return cls(
            math.atan(cx / fx),
            math.atan((width - cx) / fx),
            math.atan(cy / fy),
            math.atan((height - cy) / fy),
        )

    @property
    def width_rad(self) -> float:
        """Return the horizontal field of view."""
        return self.left_rad + self.right_rad

    @property
    def height_rad(self) -> float:
        """Return the vertical field of view."""
        return self.up_rad + self.down_rad

    def contains(self, directions: Array) -> npt.NDArray[np.bool_]:
        """
        Check which directions are within the image.

        Parameters
        ----------
        directions
            Vectors (N, 3) of any length, in the optical frame.

        Returns
        -------
        Array
            A boolean for each direction (N,).

        """
        x, y, z = directions.T
        ahead = z > 1e-6
        safe = np.where(ahead, z, 1.0)
        return np.asarray(
            ahead
            & (x / safe >= -math.tan(self.left_rad))
            & (x / safe <= math.tan(self.right_rad))
            & (y / safe >= -math.tan(self.up_rad))
            & (y / safe <= math.tan(self.down_rad))
        )


def head_sweep(
    field: FieldOfView,
    lower_rad: Sequence[float] | Array,
    upper_rad: Sequence[float] | Array,
    up_rad: float,
    down_rad: float,
) -> list[tuple[float, float]]:
    """
    Plan the yaws and pitches of a head that cover all that it can see, row by row, back and forth.

    Parameters
    ----------
    field
        The field of view of the camera.
    lower_rad, upper_rad
        The limits of yaw and pitch; looking down is positive.
    up_rad, down_rad
        The elevation above and the depression below the horizon up to which to cover.

    Returns
    -------
    list of tuple
        Yaw and pitch, in rad.

    """
    pitches = _spread(
        max(-up_rad + field.up_rad, lower_rad[1]),
        min(down_rad - field.down_rad, upper_rad[1]),
        field.height_rad,
    )
    yaws = _spread(lower_rad[0], upper_rad[0], field.width_rad)
    return [
        (yaw, pitch)
        for number, pitch in enumerate(pitches)
        for yaw in (reversed(yaws) if number % 2 else yaws)
    ]


def _spread(low: float, high: float, field_rad: float) -> list[float]:
    """Compute evenly spaced angles at which the fields of view overlap."""
    if high <= low:
        return [0.5 * (low + high)]
    count = math.ceil((high - low) / (_OVERLAP * field_rad)) + 1
    return [float(each) for each in np.linspace(low, high, count)]


def stances(field: FieldOfView, lower_rad: float, upper_rad: float) -> list[float]:
    """
    Plan the turns of the body between head sweeps that cover the full circle.

    Parameters
    ----------
    field
        The field of view of the camera.
    lower_rad, upper_rad
        The limits of the head's yaw.

    Returns
    -------
    list of float
        The turn in rad before each further sweep.

    """
    reach_rad = (upper_rad - lower_rad) + _OVERLAP * field.width_rad
    count = max(math.ceil(math.tau / reach_rad), 1)
    return [math.tau / count] * (count - 1)


class Coverage:
    """
    Coverage of a scan: which of the wanted directions have been seen.

    Parameters
    ----------
    up_rad, down_rad
        The elevation above and the depression below the horizon that bound the directions.

    """

    def __init__(self, up_rad: float, down_rad: float) -> None:
        rows = max(math.ceil((up_rad + down_rad) / _CELL_RAD), 1)
        columns = math.ceil(math.tau / _CELL_RAD)
        elevations = -down_rad + (np.arange(rows) + 0.5) * (up_rad + down_rad) / rows
        azimuths = (np.arange(columns) + 0.5) * math.tau / columns
        azimuth, elevation = (each.ravel() for each in np.meshgrid(azimuths, elevations))
        self._directions = np.stack(
            [
                np.cos(elevation) * np.cos(azimuth),
                np.cos(elevation) * np.sin(azimuth),
                np.sin(elevation),
            ],
            axis=1,
        )
        self._weights = np.cos(elevation)
        self._wanted = np.ones(len(azimuth), dtype=bool)
        self._seen = np.zeros(len(azimuth), dtype=bool)

    def want_only(self, rotations: Sequence[Array], field: FieldOfView) -> None:
        """
        Restrict the wanted directions to those that some views cover.

        Parameters
        ----------
        rotations
            The rotation (3, 3) of the optical frame of each view, in a frame whose z axis is up.
        field
            The field of view of the camera.

        """
        wanted = np.zeros_like(self._wanted)
        for rotation in rotations:
            wanted |= field.contains(self._directions @ rotation)
        self._wanted = wanted

    def see(self, rotation: Array, field: FieldOfView) -> None:
        """
        Mark the directions that a view covers as seen.

        Parameters
        ----------
        rotation
            The rotation (3, 3) of its optical frame, in the same frame as for `want_only`.
        field
            The field of view of the camera.

        """
        self._seen |= field.contains(self._directions @ rotation)

    @property
    def share(self) -> float:
        """Return the fraction of the wanted solid angle that was seen, from 0 to 1."""
        total = float(self._weights[self._wanted].sum())
        seen = float(self._weights[self._wanted & self._seen].sum())
        return seen / total if total else 0.0
