# SPDX-License-Identifier: Apache-2.0
"""Move the arms clear of obstacles: from posture to posture, to a grasp, and away from it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager

from humanoid_common.single_goal import GoalAborted, RunningGoal
from humanoid_control.dynamics.frames import Frame
from humanoid_description.robot import Array
from humanoid_manipulation.arm_trajectory import timed
from humanoid_manipulation.errors import ManipulationError
from humanoid_manipulation.grasps import Grasp
from humanoid_manipulation.held_things import carrying, HANGING
from humanoid_manipulation.manipulation_node import ManipulationNode
from humanoid_manipulation.motion_planning import approach, BlockedError, plan
from humanoid_manipulation.obstacle import Obstacle
from humanoid_manipulation.stances import base_of, Bend, BENDS, effort, grasp_reaches
from humanoid_manipulation.upper_body import OutOfReachError, Reach
import numpy as np

__all__ = ['ArmMotions', 'Reaching', 'abort_on_planning_error']

_THERE_RAD = 0.05
"""An arm whose joints are this near to a posture is not moved there."""
_TURNS_RAD = (0.0, 0.15, -0.15, 0.3, -0.3, 0.45, -0.45)
"""The waist angles that are tried."""
_SLOW_RAD_S = 0.5
_APPROACHES, _EXACT_M = 3, 0.004
"""Attempts to bring a hand to its grasp, and the position error at which they end."""
_SHARES = (1.0, 0.75, 0.5, 0.25)
"""The parts of a displacement that are tried, until one is within reach."""


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


class Reaching:
    """
    Cartesian motions of a hand, to a grasp and away from it.

    Parameters
    ----------
    node
        The node, with its arms and its surroundings.
    motions
        Moves the arms.

    """

    def __init__(self, node: ManipulationNode, motions: ArmMotions) -> None:
        self._node, self._motions = node, motions

    async def choose(
        self,
        goal: RunningGoal,
        grasps: Iterable[Grasp],
        side: str,
        place: tuple[float, float, float],
        where: str,
        but: str,
        bends: Iterable[Bend] = BENDS,
    ) -> tuple[Grasp, Bend]:
        """
        Choose the grasp and the bend with the lowest cost from where the robot stands.

        Parameters
        ----------
        goal
            The goal.
        grasps, side
            The candidate grasps in the map, and the side of the hand.
        place
            Where the robot stands: see `Feet.place`.
        where
            The name of the target in messages.
        but
            The name of the obstacle that the arm may touch.
        bends
            The candidate bends.

        Raises
        ------
        GoalAborted
            The hand reaches none of the grasps, or the arm would collide there.

        """
        node, body, grasps = self._node, self._node.arms.body, list(grasps)
        around = await self._motions.obstacles(goal, (), node.parameters.current.clearance, but)
        now = self._base
        held = node.held.boxes
        best: tuple[float, Grasp, Bend] | None = None
        trouble = GoalAborted('NOT_REACHABLE', f'I cannot reach {where} from here.')
        for bend in bends:
            base = base_of(*place, bend)
            world = node.arms.world([_moved(each, now, base) for each in around], held, 0.0)
            anyway = {each.names for each in world.contacts(side, node.arms.reach_of(side))}
            for grasp in grasps:
                reached = grasp_reaches(body, side, grasp, base, turns=_TURNS_RAD)
                if reached is None:
                    continue
                cost = effort(body, grasp, reached, side, bend)
                if best is not None and cost >= best[0]:
                    continue
                touched = [
                    contact
                    for reach in reached
                    for contact in world.contacts(side, reach)
                    if contact.names not in anyway and but not in contact.names
                ]
                if touched:
                    text = f'The {side} arm cannot reach {where}: {touched[0]}.'
                    trouble = GoalAborted('BLOCKED', text)
                else:
                    best = cost, grasp, bend
        if best is None:
            raise trouble
        return best[1:]

    async def go_before(self, goal: RunningGoal, side: str, grasp: Grasp, name: str) -> None:
        """
        Move a hand to the pre-grasp pose on a collision-free path.

        Parameters
        ----------
        goal, side, grasp
            The goal, the side of the hand, and the grasp in the map.
        name
            The name of the target in messages.

        Raises
        ------
        GoalAborted
            The grasp is out of reach, or there is no collision-free path.

        """
        arms = self._node.arms
        start = arms.reach_of(side)
        reached = grasp_reaches(arms.body, side, grasp, self._base, start, _TURNS_RAD)
        if reached is None:
            raise GoalAborted('NOT_REACHABLE', f'I cannot reach {name} from here.')
        await self._motions.bring_arms(goal, {side: reached[0]})

    async def go_to(self, goal: RunningGoal, side: str, grasp: Grasp, but: str) -> None:
        """
        Move a hand from the pre-grasp pose to the grasp in a straight line.

        The body sways with the arm; the remaining position error is corrected afterwards.

        Parameters
        ----------
        goal, side, grasp
            The goal, the side of the hand, and the grasp in the map.
        but
            The name of the only obstacle that may be touched.

        Raises
        ------
        GoalAborted
            The line is blocked or out of reach, or the arm runs into something.

        """
        arms = self._node.arms
        clearance_m = self._node.parameters.current.clearance
        around = await self._motions.obstacles(goal, (), clearance_m, but)
        for number in range(_APPROACHES):
            now = arms.reach_of(side)
            here = arms.body.forward(side, now).position_m
            there = grasp.gripper.seen_from(self._base).position_m
            if np.linalg.norm(there - here) < _EXACT_M:
                return
            try:
                with abort_on_planning_error():
                    way = approach(arms.body, side, now, there - here)
                    self._check_clear(side, way, around, but)
            except GoalAborted:
                if number == 0:
                    raise
                return
            await self._motions.move(goal, side, way, _SLOW_RAD_S)

    async def shift(
        self, goal: RunningGoal, side: str, step_m: Array, waist: bool = False
    ) -> None:
        """
        Move a hand in a straight line by a displacement, or by the part of it within reach.

        Parameters
        ----------
        goal, side
            The goal, and the side of the hand.
        step_m
            The displacement (3,) in the map.
        waist
            Whether the waist may turn as well.

        """
        arms = self._node.arms
        step_m = self._base.rotation.T @ step_m
        for share in _SHARES:
            try:
                way = approach(arms.body, side, arms.reach_of(side), share * step_m, waist)
            except OutOfReachError:
                continue
            await self._motions.move(goal, side, way, _SLOW_RAD_S)
            return

    def _check_clear(
        self, side: str, way: list[Reach], around: Sequence[Obstacle], but: str
    ) -> None:
        """Raise `BlockedError` if an arm would collide on a path, except with one obstacle."""
        world = self._node.arms.world(around, self._node.held.boxes, 0.0)
        for reach in way:
            for contact in world.contacts(side, reach):
                if but not in contact.names:
                    raise BlockedError(f'The {side} arm cannot go there: {contact}.')

    @property
    def _base(self) -> Frame:
        """Return the pose of the pelvis in the map."""
        node = self._node
        base_frame = node.parameters.current.base_frame
        pose = node.transforms.pose(node.surroundings.frame, base_frame)
        return Frame(pose[:3, 3], pose[:3, :3])


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


def _moved(obstacle: Obstacle, now: Frame, then: Frame) -> Obstacle:
    """Transform an obstacle from the current pelvis frame to that of another pelvis pose."""
    at = now.position_m + now.rotation @ obstacle.middle.position_m
    middle = Frame(at, now.rotation @ obstacle.middle.rotation)
    return Obstacle(obstacle.name, middle.seen_from(then), obstacle.size_m)
