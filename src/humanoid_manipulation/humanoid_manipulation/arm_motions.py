# SPDX-License-Identifier: Apache-2.0
"""Move the arms from posture to posture on collision-free paths."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager

from humanoid_common.single_goal import GoalAborted, RunningGoal
from humanoid_manipulation.arm_world import Obstacle
from humanoid_manipulation.errors import ManipulationError
from humanoid_manipulation.held_things import carrying, HANGING
from humanoid_manipulation.manipulation_node import ManipulationNode
from humanoid_manipulation.motion_planning import BlockedError, plan, timed
from humanoid_manipulation.upper_body import OutOfReachError, Reach

__all__ = ['ArmMotions', 'abort_on_planning_error']

_THERE_RAD = 0.05
"""An arm whose joints are this near to a posture is not moved there."""


class ArmMotions:
    """
    Motions of the arms in joint space, clear of the surroundings and of what the hands hold.

    Parameters
    ----------
    node
        The node, with its arms and its surroundings.

    """

    def __init__(self, node: ManipulationNode) -> None:
        self._node = node

    def at_ease(self) -> dict[str, Reach]:
        """Return the arm postures for walking, by side: hanging, or carrying an object."""
        body, held = self._node.arms.body, self._node.held
        return {
            side: carrying(body, side, held[side]) if side in held else hanging
            for side, hanging in HANGING.items()
        }

    async def obstacles(
        self,
        goal: RunningGoal,
        but: Sequence[str] = (),
        wider_m: float = 0.0,
        exact: str = '',
    ) -> list[Obstacle]:
        """
        List the obstacles near the robot, without the objects that it holds and also detects.

        Parameters
        ----------
        goal, but
            The goal, and the names of obstacles to leave out.
        wider_m, exact
            See `Surroundings.obstacles`.

        """
        own = {*but, *(each.box.name for each in self._node.held.values())}
        found = await self._node.surroundings.obstacles(goal, wider_m, exact)
        return [each for each in found if each.name not in own]

    async def bring_arms(
        self, goal: RunningGoal, ends: Mapping[str, Reach], but: Sequence[str] = ()
    ) -> None:
        """
        Move arms to target postures on collision-free paths.

        Parameters
        ----------
        goal
            The goal.
        ends
            The target postures by side; the arms are moved one after the other.
        but
            The names of obstacles that the arms may touch.

        Raises
        ------
        GoalAborted
            There is no collision-free path, or the arm does not get there.

        """
        arms = self._node.arms
        for side, end in ends.items():
            start = arms.reach_of(side)
            if max(abs(a - b) for a, b in zip(start.posture, end.posture)) < _THERE_RAD:
                continue
            clearance_m = self._node.parameters.current.clearance
            around = await self.obstacles(goal, but)
            world = arms.world(around, self._node.held.boxes, clearance_m)
            with abort_on_planning_error():
                await self.move(goal, side, plan(world, side, start, end))

    async def move(
        self, goal: RunningGoal, side: str, way: list[Reach], velocity_rad_s: float = 0.0
    ) -> None:
        """
        Move an arm and the waist along a path.

        Parameters
        ----------
        goal, side, way
            The goal, the side of the arm, and the waypoints of the path.
        velocity_rad_s
            The joint velocity limit; 0 selects the parameter `max_velocity`.

        Raises
        ------
        GoalAborted
            The arm runs into something, or its controller aborts the motion.

        """
        speed = velocity_rad_s or self._node.parameters.current.max_velocity
        await self._node.arms.move(goal, side, timed(way, speed))


@contextmanager
def abort_on_planning_error() -> Iterator[None]:
    """Convert planning errors to `GoalAborted` with the matching result code."""
    try:
        yield
    except OutOfReachError as error:
        raise GoalAborted('NOT_REACHABLE', str(error)) from None
    except BlockedError as error:
        raise GoalAborted('BLOCKED', str(error)) from None
    except ManipulationError as error:
        raise GoalAborted('ARM_FAILED', str(error)) from None
