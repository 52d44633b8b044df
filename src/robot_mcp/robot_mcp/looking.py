# SPDX-License-Identifier: Apache-2.0
"""Read-only tools: the state of the world, and images of the camera and the map."""

from __future__ import annotations

import json
from typing import Any

from humanoid_common.qos import LATCHED, SENSOR
from humanoid_perception.images import color_of
from llm_planner.skills import Skills
from llm_planner.world import World
from llm_planner.world_watch import WorldWatch
from nav_msgs.msg import OccupancyGrid
import numpy as np
from robot_mcp.looks import named_places, remembered_objects, robot_state
from robot_mcp.node_thread import RobotError
from robot_mcp.pictures import camera_png, map_png
from robot_mcp.robot_link import RobotLink
from sensor_msgs.msg import Image

__all__ = ['ReadOnlyTools']


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
            told: Any = remembered_objects(world)
            lack = world.missing.get('find', '')
            if not told:
                if lack:
                    raise RobotError(lack)
                return 'I do not remember any objects yet.', ()
        elif name == 'named_places':
            told = named_places(world)
            if not world.place_names:
                raise RobotError(
                    'I do not know any places: start this server with places_file:=...'
                )
        else:
            x_y = world.robot[:2] if world.robot else None
            told = robot_state(
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
