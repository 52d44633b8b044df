# SPDX-License-Identifier: Apache-2.0
"""What the drives of a robot are told."""

from __future__ import annotations

from collections.abc import Iterable

from humanoid_control.backends import Array, JointTargets
from humanoid_description.drives import Drive
from humanoid_simulation.errors import SimulationError
import numpy as np


class Servos:
    """
    Converts the targets of n joints to the inputs of MuJoCo's position servos.

    Such a servo exerts kp (input - q) - kd dq. Feed-forward is put into the input; positions,
    velocities and efforts are clamped to the limits of the drives. A target that jumps is followed
    as fast as a joint may move. Call `reset` with the positions of the joints first.

    Parameters
    ----------
    drives
        Limits and gains of the n joints, in the order of the targets.
    period_s
        Control period: the time from one `take` or `go_on` to the next.
    extrapolation_s
        How long positions go on with their velocities while no new targets come.

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
        Hold positions without feed-forward, from a moment at which the joints are there.

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
            For all joints, in their order; `check_targets` has let them through.

        """
        self._age_s = 0.0
        self._velocities = _within(targets.velocities_rad_s, -self._speed, self._speed)
        self._efforts = _within(targets.efforts_nm, -self._effort, self._effort)
        self._go_to(targets.positions_rad)

    def go_on(self) -> None:
        """Let a period pass without new targets: positions go on for a while, then they stay."""
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
        """Move the target within the range, no faster than the joints may."""
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
        One is not; the text names the joints whose targets are not finite.

    """
    arrays = (targets.positions_rad, targets.velocities_rad_s, targets.efforts_nm)
    for kind, array in zip(('positions', 'velocities', 'efforts'), arrays):
        if array.shape != (len(joints),):
            raise SimulationError(
                f"The targets of robot '{robot}' have {kind} of shape {array.shape}, but it has "
                f'{len(joints)} joints. The targets before are kept.'
            )
        if not np.isfinite(array.sum()):
            bad = [joint for joint, value in zip(joints, array) if not np.isfinite(value)]
            raise SimulationError(
                f"The targets of robot '{robot}' have {kind} that are not finite, of "
                f'{", ".join(bad)}. The targets before are kept; look at what computes them.'
            )


def _within(values: Array, lower: Array, upper: Array) -> Array:
    """Return values, those out of range replaced by the nearest within; numpy's clip is slower."""
    return np.minimum(np.maximum(values, lower), upper)
