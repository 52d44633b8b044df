# SPDX-License-Identifier: Apache-2.0
"""
Solve the inverse kinematics of the arms for random poses.

The poses are those of random postures of an arm and the waist, in the pelvis frame; the postures
are unknown to the solver. A pose is solved if the gripper comes within a millimetre and half a
degree of it, with all joints within their limits.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
import math
import sys
import time

from arguments import in_range
from humanoid_control.dynamics.frames import Frame
from humanoid_description.drives import SIDES
from humanoid_description.expansion import humanoid_urdf
from humanoid_description.loading import load_robot
from humanoid_description.rotations import log
from humanoid_manipulation.upper_body import OutOfReachError, Reach, UpperBody
import numpy as np

NEAR_M, NEAR_RAD = 1e-3, math.radians(0.5)
LEAST = 0.99


def main() -> int:
    """Measure, print a table, and return the exit status: 1 if too few poses were solved."""
    parser = argparse.ArgumentParser(description=__doc__.strip().split('\n')[0])
    parser.add_argument('--poses', type=in_range(int, 1), default=10_000, help='for each arm')
    parser.add_argument('--seed', type=in_range(int, 0), default=0)
    options = parser.parse_args()
    robot = load_robot(humanoid_urdf(hands=True), 'the humanoid')
    body, random = UpperBody.of(robot), np.random.default_rng(options.seed)
    print(f'{"arm":<8}{"solved":>9}{"mean":>9}{"95 %":>9}{"longest":>9}   (ms)')
    worst = 1.0
    for side in SIDES:
        arm = body.arms[side]
        solved, spent_s = 0, []
        for wanted in _poses(body, side, options.poses, random):
            begin_s = time.perf_counter()
            try:
                found = body.reach(side, wanted)
            except OutOfReachError as error:
                found = error.nearest
            spent_s.append(time.perf_counter() - begin_s)
            solved += arm.is_within_limits(found.posture) and _is_there(
                body.forward(side, found), wanted
            )
        share = solved / options.poses
        worst = min(worst, share)
        spent_ms = 1e3 * np.array(spent_s)
        print(
            f'{side:<8}{share:>9.2%}{spent_ms.mean():>9.3f}'
            f'{np.percentile(spent_ms, 95):>9.3f}{spent_ms.max():>9.3f}'
        )
    return int(worst < LEAST)


def _poses(body: UpperBody, side: str, count: int, random: np.random.Generator) -> Iterator[Frame]:
    """Yield reachable poses of a gripper, from random postures."""
    arm = body.arms[side]
    lower, upper = (body.lower_rad, *arm.lower_rad), (body.upper_rad, *arm.upper_rad)
    for waist_rad, *posture in random.uniform(lower, upper, (count, len(lower))).tolist():
        yield body.forward(side, Reach(waist_rad, tuple(posture)))


def _is_there(found: Frame, wanted: Frame) -> bool:
    """Check whether the pose of the gripper is within the tolerances."""
    away_m = float(np.linalg.norm(found.position_m - wanted.position_m))
    turned_rad = float(np.linalg.norm(log(found.rotation.T @ wanted.rotation)))
    return away_m < NEAR_M and turned_rad < NEAR_RAD


if __name__ == '__main__':
    sys.exit(main())
