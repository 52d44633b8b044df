# SPDX-License-Identifier: Apache-2.0
"""Ways of an arm and the waist that touch nothing, and their time."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
import math

from humanoid_control.dynamics.frames import Frame
from humanoid_description.robot import Array
from humanoid_manipulation.arm_world import ArmWorld
from humanoid_manipulation.errors import ManipulationError
from humanoid_manipulation.upper_body import OutOfReachError, Reach, UpperBody
import numpy as np

__all__ = ['BlockedError', 'Motion', 'approach', 'plan', 'timed']

_STEP_RAD = 0.0125
"""So far apart are the postures that are looked at on a way: 8 mm at the fingers."""
_DEEPER_M, _NEARER_M = 0.002, 0.002
"""How much deeper, or nearer, than at the ends of a way an arm may come to something."""
_STRIDE_RAD = 0.4
"""How far a tree grows at once."""
_MOST_STRIDES = 2000
_SHORTCUTS = 80
_APPROACH_STEP_M = 0.005
_MOST_JUMP_RAD = 0.3
"""A joint that turns farther in such a step has changed over to another posture."""
_PERIOD_S = 0.05
"""Between the points of a motion."""
_SMOOTHING_S = 0.5
"""Over so long a time a motion is a mean, so that it starts, ends and turns corners gently."""


class BlockedError(ManipulationError):
    """Something is in the way; the text says what."""


@dataclass(frozen=True, eq=False)
class Motion:
    """
    A way in time, of the waist and the six joints of an arm.

    Attributes
    ----------
    times_s
        Of the n points (n,), from 0 on.
    positions_rad, velocities_rad_s
        Of the joints at each of them (n, 7), the waist first.

    """

    times_s: Array
    positions_rad: Array
    velocities_rad_s: Array

    @property
    def duration_s(self) -> float:
        """Return how long it takes."""
        return float(self.times_s[-1])


def plan(
    world: ArmWorld,
    side: str,
    start: Reach,
    goal: Reach,
    but: Collection[frozenset[str]] = (),
    seed: int = 0,
) -> list[Reach]:
    """
    Return a way on which an arm touches nothing.

    The straight way between the postures is taken if it is free. Otherwise two trees grow towards
    each other (J. Kuffner and S. LaValle, "RRT-Connect: An efficient approach to single-query path
    planning", ICRA 2000), and what they find is shortened by chance.

    Parameters
    ----------
    world
        What is to be kept clear of.
    side
        Which arm moves.
    start, goal
        Where it is, and where it is to be. What it touches at the start, it may touch on the way,
        but no more deeply; what it comes too near to at the goal without touching it, it may come
        so near to.
    but
        Pairs of names that may touch each other.
    seed
        Of the chance: the same one gives the same way.

    Returns
    -------
    list of Reach
        The corners of the way, from the start to the goal; between them all joints move evenly.

    Raises
    ------
    BlockedError
        The arm touches something at the goal, or no way was found.

    """
    allowed = dict.fromkeys(but, -math.inf)
    for contact in world.contacts(side, start):
        least_m = min(allowed.get(contact.names, math.inf), contact.distance_m - _DEEPER_M)
        allowed[contact.names] = least_m
    for contact in world.contacts(side, goal):
        if contact.distance_m < min(0.0, allowed.get(contact.names, 0.0)):
            raise BlockedError(f'The {side} arm cannot be there: {contact}.')
        least_m = allowed.get(contact.names, math.inf)
        allowed[contact.names] = min(least_m, contact.distance_m - _NEARER_M)
    search = _Search(world, side, allowed, np.random.default_rng(seed))
    way = search.way(_array(start), _array(goal))
    if way is None:
        raise BlockedError(f'No free way was found for the {side} arm.')
    return [Reach(each[0], tuple(each[1:])) for each in np.array(way).tolist()]


def approach(
    body: UpperBody, side: str, start: Reach, step_m: Array, waist: bool = False
) -> list[Reach]:
    """
    Return the way of a gripper along a straight line, without turning.

    Parameters
    ----------
    body
        The upper body.
    side
        Which arm moves.
    start
        Where it is.
    step_m
        How far the gripper moves (3,), in the pelvis.
    waist
        Whether the waist may help.

    Returns
    -------
    list of Reach
        Postures 5 mm from each other, from the start on.

    Raises
    ------
    OutOfReachError
        The line leaves the reach of the arm, or would have to change over to another posture.

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
                f'{arm.joints[0]} and others would have to swing round.',
                last,
                body.forward(side, last),
            )
        way.append(found)
    return way


def timed(way: list[Reach], velocity_rad_s: float) -> Motion:
    """
    Return a way in time: at a speed, and gently at its ends and corners.

    The way is gone through evenly, and then each point becomes the mean of those around it, with
    the weights of a Hann window; so no joint gets faster than the speed, none accelerates by more
    than four times the speed over the window's length, and corners are rounded.

    Parameters
    ----------
    way
        The corners.
    velocity_rad_s
        The greatest velocity of a joint.

    """
    corners = np.array([_array(each) for each in way])
    lengths = np.abs(np.diff(corners, axis=0)).max(axis=1, initial=0.0)
    ends_s = np.concatenate(([0.0], np.cumsum(lengths / velocity_rad_s)))
    fine_s = _PERIOD_S / 10.0
    window = np.hanning(round(_SMOOTHING_S / fine_s) + 2)[1:-1]
    window /= window.sum()
    padding = len(window) // 2
    even_s = np.arange(math.ceil(ends_s[-1] / fine_s) + 1) * fine_s
    even = np.stack([np.interp(even_s, ends_s, column) for column in corners.T], axis=1)
    padded = np.concatenate(
        (np.repeat(even[:1], 2 * padding, 0), even, np.repeat(even[-1:], 2 * padding + 10, 0))
    )
    smooth = np.stack([np.convolve(column, window, 'valid') for column in padded.T], axis=1)
    positions = smooth[::10]
    positions[0], positions[-1] = corners[0], corners[-1]
    velocities = np.gradient(positions, _PERIOD_S, axis=0) if len(positions) > 1 else positions * 0
    velocities[0] = velocities[-1] = 0.0
    times_s = np.arange(len(positions), dtype=np.float64) * _PERIOD_S
    return Motion(times_s, positions, velocities)


class _Search:
    """Looks for a way through the seven joints of an arm and the waist."""

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
        """Return the corners of a free way; None if none was found."""
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
        """Let a tree grow a stride towards a posture; return the place of the new leaf."""
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
        """Let a tree grow up to a posture; return the place of the leaf that is there."""
        while True:
            place = self._grow(tree, wanted)
            if place is None or np.array_equal(tree[place][0], wanted):
                return place

    def _shortened(self, way: list[Array]) -> list[Array]:
        """Leave out what is not needed."""
        for _ in range(_SHORTCUTS):
            if len(way) < 3:
                break
            first, last = sorted(self._random.choice(len(way), 2, replace=False).tolist())
            if last - first > 1 and self._is_free_between(way[first], way[last]):
                way = [*way[: first + 1], *way[last:]]
        return way

    def _is_free_between(self, one: Array, other: Array) -> bool:
        """Return whether the straight way between two postures is free, its end included."""
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


def _array(reach: Reach) -> Array:
    """Return the joints of a reach (7,), the waist first."""
    return np.array([reach.waist_rad, *reach.posture])
