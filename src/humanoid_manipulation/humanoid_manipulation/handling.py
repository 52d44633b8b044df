# SPDX-License-Identifier: Apache-2.0
"""What taking things and putting them down have in common: standing, bending, moving a hand."""

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
"""Where hands are while the robot steps up to furniture and bends: elbows back, nothing ahead."""
TURNS_RAD = (0.0, 0.15, -0.15, 0.3, -0.3, 0.45, -0.45)
"""The turns of the waist that are tried."""
_BACK_M = 0.35
"""How far the robot steps back from where it took a thing, or put it down."""
_BESIDE_M, _BESIDE_RAD = 0.25, 0.4
"""A robot that is no farther from where it is to stand steps there at once."""
_NEAR_M = 1.5
"""A robot that is no farther from before that, and has nothing in its way, steps there."""
_THERE_RAD = 0.05
_SLOW_RAD_S = 0.5
_APPROACHES, _EXACT_M = 3, 0.004
"""How often a hand is brought to where it closes, until it is that near."""
_SHARES = (1.0, 0.75, 0.5, 0.25)
LEAST_SHARE = 0.5
"""Of its width, by which the gripper must stay open if it holds the thing."""
GRIP_N = 25.0
_OPENS_M, _WIDEST_M = 0.03, 0.10
"""How much wider than a thing the gripper opens to let go of it, and how wide it can be."""
_THIN_M, _HOLDING_N = 0.008, 3.0
"""A hand that is so far open although it closes with such a force holds something."""
_OTHER_M = 0.025
"""Fingers that are so much farther or less far open than they were hold it no longer."""
_SOMETHING_M = (0.07, 0.07, 0.15)
"""The size of what a hand holds of which nobody knows what it is."""
_OTHERWISE = ('WALK_FAILED', 'NOT_REACHABLE', 'BLOCKED', 'SLIPPED')
"""What may go better from elsewhere."""


class Handling:
    """
    Stands, bends, and moves a hand, for goals that take things or put them down.

    Parameters
    ----------
    node
        The node, with its arms and its surroundings.
    feedback
        The kind of feedback, which has a state.

    """

    def __init__(self, node: Manipulator, feedback: Any) -> None:
        self.node, self._feedback = node, feedback

    def tell(self, goal: RunningGoal, state: str) -> None:
        """
        Say how far it is.

        Parameters
        ----------
        goal, state
            What it is done for, and one of the states that the action's feedback knows.

        """
        goal.publish_feedback(self._feedback(state=state))

    async def begin(self, goal: RunningGoal) -> None:
        """
        Wait until the arms can be moved, and feel what hands hold.

        A hand that is closed with a force around something holds that, whoever closed it; one
        whose fingers have moved since then holds its thing no longer.

        Parameters
        ----------
        goal
            What it is done for.

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
        Return the hand that is meant, and what it holds.

        Parameters
        ----------
        asked
            `left`, `right`, or nothing for any hand that holds something.

        Raises
        ------
        GoalAborted
            It holds nothing.

        """
        for side, held in self.node.held.items():
            if asked in ('', side):
                return side, held
        raise GoalAborted('EMPTY_HAND', 'I hold nothing.')

    @property
    def base(self) -> Frame:
        """Return where the pelvis is in the map."""
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
        Return what is near the robot, but for what it holds, which it sees as well.

        Parameters
        ----------
        goal, but
            What it is done for, and the names of what is left out.
        wider_m, exact
            See `Surroundings.obstacles`.

        """
        own = {*but, *(each.box.name for each in self.node.held.values())}
        found = await self.node.surroundings.obstacles(goal, wider_m, exact)
        return [each for each in found if each.name not in own]

    async def place_of_feet(self, goal: RunningGoal) -> tuple[float, float, float]:
        """
        Wait until it is known where the robot stands, and compute that: see `Feet.place`.

        Parameters
        ----------
        goal
            What it is done for.

        Returns
        -------
        tuple
            x and y in m, and the heading in rad, in the frame of the remembered objects.

        Raises
        ------
        GoalAborted
            The pose of a sole does not become known: NO_TRANSFORM.
        GoalCanceled
            The goal is canceled.

        """
        node = self.node
        for sole in node.feet.soles:
            await node.transforms.known(goal, node.surroundings.frame, sole)
        return node.feet.place(node.surroundings.frame)

    async def stand(self, goal: RunningGoal, stance: Stance) -> None:
        """
        Walk to a stance, unless the robot is there.

        Long ways are for navigation, up to where the robot can still turn; the last half metre it
        steps by itself, with the elbows back, and exactly.

        Parameters
        ----------
        goal, stance
            What it is done for, and where to stand, in the map.

        Raises
        ------
        GoalAborted
            The robot does not get there, or its arms have no free way.

        """
        self.tell(goal, 'walking')
        node, feet, frame = self.node, self.node.feet, self.node.surroundings.frame
        x_m, y_m, yaw_rad = await self.place_of_feet(goal)
        at, before = (stance.x_m, stance.y_m, stance.yaw_rad), stance.before
        turned_rad = abs(math.remainder(stance.yaw_rad - yaw_rad, math.tau))
        if math.dist((x_m, y_m), at[:2]) > _BESIDE_M or turned_rad > _BESIDE_RAD:
            await self.bring_arms(goal, self.at_ease())
            # Navigation is for long ways: it turns in wide curves, and ends about there.
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
            # Navigation does not begin so near to furniture.
            if error.name == 'WALK_FAILED':
                await self.step_back(goal)
                await self.bring_arms(goal, self.at_ease())
            raise

    async def step_back(self, goal: RunningGoal) -> None:
        """
        Step back by 0.35 m from where something was taken, put down, or in the way.

        Parameters
        ----------
        goal
            What it is done for.

        Raises
        ------
        GoalAborted
            The robot does not get there, or it is not known where it stands.
        GoalCanceled
            The goal is canceled.

        """
        x_m, y_m, yaw_rad = await self.place_of_feet(goal)
        back = (x_m - _BACK_M * math.cos(yaw_rad), y_m - _BACK_M * math.sin(yaw_rad), yaw_rad)
        await self.node.feet.step_to(goal, self.node.surroundings.frame, back)

    def at_ease(self) -> dict[str, Reach]:
        """Return where arms are while the robot walks about."""
        body, held = self.node.arms.body, self.node.held
        return {
            side: carrying(body, side, held[side]) if side in held else hanging
            for side, hanging in HANGING.items()
        }

    async def bring_arms(
        self, goal: RunningGoal, ends: Mapping[str, Reach], but: Sequence[str] = ()
    ) -> None:
        """
        Bring arms somewhere, free of all that is around but for some things.

        Parameters
        ----------
        goal
            What it is done for.
        ends
            Where the arms are to be, by their sides; one after the other is moved.
        but
            The names of things that they may touch.

        Raises
        ------
        GoalAborted
            There is no free way, or the arm does not get there.

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
        Walk to one stance after another until some work can be done there.

        Parameters
        ----------
        goal, stances
            What it is done for, and where; at least one.
        work
            Is given the stance.

        Raises
        ------
        GoalAborted
            It cannot be done from the last one, or from none.

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
        Return the grasp and the bend that are best from where the robot stands.

        Parameters
        ----------
        goal
            What it is done for.
        grasps, side
            The grasps in the map, and whose hand.
        place
            Where the robot stands: see `Feet.place`.
        where
            What that is called in sentences.
        but
            The name of what the arm may touch.
        bends
            Those that are considered.

        Raises
        ------
        GoalAborted
            The hand gets to none of them, or the arm would touch something there.

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
        Bring a hand before a grasp, which is in the map, on a free way.

        Parameters
        ----------
        goal, side, grasp
            What it is done for, whose hand, and the grasp.
        name
            What that is called in sentences.

        Raises
        ------
        GoalAborted
            It is out of reach, or there is no free way.

        """
        arms = self.node.arms
        start = arms.reach_of(side)
        reached = grasp_reaches(arms.body, side, grasp, self.base, start, TURNS_RAD)
        if reached is None:
            raise GoalAborted('NOT_REACHABLE', f'I do not get to {name} from here.')
        await self.bring_arms(goal, {side: reached[0]})

    async def go_to(self, goal: RunningGoal, side: str, grasp: Grasp, but: str) -> None:
        """
        Bring a hand to a grasp, straight; only one thing may be touched.

        The body sways with the arm; what the hand is off after that is made up for.

        Parameters
        ----------
        goal, side, grasp
            What it is done for, whose hand, which is before the grasp, and the grasp in the map.
        but
            The name of what may be touched.

        Raises
        ------
        GoalAborted
            Something is in the way, the arm does not reach so far, or something stops it.

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
        """Raise if an arm would touch something on its way, but for one thing."""
        world = self.node.arms.world(around, self.node.held.boxes, 0.0)
        for reach in way:
            for contact in world.contacts(side, reach):
                if but not in contact.names:
                    raise BlockedError(f'The {side} arm cannot go there: {contact}.')

    async def shift(
        self, goal: RunningGoal, side: str, step_m: Array, waist: bool = False
    ) -> None:
        """
        Move a hand straight by a step, or as much of it as it can.

        Parameters
        ----------
        goal, side
            What it is done for, and whose hand.
        step_m
            The step (3,) in the map.
        waist
            Whether the waist may turn for that.

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
        Come up, step back, and bring the arms to where they are while the robot walks.

        That is done as far as it can be: what was asked for is over by then.

        Parameters
        ----------
        goal
            What it is done for.
        but
            The names of what arms may touch meanwhile.

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
        Close a hand, and return the gap between its fingers (m).

        Parameters
        ----------
        goal, side
            What it is done for, and whose hand.
        width_m
            Of what should be between the fingers.

        Returns
        -------
        float
            -1 if the fingers have closed too far for that.

        """
        closed = await self.node.arms.grip(goal, side, 0.0, GRIP_N)
        return float(closed.position) if closed.position >= LEAST_SHARE * width_m else -1.0

    async def let_go(self, goal: RunningGoal, side: str, *, wide: bool = False) -> None:
        """
        Open a hand, which holds nothing then.

        Parameters
        ----------
        goal, side
            What it is done for, and whose hand.
        wide
            Whether it opens as wide as it can, or no more than it has to beside other things.

        """
        gap_m = _WIDEST_M if wide else min(self.node.held[side].width_m + _OPENS_M, _WIDEST_M)
        await self.node.arms.grip(goal, side, gap_m)
        del self.node.held[side]

    async def move(
        self, goal: RunningGoal, side: str, way: list[Reach], velocity_rad_s: float = 0.0
    ) -> None:
        """
        Move an arm, and the waist, along a way.

        Parameters
        ----------
        goal, side, way
            What it is done for, which arm, and the postures through which it goes.
        velocity_rad_s
            How fast joints turn at most; 0 is the parameter `max_velocity`.

        Raises
        ------
        GoalAborted
            Something stops it, or its controller does.

        """
        speed = velocity_rad_s or self.node.parameters.current.max_velocity
        await self.node.arms.move(goal, side, timed(way, speed))

    @contextmanager
    def failing(self) -> Iterator[None]:
        """Let what cannot be planned end a goal, with the code for that."""
        try:
            yield
        except OutOfReachError as error:
            raise GoalAborted('NOT_REACHABLE', str(error)) from None
        except BlockedError as error:
            raise GoalAborted('BLOCKED', str(error)) from None
        except ManipulationError as error:
            raise GoalAborted('ARM_FAILED', str(error)) from None


def _moved(obstacle: Obstacle, now: Frame, then: Frame) -> Obstacle:
    """Return what is seen from the pelvis as it will be seen from another place of it."""
    at = now.position_m + now.rotation @ obstacle.middle.position_m
    middle = Frame(at, now.rotation @ obstacle.middle.rotation)
    return Obstacle(obstacle.name, middle.seen_from(then), obstacle.size_m)


def _something(arms: Arms, side: str, gap_m: float) -> Held:
    """Return what a hand holds that was taken before this node ran, or by somebody else."""
    gripper = arms.body.forward(side, arms.reach_of(side)).rotation
    box = Obstacle(SOMETHING, Frame(np.zeros(3), gripper.T), _SOMETHING_M)
    return Held(SOMETHING, (SOMETHING,), box, gap_m, gripper, 0.5 * _SOMETHING_M[2])


def unsound_side(side: str) -> str:
    """
    Validate the side that a goal asks for.

    Parameters
    ----------
    side
        `left`, `right`, or nothing for the one that fits.

    Returns
    -------
    str
        What is wrong with it, as a sentence; empty if nothing is.

    """
    if side in ('', *SIDES):
        return ''
    return f"There is no side '{side}'. Give left, right, or nothing for the one that fits."
