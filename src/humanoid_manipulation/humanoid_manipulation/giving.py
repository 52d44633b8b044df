# SPDX-License-Identifier: Apache-2.0
"""Let go of what a hand holds: the work of `hand_over` and of `drop`."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from humanoid_common.single_goal import GoalAborted, RunningGoal
from humanoid_description.robot import Array
from humanoid_interfaces.action import HandOver
from humanoid_manipulation.handling import carrying, Handling, HANGING
from humanoid_manipulation.motion_planning import plan
from humanoid_manipulation.upper_body import Reach
import numpy as np

if TYPE_CHECKING:
    from humanoid_manipulation.manipulator import Manipulator

__all__ = ['Giving']

_OUT = {
    'left': Reach(0.0, (-0.75, 0.15, 0.0, -0.75, 0.0, -0.05)),
    'right': Reach(0.0, (-0.75, -0.15, 0.0, -0.75, 0.0, -0.05)),
}
"""A hand that is held out at the height of a table, level."""
_PATIENCE_S = 30.0
_STILL_S, _PULL_S = 0.8, 0.15
"""How long an arm has to be still until a pull can be felt, and how long that lasts."""
_PULL_NM = 1.6
"""How much the effort of a joint changes when somebody pulls."""
_OPEN_M = 0.03


class Giving(Handling):
    """
    The work of `hand_over` and `drop`.

    Parameters
    ----------
    node
        The node, with its arms.

    """

    def __init__(self, node: Manipulator) -> None:
        super().__init__(node, HandOver.Feedback)

    def unsound(self, request: Any) -> str:
        """Return why a goal makes no sense; nothing if it does."""
        return self.node.unsound_side(request.side)

    async def hand_over(self, goal: RunningGoal) -> None:
        """Hold out a thing, and let go when it is pulled at."""
        node, arms = self.node, self.node.arms
        side, held = self.holding(goal.request.side)
        goal.result.object = held.object_id
        with node.transforms.listening(), arms.listening():
            await arms.wait(goal)
            self.tell(goal, 'reaching')
            # Who takes it stands there: only the robot itself is kept clear of.
            world = arms.world([], {side: held.box}, 0.0)
            with self.failing():
                await self.move(goal, side, plan(world, side, arms.reach_of(side), _OUT[side]))
            self.tell(goal, 'waiting')
            if not await self._is_pulled(goal, side):
                with self.failing():
                    back = plan(world, side, arms.reach_of(side), carrying(arms.body, side, held))
                    await self.move(goal, side, back)
                raise GoalAborted('NOT_TAKEN', 'Nobody has taken it.')
            self.tell(goal, 'opening')
            await arms.grip(goal, side, min(held.width_m + _OPEN_M, 0.1))
            del node.held[side]
            await self._wait(goal, 1.0)
            world = arms.world([], {}, 0.0)
            with self.failing():
                await self.move(goal, side, plan(world, side, arms.reach_of(side), HANGING[side]))

    async def drop(self, goal: RunningGoal) -> None:
        """Open a hand."""
        side, held = self.holding(goal.request.side)
        goal.result.object = held.object_id
        await self.node.arms.grip(goal, side, 0.1)
        del self.node.held[side]

    async def _is_pulled(self, goal: RunningGoal, side: str) -> bool:
        """Return whether somebody pulls within the time that they may take."""
        given = goal.request.patience
        patience_s = given.sec + given.nanosec * 1e-9 or _PATIENCE_S
        at_rest = await self._efforts_nm(goal, side, _STILL_S)
        for _ in range(round(patience_s / _PULL_S)):
            now = await self._efforts_nm(goal, side, _PULL_S)
            if float(np.abs(now - at_rest).max()) > _PULL_NM:
                return True
        return False

    async def _efforts_nm(self, goal: RunningGoal, side: str, seconds: float) -> Array:
        """Return the mean efforts of an arm over some time, the fingers left out."""
        efforts = []
        for _ in range(max(1, round(seconds * 20.0))):
            efforts.append(self.node.arms.efforts_of(side))
            await goal.tick()
        return np.asarray(np.mean(efforts, axis=0))

    async def _wait(self, goal: RunningGoal, seconds: float) -> None:
        for _ in range(round(seconds * 20.0)):
            await goal.tick()
