# SPDX-License-Identifier: Apache-2.0
"""Position servos of a robot: feed-forward, limits and extrapolation of targets."""

from __future__ import annotations

from collections.abc import Iterable

from humanoid_control.backends import Array, JointTargets
from humanoid_description.drives import Drive
from humanoid_simulation.errors import SimulationError
import numpy as np


class Servos:
    """
    Converts the targets of n joints to the inputs of MuJoCo's position servos.

    Such a servo exerts kp (input - q) - kd dq. Feed-forward is folded into the input; positions,
    velocities and efforts are clamped to the limits of the drives. Jumps of a target are rate
    limited to the maximum joint velocity. Call `reset` with the positions of the joints first.

    Parameters
    ----------
    drives
        Limits and gains of the n joints, in the order of the targets.
    period_s
        Control period: the time from one `take` or `go_on` to the next.
    extrapolation_s
        How long positions are extrapolated at their target velocities without new targets.

    """

    def __init__(self, drives: Iterable[Drive], period_s: float, extrapolation_s: float) -> None:
        drives = tuple(drives)
        self._lower = np.array([drive.lower for drive in drives])
        self._upper = np.array([drive.upper for drive in drives])
        self._speed = np.array([drive.velocity for drive in drives])
        self._effort = np.array([drive.effort for drive in drives])
        self._damping_per_stiffness = np.array([d.kd / d.kp for d in drives])
        self._compliance = np.array([1.0 / drive.kp for drive in drives])
        self._period_s = period_s
        self._extrapolation_s = extrapolation_s
        self.reset(np.zeros(len(drives)))

    def reset(self, positions_rad: Array) -> None:
        """
        Hold the current positions of the joints, without feed-forward.

        Parameters
        ----------
        positions_rad
            Positions of the joints (n,).

        """
        self._positions = positions_rad.copy()
        self._velocities = np.zeros_like(positions_rad)
        self._efforts = np.zeros_like(positions_rad)
        self._age_s = 0.0

    def take(self, targets: JointTargets) -> None:
        """
        Follow new targets, clamped to the limits of the drives.

        Parameters
        ----------
        targets
            For all joints, in their order; already validated by `check_targets`.

        """
        self._age_s = 0.0
        self._velocities = _within(targets.velocities_rad_s, -self._speed, self._speed)
        self._efforts = _within(targets.efforts_nm, -self._effort, self._effort)
        self._go_to(targets.positions_rad)

    def go_on(self) -> None:
        """Advance a period without new targets: extrapolate positions for a while, then hold."""
        self._age_s += self._period_s
        if self._age_s <= self._extrapolation_s:
            self._go_to(self._positions + self._velocities * self._period_s)
        elif self._extrapolation_s > 0.0:
            self._velocities = np.zeros_like(self._velocities)

    @property
    def inputs(self) -> Array:
        """Return the inputs of the servos (n,)."""
        inputs: Array = self._positions + self._damping_per_stiffness * self._velocities
        inputs += self._compliance * self._efforts
        return inputs

    def _go_to(self, positions_rad: Array) -> None:
        """Move the target, clamped to the joint range and rate limited to the joint velocity."""
        reach = self._speed * self._period_s
        in_range = _within(positions_rad, self._lower, self._upper)
        self._positions = _within(in_range, self._positions - reach, self._positions + reach)


def check_targets(robot: str, joints: tuple[str, ...], targets: JointTargets) -> None:
    """
    Check the number and the values of joint targets.

    Parameters
    ----------
    robot
        Name of the robot, for the error.
    joints
        Names of its n joints, in the order of the targets.
    targets
        Each array should be (n,) and finite.

    Raises
    ------
    SimulationError
        A shape is wrong, or targets are not finite; the message then names their joints.

    """
    arrays = (targets.positions_rad, targets.velocities_rad_s, targets.efforts_nm)
    for kind, array in zip(('positions', 'velocities', 'efforts'), arrays):
        if array.shape != (len(joints),):
            raise SimulationError(
                f"The targets of robot '{robot}' have {kind} of shape {array.shape}, but it has "
                f'{len(joints)} joints. The previous targets are kept.'
            )
        if not np.isfinite(array.sum()):
            bad = [joint for joint, value in zip(joints, array) if not np.isfinite(value)]
            raise SimulationError(
                f"The targets of robot '{robot}' have {kind} that are not finite, of "
                f'{", ".join(bad)}. The previous targets are kept; check the node that computes '
                'them.'
            )


def _within(values: Array, lower: Array, upper: Array) -> Array:
    """Clamp values to a range, faster than `numpy.clip`."""
    return np.minimum(np.maximum(values, lower), upper)
