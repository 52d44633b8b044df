# SPDX-License-Identifier: Apache-2.0
"""Common parts of the actions pick, place, hand-over and drop."""

from __future__ import annotations

from typing import Any

from humanoid_common.single_goal import RunningGoal
from humanoid_description.drives import SIDES
from humanoid_manipulation.arm_motions import ArmMotions, Reaching
from humanoid_manipulation.manipulation_node import ManipulationNode
from humanoid_manipulation.positioning import Positioning

__all__ = ['ManipulationAction', 'unsound_side']


class ManipulationAction:
    """
    Base class of the actions that manipulate objects: their feedback, and what they work with.

    Parameters
    ----------
    node
        The node, with its arms, its hands and its surroundings.
    feedback
        The feedback message type of the action, with a field `state`.

    Attributes
    ----------
    hands
        The grippers, and what they hold.
    motions
        Moves the arms from posture to posture.
    reaching
        Moves a hand to a grasp and away from it.
    positioning
        Walks to stances and back.

    """

    def __init__(self, node: ManipulationNode, feedback: Any) -> None:
        self.node, self._feedback = node, feedback
        self.hands, self.motions = node.hands, ArmMotions(node)
        self.reaching = Reaching(node, self.motions)
        self.positioning = Positioning(node, self.motions, self.tell)

    def tell(self, goal: RunningGoal, state: str) -> None:
        """
        Publish the state of a goal as feedback.

        Parameters
        ----------
        goal, state
            The goal, and one of the states that the action's feedback defines.

        """
        goal.publish_feedback(self._feedback(state=state))

    async def begin(self, goal: RunningGoal) -> None:
        """
        Wait until the arms can be moved, and update which hands hold an object.

        Parameters
        ----------
        goal
            The goal.

        Raises
        ------
        GoalAborted
            The arms cannot be moved.
        GoalCanceled
            The goal is canceled.

        """
        await self.node.arms.wait(goal)
        self.hands.update_held()


def unsound_side(side: str) -> str:
    """
    Validate the side that a goal asks for.

    Parameters
    ----------
    side
        `left`, `right`, or empty for the one that fits.

    Returns
    -------
    str
        The error message; empty if the side is valid.

    """
    if side in ('', *SIDES):
        return ''
    return f"Unknown side '{side}'. Give left, right, or nothing to choose automatically."
