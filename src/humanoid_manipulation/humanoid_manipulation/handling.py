# SPDX-License-Identifier: Apache-2.0
"""Common parts of the manipulation actions: feedback, walking to stances, and withdrawing."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Iterable, Sequence
import math
from typing import Any

from humanoid_common.single_goal import GoalAborted, GoalCanceled, RunningGoal
from humanoid_description.drives import SIDES
from humanoid_manipulation.arm_motions import ArmMotions, Reaching
from humanoid_manipulation.manipulation_node import ManipulationNode
from humanoid_manipulation.stances import BENDS, Stance
from humanoid_manipulation.upper_body import Reach

__all__ = ['ManipulationAction', 'Positioning', 'unsound_side']

_TUCKED = {
    'left': Reach(0.0, (0.75, 0.2, 0.0, -2.1, 0.0, 0.0)),
    'right': Reach(0.0, (0.75, -0.2, 0.0, -2.1, 0.0, 0.0)),
}
"""Arm postures for stepping up to furniture and bending: elbows back, nothing ahead."""
_BACK_M = 0.35
"""How far the robot steps back after it picked or placed an object."""
_BESIDE_M, _BESIDE_RAD = 0.25, 0.4
"""Largest distance and turn to the stance for which the robot steps there directly."""
_NEAR_M = 1.5
"""Largest distance to `Stance.before` for which it steps there if the way is clear; otherwise it
navigates."""
_OTHERWISE = ('WALK_FAILED', 'NOT_REACHABLE', 'BLOCKED', 'SLIPPED')
"""Errors after which another stance is tried."""


class Positioning:
    """
    Walking to stances and back, with the arms out of the way.

    Parameters
    ----------
    node
        The node, with its feet and its surroundings.
    motions
        Moves the arms.
    tell
        Publishes the state of a goal as feedback.

    """

    def __init__(
        self, node: ManipulationNode, motions: ArmMotions, tell: Callable[[RunningGoal, str], None]
    ) -> None:
        self._node, self._motions, self._tell = node, motions, tell

    async def place_of_feet(self, goal: RunningGoal) -> tuple[float, float, float]:
        """
        Wait for the transforms of the soles, and compute where the robot stands: see `Feet.place`.

        Parameters
        ----------
        goal
            The goal.

        Returns
        -------
        tuple
            x and y in m, and the heading in rad, in the frame of the remembered objects.

        Raises
        ------
        GoalAborted
            The transform of a sole does not become available: NO_TRANSFORM.
        GoalCanceled
            The goal is canceled.

        """
        node = self._node
        for sole in node.feet.soles:
            await node.transforms.known(goal, node.surroundings.frame, sole)
        return node.feet.place(node.surroundings.frame)

    async def from_one_of(
        self,
        goal: RunningGoal,
        stances: Iterable[Stance],
        work: Callable[[Stance], Awaitable[None]],
    ) -> None:
        """
        Try stances one after another until the work succeeds from one of them.

        Parameters
        ----------
        goal, stances
            The goal, and the stances in the order in which they are tried.
        work
            A coroutine function that does the work; it receives the stance.

        Raises
        ------
        GoalAborted
            The error of the last stance; NOT_REACHABLE if there is no stance.

        """
        node, trouble = self._node, GoalAborted('NOT_REACHABLE', 'There is nowhere to stand.')
        for stance in stances:
            held = node.held.get(stance.side)
            has_begun = False
            try:
                await self._stand(goal, stance)
                has_begun = True
                await work(stance)
                return
            except GoalAborted as error:
                if error.name not in _OTHERWISE or node.held.get(stance.side) is not held:
                    raise
                trouble = error
                node.get_logger().info(f'Trying another stance: {error}')
                if has_begun:
                    await self.withdraw(goal)
            except GoalCanceled:
                if has_begun:
                    with goal.ending():
                        await self.withdraw(goal)
                raise
            finally:
                node.feet.straighten()
        raise trouble

    async def withdraw(self, goal: RunningGoal, but: Sequence[str] = ()) -> None:
        """
        Straighten up, step back, and move the arms to their postures for walking.

        Walking and planning errors are only logged, as the work of the goal has ended by then.

        Parameters
        ----------
        goal
            The goal.
        but
            The names of obstacles that the arms may touch.

        """
        try:
            await self._node.feet.bend(goal, BENDS[0])
            await self._step_back(goal)
            await self._motions.bring_arms(goal, self._motions.at_ease(), but)
        except GoalAborted as error:
            if error.name not in _OTHERWISE:
                raise
            self._node.get_logger().info(f'Cannot return to the posture for walking: {error}')

    async def _stand(self, goal: RunningGoal, stance: Stance) -> None:
        """
        Walk to a stance, unless the robot stands there already.

        Navigation takes the robot over long distances, to a point where it can still turn. It
        steps the last half metre by itself, exactly and with the elbows back.
        """
        self._tell(goal, 'walking')
        node, feet, frame = self._node, self._node.feet, self._node.surroundings.frame
        x_m, y_m, yaw_rad = await self.place_of_feet(goal)
        at, before = (stance.x_m, stance.y_m, stance.yaw_rad), stance.before
        turned_rad = abs(math.remainder(stance.yaw_rad - yaw_rad, math.tau))
        if math.dist((x_m, y_m), at[:2]) > _BESIDE_M or turned_rad > _BESIDE_RAD:
            await self._motions.bring_arms(goal, self._motions.at_ease())
            # Navigation is for long distances: it turns in wide curves, and ends roughly there.
            is_near = math.dist((x_m, y_m), before[:2]) < _NEAR_M
            if is_near and node.surroundings.floor.is_clear_way((x_m, y_m), before[:2]):
                await feet.step_to(goal, frame, before)
            else:
                await feet.go(goal, frame, before)
        free = {side: end for side, end in _TUCKED.items() if side not in node.held}
        await self._motions.bring_arms(goal, free)
        try:
            await feet.step_to(goal, frame, at)
        except GoalAborted as error:
            # Navigation does not start this near to furniture.
            if error.name == 'WALK_FAILED':
                await self._step_back(goal)
                await self._motions.bring_arms(goal, self._motions.at_ease())
            raise

    async def _step_back(self, goal: RunningGoal) -> None:
        """Step back by 0.35 m after a pick, a place, or a failed approach."""
        x_m, y_m, yaw_rad = await self.place_of_feet(goal)
        back = (x_m - _BACK_M * math.cos(yaw_rad), y_m - _BACK_M * math.sin(yaw_rad), yaw_rad)
        await self._node.feet.step_to(goal, self._node.surroundings.frame, back)


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
        self.node.update_held()


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
