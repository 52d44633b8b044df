# SPDX-License-Identifier: Apache-2.0
"""
Controllers of commands without a goal: streamed joint commands, and joint trajectories.

A stream of commands ends with a timeout.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
import math

from humanoid_control.backends import JointTargets, Observation
from humanoid_control.controllers.commands import PartialTargets
from humanoid_control.controllers.interface import Mask
from humanoid_control.controllers.spline import Spline, spline_from
from humanoid_control.controllers.trajectory import Trajectory
import numpy as np

TIMEOUT_S = 0.5
Clock = Callable[[], float]


class Follower:
    """
    Controller that follows a stream of joint commands, and releases joints when it stops.

    It claims each joint until the timeout has passed since the last command for it. A command for
    some joints leaves the targets of the others unchanged.

    Parameters
    ----------
    joints
        All joints of the robot, in the order of its targets.
    timeout_s
        How long a joint stays claimed after the last command for it.
    clock
        Returns the computer's time in s, by which the timeout must have passed as well; without it
        only the robot's time counts.
    name
        Name of the controller, as shown to users.

    """

    way_out = 'wait until its commands end'

    def __init__(
        self,
        joints: Sequence[str],
        timeout_s: float = TIMEOUT_S,
        clock: Clock | None = None,
        name: str = 'joint_commands',
    ) -> None:
        self.name = name
        self.joints = tuple(joints)
        self._timeout_s, self._clock = timeout_s, clock
        self._silences: dict[tuple[int, ...], tuple[Mask, Silence]] = {}
        rest = np.zeros(len(self.joints))
        self._targets = JointTargets(rest, rest.copy(), rest.copy())

    @property
    def waits(self) -> bool:
        """Whether a start is pending: never, as the targets come with the commands."""
        return False

    def start(self, observation: Observation, held: JointTargets) -> None:
        """
        Start the controller; a no-op, as the targets come with the commands.

        Parameters
        ----------
        observation, held
            As for `Controller.start`; not used.

        """

    def accept(self, command: PartialTargets) -> None:
        """
        Store a command, which takes effect in the next period.

        Parameters
        ----------
        command
            Checked targets of some joints, whose timeout restarts; other joints keep theirs.

        """
        targets, indices = self._targets, command.indices
        targets.positions_rad[indices] = command.targets.positions_rad
        targets.velocities_rad_s[indices] = command.targets.velocities_rad_s
        targets.efforts_nm[indices] = command.targets.efforts_nm
        self._silence_of(indices.tolist()).heard()

    def wanted(self, now_s: float) -> Mask:
        """
        Compute the mask of joints whose commands have not timed out.

        Parameters
        ----------
        now_s
            The robot's time.

        Returns
        -------
        Mask
            Over all joints (n,).

        """
        self._silences = {
            key: entry for key, entry in self._silences.items() if not entry[1].lasts(now_s)
        }
        masks = [mask for mask, _ in self._silences.values()]
        wanted: Mask = np.logical_or.reduce(masks) if masks else self._mask([])
        return wanted

    def update(self, observation: Observation) -> JointTargets:
        """
        Return the latest commanded targets.

        Parameters
        ----------
        observation
            Not used.

        Returns
        -------
        JointTargets
            Targets of all n joints; entries of joints that are not `wanted` are to be ignored.

        """
        return self._targets

    def cancel(self) -> None:
        """Drop all commands."""
        self._silences = {}

    def _silence_of(self, indices: list[int]) -> Silence:
        """Return the timeout of a set of joints that are commanded together."""
        key = tuple(indices)
        if key not in self._silences:
            self._silences[key] = (self._mask(indices), Silence(self._timeout_s, self._clock))
        return self._silences[key][1]

    def _mask(self, indices: list[int]) -> Mask:
        mask = np.zeros(len(self.joints), dtype=np.bool_)
        mask[indices] = True
        return mask


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


class Silence:
    """
    Timeout since the last input, such as a command.

    It must have passed in both the robot's time and the computer's: the robot's time may run many
    times faster than the operator's, or stand still while the simulator is paused.

    Parameters
    ----------
    timeout_s
        Time without input until the timeout.
    clock
        Returns the computer's time in s; without it only the robot's time counts.

    """

    def __init__(self, timeout_s: float, clock: Clock | None = None) -> None:
        self._timeout_s = timeout_s
        self._clock: Clock = clock or (lambda: math.inf)
        self._unheard = True
        self._fresh = False
        self._heard_s = self._heard_clock_s = -math.inf

    def heard(self) -> None:
        """Restart the timeout on an input."""
        self._unheard, self._fresh = False, True
        self._heard_clock_s = self._clock()

    def end(self) -> None:
        """Expire at once; the next input restarts the timeout."""
        self._unheard = True

    def lasts(self, now_s: float) -> bool:
        """
        Check whether the timeout has passed since the last input.

        Call it in every period: the timeout counts from the first call after `heard`.

        Parameters
        ----------
        now_s
            The robot's time.

        Returns
        -------
        bool
            Also true before the first input, and after `end` until the next one.

        """
        if self._fresh:
            self._fresh, self._heard_s = False, now_s
        if not self._unheard and now_s - self._heard_s >= self._timeout_s:
            clock_s = self._clock()
            self._unheard = clock_s == math.inf or clock_s - self._heard_clock_s >= self._timeout_s
        return self._unheard
