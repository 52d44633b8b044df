# SPDX-License-Identifier: Apache-2.0
"""A flat, a robot that walks a tour of it among people, and a localizer that follows it."""

from __future__ import annotations

import math

from nav2_amcl.localizer import Localizer, LocalizerSettings
from nav2_amcl.occupancy_map import FREE, OccupancyMap, OCCUPIED, RayCaster, UNKNOWN
from nav2_amcl.scan_projection import Scan
from nav2_util.geometry import angle_between, Pose2D
import numpy as np

ANGLES = np.radians(np.arange(360.0) - 180.0)
FAR_M = 12.0


def make_flat():
    """Return a flat of 10 x 9 m with four rooms that differ, unknown around it."""
    cells = np.full((200, 220), UNKNOWN, np.int8)
    cells[10:190, 10:210] = FREE

    def wall(x0, y0, x1, y1):
        left, low, right, high = (round(bound * 20) for bound in (x0, y0, x1, y1))
        cells[low:high, left:right] = OCCUPIED

    for edges in ((0.5, 0.5, 10.5, 0.6), (0.5, 9.4, 10.5, 9.5)):
        wall(*edges)
    for edges in ((0.5, 0.5, 0.6, 9.5), (10.4, 0.5, 10.5, 9.5)):
        wall(*edges)
    for edges in ((4.5, 0.5, 4.6, 2.5), (4.5, 3.5, 4.6, 6.5), (4.5, 7.5, 4.6, 9.5)):
        wall(*edges)
    for edges in ((0.5, 5.0, 2.0, 5.1), (3.0, 5.0, 7.0, 5.1), (8.0, 5.0, 10.5, 5.1)):
        wall(*edges)
    for edges in ((0.6, 8.5, 2.4, 9.4), (9.0, 8.2, 10.4, 9.4), (6.5, 0.6, 8.5, 1.2)):
        wall(*edges)
    wall(2.4, 1.8, 2.8, 2.9)
    return OccupancyMap(cells, 0.05, (-2.0, 1.0, 0.0))


FLAT = make_flat()
CASTER = RayCaster(FLAT)
TOUR = [  # through the doors of all rooms
    (1.6, 4.5), (2.55, 4.0), (4.0, 4.0), (5.5, 5.0), (5.5, 7.2), (4.0, 8.0), (2.55, 8.0),
    (1.0, 8.0), (0.5, 7.0), (0.5, 5.0),
]  # fmt: skip
START = Pose2D(0.0, 4.5, 0.0)


class Walker:
    """A robot that walks a tour of the flat; what its odometry says and its laser sees."""

    def __init__(self, seed):
        self.random = np.random.default_rng(seed)
        self.pose, self.odom = START, Pose2D(5.0, -3.0, 1.0)
        self.drift = math.radians(4.0) / 60.0 * self.random.choice([-1, 1])
        self.scale = 1.0 + 0.02 * self.random.choice([-1, 1])
        self.time = self.distance = 0.0
        self.next = 0

    def step(self, dt=0.1):
        """Walk on for a tenth of a second."""
        goal = TOUR[self.next % len(TOUR)]
        if math.hypot(goal[0] - self.pose.x, goal[1] - self.pose.y) < 0.25:
            self.next += 1
        error = angle_between(
            self.pose.yaw, math.atan2(goal[1] - self.pose.y, goal[0] - self.pose.x)
        )
        turn = min(max(1.5 * error, -0.7), 0.7) * dt
        ahead = 0.4 * dt if abs(error) < 0.6 else 0.0
        noise = self.random.normal(0.0, 0.002, 3)
        self.pose = self.pose @ Pose2D(ahead, 0.0, turn)
        self.odom = self.odom @ Pose2D(
            ahead * self.scale + noise[0], noise[1], turn + self.drift * dt + noise[2]
        )
        self.time, self.distance = self.time + dt, self.distance + ahead

    def scan(self, people=True):
        """Return what the laser sees from where the robot sways."""
        found = CASTER.cast(np.array([[self.pose.x, self.pose.y]]), self.pose.yaw + ANGLES, FAR_M)
        if people:
            for radius, rate in ((1.2, 0.3), (2.0, -0.2)):
                away = (ANGLES - self.time * rate + math.pi) % (2.0 * math.pi) - math.pi
                hidden = np.abs(away) < math.atan2(0.25, radius)
                found[hidden] = np.minimum(found[hidden], radius - 0.2)
        found += self.random.normal(0.0, 0.015, len(found))
        return Scan(found, -math.pi, math.radians(1.0), 0.1, FAR_M)

    def errors(self, localizer):
        """Return how far the localizer is off, in m and degrees."""
        found = localizer.map_to_odom @ self.odom
        return found.distance_to(self.pose), abs(
            math.degrees(angle_between(found.yaw, self.pose.yaw))
        )


def laser_at(pose):
    """Return the rotation and translation of a level laser at a pose."""
    cos, sin = math.cos(pose.yaw), math.sin(pose.yaw)
    rotation = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    return rotation, np.array([pose.x, pose.y, 1.2])


def follow(localizer, walker, duration_s):
    """Let a robot walk; return its errors at the end of each second."""
    found = []
    for count in range(round(duration_s * 10)):
        walker.step()
        localizer.observe(walker.scan(), *laser_at(walker.odom), walker.odom)
        if count % 10 == 9:
            found.append(walker.errors(localizer))
    return np.array(found)


def make_localizer(seed=1, **settings):
    """Return a localizer with the flat as map."""
    made = Localizer(LocalizerSettings(**settings), np.random.default_rng(seed))
    made.set_map(FLAT)
    return made
