# SPDX-License-Identifier: Apache-2.0
"""Release a held object: the implementation of `hand_over` and `drop`."""

from __future__ import annotations

from typing import Any

from humanoid_common.single_goal import GoalAborted, GoalCanceled, RunningGoal
from humanoid_description.robot import Array
from humanoid_interfaces.action import HandOver
from humanoid_manipulation.arm_motions import abort_on_planning_error
from humanoid_manipulation.handling import ManipulationAction, unsound_side
from humanoid_manipulation.hands import LEAST_SHARE
from humanoid_manipulation.held_things import Held
from humanoid_manipulation.manipulation_node import ManipulationNode
from humanoid_manipulation.motion_planning import plan
from humanoid_manipulation.upper_body import Reach
import numpy as np

__all__ = ['Giving']

_OUT = {
    'left': Reach(0.0, (-0.75, 0.15, 0.0, -0.75, 0.0, -0.05)),
    'right': Reach(0.0, (-0.75, -0.15, 0.0, -0.75, 0.0, -0.05)),
}
"""The arm postures with the hand held out, level, at the height of a table."""
_PATIENCE_S = 30.0
_STILL_S, _PULL_S = 0.8, 0.15
"""Averaging times of the efforts at rest, and of those that are compared to detect a pull."""
_PULL_NM = 1.6
"""Change of a joint's effort that counts as a pull."""


class Giving(ManipulationAction):
    """
    Implementation of the actions `hand_over` and `drop`.

    Parameters
    ----------
    node
        The node, with its arms.

    """

    def __init__(self, node: ManipulationNode) -> None:
        super().__init__(node, HandOver.Feedback)

    def unsound(self, request: Any) -> str:
        """
        Validate a goal before it is accepted.

        Parameters
        ----------
        request
            A goal of `hand_over` or `drop`.

        Returns
        -------
        str
            The rejection message; empty if the goal is accepted.

        """
        return unsound_side(request.side)

    async def hand_over(self, goal: RunningGoal) -> None:
        """
        Hold out an object, and release it when someone pulls on it.

        Parameters
        ----------
        goal
            A goal of `hand_over`; its result is filled in with the id of the object.

        Raises
        ------
        GoalAborted
            The hand is empty, no one takes the object in time, or the arm cannot be moved.
        GoalCanceled
            The goal is canceled; the arms are retracted first.

        """
        with self.node.transforms.listening(), self.node.arms.listening():
            await self.begin(goal)
            side, held = self.hands.holding(goal.request.side)
            goal.result.object = held.object_id
            try:
                await self._hold_out(goal, side, held)
                await self._give(goal, side)
            except GoalCanceled:
                with goal.ending():
                    await self._draw_back(goal)
                raise

    async def _hold_out(self, goal: RunningGoal, side: str, held: Held) -> None:
        """Hold out an object until someone pulls on it."""
        arms = self.node.arms
        self.tell(goal, 'reaching')
        # The receiver stands there: only self-collisions are avoided.
        world = arms.world([], {side: held.box}, 0.0)
        with abort_on_planning_error():
            await self.motions.move(goal, side, plan(world, side, arms.reach_of(side), _OUT[side]))
        self.tell(goal, 'waiting')
        if not await self._is_taken(goal, side, held):
            await self._draw_back(goal)
            raise GoalAborted('NOT_TAKEN', 'Nobody took it.')

    async def _give(self, goal: RunningGoal, side: str) -> None:
        """Release the object, and retract the arms."""
        self.tell(goal, 'opening')
        await self.hands.let_go(goal, side)
        await self._wait(goal, 1.0)
        await self._draw_back(goal)

    async def _draw_back(self, goal: RunningGoal) -> None:
        """Retract the arms, avoiding only self-collisions: the receiver may stand there."""
        arms = self.node.arms
        for side, end in self.motions.at_ease().items():
            world = arms.world([], self.node.held.boxes, 0.0)
            with abort_on_planning_error():
                way = plan(world, side, arms.reach_of(side), end)
                await self.motions.move(goal, side, way)

    async def drop(self, goal: RunningGoal) -> None:
        """
        Open a hand fully, so that the object that it holds falls.

        Parameters
        ----------
        goal
            A goal of `drop`; its result is filled in with the id of the object.

        Raises
        ------
        GoalAborted
            The hand is empty, or cannot be opened.
        GoalCanceled
            The goal is canceled.

        """
        with self.node.arms.listening():
            await self.begin(goal)
            side, held = self.hands.holding(goal.request.side)
            goal.result.object = held.object_id
            await self.hands.let_go(goal, side, wide=True)

    async def _is_taken(self, goal: RunningGoal, side: str, held: Held) -> bool:
        """Wait until someone pulls on the object or has taken it; False after the patience."""
        given = goal.request.patience
        patience_s = given.sec + given.nanosec * 1e-9 or _PATIENCE_S
        at_rest = await self._efforts_nm(goal, side, _STILL_S)
        for _ in range(round(patience_s / _PULL_S)):
            now = await self._efforts_nm(goal, side, _PULL_S)
            gap_m, _ = self.node.arms.grip_of(side)
            is_gone = gap_m < LEAST_SHARE * held.width_m
            if is_gone or float(np.abs(now - at_rest).max()) > _PULL_NM:
                return True
        return False

    async def _efforts_nm(self, goal: RunningGoal, side: str, seconds: float) -> Array:
        """Average the efforts of an arm over some time, without those of the fingers."""
        efforts = []
        for _ in range(max(1, round(seconds * 20.0))):
            efforts.append(self.node.arms.efforts_of(side))
            await goal.tick()
        return np.asarray(np.mean(efforts, axis=0))

    async def _wait(self, goal: RunningGoal, seconds: float) -> None:
        for _ in range(round(seconds * 20.0)):
            await goal.tick()
