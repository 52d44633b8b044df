# SPDX-License-Identifier: Apache-2.0
"""Take a thing into a hand: the work of `pick`."""

from __future__ import annotations

from collections.abc import Sequence
import math
from typing import Any, TYPE_CHECKING

from control_msgs.action import PointHead
from humanoid_common.single_goal import GoalAborted, RunningGoal
from humanoid_control.dynamics.frames import Frame
from humanoid_control.dynamics.rotations import about_z
from humanoid_interfaces.action import Pick
from humanoid_manipulation.arm_world import Obstacle
from humanoid_manipulation.grasps import Grasp, grasps_of
from humanoid_manipulation.handling import CARRYING, Handling, Held
from humanoid_manipulation.stances import Stance, stances_for
from humanoid_manipulation.surroundings import Remembered
import numpy as np
from rclpy.action import ActionClient

if TYPE_CHECKING:
    from humanoid_manipulation.manipulator import Manipulator

__all__ = ['Picking']

_ATTEMPTS, _STANCES = 3, 3
_LIFT_M = 0.08
_LOOK_S = 1.5
"""How long a thing is looked at before it is taken."""
_OTHERWISE = ('WALK_FAILED', 'NOT_REACHABLE', 'BLOCKED', 'SLIPPED')
"""What may go better from elsewhere, or with another grasp."""


class Picking(Handling):
    """
    The work of `pick`.

    Parameters
    ----------
    node
        The node, with its arms and its surroundings.

    """

    def __init__(self, node: Manipulator) -> None:
        super().__init__(node, Pick.Feedback)
        self._look = ActionClient(node, PointHead, 'look_at')

    def unsound(self, request: Any) -> str:
        """Return why a goal makes no sense; nothing if it does."""
        if not request.object:
            return 'It names no object. Give the id of a remembered thing, or a class such as mug.'
        return self.node.unsound_side(request.side)

    async def work(self, goal: RunningGoal) -> None:
        """Take a thing; the result says which one, and with which hand."""
        node = self.node
        with node.transforms.listening(), node.arms.listening():
            await node.arms.wait(goal)
            thing = self._thing(goal.request.object)
            goal.result.object = thing.object_id
            sides = self._free_sides(goal.request.side)
            place = await self.place_of_feet(goal)
            trouble: GoalAborted | None = None
            for stance in self._stances(thing, sides, place[:2]):
                try:
                    await self.stand(goal, stance)
                    await self._take(goal, thing.object_id, stance.side)
                    goal.result.side = stance.side
                    return
                except GoalAborted as error:
                    if error.name not in _OTHERWISE:
                        raise
                    trouble = error
                finally:
                    node.feet.straighten()
            assert trouble is not None
            raise trouble

    def _thing(self, asked: str) -> Remembered:
        """Return the remembered thing that is meant."""
        found = self.node.surroundings.things(asked)
        if not found:
            raise GoalAborted('NOT_SEEN', f"I remember nothing that is '{asked}'.")
        return found[0]

    def _free_sides(self, asked: str) -> tuple[str, ...]:
        """Return the hands that hold nothing."""
        held = self.node.held
        sides = tuple(
            side for side in self.node.arms.body.arms if asked in ('', side) and side not in held
        )
        if not sides:
            names = ' and '.join(each.object_id for each in held.values())
            raise GoalAborted('OCCUPIED_HAND', f'The hand holds {names} already.')
        return sides

    def _stances(
        self, thing: Remembered, sides: Sequence[str], near_m: tuple[float, float]
    ) -> list[Stance]:
        """Return where to stand."""
        grasps = list(grasps_of(thing.graspable))
        if not grasps:
            raise GoalAborted('NOT_REACHABLE', f'{thing.object_id} is too wide for my hand.')
        found = stances_for(
            self.node.arms.body,
            grasps,
            thing.graspable.position_m,
            self.node.surroundings.places,
            near_m,
            sides,
        )
        if not found:
            raise GoalAborted(
                'NOT_REACHABLE', f'I get to {thing.object_id} from nowhere that I could stand.'
            )
        return found[:_STANCES]

    async def _take(self, goal: RunningGoal, object_id: str, side: str) -> None:
        """Take a thing from where the robot stands; another grasp is tried twice."""
        tried: list[Grasp] = []
        trouble: GoalAborted | None = None
        for _ in range(_ATTEMPTS):
            thing = await self._look_at(goal, object_id)
            try:
                await self._grasp(goal, thing, side, tried)
                return
            except GoalAborted as error:
                if error.name not in ('BLOCKED', 'SLIPPED'):
                    raise trouble or error from None
                trouble = error
        assert trouble is not None
        raise trouble

    async def _look_at(self, goal: RunningGoal, object_id: str) -> Remembered:
        """Look at a thing, and return what is known of it then."""
        self.tell(goal, 'looking')
        thing = self._thing(object_id)
        if self._look.server_is_ready():
            wanted = PointHead.Goal()
            wanted.target.header.frame_id = self.node.surroundings.frame
            at = wanted.target.point
            at.x, at.y, at.z = thing.graspable.position_m.tolist()
            self._look.send_goal_async(wanted)
            for _ in range(round(_LOOK_S * 20.0)):
                await goal.tick()
        return self._thing(object_id)

    async def _grasp(
        self, goal: RunningGoal, thing: Remembered, side: str, tried: list[Grasp]
    ) -> None:
        """Bend, reach, close, lift and carry."""
        node, arms = self.node, self.node.arms
        grasps = [
            each
            for each in grasps_of(thing.graspable)
            if not any(_is_like(each, other) for other in tried)
        ]
        chosen = self.choose(grasps, side, await self.place_of_feet(goal))
        if chosen is None:
            raise GoalAborted('NOT_REACHABLE', f'I do not get to {thing.object_id} from here.')
        grasp, bend = chosen
        tried.append(grasp)
        self.tell(goal, 'bending')
        await node.feet.bend(goal, bend)
        world = arms.world(
            await node.surroundings.obstacles(goal), {}, node.parameters.current.clearance
        )
        self.tell(goal, 'reaching')
        await arms.grip(goal, side, grasp.gap_m)
        await self.go_before(goal, side, grasp, world, thing.object_id)
        await self.go_to(goal, side, grasp, world, thing.name)
        self.tell(goal, 'closing')
        gap_m = await self.check_held(goal, side, grasp.width_m)
        if gap_m < 0.0:
            await arms.grip(goal, side, grasp.gap_m)
            await self.shift(goal, side, grasp.approach_m)
            raise GoalAborted('SLIPPED', f'{thing.object_id} is not between my fingers.')
        held = node.held[side] = _held(thing, grasp, gap_m)
        await self._carry(goal, side, held, thing.name)

    async def _carry(self, goal: RunningGoal, side: str, held: Held, name: str) -> None:
        """Lift what is held, come up, and hold it before the body."""
        self.tell(goal, 'lifting')
        await self.shift(goal, side, np.array([0.0, 0.0, _LIFT_M]), waist=True)
        await self._still_held(goal, side, held)
        self.tell(goal, 'carrying')
        await self.rest(goal, side, CARRYING[side], held.box, (name,))
        await self._still_held(goal, side, held)

    async def _still_held(self, goal: RunningGoal, side: str, held: Held) -> None:
        """Abort if a thing is no longer in the hand."""
        if await self.check_held(goal, side, held.width_m) < 0.0:
            del self.node.held[side]
            raise GoalAborted('SLIPPED', f'{held.object_id} has slipped out of my hand.')


def _held(thing: Remembered, grasp: Grasp, gap_m: float) -> Held:
    """Return a thing that has just been taken."""
    box = Frame(thing.graspable.position_m, thing.rotation).seen_from(grasp.gripper)
    length, width, height = thing.graspable.size_m.tolist()
    back = grasp.gripper.rotation[:, 2]
    heading_rad = math.atan2(-back[1], -back[0])
    return Held(
        thing.object_id,
        Obstacle(thing.name, box, (length, width, height)),
        gap_m,
        about_z(-heading_rad) @ grasp.gripper.rotation,
        float(grasp.gripper.position_m[2]) - thing.graspable.bottom_m,
    )


def _is_like(one: Grasp, other: Grasp) -> bool:
    """Return whether two grasps come from about the same direction."""
    return float(one.gripper.rotation[:, 2] @ other.gripper.rotation[:, 2]) > 0.9
