# SPDX-License-Identifier: Apache-2.0
"""Motion planning for an arm and the waist: collision-free paths, and straight approaches."""

from __future__ import annotations

from collections.abc import Collection, Mapping
import math

from humanoid_control.dynamics.frames import Frame
from humanoid_description.robot import Array
from humanoid_manipulation.arm_world import ArmWorld
from humanoid_manipulation.errors import ManipulationError
from humanoid_manipulation.upper_body import OutOfReachError, Reach, UpperBody
import numpy as np

__all__ = ['BlockedError', 'approach', 'plan']

_STEP_RAD = 0.0125
"""Distance between the postures that are checked along a path: 8 mm at the fingers."""
_DEEPER_M, _NEARER_M = 0.002, 0.002
"""By how much contacts on a path may be deeper than at its start, and nearer than at its goal."""
_STRIDE_RAD = 0.4
"""Largest extension of a tree in one step."""
_MOST_STRIDES = 2000
_SHORTCUTS = 80
_APPROACH_STEP_M = 0.005
_MOST_JUMP_RAD = 0.3
"""A joint that turns farther in such a step has switched to another IK solution."""


class BlockedError(ManipulationError):
    """An obstacle blocks a posture or a path; the message names it."""


def plan(
    world: ArmWorld,
    side: str,
    start: Reach,
    goal: Reach,
    but: Collection[frozenset[str]] = (),
    seed: int = 0,
) -> list[Reach]:
    """
    Plan a collision-free path of an arm and the waist.

    The straight line in joint space is used if it is free. Otherwise two trees grow towards each
    other (J. Kuffner and S. LaValle, "RRT-Connect: An efficient approach to single-query path
    planning", ICRA 2000), and random shortcuts shorten the path that they find.

    Parameters
    ----------
    world
        The collision checker.
    side
        The side of the arm.
    start, goal
        The current and the target posture. A pair in contact at the start may stay in contact on
        the path, but no deeper; a pair that is too near at the goal without touching may come
        equally near on the path.
    but
        Pairs of names that may touch each other.
    seed
        The random seed: the same seed gives the same path.

    Returns
    -------
    list of Reach
        The waypoints of the path, from the start to the goal, with linear interpolation in joint
        space between them.

    Raises
    ------
    BlockedError
        The arm is in collision at the goal, or no path was found.

    """
    allowed = dict.fromkeys(but, -math.inf)
    for contact in world.contacts(side, start):
        least_m = min(allowed.get(contact.names, math.inf), contact.distance_m - _DEEPER_M)
        allowed[contact.names] = least_m
    for contact in world.contacts(side, goal):
        if contact.distance_m < min(0.0, allowed.get(contact.names, 0.0)):
            raise BlockedError(f'The {side} arm cannot take that pose: {contact}.')
        least_m = allowed.get(contact.names, math.inf)
        allowed[contact.names] = min(least_m, contact.distance_m - _NEARER_M)
    search = _Search(world, side, allowed, np.random.default_rng(seed))
    way = search.way(start.positions_rad, goal.positions_rad)
    if way is None:
        raise BlockedError(f'There is no collision-free path for the {side} arm.')
    return [Reach(each[0], tuple(each[1:])) for each in np.array(way).tolist()]


def approach(
    body: UpperBody, side: str, start: Reach, step_m: Array, waist: bool = False
) -> list[Reach]:
    """
    Plan a Cartesian path: move the gripper along a straight line at constant orientation.

    Parameters
    ----------
    body
        The upper body.
    side
        The side of the arm.
    start
        The current posture.
    step_m
        The displacement of the gripper (3,), in the pelvis frame.
    waist
        Whether the waist may turn as well.

    Returns
    -------
    list of Reach
        Postures at most 5 mm apart, from the start on.

    Raises
    ------
    OutOfReachError
        The line leaves the reach of the arm, or would require a switch of the IK solution.

    """
    arm, begin = body.arms[side], body.forward(side, start)
    count = max(1, math.ceil(float(np.linalg.norm(step_m)) / _APPROACH_STEP_M))
    way = [start]
    for number in range(1, count + 1):
        wanted = Frame(begin.position_m + step_m * (number / count), begin.rotation)
        last = way[-1]
        if waist:
            found = body.reach(side, wanted, last)
        else:
            found = body.reach_with_arm(side, wanted, last)
        if max(abs(a - b) for a, b in zip(found.posture, last.posture)) > _MOST_JUMP_RAD:
            raise OutOfReachError(
                f'The {side} arm cannot go straight there: '
                f'{arm.joints[0]} and others would have to swing around.',
                last,
                body.forward(side, last),
            )
        way.append(found)
    return way


class _Search:
    """RRT-Connect search in the joint space of the waist and the six joints of an arm."""

    def __init__(
        self,
        world: ArmWorld,
        side: str,
        allowed: Mapping[frozenset[str], float],
        random: np.random.Generator,
    ) -> None:
        self._world, self._side, self._allowed, self._random = world, side, allowed, random
        body = world.body
        arm = body.arms[side]
        self._lower = np.array([body.lower_rad, *arm.lower_rad])
        self._upper = np.array([body.upper_rad, *arm.upper_rad])

    def way(self, start: Array, goal: Array) -> list[Array] | None:
        """
        Search for a collision-free path with two trees, one from each end.

        Parameters
        ----------
        start, goal
            Postures of the waist and the arm (n,), in rad.

        Returns
        -------
        list or None
            The waypoints (n,) from start to goal; None if no path was found.

        """
        if self._is_free_between(start, goal):
            return [start, goal]
        trees = ([(start, -1)], [(goal, -1)])
        for _ in range(_MOST_STRIDES):
            wanted = self._random.uniform(self._lower, self._upper)
            grown, other = trees
            place = self._grow(grown, wanted)
            if place is not None:
                met = self._connect(other, grown[place][0])
                if met is not None:
                    first, second = _branch(grown, place), _branch(other, met)
                    way = [*first[::-1], *second[1:]]
                    return self._shortened(way if way[0] is start else way[::-1])
            trees = (other, grown)
        return None

    def _grow(self, tree: list[tuple[Array, int]], wanted: Array) -> int | None:
        """Extend a tree by one stride towards a posture; return the index of the new leaf."""
        nearest = int(np.argmin([float(np.abs(each - wanted).max()) for each, _ in tree]))
        leaf = tree[nearest][0]
        step = wanted - leaf
        length = float(np.abs(step).max())
        new = wanted if length <= _STRIDE_RAD else leaf + step * (_STRIDE_RAD / length)
        if not self._is_free_between(leaf, new):
            return None
        tree.append((new, nearest))
        return len(tree) - 1

    def _connect(self, tree: list[tuple[Array, int]], wanted: Array) -> int | None:
        """Extend a tree until it reaches a posture; return the index of the leaf there."""
        while True:
            place = self._grow(tree, wanted)
            if place is None or np.array_equal(tree[place][0], wanted):
                return place

    def _shortened(self, way: list[Array]) -> list[Array]:
        """Shorten a path by random shortcuts."""
        for _ in range(_SHORTCUTS):
            if len(way) < 3:
                break
            first, last = sorted(self._random.choice(len(way), 2, replace=False).tolist())
            if last - first > 1 and self._is_free_between(way[first], way[last]):
                way = [*way[: first + 1], *way[last:]]
        return way

    def _is_free_between(self, one: Array, other: Array) -> bool:
        """Check whether the straight line between two postures is free, its end included."""
        count = max(1, math.ceil(float(np.abs(other - one).max()) / _STEP_RAD))
        for number in range(count, 0, -1):
            at = (one + (other - one) * (number / count)).tolist()
            if not self._world.is_free(self._side, Reach(at[0], tuple(at[1:])), self._allowed):
                return False
        return True


def _branch(tree: list[tuple[Array, int]], place: int) -> list[Array]:
    """Return the postures from a leaf to the root of its tree."""
    branch = []
    while place >= 0:
        posture, place = tree[place]
        branch.append(posture)
    return branch
