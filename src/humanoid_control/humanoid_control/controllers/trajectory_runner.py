# SPDX-License-Identifier: Apache-2.0
"""Controller that runs joint trajectories that are commanded without a goal."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_control.backends import Array, JointTargets, Observation
from humanoid_control.controllers.interface import Mask
from humanoid_control.controllers.spline import inner_velocities, Spline
from humanoid_control.controllers.trajectory import Trajectory
import numpy as np


class TrajectoryRunner:
    """
    Controller that runs a trajectory to its last point; a new trajectory replaces the old one.

    It claims the joints of the trajectory until then. The motion starts from the targets that the
    joints have when it starts. If no point has velocities, they are chosen for a smooth motion
    through the positions; if no point has accelerations, the spline is cubic.

    Parameters
    ----------
    joints
        All joints of the robot, in the order of its targets.
    name
        Name of the controller, as shown to users.

    """

    way_out = 'wait until it ends'

    def __init__(self, joints: Sequence[str], name: str = 'joint_trajectory') -> None:
        self.name = name
        self.joints = tuple(joints)
        self._waiting: Trajectory | None = None
        self._spline: Spline | None = None
        self._start_s = 0.0
        self._wanted = np.zeros(len(self.joints), dtype=np.bool_)
        self._indices = np.zeros(0, dtype=np.intp)
        rest = np.zeros(len(self.joints))
        self._targets = JointTargets(rest, rest.copy(), rest.copy())

    @property
    def waits(self) -> bool:
        """Whether a new trajectory is to be started."""
        return self._waiting is not None

    def accept(self, trajectory: Trajectory) -> None:
        """
        Accept a trajectory, which starts in the next period and replaces the running one.

        Parameters
        ----------
        trajectory
            A trajectory that has been checked; its times count from the start.

        """
        self._waiting, self._spline = trajectory, None
        self._wanted = np.zeros(len(self.joints), dtype=np.bool_)
        self._wanted[trajectory.indices] = True

    def wanted(self, now_s: float) -> Mask:
        """
        Compute the mask of joints that a trajectory moves or is about to move.

        A trajectory whose last point has passed is dropped.

        Parameters
        ----------
        now_s
            The robot's time.

        Returns
        -------
        Mask
            Over all joints (n,).

        """
        if self._spline is not None and now_s - self._start_s > self._spline.end_s:
            self.cancel()
        return self._wanted

    def start(self, observation: Observation, held: JointTargets) -> None:
        """
        Start the accepted trajectory, if there is one, from the last targets of its joints.

        Parameters
        ----------
        observation, held
            As for `Controller.start`.

        """
        if self._waiting is not None:
            trajectory, self._waiting = self._waiting, None
            self._start_s = observation.time_s
            self._indices = trajectory.indices
            self._spline = spline_from(trajectory, held)

    def update(self, observation: Observation) -> JointTargets:
        """
        Sample the running trajectory.

        Parameters
        ----------
        observation
            As for `Controller.update`; only its time is used.

        Returns
        -------
        JointTargets
            Targets of all n joints; entries of joints that are not `wanted` are to be ignored.

        """
        if self._spline is not None:
            positions_rad, velocities_rad_s = self._spline.at(observation.time_s - self._start_s)
            self._targets.positions_rad[self._indices] = positions_rad
            self._targets.velocities_rad_s[self._indices] = velocities_rad_s
        return self._targets

    def cancel(self) -> None:
        """Drop the trajectory."""
        self._waiting, self._spline = None, None
        self._wanted = np.zeros(len(self.joints), dtype=np.bool_)


def spline_from(trajectory: Trajectory, held: JointTargets) -> Spline:
    """
    Build the spline from the last targets of joints through the points of a trajectory.

    Parameters
    ----------
    trajectory
        Trajectory of m joints; its times count from now.
    held
        Last targets of all joints of the robot. The spline starts at their positions and
        velocities, unless the trajectory has a point at time zero or before.

    Returns
    -------
    Spline
        Spline of the m joints; it ends at rest if the points have no velocities.

    """
    times_s, positions_rad = trajectory.times_s, trajectory.positions_rad
    velocities_rad_s, accelerations = trajectory.velocities_rad_s, trajectory.accelerations_rad_s2
    begins = times_s[0] > 0.0
    if begins:
        times_s = np.concatenate(([0.0], times_s))
        positions_rad = _led_by(held.positions_rad[trajectory.indices], positions_rad)
    if velocities_rad_s is None:
        velocities_rad_s = inner_velocities(times_s, positions_rad)
        if begins:
            velocities_rad_s[0] = held.velocities_rad_s[trajectory.indices]
    elif begins:
        velocities_rad_s = _led_by(held.velocities_rad_s[trajectory.indices], velocities_rad_s)
    if accelerations is not None and begins:
        accelerations = _led_by(np.zeros_like(accelerations[0]), accelerations)
    return Spline(times_s, positions_rad, velocities_rad_s, accelerations)


def _led_by(first: Array, rows: Array) -> Array:
    """Prepend a row."""
    return np.vstack([first, rows])
