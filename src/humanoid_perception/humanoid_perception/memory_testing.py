# SPDX-License-Identifier: Apache-2.0
"""A simulated world of boxes, with a camera and a detector, for tests of the object memory."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
import math
from typing import Any

from humanoid_perception.sighting import Sighting, sighting_noise
from humanoid_perception.visibility import View
import numpy as np

Point = Sequence[float]
WIDTH, HEIGHT, FOCAL = 320, 240, 250.0
COARSE = 4
"""Pixels per depth value, in each direction."""


@dataclass
class Box:
    """A box in the world."""

    name: str
    position: tuple[float, float, float]
    size: tuple[float, float, float] = (0.08, 0.08, 0.1)
    colour: str = 'red'
    is_detectable: bool = True


@dataclass
class BoxWorld:
    """A set of boxes, and the simulated measurements of a camera."""

    boxes: list[Box]
    random: np.random.Generator = field(default_factory=lambda: np.random.default_rng(1))
    noise: float = 1.0
    time_s: float = 0.0

    def view(self, at: Point, towards: Point, depth: bool = True, **options: Any) -> View:
        """
        Place the camera at a point, looking towards another, 0.2 s after the last view.

        Parameters
        ----------
        at, towards
            The points (3,) in m, in the frame of the boxes; neither straight above the other.
        depth
            Whether the view has a depth image.
        **options
            Further fields of the view, such as `turn_rad_s`.

        """
        position = np.array(at, dtype=float)
        ahead = np.array(towards, dtype=float) - position
        ahead /= np.linalg.norm(ahead)
        right = np.cross(ahead, [0.0, 0.0, 1.0])
        right /= np.linalg.norm(right)
        rotation = np.stack([right, np.cross(ahead, right), ahead], axis=1)
        self.time_s += 0.2
        view = View(
            self.time_s,
            position,
            rotation,
            WIDTH,
            HEIGHT,
            FOCAL,
            FOCAL,
            WIDTH / 2,
            HEIGHT / 2,
            **options,
        )
        return replace(view, depth_m=self.depth(view)) if depth else view

    def depth(self, view: View) -> np.ndarray:
        """
        Render a depth image by intersecting rays with upright boxes (the slab method).

        Parameters
        ----------
        view
            The view to render.

        Returns
        -------
        Array
            The depth (60, 80) in m along the optical axis, infinite where there is no box. It is
            coarser than the image.

        """
        u, v = np.meshgrid(np.arange(0.0, WIDTH, COARSE), np.arange(0.0, HEIGHT, COARSE))
        rays = np.stack([(u - view.cx_px) / FOCAL, (v - view.cy_px) / FOCAL, np.ones_like(u)], 2)
        rays = rays @ view.rotation.T
        rays = np.where(np.abs(rays) < 1e-9, 1e-9, rays)
        depth = np.full(u.shape, np.inf)
        for box in self.boxes:
            low = np.array(box.position) - np.array(box.size) / 2 - view.position_m
            high = low + np.array(box.size)
            near = np.minimum(low / rays, high / rays).max(axis=2)
            far = np.maximum(low / rays, high / rays).min(axis=2)
            depth = np.where((near < far) & (near > 0.05), np.minimum(depth, near), depth)
        return depth.astype(np.float32)

    def sightings(self, view: View, score: float = 0.8, chance: float = 1.0) -> list[Sighting]:
        """
        Simulate a detector: return the visible boxes, with noise.

        Parameters
        ----------
        view
            The view; without depth, nothing is occluded.
        score
            The score of each detection.
        chance
            The probability that a box is detected, 0 to 1.

        """
        found = []
        for box in self.boxes:
            middle = np.array(box.position, dtype=float)
            (pixel,), (depth,) = view.project(middle[None])
            is_in = (pixel > 8).all() and pixel[0] < WIDTH - 8 and pixel[1] < HEIGHT - 8
            if not (box.is_detectable and is_in and 0.3 < depth < 4.0):
                continue
            if view.depth_m is not None:
                measured = view.depth_m[int(pixel[1]) // COARSE, int(pixel[0]) // COARSE]
                if measured < depth - max(box.size):
                    continue
            if self.random.random() > chance:
                continue
            covariance = sighting_noise(middle, view.position_m)
            error = self.random.multivariate_normal(np.zeros(3), self.noise * covariance)
            found.append(
                Sighting(
                    box.name,
                    score,
                    middle + error,
                    np.array(box.size) * (1.0 + 0.1 * self.noise * self.random.normal()),
                    colour=box.colour,
                )
            )
        return found


def around(middle: Point, radius: float, angle: float, height: float = 1.2) -> Point:
    """
    Compute a viewpoint on a circle.

    Parameters
    ----------
    middle
        The centre of the circle in m; its z is ignored.
    radius, angle
        The radius in m, and the angle in rad from the x axis.
    height
        The z of the viewpoint in m.

    Returns
    -------
    Point
        The viewpoint (3,) in m.

    """
    return (
        middle[0] + radius * math.cos(angle),
        middle[1] + radius * math.sin(angle),
        height,
    )


TABLE = Box('table', (0.0, 0.0, 0.35), (1.2, 1.2, 0.7), '', is_detectable=False)
WALL = Box('wall', (-4.0, 0.0, 1.0), (0.1, 20.0, 4.0), '', is_detectable=False)
