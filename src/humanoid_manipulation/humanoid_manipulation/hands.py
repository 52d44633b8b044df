# SPDX-License-Identifier: Apache-2.0
"""Close and open the hands, and tell which of them holds what."""

from __future__ import annotations

from typing import Any

from action_msgs.msg import GoalStatus
from control_msgs.action import GripperCommand
from humanoid_common.single_goal import GoalAborted, RunningGoal
from humanoid_control.dynamics.frames import Frame
from humanoid_description.robot import Array
from humanoid_manipulation.held_things import Held, HeldThings, SOMETHING
from humanoid_manipulation.obstacle import Obstacle
import numpy as np
from rclpy.action import ActionClient
from rclpy.node import Node

__all__ = ['LEAST_SHARE', 'Hands', 'has_lost']

LEAST_SHARE = 0.5
"""Smallest gap of a closed gripper that holds an object, as a fraction of the object's width."""
_CODE = 'ARM_FAILED'
_GRIP_N = 25.0
_OPENS_M, _WIDEST_M = 0.03, 0.10
"""How much wider than an object the gripper opens to release it, and its largest gap."""
_THIN_M, _HOLDING_N = 0.008, 3.0
"""A hand that stays open by this gap while it closes with this force holds something."""
_OTHER_M = 0.025
"""Change of the gap between the fingers from which an object counts as no longer held."""
_SOMETHING_M = (0.07, 0.07, 0.15)
"""The assumed size of an unknown held object."""


def has_lost(held: Held, gap_m: float) -> bool:
    """
    Check whether a hand no longer holds an object, from the gap between its fingers.

    Parameters
    ----------
    held, gap_m
        The object, and the measured gap.

    """
    has_closed = gap_m < LEAST_SHARE * held.width_m
    return has_closed or abs(gap_m - held.width_m) > _OTHER_M


class Hands:
    """
    Interface to the grippers, and the record of what they hold.

    Gripper goals go on when this process ends: a hand may hold something.

    Parameters
    ----------
    node
        The node that owns the action clients.
    held
        The held objects, which are updated.

    """

    def __init__(self, node: Node, held: HeldThings) -> None:
        self._node, self._held = node, held
        self._grippers: dict[str, ActionClient] = {}

    def update_held(self, side: str, gap_m: float, force_n: float, gripper: Array) -> None:
        """
        Update whether a hand holds an object, from the measured state of its gripper.

        A hand that closes with a force but stays open holds something, whichever node closed it;
        a hand whose fingers have moved since it grasped its object no longer holds it.

        Parameters
        ----------
        side, gap_m, force_n
            The side of the hand, the gap between its fingers, and their force: see `Arms.grip_of`.
        gripper
            The rotation (3, 3) of the gripper in the pelvis frame.

        """
        held = self._held.get(side)
        if held is None and gap_m > _THIN_M and force_n < -_HOLDING_N:
            self._held[side] = _something(gripper, gap_m)
        elif held is not None and has_lost(held, gap_m):
            del self._held[side]

    def holding(self, asked: str) -> tuple[str, Held]:
        """
        Find the hand that a goal asks for, and the object that it holds.

        Parameters
        ----------
        asked
            `left`, `right`, or empty for any hand that holds something.

        Raises
        ------
        GoalAborted
            The hand is empty: EMPTY_HAND.

        """
        for side, held in self._held.items():
            if asked in ('', side):
                return side, held
        raise GoalAborted('EMPTY_HAND', 'I am not holding anything.')

    async def grip(self, goal: RunningGoal, side: str, gap_m: float, most_n: float = 0.0) -> Any:
        """
        Open or close a gripper, and return the result of its action.

        Parameters
        ----------
        goal
            The goal.
        side, gap_m, most_n
            The side of the hand, the gap between its fingers, and the force limit; 0 is the full
            force.

        Raises
        ------
        GoalAborted
            Its controller is not available, or does not succeed.

        """
        name = f'{side}_gripper_controller/gripper_cmd'
        if side not in self._grippers:
            self._grippers[side] = ActionClient(self._node, GripperCommand, name)
        client = self._grippers[side]
        command = GripperCommand.Goal()
        command.command.position, command.command.max_effort = gap_m, most_n
        answer = await goal.delegate(client, command, name, _CODE)
        if answer.status != GoalStatus.STATUS_SUCCEEDED:
            raise GoalAborted(_CODE, f"'{name}' did not reach its commanded position.")
        return answer.result

    async def check_held(self, goal: RunningGoal, side: str, width_m: float) -> float:
        """
        Close a hand, and check that an object is between its fingers.

        Parameters
        ----------
        goal, side
            The goal, and the side of the hand.
        width_m
            The width of the object.

        Returns
        -------
        float
            The gap between the fingers (m); -1 if they have closed too far to hold the object.

        """
        closed = await self.grip(goal, side, 0.0, _GRIP_N)
        return float(closed.position) if closed.position >= LEAST_SHARE * width_m else -1.0

    async def let_go(self, goal: RunningGoal, side: str, *, wide: bool = False) -> None:
        """
        Open a hand to release the object that it holds.

        Parameters
        ----------
        goal, side
            The goal, and the side of the hand.
        wide
            Whether it opens to its largest gap, or only as far as needed, to spare objects nearby.

        """
        gap_m = _WIDEST_M if wide else min(self._held[side].width_m + _OPENS_M, _WIDEST_M)
        await self.grip(goal, side, gap_m)
        del self._held[side]


def _something(gripper: Array, gap_m: float) -> Held:
    """Create the held object for a grasp that this node did not perform."""
    box = Obstacle(SOMETHING, Frame(np.zeros(3), gripper.T), _SOMETHING_M)
    return Held(SOMETHING, (SOMETHING,), box, gap_m, gripper, 0.5 * _SOMETHING_M[2])
