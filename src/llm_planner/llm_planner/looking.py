# SPDX-License-Identifier: Apache-2.0
"""Gaze skills: look at targets, look around, and search for objects."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
import math
from typing import Any

from control_msgs.action import PointHead
from humanoid_interfaces.action import ScanRoom
from llm_planner.recall import Recall
from llm_planner.robot import RobotInterface
from llm_planner.skills import SkillError, SkillRun
from llm_planner.walking import Walking
from llm_planner.wording import where_is
from llm_planner.world import base_name, in_words, listed, ObjectDescription
from llm_planner.world_watch import WorldWatch

__all__ = ['Looking']

_SEEN_FROM_M = 4.0
_LOOK_S = 2.0
_LATELY_S = 600.0
"""A room that was scanned within this time is searched after the others."""


class Looking:
    """
    Gaze and search skills that use the actions of the head.

    Parameters
    ----------
    robot, watch, recall, walking
        The interface to the robot, the observed world, the lookup of remembered objects, and the
        walking skills.

    """

    def __init__(
        self, robot: RobotInterface, watch: WorldWatch, recall: Recall, walking: Walking
    ) -> None:
        self._robot, self._watch = robot, watch
        self._recall, self._walking = recall, walking
        self._searched_s: dict[str, float] = {}

    def look_at(self, target: Any) -> SkillRun:
        """
        Turn the head towards an object or a place; turn the body first if that is not in front.

        Parameters
        ----------
        target
            An `ObjectDescription`, or the name of a surface or room.

        Raises
        ------
        SkillError
            No remembered object fits, or the head cannot be turned there.

        """
        position_m = self._recall.position(target)
        what = in_words(target) if isinstance(target, str) else target.text
        yield from self._walking.face(position_m)
        yield from self._look(position_m, f'I cannot turn my head far enough to see {what}.')

    def _look(self, position_m: tuple[float, float, float], otherwise: str = '') -> SkillRun:
        goal = PointHead.Goal()
        goal.target.header.frame_id = 'map'
        goal.target.point.x, goal.target.point.y, goal.target.point.z = map(float, position_m)
        yield from self._robot.act(PointHead, 'look_at', goal, otherwise)

    def glance_at(self, position_m: tuple[float, float, float]) -> SkillRun:
        """
        Point the head at a position for 2 s if possible; failures are ignored.

        Nothing happens if the point is more than 4 m away, the pose of the robot is unknown, or
        the action `look_at` is unavailable.

        Parameters
        ----------
        position_m
            The point (3,) in the map frame.

        """
        pose = self._watch.pose()
        if pose is None or math.dist(pose[:2], position_m[:2]) > _SEEN_FROM_M:
            return
        if self._watch.lacks('look_at'):
            return
        try:
            yield from self._walking.face(position_m)
            yield from self._look(position_m)
            yield from self._robot.sleep(_LOOK_S)
        except SkillError:
            return

    def look_around(self) -> SkillRun:
        """Scan all directions with the action `scan_room`, turning the body."""
        yield from self._robot.act(ScanRoom, 'scan_room', ScanRoom.Goal(turn_body=True))

    def look_over(self, place: str) -> SkillRun:
        """
        Point the head at every surface of a piece of furniture, from the current pose.

        Parameters
        ----------
        place
            The base name of surfaces, such as `shelf`. With any other name, such as that of a
            room, the robot looks around instead.

        Raises
        ------
        SkillError
            The robot cannot look around.

        """
        surfaces = [each for each in self._watch.places.surfaces if base_name(each.name) == place]
        if surfaces:
            yield from self._look_upon(surfaces)
        else:
            yield from self.look_around()

    def find(self, object: ObjectDescription) -> SkillRun:  # noqa: A002
        """
        Search for an object in one place after another, and report where it is.

        Parameters
        ----------
        object
            The description; for the rest of the plan it refers to the object that was found.

        Raises
        ------
        SkillError
            The object was not found, or an action that the search needs is unavailable.

        """
        looked: list[str] = []
        for search in self._searches(object, looked):
            try:
                for _ in search:
                    if self._recall.remembered(object) is not None:
                        break
                    yield
            except SkillError as error:
                if error.code == 'UNAVAILABLE':
                    raise
            finally:
                search.close()
            if self._recall.remembered(object) is not None:
                break
        thing = self._recall.remembered(object)
        if thing is None:
            where = f' I have looked in {listed(looked)}.' if looked else ''
            raise SkillError(f'I have not found {object.text}.{where}', is_final=True)
        self._recall.take_found(object, thing)
        self._robot.say(f'I see the {thing.name}{where_is(thing)}.')

    def _searches(self, wanted: ObjectDescription, looked: list[str]) -> Iterator[SkillRun]:
        """
        Yield the stages of a search for an object; append the names of the rooms to `looked`.

        Most objects are visible from the centre of a room. All rooms are therefore scanned first,
        and then the furniture in them, one piece after another.
        """
        places, pose = self._watch.places, self._watch.pose()
        yield self._robot.sleep(0.0)
        only = wanted.place
        surfaces = [each for each in places.surfaces if base_name(each.name) == only]
        here = places.room_at(pose[0], pose[1]) if pose else ''
        if surfaces:
            yield self._walking.go_to(only)
            looked.append(f'front of the {in_words(only)}')
            yield self.look_over(only)
            yield self.look_around()
            return
        rooms = [each for each in places.rooms if only in ('', each.name)]
        if pose is not None:
            rooms.sort(key=lambda room: math.dist(room.middle_m, pose[:2]))
        rooms.sort(key=lambda room: self._was_searched(room.name))
        if not rooms:
            looked.append('all directions from here')
            yield self.look_around()
        for room in rooms:
            if room.name != here:
                yield self._walking.go_to(room.name)
            looked.append(f'the {in_words(room.name)}')
            yield self.look_around()
            self._searched_s[room.name] = self._robot.now_s()
        for room in rooms:
            for surface in places.surfaces:
                if places.room_at(*surface.middle_m) == room.name:
                    yield self._visit(surface.name)

    def _was_searched(self, room: str) -> bool:
        """Check whether a room was scanned recently."""
        passed_s = self._robot.now_s() - self._searched_s.get(room, -math.inf)
        return 0.0 <= passed_s < _LATELY_S

    def _visit(self, name: str) -> SkillRun:
        yield from self._walking.go_to(base_name(name))
        yield from self._look_upon(
            [each for each in self._watch.places.surfaces if each.name == name]
        )

    def _look_upon(self, surfaces: Sequence[Any]) -> SkillRun:
        for surface in surfaces:
            yield from self.glance_at((*surface.middle_m, surface.height_m))
