# SPDX-License-Identifier: Apache-2.0
"""Place a held object on a surface: the implementation of `place`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
import math
from typing import Any

from humanoid_common.naming import did_you_mean
from humanoid_common.single_goal import GoalAborted, RunningGoal
from humanoid_control.dynamics.frames import Frame
from humanoid_description.robot import Array
from humanoid_description.rotations import about_z
from humanoid_interfaces.action import Place
from humanoid_manipulation.grasps import Grasp
from humanoid_manipulation.handling import ManipulationAction, unsound_side
from humanoid_manipulation.held_things import Held
from humanoid_manipulation.manipulation_node import ManipulationNode
from humanoid_manipulation.stances import Stance, stances_for
from humanoid_perception.places import Surface
import numpy as np

__all__ = ['Placing', 'free_spots']

_STANCES, _SPOTS = 3, 8
_HEADINGS = 16
_GRID_M = 0.06
_MARGIN_M = 0.04
"""Clearance of a placed object from other objects and from the edge of the surface."""
_RIM_M = 0.04
"""Height above the rim of a container at which an object is released."""
_ABOVE_M, _LOWERS_M = 0.005, 0.08
"""Height above the surface at which an object is released, and from which it is lowered to
there."""


class Placing(ManipulationAction):
    """
    Implementation of the action `place`.

    Parameters
    ----------
    node
        The node, with its arms and its surroundings.

    """

    def __init__(self, node: ManipulationNode) -> None:
        super().__init__(node, Place.Feedback)

    def unsound(self, request: Any) -> str:
        """
        Validate a goal before it is accepted.

        Parameters
        ----------
        request
            A goal of `place`.

        Returns
        -------
        str
            The rejection message; empty if the goal is accepted.

        """
        return unsound_side(request.side)

    async def work(self, goal: RunningGoal) -> None:
        """
        Walk to a surface, and place the held object there.

        Parameters
        ----------
        goal
            A goal of `place`; its result is filled in with the id of the object, the surface, and
            the position on it.

        Raises
        ------
        GoalAborted
            The object cannot be placed; the name is that of a code of `Place`'s result.
        GoalCanceled
            The goal is canceled.

        """
        node = self.node
        with node.transforms.listening(), node.arms.listening():
            await self.begin(goal)
            side, held = self.hands.holding(goal.request.side)
            goal.result.object = held.object_id
            place = await self.positioning.place_of_feet(goal)
            surface = self._surface(goal.request.place, place[:2])
            goal.result.place = surface.name
            spots = self._spots(surface, held, place[:2])
            if not spots:
                raise GoalAborted('BLOCKED', f'There is no free space on {_words(surface)}.')

            async def put(stance: Stance) -> None:
                await self._put(goal, side, held, surface, spots)

            stances = self._stances(surface, spots, side, held, place[:2])
            await self.positioning.from_one_of(goal, stances, put)

    def _surface(self, asked: str, near_m: tuple[float, float]) -> Surface:
        """Find the surface with a name, or the nearest one if the name is empty."""
        surfaces = self.node.surroundings.places.surfaces
        if not asked:
            if not surfaces:
                raise GoalAborted('INVALID', 'I know no surfaces. Set the parameter places_file.')
            return min(surfaces, key=lambda each: each.distance_m(near_m))
        wanted = asked.replace(' ', '_')
        for each in surfaces:
            if each.name == wanted:
                return each
        hint = did_you_mean(wanted, [each.name for each in surfaces])
        raise GoalAborted('INVALID', f"There is no surface named '{asked}'. {hint}".rstrip())

    def _spots(
        self, surface: Surface, held: Held, near_m: tuple[float, float]
    ) -> list[tuple[float, float]]:
        """List the spots on a surface, or above a container, where the object can be released."""
        if surface.is_container:
            return [surface.middle_m]
        return list(free_spots(surface, self._others(surface), _radius_m(held), near_m))

    def _others(self, surface: Surface) -> list[tuple[float, float, float]]:
        """List the other objects on a surface: x, y and radius of each, in the map."""
        found = []
        for each in self.node.surroundings.things():
            thing = each.graspable
            x, y = float(thing.position_m[0]), float(thing.position_m[1])
            is_own = any(each.object_id == held.object_id for held in self.node.held.values())
            if not is_own and surface.misfit_m(x, y, thing.bottom_m, 0.05) < math.inf:
                found.append((x, y, 0.5 * math.hypot(*thing.size_m[:2].tolist())))
        return found

    def _stances(
        self,
        surface: Surface,
        spots: Sequence[tuple[float, float]],
        side: str,
        held: Held,
        near_m: tuple[float, float],
    ) -> list[Stance]:
        """Compute the best stances from which the object can be placed on one of the spots."""
        found: list[Stance] = []
        for spot in spots[:_SPOTS]:
            position = _let_go(surface, spot)
            grasps = list(_ways_down(held, position))
            found += stances_for(
                self.node.arms.body,
                grasps,
                position,
                self.node.surroundings.places,
                near_m,
                (side,),
                1,
                self.node.surroundings.floor,
            )
        if not found:
            raise GoalAborted(
                'NOT_REACHABLE', f'I cannot reach {_words(surface)} from anywhere I can stand.'
            )
        return sorted(found, key=lambda stance: stance.cost)[:_STANCES]

    async def _put(
        self,
        goal: RunningGoal,
        side: str,
        held: Held,
        surface: Surface,
        spots: Sequence[tuple[float, float]],
    ) -> None:
        """Bend, reach, lower, open the hand, and withdraw."""
        node = self.node
        feet = await self.positioning.place_of_feet(goal)
        near = sorted(spots, key=lambda spot: math.dist(spot, feet[:2]))[:_SPOTS]
        grasps = [each for spot in near for each in _ways_down(held, _let_go(surface, spot))]
        grasp, bend = await self.reaching.choose(
            goal, grasps, side, feet, _words(surface), held.box.name
        )
        self.tell(goal, 'bending')
        await node.feet.bend(goal, bend)
        self.tell(goal, 'reaching')
        await self.reaching.go_before(goal, side, grasp, surface.name)
        if await self.hands.check_held(goal, side, held.width_m) < 0.0:
            del node.held[side]
            raise GoalAborted('SLIPPED', f'{held.object_id} has slipped out of my hand.')
        self.tell(goal, 'lowering')
        await self.reaching.go_to(goal, side, grasp, held.box.name)
        self.tell(goal, 'opening')
        await self.hands.let_go(goal, side, wide=surface.is_container)
        at = grasp.gripper.position_m + grasp.gripper.rotation @ held.box.middle.position_m
        position = goal.result.position
        position.x, position.y, position.z = float(at[0]), float(at[1]), surface.height_m
        away = grasp.gripper.rotation[:, 2] * 0.10
        await self.reaching.shift(goal, side, away)
        await self.positioning.withdraw(goal, (held.box.name,))


def _let_go(surface: Surface, spot: tuple[float, float]) -> Array:
    """Compute the release point (3,) of an object's underside: on a surface, or above a rim."""
    return np.array([*spot, surface.height_m + (_RIM_M if surface.is_container else 0.0)])


def free_spots(
    surface: Surface,
    others: Sequence[tuple[float, float, float]],
    radius_m: float,
    near_m: tuple[float, float],
) -> Iterator[tuple[float, float]]:
    """
    Yield free spots on a surface where an object can be placed, the nearest first.

    Parameters
    ----------
    surface, others
        The surface, and the objects on it besides its fixtures: x, y and radius of each, in m.
    radius_m
        The radius of the object to place.
    near_m
        The position of the robot: x and y in m.

    """
    xs, ys = zip(*surface.outline_m)
    spots = []
    for x in np.arange(min(xs), max(xs), _GRID_M).tolist():
        for y in np.arange(min(ys), max(ys), _GRID_M).tolist():
            if not _is_inside(surface, (x, y), radius_m + _MARGIN_M):
                continue
            away_m = [math.dist((x, y), other[:2]) - other[2] for other in others]
            away_m += [each.distance_m((x, y)) for each in surface.fixtures]
            if min(away_m, default=math.inf) > radius_m + _MARGIN_M:
                spots.append((x, y))
    yield from sorted(spots, key=lambda spot: math.dist(spot, near_m))


def _is_inside(surface: Surface, point: tuple[float, float], margin_m: float) -> bool:
    """Check whether a point is on a surface, at least a margin away from its edge."""
    around = (math.tau * number / 12 for number in range(12))
    return all(
        surface.distance_m(
            (point[0] + margin_m * math.cos(angle), point[1] + margin_m * math.sin(angle))
        )
        == 0.0
        for angle in around
    )


def _ways_down(held: Held, position_m: Array) -> Iterator[Grasp]:
    """Yield gripper poses that set the held object down on a point (3,), as upright as before."""
    above = position_m + np.array([0.0, 0.0, held.below_m + _ABOVE_M])
    for number in range(_HEADINGS):
        rotation = about_z(math.tau * number / _HEADINGS) @ held.gripper
        # The grasp may be off-centre: the centre of the object goes above the point.
        middle = rotation @ held.box.middle.position_m
        at = above - np.array([middle[0], middle[1], 0.0])
        is_down = rotation[2, 2] > 0.9
        yield Grasp(Frame(at, rotation), 0.0, held.width_m, is_down, _LOWERS_M)


def _radius_m(held: Held) -> float:
    """Compute the radius of the held object, seen from above."""
    return 0.5 * math.hypot(*held.box.size_m[:2])


def _words(surface: Surface) -> str:
    return f'the {surface.name.replace("_", " ")}'
