# SPDX-License-Identifier: Apache-2.0
"""A world of walls in a grid, a scanner in it, and a robot with odometry that drifts."""

from __future__ import annotations

from dataclasses import dataclass, field

import cv2
import numpy as np
from slam_toolbox_py.poses import compose, relative, wrap
from slam_toolbox_py.scans import take_scan

RAYS = 360
ANGLES = -np.pi + np.arange(RAYS) * 2.0 * np.pi / RAYS


class World:
    """Walls, and distances to them; `cells` is true at walls, row 0 at the lowest y."""

    def __init__(self, cells, resolution_m, origin):
        self.resolution_m, self.origin = resolution_m, np.asarray(origin, dtype=float)
        self.cells = np.asarray(cells, dtype=bool)
        free = (~self.cells).astype(np.uint8)
        self.distance = cv2.distanceTransform(free, cv2.DIST_L2, 5) * resolution_m

    def distance_at(self, points):
        cells = np.floor((points - self.origin) / self.resolution_m).astype(int)
        cells = np.clip(cells, 0, np.array(self.cells.shape[::-1]) - 1)
        return self.distance[cells[..., 1], cells[..., 0]]

    def ranges(self, pose, rng=None, noise_m=0.015, dropout=0.0, range_max_m=12.0):
        heading = pose[2] + ANGLES
        beams = np.stack([np.cos(heading), np.sin(heading)], axis=1)
        ranges = np.zeros(RAYS)
        for _ in range(100):
            distance = self.distance_at(pose[:2] + beams * ranges[:, None])
            if (distance <= 0.0).all():
                break
            ranges += np.where(distance > 0.0, np.maximum(distance - 0.008, 0.004), 0.0)
        ranges[ranges > range_max_m] = np.inf
        if rng is not None:
            ranges = ranges + rng.normal(0.0, noise_m, RAYS)
            ranges[rng.random(RAYS) < dropout] = np.inf
        return ranges

    def scan(self, pose, rng=None, **noise):
        ranges = self.ranges(np.asarray(pose, dtype=float), rng, **noise)
        return take_scan(ranges, ANGLES, np.eye(3), np.zeros(3), 0.1, 12.0)


def walls(size, resolution_m, rectangles, origin=(0.0, 0.0)):
    """Return a world of rectangles (x0, y0, x1, y1) in m, filled."""
    cells = np.zeros((int(size[1] / resolution_m), int(size[0] / resolution_m)), dtype=np.uint8)
    for x0, y0, x1, y1 in rectangles:
        low = np.rint((np.array([x0, y0]) - origin) / resolution_m).astype(int)
        high = np.rint((np.array([x1, y1]) - origin) / resolution_m).astype(int)
        cells[slice(low[1], high[1]), slice(low[0], high[0])] = 1
    return World(cells, resolution_m, origin)


def room(resolution_m=0.01):
    """Return a room of 6 by 4 m with a cupboard, a pillar and a door."""
    return walls(
        (7.0, 5.0),
        resolution_m,
        [
            (0.4, 0.4, 6.6, 0.5),
            (0.4, 4.5, 6.6, 4.6),
            (0.4, 0.4, 0.5, 4.6),
            (6.5, 0.4, 6.6, 2.2),
            (6.5, 3.1, 6.6, 4.6),
            (2.0, 0.5, 3.2, 1.1),
            (4.6, 3.0, 4.9, 3.3),
        ],
    )


@dataclass
class Robot:
    """A robot whose odometry is off by a share of the way, and turns slowly away."""

    pose: np.ndarray
    rng: np.random.Generator
    scale: float = 1.015
    turn_rad_s: float = np.deg2rad(4.0) / 60.0
    noise_m: float = 0.002
    noise_rad: float = 0.002
    odometry: np.ndarray = field(init=False)

    def __post_init__(self):
        self.pose = np.asarray(self.pose, dtype=float)
        self.odometry = self.pose.copy()

    def step(self, pose, dt_s):
        """Move to a pose in a time."""
        moved = relative(self.pose, np.asarray(pose, dtype=float))
        told = moved * [self.scale, self.scale, 1.0]
        told[:2] += self.rng.normal(0.0, self.noise_m, 2)
        told[2] += self.turn_rad_s * dt_s + self.rng.normal(0.0, self.noise_rad)
        self.pose = np.asarray(pose, dtype=float)
        self.odometry = compose(self.odometry, told)


def walk(waypoints, speed=0.35, turn_speed=0.6, dt_s=0.1):
    """Yield poses at each period on the way through waypoints: turn, then go."""
    points = np.asarray(waypoints, dtype=float)
    heading = np.arctan2(*(points[1] - points[0])[::-1])
    for start, end in zip(points[:-1], points[1:]):
        target = np.arctan2(*(end - start)[::-1])
        turn = float(wrap(target - heading))
        for share in np.linspace(0.0, 1.0, max(2, int(abs(turn) / (turn_speed * dt_s)))):
            yield np.array([*start, heading + share * turn])
        heading = target
        steps = max(2, int(np.hypot(*(end - start)) / (speed * dt_s)))
        for share in np.linspace(0.0, 1.0, steps):
            yield np.array([*(start + share * (end - start)), heading])
