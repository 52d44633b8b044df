# SPDX-License-Identifier: Apache-2.0
"""Walking skills: go to places and objects, come back, move and turn by a given amount."""

from __future__ import annotations

from collections.abc import Sequence
import math
from typing import Any

from humanoid_navigation.arrival import stamped
from llm_planner.plan import value_in_words
from llm_planner.recall import Recall
from llm_planner.robot import RobotInterface
from llm_planner.skills import SkillError, SkillRun
from llm_planner.standing import Pose, stands_at_object, stands_at_surface, stands_in_room
from llm_planner.world import in_words, KnownObject, listed, ObjectDescription
from llm_planner.world_watch import WorldWatch
from nav2_msgs.action import (
    BackUp,
    ComputePathToPose,
    DriveOnHeading,
    FollowWaypoints,
    NavigateToPose,
    Spin,
)
from rclpy.duration import Duration

__all__ = ['Walking']

_TRIED_STANDS = 8
_FACING_RAD = 0.9
_DRIVE_M_S = 0.2


class Walking:
    """
    Walking skills that use the actions of Nav2.

    Parameters
    ----------
    robot, watch, recall
        The interface to the robot, the observed world, and the lookup of remembered objects.

    """

    def __init__(self, robot: RobotInterface, watch: WorldWatch, recall: Recall) -> None:
        self._robot, self._watch, self._recall = robot, watch, recall
        self._home: Pose | None = None
        self._missed: list[Pose] = []

    def begin_plan(self) -> None:
        """Store the current pose, to come back to."""
        self._home = self._watch.pose()
        self._missed.clear()

    def go_to(self, target: Any) -> SkillRun:
        """
        Walk to a place, or up to an object.

        Parameters
        ----------
        target
            An `ObjectDescription`, or the name of a surface or room; if the robot is already in
            that room, it stays where it is.

        Raises
        ------
        SkillError
            No remembered object fits, there is no path, or navigation does not succeed.

        """
        if isinstance(target, ObjectDescription):
            stands = self._stands_at(self._recall.thing(target))
        else:
            pose = self._watch.pose()
            if pose is not None and self._watch.places.room_at(pose[0], pose[1]) == target:
                return
            stands = self._stands_at_place(target)
        yield from self._walk_to_first(stands, value_in_words(target))

    def come_back(self) -> SkillRun:
        """Walk back to the pose stored by `begin_plan`."""
        if self._home is None:
            raise SkillError('I did not know where I was when you asked me, so I cannot go back.')
        yield from self._navigate(self._home)

    def follow_path(self, places: Sequence[str]) -> SkillRun:
        """
        Walk through several places with the action `follow_waypoints`.

        Parameters
        ----------
        places
            The names of surfaces or rooms, in order.

        Raises
        ------
        SkillError
            There is no free floor at a place, or the robot did not reach one.

        """
        poses = []
        for place in places:
            stands = self._stands_at_place(place)
            if not stands:
                raise SkillError(f'There is no free floor at the {in_words(place)}.')
            poses.append(stamped(stands[0]))
        result = yield from self._robot.act(
            FollowWaypoints, 'follow_waypoints', FollowWaypoints.Goal(poses=poses)
        )
        missed = [f'the {in_words(places[each.index])}' for each in result.missed_waypoints]
        if missed:
            raise SkillError(f'I did not reach {listed(missed)}.')

    def move(self, direction: str, distance: float) -> SkillRun:
        """
        Walk straight forward or backward.

        Parameters
        ----------
        direction
            `forward` or `backward`.
        distance
            The distance in m.

        """
        is_back = direction == 'backward'
        kind, name = (BackUp, 'backup') if is_back else (DriveOnHeading, 'drive_on_heading')
        goal = kind.Goal(speed=_DRIVE_M_S)
        goal.target.x = float(distance)
        goal.time_allowance = Duration(seconds=distance / _DRIVE_M_S * 3.0 + 10.0).to_msg()
        yield from self._robot.act(kind, name, goal)

    def turn(self, direction: str, angle: float) -> SkillRun:
        """
        Turn in place to the left or the right.

        Parameters
        ----------
        direction
            `left` or `right`.
        angle
            The angle in degrees.

        """
        sign = -1.0 if direction == 'right' else 1.0
        yield from self.spin(sign * math.radians(angle))

    def spin(self, angle_rad: float) -> SkillRun:
        """
        Turn in place by an angle.

        Parameters
        ----------
        angle_rad
            The angle; positive turns to the left.

        Raises
        ------
        SkillError
            The action `spin` does not succeed.

        """
        goal = Spin.Goal(target_yaw=angle_rad, time_allowance=Duration(seconds=60.0).to_msg())
        yield from self._robot.act(Spin, 'spin', goal)

    def _stands_at_place(self, place: str) -> list[Pose]:
        places = self._watch.places
        if room := self._watch.room(place):
            return stands_in_room(room, places)
        surface = self._watch.surface(place)
        assert surface is not None, 'The plan was checked.'
        return stands_at_surface(surface, places)

    def _stands_at(self, thing: KnownObject) -> list[Pose]:
        """Compute the poses to reach an object: in front of its surface, or beside it."""
        places, at = self._watch.places, thing.position_m[:2]
        surface = next((each for each in places.surfaces if each.name == thing.place), None)
        if surface is not None:
            return stands_at_surface(surface, places, at)
        return stands_at_object(at, places)

    def _walk_to_first(self, stands: Sequence[Pose], what: str) -> SkillRun:
        """Walk to the first pose to which there is a path; poses missed before are tried last."""
        reason = 'There is no free floor around it.'
        for stand in sorted(stands, key=self._missed.__contains__)[:_TRIED_STANDS]:
            goal = ComputePathToPose.Goal(goal=stamped(stand))
            try:
                yield from self._robot.act(ComputePathToPose, 'compute_path_to_pose', goal)
            except SkillError as error:
                if error.code == 'UNAVAILABLE':
                    raise
                reason = str(error)
                continue
            try:
                yield from self._navigate(stand)
            except SkillError:
                self._missed.append(stand)
                raise
            return
        raise SkillError(f'I cannot find a way to {what}. {reason}')

    def _navigate(self, pose: Pose) -> SkillRun:
        """Walk to a pose; raise SkillError as soon as a hand has lost what it held."""
        held = ''
        goal = NavigateToPose.Goal(pose=stamped(pose))
        walk = self._robot.act(NavigateToPose, 'navigate_to_pose', goal)
        try:
            for _ in walk:
                if held and not self._watch.holding:
                    raise SkillError(f'I have lost the {held} on the way.', is_final=True)
                held = self._watch.holding
                yield
        finally:
            walk.close()

    def face(self, position_m: Sequence[float]) -> SkillRun:
        """
        Turn the body towards a point that the head alone cannot look at.

        Nothing happens if the bearing is less than 0.9 rad, the pose of the robot is unknown, or
        it cannot turn now.

        Parameters
        ----------
        position_m
            The point in the map frame, of which x and y are used.

        Raises
        ------
        SkillError
            The turn does not succeed.

        """
        pose = self._watch.pose()
        if pose is None or self._watch.lacks('turn'):
            return
        bearing = math.atan2(position_m[1] - pose[1], position_m[0] - pose[0]) - pose[2]
        bearing = math.remainder(bearing, math.tau)
        if abs(bearing) > _FACING_RAD:
            yield from self.spin(bearing)
