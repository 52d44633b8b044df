# SPDX-License-Identifier: Apache-2.0
"""Grasp and lift an object: the implementation of `pick`."""

from __future__ import annotations

from collections.abc import Sequence
import math
from typing import Any

from control_msgs.action import PointHead
from humanoid_common.single_goal import GoalAborted, RunningGoal
from humanoid_control.dynamics.frames import Frame
from humanoid_description.rotations import about_z
from humanoid_interfaces.action import Pick
from humanoid_manipulation.grasps import Grasp, grasps_of
from humanoid_manipulation.handling import ManipulationAction, unsound_side
from humanoid_manipulation.held_things import Held
from humanoid_manipulation.manipulation_node import ManipulationNode
from humanoid_manipulation.obstacle import Obstacle
from humanoid_manipulation.stances import LIFT_M, Stance, stances_for
from humanoid_manipulation.surroundings import Remembered
from rclpy.action import ActionClient

__all__ = ['Picking', 'held_by']

_ATTEMPTS, _STANCES = 3, 3
_TURN_S, _LOOK_S = 0.7, 3.0
"""How long the head turns towards an object, and the longest time that it is observed then."""
_LOOKS = 5
"""Number of detections that suffice to correct its position."""


class Picking(ManipulationAction):
    """
    Implementation of the action `pick`.

    Parameters
    ----------
    node
        The node, with its arms and its surroundings.

    """

    def __init__(self, node: ManipulationNode) -> None:
        super().__init__(node, Pick.Feedback)
        self._look = ActionClient(node, PointHead, 'look_at')

    def unsound(self, request: Any) -> str:
        """
        Validate a goal before it is accepted.

        Parameters
        ----------
        request
            A goal of `pick`.

        Returns
        -------
        str
            The rejection message; empty if the goal is accepted.

        """
        if not request.object:
            return 'It names no object. Give the id of a remembered one, or a class such as mug.'
        return unsound_side(request.side)

    async def work(self, goal: RunningGoal) -> None:
        """
        Walk to an object, grasp it, and lift it.

        Parameters
        ----------
        goal
            A goal of `pick`; its result is filled in with the id of the object and the side of
            the hand.

        Raises
        ------
        GoalAborted
            The object cannot be picked; the name is that of a code of `Pick`'s result.
        GoalCanceled
            The goal is canceled.

        """
        node = self.node
        with node.transforms.listening(), node.arms.listening():
            await self.begin(goal)
            self._thing(goal.request.object)  # an unknown object fails before waiting for the feet
            place = await self.positioning.place_of_feet(goal)
            thing = self._thing(goal.request.object, place[:2])
            goal.result.object = thing.object_id
            sides = self._free_sides(goal.request.side)

            async def take(stance: Stance) -> None:
                await self._take(goal, thing.object_id, stance.side)
                goal.result.side = stance.side

            await self.positioning.from_one_of(goal, self._stances(thing, sides, place[:2]), take)

    def _thing(self, asked: str, near_m: tuple[float, float] = (0.0, 0.0)) -> Remembered:
        """Find the nearest remembered object that matches an id or a class."""
        found = self.node.surroundings.things(asked)
        if not found:
            raise GoalAborted('NOT_SEEN', f"I do not remember any '{asked}'.")
        return min(
            found, key=lambda each: math.dist(near_m, each.graspable.position_m[:2].tolist())
        )

    def _free_sides(self, asked: str) -> tuple[str, ...]:
        """List the sides of the empty hands that a goal may use."""
        held = self.node.held
        sides = tuple(
            side for side in self.node.arms.body.arms if asked in ('', side) and side not in held
        )
        if not sides:
            names = ' and '.join(each.object_id for each in held.values())
            raise GoalAborted('OCCUPIED_HAND', f'The hand is already holding {names}.')
        return sides

    def _stances(
        self, thing: Remembered, sides: Sequence[str], near_m: tuple[float, float]
    ) -> list[Stance]:
        """Compute the best stances from which the object can be grasped."""
        grasps = list(grasps_of(thing.graspable))
        if not grasps:
            raise GoalAborted(
                'NOT_REACHABLE',
                f'{thing.object_id} is too wide for my hand: '
                f'{min(thing.graspable.size_m[:2].tolist()):.2f} m.',
            )
        found = stances_for(
            self.node.arms.body,
            grasps,
            thing.graspable.position_m,
            self.node.surroundings.places,
            near_m,
            sides,
            floor=self.node.surroundings.floor,
        )
        if not found:
            raise GoalAborted(
                'NOT_REACHABLE', f'I cannot reach {thing.object_id} from anywhere I can stand.'
            )
        return found[:_STANCES]

    async def _take(self, goal: RunningGoal, object_id: str, side: str) -> None:
        """Pick an object from where the robot stands, with up to three different grasps."""
        tried: list[Grasp] = []
        trouble: GoalAborted | None = None
        for _ in range(_ATTEMPTS):
            try:
                await self._grasp(goal, object_id, side, tried)
                return
            except GoalAborted as error:
                if error.name not in ('BLOCKED', 'SLIPPED') or side in self.node.held:
                    raise trouble or error from None
                trouble = error
                self.node.get_logger().info(f'Trying another grasp: {error}')
        assert trouble is not None
        raise trouble

    async def _look_at(self, goal: RunningGoal, thing: Remembered) -> Remembered:
        """
        Look at an object, and return it at the position where it is detected now.

        The remembered position includes the localisation error of the time when it was seen.
        """
        self.tell(goal, 'looking')
        surroundings = self.node.surroundings
        wanted = PointHead.Goal()
        wanted.target.header.frame_id = surroundings.frame
        at = wanted.target.point
        at.x, at.y, at.z = thing.graspable.position_m.tolist()
        if self._look.server_is_ready():
            self._look.send_goal_async(wanted)
            for _ in range(round(_TURN_S * 20.0)):
                await goal.tick()
        with surroundings.watching():
            for _ in range(round(_LOOK_S * 20.0)):
                await goal.tick()
                if len(surroundings.seen(thing)) >= _LOOKS:
                    break
        return surroundings.corrected(self._thing(thing.object_id))

    async def _grasp(
        self, goal: RunningGoal, object_id: str, side: str, tried: list[Grasp]
    ) -> None:
        """Bend, look, reach, close the hand, lift and carry."""
        node = self.node
        thing = self._thing(object_id)
        feet = await self.positioning.place_of_feet(goal)
        name = thing.name
        _, bend = await self.reaching.choose(goal, _untried(thing, tried), side, feet, name, name)
        self.tell(goal, 'bending')
        await node.feet.bend(goal, bend)
        thing = await self._look_at(goal, thing)
        grasp, _ = await self.reaching.choose(
            goal, _untried(thing, tried), side, feet, name, name, (bend,)
        )
        tried.append(grasp)
        self.tell(goal, 'reaching')
        await self.hands.grip(goal, side, grasp.gap_m)
        await self.reaching.go_before(goal, side, grasp, thing.object_id)
        await self.reaching.go_to(goal, side, grasp, name)
        self.tell(goal, 'closing')
        gap_m = await self.hands.check_held(goal, side, grasp.width_m)
        if gap_m < 0.0:
            await self.hands.grip(goal, side, grasp.gap_m)
            await self.reaching.shift(goal, side, grasp.approach_m)
            raise GoalAborted('SLIPPED', f'{thing.object_id} is not between my fingers.')
        held = node.held[side] = held_by(thing, grasp, gap_m)
        await self._carry(goal, side, held, thing.name)

    async def _carry(self, goal: RunningGoal, side: str, held: Held, name: str) -> None:
        """Lift the held object, straighten up, and hold the object in front of the body."""
        self.tell(goal, 'lifting')
        await self.reaching.shift(goal, side, LIFT_M, waist=True)
        await self._still_held(goal, side, held)
        self.tell(goal, 'carrying')
        await self.positioning.withdraw(goal, (name,))
        await self._still_held(goal, side, held)

    async def _still_held(self, goal: RunningGoal, side: str, held: Held) -> None:
        """Abort the goal if the object has slipped out of the hand."""
        if await self.hands.check_held(goal, side, held.width_m) < 0.0:
            del self.node.held[side]
            raise GoalAborted('SLIPPED', f'{held.object_id} has slipped out of my hand.')


def held_by(thing: Remembered, grasp: Grasp, gap_m: float) -> Held:
    """
    Create the held object from a remembered object and its grasp.

    Parameters
    ----------
    thing, grasp
        The object and the grasp, both in the frame of the object memory.
    gap_m
        The gap between the fingers.

    """
    box = Frame(thing.graspable.position_m, thing.rotation).seen_from(grasp.gripper)
    length, width, height = thing.graspable.size_m.tolist()
    back = grasp.gripper.rotation[:, 2]
    heading_rad = math.atan2(-back[1], -back[0])
    return Held(
        thing.object_id,
        thing.names,
        Obstacle(thing.name, box, (length, width, height)),
        gap_m,
        about_z(-heading_rad) @ grasp.gripper.rotation,
        float(grasp.gripper.position_m[2]) - thing.graspable.bottom_m,
    )


def _untried(thing: Remembered, tried: Sequence[Grasp]) -> list[Grasp]:
    """List the grasps of an object that differ from those already tried."""
    return [
        each
        for each in grasps_of(thing.graspable)
        if not any(_is_like(each, other) for other in tried)
    ]


def _is_like(one: Grasp, other: Grasp) -> bool:
    """Check whether two grasps come from about the same direction."""
    return float(one.gripper.rotation[:, 2] @ other.gripper.rotation[:, 2]) > 0.9
