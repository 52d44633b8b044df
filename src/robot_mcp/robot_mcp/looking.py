# SPDX-License-Identifier: Apache-2.0
"""Read-only tools: the state of the world as data, and images of the camera and the map."""

from __future__ import annotations

import json
import math
from typing import Any

from humanoid_common.qos import LATCHED, SENSOR
from humanoid_perception.images import color_of
from llm_planner.skills import Skills
from llm_planner.world import base_name, World
from llm_planner.world_watch import WorldWatch
from nav_msgs.msg import OccupancyGrid
import numpy as np
from robot_mcp.node_thread import RobotError
from robot_mcp.pictures import camera_png, map_png
from robot_mcp.robot_link import RobotLink
from sensor_msgs.msg import Image

__all__ = ['ReadOnlyTools']

_MOST_OBJECTS = 200


class ReadOnlyTools:
    """
    Handler of the read-only tools, which never move the robot.

    Parameters
    ----------
    link, skills, watch
        The link to the robot, its skills, and the observed world.
    may_move
        Whether assistants may move the robot, which is reported as part of its state.

    """

    def __init__(
        self, link: RobotLink, skills: Skills, watch: WorldWatch, *, may_move: bool
    ) -> None:
        self._link, self._skills, self._watch = link, skills, watch
        self._may_move = may_move

    async def look(self, name: str) -> tuple[str, tuple[bytes, ...]]:
        """
        Execute a read-only tool; return its text and its images.

        Parameters
        ----------
        name
            One of `tools.LOOKS`.

        Raises
        ------
        RobotError, ImageError
            No data is available.

        """
        await self._link.thread.settle()
        world: World = await self._link.thread.do(self._watch.world)
        if name == 'camera_picture':
            image = await self._link.thread.newest(
                Image, 'camera/image_raw', SENSOR, 'I cannot see: there is no camera.'
            )
            return 'What the camera sees.', (camera_png(color_of(image)),)
        if name == 'map_picture':
            return await self._map(world)
        if name == 'remembered_objects':
            told: Any = _remembered_objects(world)
            lack = world.missing.get('find', '')
            if not told:
                if lack:
                    raise RobotError(lack)
                return 'I do not remember any objects yet.', ()
        elif name == 'named_places':
            told = _named_places(world)
            if not world.place_names:
                raise RobotError(
                    'I do not know any places: start this server with places_file:=...'
                )
        else:
            x_y = world.robot[:2] if world.robot else None
            told = _robot_state(
                self._skills,
                world,
                self._watch.places.room_at(*x_y) if x_y else '',
                self._link.walking_state,
                self._link.plan_state,
                await self._link.lack(),
                may_move=self._may_move,
            )
        return json.dumps(told), ()

    async def _map(self, world: World) -> tuple[str, tuple[bytes, ...]]:
        grid = await self._link.thread.newest(
            OccupancyGrid, 'map', LATCHED, 'There is no map, as navigation is not running.'
        )
        info = grid.info
        if len(grid.data) != info.width * info.height or not len(grid.data):
            raise RobotError('The map is empty or damaged.')
        cells = np.array(grid.data, np.int8).reshape(info.height, info.width)
        corner = info.origin.position
        png, words = map_png(cells, info.resolution, (corner.x, corner.y), world.robot)
        return words, (png,)


def _robot_state(
    skills: Skills,
    world: World,
    room: str,
    walking: str,
    plan: str,
    lack: str,
    *,
    may_move: bool,
) -> dict[str, Any]:
    """
    Report the state of the robot: its pose, and what it can do.

    Parameters
    ----------
    skills, world
        The skills, and the state of the world.
    room
        The room of the robot; empty if it is unknown.
    walking
        The state reported by the walking controller: `standing`, `walking`, `fallen`, ...
    plan
        The current or last plan, as reported by the executor: JSON.
    lack
        Why the robot can do nothing at all; empty if it can.
    may_move
        Whether assistants may move the robot.

    """
    missing = world.missing
    pose = None
    if world.robot is not None:
        x, y, yaw = world.robot
        pose = {'x_m': round(x, 2), 'y_m': round(y, 2), 'yaw_deg': round(math.degrees(yaw))}
    return {
        'pose_in_map': pose,
        'room': room or None,
        'walking_state': walking or None,
        'cannot_move_because': lack or world.inhibition or None,
        'holding': world.holding or None,
        'last_plan': _plan(plan),
        'assistants_may_move_it': may_move,
        'can': [
            each.name for each in skills if not lack and not skills.simple(each.name) & {*missing}
        ],
        'cannot': dict(missing),
    }  # fmt: skip


def _remembered_objects(world: World) -> list[dict[str, Any]]:
    """
    List the remembered objects, in the words by which tools can refer to them.

    Parameters
    ----------
    world
        The state of the world.

    Returns
    -------
    list of dict
        The id, class, colour, place, room and position (m, in the map) of 200 objects at most.

    """
    return [
        {
            'id': each.object_id,
            'class': each.class_id,
            'colour': each.colour or None,
            'place': base_name(each.place) or None,
            'room': each.room or None,
            'position_m': [round(value, 2) for value in each.position_m],
        }
        for each in world.things[:_MOST_OBJECTS]
    ]


def _named_places(world: World) -> dict[str, Any]:
    """
    List the rooms, and the places with the rooms in which they are.

    Parameters
    ----------
    world
        The state of the world.

    Returns
    -------
    dict
        `rooms`, a list of names, and `places`: for each name its room, or None.

    """
    return {
        'rooms': list(world.rooms),
        'places': {name: room or None for name, room in world.places.items()},
    }


def _plan(text: str) -> Any:
    """Parse the plan state that the executor reports; None if there is none."""
    try:
        return json.loads(text) if text else None
    except ValueError:
        return None
