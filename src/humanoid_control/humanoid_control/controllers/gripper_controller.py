# SPDX-License-Identifier: Apache-2.0
"""Gripper controller with a force limit and stall detection."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math

from humanoid_control.backends import JointLimits, JointTargets, Observation
from humanoid_control.controllers.commands import CommandError
from humanoid_control.controllers.interface import GoalController

TOLERANCE_M = 0.002
"""A gap this close to the commanded one counts as reached."""
STALL_M, STALL_S = 0.0005, 0.3
"""A finger that moves less than this distance in this time has stalled."""
_BEYOND_M = 1e-3
"""A gap may be out of range by this amount, as when it was rounded or measured."""
REACHED = 'Gap reached.'
STALLED = 'The fingers hold something, or are held.'
GRIPPERS = {'left_gripper_controller': 'left_gripper', 'right_gripper_controller': 'right_gripper'}
"""Suffix of the joint name of each gripper controller."""


@dataclass(frozen=True)
class Grip:
    """Gap between the fingers (m), and the maximum force (N) with which they move there."""

    gap_m: float
    most_n: float


@dataclass(frozen=True)
class GripState:
    """
    State of a gripper, with the fields of control_msgs/GripperCommand.

    Attributes
    ----------
    gap_m, effort_n
        Gap between the fingers; force of the actuator, negative when closing.
    stalled
        Whether the fingers stopped before the gap was reached.
    reached_goal
        Whether the commanded gap is reached.

    """

    gap_m: float = 0.0
    effort_n: float = 0.0
    stalled: bool = False
    reached_goal: bool = False


@dataclass(frozen=True)
class GripResult:
    """Result of a grip, with a message."""

    state: GripState
    message: str
    is_canceled: bool = False

    @property
    def has_ended_well(self) -> bool:
        """Whether the gap is reached, or the fingers hold something."""
        return self.state.reached_goal or self.state.stalled


class GripperController(GoalController[Grip, GripResult]):
    """
    Controller of the finger of a gripper; the thumb mirrors it: the gap is twice its position.

    The target leads the measured position by no more than the maximum force divided by the
    stiffness of the servo. The finger thus presses on an object with that force, also after the
    goal has ended: the object stays held even if it yields.

    Parameters
    ----------
    name, joints
        As for `GoalController`.
    own
        The joint of the finger, which is prismatic.
    limits
        Limits of all joints, in their order; those of the finger bound the gap and the force.

    Attributes
    ----------
    state
        Gap, effort and status as of the last `update`.

    """

    kind = 'position_controllers/GripperActionController'

    def __init__(self, name: str, joints: Sequence[str], own: str, limits: JointLimits) -> None:
        super().__init__(name, joints, (own,))
        self._index = index = int(self.indices[0])
        self.widest_m = 2.0 * float(limits.upper_rad[index])
        """Gap of the fully open gripper."""
        self._strongest_n = float(limits.effort_nm[index])
        self._stiffness_n_m = float(limits.kp_nm_rad[index])
        self.state = GripState()
        self._set = Grip(0.0, self._strongest_n)
        self._anchor_m, self._anchor_s = 0.0, -math.inf

    def checked(self, gap_m: float, most_n: float) -> Grip:
        """
        Validate a grip and clamp it to the limits of the gripper.

        Parameters
        ----------
        gap_m
            Gap between the fingers.
        most_n
            Maximum force; 0 is that of the actuator.

        Raises
        ------
        CommandError
            One of them is out of range.

        """
        if not -_BEYOND_M <= gap_m <= self.widest_m + _BEYOND_M:
            raise CommandError(
                f'The position of a gripper is the gap between its fingers: give 0 to '
                f'{self.widest_m:.3g} m, not {gap_m:g}.'
            )
        if not 0.0 <= most_n < math.inf:
            raise CommandError(
                f'Its max_effort is {most_n:g} N. Give a force, or 0 for the maximum, '
                f'{self._strongest_n:g} N.'
            )
        force_n = min(most_n or self._strongest_n, self._strongest_n)
        return Grip(min(max(gap_m, 0.0), self.widest_m), force_n)

    def start(self, observation: Observation, held: JointTargets) -> None:
        """
        Start the accepted grip, or hold the finger at its last target if there is none.

        Parameters
        ----------
        observation, held
            As for `Controller.start`. A hold keeps the force limit of the last grip.

        """
        self._starts = False
        if self._goal is not None:
            self._set = self._goal
            self._anchor_s = -math.inf
        else:
            self._set = Grip(2.0 * float(held.positions_rad[self._index]), self._set.most_n)

    def update(self, observation: Observation) -> JointTargets:
        """
        Compute the force-limited target of the finger; end the goal when it is reached or stalls.

        The target stays close enough to the measured position for the stiffness of the servo to
        exert no more than the force of the grip.

        Parameters
        ----------
        observation
            As for `Controller.update`.

        Returns
        -------
        JointTargets
            Targets of all n joints of the robot; only the position (m) of the finger is valid.

        """
        at_m = float(observation.positions_rad[self._index])
        way_m = self._set.most_n / self._stiffness_n_m
        wanted_m = self._set.gap_m / 2.0
        target_m = min(max(wanted_m, at_m - way_m), at_m + way_m)
        self._targets.positions_rad[self._index] = target_m
        self._watch(at_m, abs(wanted_m - at_m) <= TOLERANCE_M / 2.0, observation)
        return self._targets

    def _watch(self, at_m: float, reached: bool, observation: Observation) -> None:
        """End the goal when it is reached or the finger has stalled."""
        now_s = observation.time_s
        if abs(at_m - self._anchor_m) > STALL_M or math.isinf(self._anchor_s):
            self._anchor_m, self._anchor_s = at_m, now_s
        stalled = not reached and now_s - self._anchor_s >= STALL_S
        effort_n = float(observation.efforts_nm[self._index])
        self.state = GripState(2.0 * at_m, effort_n, stalled, reached)
        if reached or stalled:
            self._end(GripResult(self.state, REACHED if reached else STALLED), stays=True)

    def _ended(self, why: str, is_canceled: bool) -> GripResult:
        """Build the result of a goal that was canceled or aborted from outside."""
        state = GripState(self.state.gap_m, self.state.effort_n)
        return GripResult(state, why, is_canceled)


def gripper_controllers(
    joints: Sequence[str], limits: JointLimits
) -> tuple[GripperController, ...]:
    """
    Create the controllers of the grippers of a robot.

    Parameters
    ----------
    joints, limits
        All joints of the robot, in the order of its targets, and their limits.

    """
    return tuple(
        GripperController(name, joints, joint, limits)
        for name, end in GRIPPERS.items()
        for joint in joints
        if joint.endswith(end)
    )
