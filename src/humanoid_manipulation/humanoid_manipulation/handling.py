# SPDX-License-Identifier: Apache-2.0
"""Common parts of pick, place, hand-over and drop: walking, bending and moving a hand."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
import math
from typing import Any, TYPE_CHECKING

from humanoid_common.single_goal import GoalAborted, GoalCanceled, RunningGoal
from humanoid_control.dynamics.frames import Frame
from humanoid_description.drives import SIDES
from humanoid_description.robot import Array
from humanoid_manipulation.arm_world import Obstacle
from humanoid_manipulation.arms import Arms
from humanoid_manipulation.errors import ManipulationError
from humanoid_manipulation.grasps import Grasp
from humanoid_manipulation.held_things import carrying, HANGING, Held, SOMETHING
from humanoid_manipulation.motion_planning import approach, BlockedError, plan, timed
from humanoid_manipulation.stances import (
    base_of,
    Bend,
    BENDS,
    effort,
    grasp_reaches,
    Stance,
)
from humanoid_manipulation.upper_body import OutOfReachError, Reach
import numpy as np

if TYPE_CHECKING:
    from humanoid_manipulation.manipulator import Manipulator

__all__ = ['LEAST_SHARE', 'Handling', 'unsound_side']

TUCKED = {
    'left': Reach(0.0, (0.75, 0.2, 0.0, -2.1, 0.0, 0.0)),
    'right': Reach(0.0, (0.75, -0.2, 0.0, -2.1, 0.0, 0.0)),
}
"""Arm postures for stepping up to furniture and bending: elbows back, nothing ahead."""
TURNS_RAD = (0.0, 0.15, -0.15, 0.3, -0.3, 0.45, -0.45)
"""The waist angles that are tried."""
_BACK_M = 0.35
"""How far the robot steps back after it picked or placed an object."""
_BESIDE_M, _BESIDE_RAD = 0.25, 0.4
"""Largest distance and turn to the stance for which the robot steps there directly."""
_NEAR_M = 1.5
"""Largest distance to `Stance.before` for which it steps there if the way is clear; otherwise it
navigates."""
_THERE_RAD = 0.05
_SLOW_RAD_S = 0.5
_APPROACHES, _EXACT_M = 3, 0.004
"""Attempts to bring a hand to its grasp, and the position error at which they end."""
_SHARES = (1.0, 0.75, 0.5, 0.25)
LEAST_SHARE = 0.5
"""Smallest gap of a closed gripper that holds an object, as a fraction of the object's width."""
GRIP_N = 25.0
_OPENS_M, _WIDEST_M = 0.03, 0.10
"""How much wider than an object the gripper opens to release it, and its largest gap."""
_THIN_M, _HOLDING_N = 0.008, 3.0
"""A hand that stays open by this gap while it closes with this force holds something."""
_OTHER_M = 0.025
"""Change of the gap between the fingers from which an object counts as no longer held."""
_SOMETHING_M = (0.07, 0.07, 0.15)
"""The assumed size of an unknown held object."""
_OTHERWISE = ('WALK_FAILED', 'NOT_REACHABLE', 'BLOCKED', 'SLIPPED')
"""Errors after which another stance is tried."""


class Handling:
    """
    Base class of the actions that manipulate objects: walking, bending and moving a hand.

    Parameters
    ----------
    node
        The node, with its arms and its surroundings.
    feedback
        The feedback message type of the action, with a field `state`.

    """

    def __init__(self, node: Manipulator, feedback: Any) -> None:
        self.node, self._feedback = node, feedback

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

        A hand that closes with a force but stays open holds something, whichever node closed it;
        a hand whose fingers have moved since it grasped its object no longer holds it.

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
        node = self.node
        await node.arms.wait(goal)
        for side in HANGING:
            gap_m, force_n = node.arms.grip_of(side)
            held = node.held.get(side)
            if held is None and gap_m > _THIN_M and force_n < -_HOLDING_N:
                node.held[side] = _something(node.arms, side, gap_m)
            elif held is not None and abs(gap_m - held.width_m) > _OTHER_M:
                del node.held[side]

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
        for side, held in self.node.held.items():
            if asked in ('', side):
                return side, held
        raise GoalAborted('EMPTY_HAND', 'I hold nothing.')

    @property
    def base(self) -> Frame:
        """Return the pose of the pelvis in the map."""
        node = self.node
        base_frame = node.parameters.current.base_frame
        pose = node.transforms.pose(node.surroundings.frame, base_frame)
        return Frame(pose[:3, 3], pose[:3, :3])

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
        own = {*but, *(each.box.name for each in self.node.held.values())}
        found = await self.node.surroundings.obstacles(goal, wider_m, exact)
        return [each for each in found if each.name not in own]

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
        node = self.node
        for sole in node.feet.soles:
            await node.transforms.known(goal, node.surroundings.frame, sole)
        return node.feet.place(node.surroundings.frame)

    async def stand(self, goal: RunningGoal, stance: Stance) -> None:
        """
        Walk to a stance, unless the robot stands there already.

        Navigation takes the robot over long distances, to a point where it can still turn. It
        steps the last half metre by itself, exactly and with the elbows back.

        Parameters
        ----------
        goal, stance
            The goal, and where to stand, in the map.

        Raises
        ------
        GoalAborted
            The robot does not get there, or there is no collision-free path for its arms.

        """
        self.tell(goal, 'walking')
        node, feet, frame = self.node, self.node.feet, self.node.surroundings.frame
        x_m, y_m, yaw_rad = await self.place_of_feet(goal)
        at, before = (stance.x_m, stance.y_m, stance.yaw_rad), stance.before
        turned_rad = abs(math.remainder(stance.yaw_rad - yaw_rad, math.tau))
        if math.dist((x_m, y_m), at[:2]) > _BESIDE_M or turned_rad > _BESIDE_RAD:
            await self.bring_arms(goal, self.at_ease())
            # Navigation is for long distances: it turns in wide curves, and ends roughly there.
            is_near = math.dist((x_m, y_m), before[:2]) < _NEAR_M
            if is_near and node.surroundings.floor.is_clear_way((x_m, y_m), before[:2]):
                await feet.step_to(goal, frame, before)
            else:
                await feet.go(goal, frame, before)
        free = {side: end for side, end in TUCKED.items() if side not in node.held}
        await self.bring_arms(goal, free)
        try:
            await feet.step_to(goal, frame, at)
        except GoalAborted as error:
            # Navigation does not start this near to furniture.
            if error.name == 'WALK_FAILED':
                await self.step_back(goal)
                await self.bring_arms(goal, self.at_ease())
            raise

    async def step_back(self, goal: RunningGoal) -> None:
        """
        Step back by 0.35 m after a pick, a place, or a failed approach.

        Parameters
        ----------
        goal
            The goal.

        Raises
        ------
        GoalAborted
            The robot does not get there, or the transform of a sole is not available.
        GoalCanceled
            The goal is canceled.

        """
        x_m, y_m, yaw_rad = await self.place_of_feet(goal)
        back = (x_m - _BACK_M * math.cos(yaw_rad), y_m - _BACK_M * math.sin(yaw_rad), yaw_rad)
        await self.node.feet.step_to(goal, self.node.surroundings.frame, back)

    def at_ease(self) -> dict[str, Reach]:
        """Return the arm postures for walking, by side: hanging, or carrying an object."""
        body, held = self.node.arms.body, self.node.held
        return {
            side: carrying(body, side, held[side]) if side in held else hanging
            for side, hanging in HANGING.items()
        }

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
        arms = self.node.arms
        for side, end in ends.items():
            start = arms.reach_of(side)
            if max(abs(a - b) for a, b in zip(start.posture, end.posture)) < _THERE_RAD:
                continue
            clearance_m = self.node.parameters.current.clearance
            around = await self.obstacles(goal, but)
            world = arms.world(around, self.node.held.boxes, clearance_m)
            with self.failing():
                await self.move(goal, side, plan(world, side, start, end))

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
        node, trouble = self.node, GoalAborted('NOT_REACHABLE', 'There is nowhere to stand.')
        for stance in stances:
            held = node.held.get(stance.side)
            has_begun = False
            try:
                await self.stand(goal, stance)
                has_begun = True
                await work(stance)
                return
            except GoalAborted as error:
                if error.name not in _OTHERWISE or node.held.get(stance.side) is not held:
                    raise
                trouble = error
                node.get_logger().info(f'I try another way: {error}')
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
        node, body, grasps = self.node, self.node.arms.body, list(grasps)
        around = await self.obstacles(goal, (), node.parameters.current.clearance, but)
        now = self.base
        held = node.held.boxes
        best: tuple[float, Grasp, Bend] | None = None
        trouble = GoalAborted('NOT_REACHABLE', f'I do not get to {where} from here.')
        for bend in bends:
            base = base_of(*place, bend)
            world = node.arms.world([_moved(each, now, base) for each in around], held, 0.0)
            anyway = {each.names for each in world.contacts(side, node.arms.reach_of(side))}
            for grasp in grasps:
                reached = grasp_reaches(body, side, grasp, base, turns=TURNS_RAD)
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
                    text = f'The {side} arm cannot get to {where}: {touched[0]}.'
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
        arms = self.node.arms
        start = arms.reach_of(side)
        reached = grasp_reaches(arms.body, side, grasp, self.base, start, TURNS_RAD)
        if reached is None:
            raise GoalAborted('NOT_REACHABLE', f'I do not get to {name} from here.')
        await self.bring_arms(goal, {side: reached[0]})

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
        arms = self.node.arms
        around = await self.obstacles(goal, (), self.node.parameters.current.clearance, but)
        for number in range(_APPROACHES):
            now = arms.reach_of(side)
            here = arms.body.forward(side, now).position_m
            there = grasp.gripper.seen_from(self.base).position_m
            if np.linalg.norm(there - here) < _EXACT_M:
                return
            try:
                with self.failing():
                    way = approach(arms.body, side, now, there - here)
                    self._check_clear(side, way, around, but)
            except GoalAborted:
                if number == 0:
                    raise
                return
            await self.move(goal, side, way, _SLOW_RAD_S)

    def _check_clear(
        self, side: str, way: list[Reach], around: Sequence[Obstacle], but: str
    ) -> None:
        """Raise `BlockedError` if an arm would collide on a path, except with one obstacle."""
        world = self.node.arms.world(around, self.node.held.boxes, 0.0)
        for reach in way:
            for contact in world.contacts(side, reach):
                if but not in contact.names:
                    raise BlockedError(f'The {side} arm cannot go there: {contact}.')

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
        arms = self.node.arms
        step_m = self.base.rotation.T @ step_m
        for share in _SHARES:
            try:
                way = approach(arms.body, side, arms.reach_of(side), share * step_m, waist)
            except OutOfReachError:
                continue
            await self.move(goal, side, way, _SLOW_RAD_S)
            return

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
            await self.node.feet.bend(goal, BENDS[0])
            await self.step_back(goal)
            await self.bring_arms(goal, self.at_ease(), but)
        except GoalAborted as error:
            if error.name not in _OTHERWISE:
                raise
            self.node.get_logger().info(f'I do not get back to where I stand at ease: {error}')

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
        closed = await self.node.arms.grip(goal, side, 0.0, GRIP_N)
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
        gap_m = _WIDEST_M if wide else min(self.node.held[side].width_m + _OPENS_M, _WIDEST_M)
        await self.node.arms.grip(goal, side, gap_m)
        del self.node.held[side]

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
        speed = velocity_rad_s or self.node.parameters.current.max_velocity
        await self.node.arms.move(goal, side, timed(way, speed))

    @contextmanager
    def failing(self) -> Iterator[None]:
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


def _something(arms: Arms, side: str, gap_m: float) -> Held:
    """Create the held object for a grasp that this node did not perform."""
    gripper = arms.body.forward(side, arms.reach_of(side)).rotation
    box = Obstacle(SOMETHING, Frame(np.zeros(3), gripper.T), _SOMETHING_M)
    return Held(SOMETHING, (SOMETHING,), box, gap_m, gripper, 0.5 * _SOMETHING_M[2])


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
    return f"There is no side '{side}'. Give left, right, or nothing for the one that fits."
