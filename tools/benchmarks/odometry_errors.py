# SPDX-License-Identifier: Apache-2.0
"""Compare the errors of the walk's odometry with the variances that it states.

Each run walks by random commands, with the realistic noise of the sensors and biases of its own.
There is no ROS: controller and physics run in lockstep, as fast as possible. A ratio of 1 is a
stated variance that is the true one. The status is 1 if one is not within a factor of 2.
"""

from __future__ import annotations

import argparse
import math
import sys

from arguments import in_range
from humanoid_description.rotations import from_quaternion, to_rpy, wrap_angle
from humanoid_simulation.backend import BackendSettings, SensorNoise
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.sweep.walk import random_segment
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
QUANTITIES = {'x, y': (0, 1), 'z': (2,), 'roll, pitch': (3, 4), 'heading': (5,)}
FACTOR = 2.0


class OdometryRun:
    """
    A robot that walks without pushes, and the errors of its odometry.

    Parameters
    ----------
    seed
        The seed of the commands, and of the noise and biases of the sensors.
    noise
        The noise of the sensors.

    """

    def __init__(self, seed: int, noise: SensorNoise) -> None:
        self._robot = LockstepRobot(BackendSettings(noise=noise, seed=seed))
        self._random = np.random.default_rng([seed, 4])
        self._start = self._robot.pose
        self._left_s = 0.0

    def walk(self, duration_s: float) -> bool:
        """
        Walk by random commands; return whether the robot still stands.

        Parameters
        ----------
        duration_s
            The duration, in simulated time.

        """
        end_s = self._robot.backend.time_s + duration_s
        while (rest_s := end_s - self._robot.backend.time_s) > 1e-6:
            if self._left_s <= 0.0:
                segment = random_segment(self._random, 0.0)
                command, self._left_s = segment.command, segment.duration_s
                self._robot.drive(command.forward_m_s, command.left_m_s, command.turn_rad_s)
            step_s = min(self._left_s, rest_s)
            self._left_s -= step_s
            if not self._robot.wait(step_s):
                return False
        return True

    def errors(self) -> tuple[Array, Array]:
        """Return the errors (6,) of the pose, and the stated variances (6,)."""
        # Sensors have measured the state after the last tick; odometry must include it.
        walker, backend = self._robot.walking.walker, self._robot.backend
        walker.update(backend.observe()[''])
        status = walker.status
        if status is None:
            raise RuntimeError('The robot has not begun to walk.')
        odometry, truth = status.odometry, self._robot.pose
        place = self._start.local(truth.position_m)
        true_rpy = to_rpy(from_quaternion(self._robot.truth.orientation))
        said_rpy = to_rpy(from_quaternion(np.array(odometry.orientation)))
        errors = [
            odometry.pose.position_m.real - place.real,
            odometry.pose.position_m.imag - place.imag,
            odometry.height_m - float(self._robot.truth.position_m[2]),
            said_rpy[0] - true_rpy[0],
            said_rpy[1] - true_rpy[1],
            wrap_angle(odometry.pose.yaw_rad - truth.yaw_rad + self._start.yaw_rad),
        ]
        return np.array(errors), np.diag(odometry.covariance).copy()


def main() -> int:
    """Run, print a table, and return the exit status: 1 if a stated variance is wrong."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=int, default=20)
    parser.add_argument('--seconds', type=float, default=60.0, help='length of a run')
    parser.add_argument('--first-seed', type=in_range(int, 0), default=0)
    parser.add_argument(
        '--noise', type=in_range(float, 0.0), default=1.0, help='factor of all noise'
    )
    options = parser.parse_args()
    if options.runs < 1 or options.seconds <= 0.0:
        parser.error('--runs and --seconds must be above zero: nothing else shows anything')
    noise = REALISTIC.scaled(options.noise)
    found: list[list[tuple[Array, Array]]] = [[], [], []]
    for seed in range(options.first_seed, options.first_seed + options.runs):
        run = OdometryRun(seed, noise)
        for samples in found:
            if not run.walk(options.seconds / len(found)):
                print(f'Run {seed} fell.')
                break
            samples.append(run.errors())
    print('| after | what | true deviation | stated deviation | ratio of variances |')
    print('|---|---|---|---|---|')
    is_right = True
    for number, samples in enumerate(found):
        after_s = (number + 1) * options.seconds / len(found)
        for name, ratio in rows(samples, after_s):
            print(name)
            is_right &= 1.0 / FACTOR <= ratio <= FACTOR
    return int(not is_right)


def rows(samples: list[tuple[Array, Array]], after_s: float) -> list[tuple[str, float]]:
    """
    Compare the true with the stated variance of each quantity, over all runs.

    Parameters
    ----------
    samples
        For each run, the errors (6,) and the stated variances (6,) of x, y, z in m and roll,
        pitch, yaw in rad.
    after_s
        The time that the robot had walked, for the table.

    Returns
    -------
    list of (str, float)
        For each of `QUANTITIES`, a row and the ratio of the stated variance to the true one.

    """
    errors = np.array([error for error, _ in samples])
    stated = np.array([variance for _, variance in samples])
    result = []
    for name, axes in QUANTITIES.items():
        columns = list(axes)
        true2, said2 = float(np.mean(errors[:, columns] ** 2)), float(np.mean(stated[:, columns]))
        ratio = said2 / true2
        text = f'| {after_s:.0f} s | {name} | {math.sqrt(true2):.4f} | {math.sqrt(said2):.4f} |'
        result.append((f'{text} {ratio:.2f} |', ratio))
    return result


if __name__ == '__main__':
    sys.exit(main())
