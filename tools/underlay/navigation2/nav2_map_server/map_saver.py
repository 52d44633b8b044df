# SPDX-License-Identifier: Apache-2.0
"""Save maps from topics to files: the node `map_saver`, and the command `map_saver_cli`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass, field
import sys
import time
from typing import Any

from nav2_map_server.map_io import IMAGE_FORMATS, MapError, write_map
from nav2_map_server.map_messages import map_from, path_of
from nav2_map_server.occupancy_map import MODES, Thresholds
from nav2_msgs.srv import SaveMap
from nav2_util.errors import NavigationError
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter
from nav2_util.services import create_async_service, wait_for
from nav_msgs.msg import OccupancyGrid
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.task import Future
from tf2_ros.executing import make_executor, spin_until
from tf2_ros.program import run

__all__ = ['MapSaver', 'MapSaverParameters', 'SaveOptions', 'main']


@dataclass(frozen=True)
class MapSaverParameters:
    """The parameters of `nav2_map_server::MapSaver`."""

    save_map_timeout: float = parameter(2.0, 'How long to wait for a map, in s.', low=0.0)
    free_thresh_default: float = parameter(
        0.25, 'Cells are free up to this probability, unless a request says otherwise.'
    )
    occupied_thresh_default: float = parameter(
        0.65, 'Cells are occupied from this probability, unless a request says otherwise.'
    )
    map_subscribe_transient_local: bool = parameter(
        True, 'Whether a map is received that was published before.'
    )


@dataclass(frozen=True)
class SaveOptions:
    """Options for saving a map."""

    topic: str = 'map'
    stem: str = 'map'
    """The path of the files without the extension."""
    image_format: str = ''
    mode: str = 'trinary'
    thresholds: Thresholds = field(default_factory=Thresholds)


class MapSaver(LifecycleNode):
    """
    Node that saves the map of a topic to files.

    Parameters
    ----------
    node_name
        Its name.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, node_name: str = 'map_saver', **options: Any) -> None:
        super().__init__(node_name, **options)
        self._settings: Any = None

    def configure(self) -> None:
        """Create the service."""
        self._settings = self.parameters.declare(MapSaverParameters)
        create_async_service(self, SaveMap, '~/save_map', self._serve)

    async def save(self, options: SaveOptions) -> None:
        """
        Wait for a map on a topic, and save it to files.

        The parameter `save_map_timeout` is the timeout in s.

        Parameters
        ----------
        options
            The topic, the path of the files, their format, and the thresholds.

        Raises
        ------
        MapError
            No map was received in time, or it cannot be written.

        """
        values: MapSaverParameters = self.parameters.declare(MapSaverParameters).current
        found: Future[OccupancyGrid] = Future(executor=self.executor)

        def take(message: OccupancyGrid) -> None:
            if not found.done():
                found.set_result(message)

        durability = (
            DurabilityPolicy.TRANSIENT_LOCAL
            if values.map_subscribe_transient_local
            else DurabilityPolicy.VOLATILE
        )
        profile = QoSProfile(depth=1, durability=durability)
        subscription = self.create_subscription(OccupancyGrid, options.topic, take, profile)
        self.get_logger().info(f"Waiting for a map on '{subscription.topic_name}'")
        try:
            is_there = await wait_for(self, found, values.save_map_timeout)
        finally:
            self.destroy_subscription(subscription)
        if not is_there:
            raise MapError(
                f"No map was received on '{options.topic}' within {values.save_map_timeout:g} s. "
                "Is it published, and on this topic? The parameter 'save_map_timeout' says how "
                'long to wait.'
            )
        file, image = write_map(
            map_from(found.result()),
            options.stem,
            image_format=options.image_format,
            mode=options.mode,
            thresholds=options.thresholds,
        )
        self.get_logger().info(f"Wrote the map to '{file}' and '{image}'")

    async def _serve(
        self, request: SaveMap.Request, response: SaveMap.Response
    ) -> SaveMap.Response:
        try:
            await self.save(self._options(request))
            response.result = True
        except MapError as error:
            self.get_logger().error(str(error))
        return response

    def _options(self, request: SaveMap.Request) -> SaveOptions:
        values: MapSaverParameters = self._settings.current
        # In a request, 0 stands for the default.
        free = request.free_thresh or values.free_thresh_default
        occupied = request.occupied_thresh or values.occupied_thresh_default
        try:
            thresholds = Thresholds(round(free, 6), round(occupied, 6))
        except ValueError as error:
            raise MapError(f'{error}.') from error
        return SaveOptions(
            request.map_topic or 'map',
            path_of(request.map_url).removesuffix('.yaml'),
            request.image_format,
            request.map_mode or 'trinary',
            thresholds,
        )


def main(arguments: Sequence[str] | None = None) -> int:
    """
    Run the command; return the exit status.

    Parameters
    ----------
    arguments : Sequence[str] | None
        The command line with the program's name; by default that of the process.

    """
    return run(_parse, _save, arguments)


def _parse(words: list[str]) -> SaveOptions:
    parser = argparse.ArgumentParser(
        prog='map_saver_cli',
        description='Write the map of a topic to a YAML file and an image.',
        epilog='Parameters of the node follow --ros-args: -p save_map_timeout:=5.0 and '
        '-p map_subscribe_transient_local:=true.',
    )
    default = f'map_{int(time.time())}'
    parser.add_argument('-t', dest='topic', default='map', help='the topic of the map')
    parser.add_argument(
        '-f', dest='stem', default=default, help='the path of the files without the ending'
    )
    parser.add_argument(
        '--occ', type=float, default=0.65, help='cells are occupied from this probability (0.65)'
    )
    parser.add_argument(
        '--free', type=float, default=0.25, help='cells are free up to this probability (0.25)'
    )
    parser.add_argument(
        '--fmt',
        default='',
        choices=IMAGE_FORMATS,
        help=f'the format of the image: {", ".join(IMAGE_FORMATS)} (pgm; png in mode scale)',
    )
    parser.add_argument(
        '--mode',
        default='trinary',
        choices=MODES,
        help=f'what cells are: {", ".join(MODES)} (trinary)',
    )
    found = parser.parse_args(words)
    try:
        thresholds = Thresholds(found.free, found.occ)
    except ValueError as error:
        parser.error(str(error))
    return SaveOptions(found.topic, found.stem, found.fmt, found.mode, thresholds)


def _save(options: SaveOptions) -> int:
    node = MapSaver()
    executor = make_executor()
    executor.add_node(node)
    end: Future[int] = Future(executor=executor)

    async def work() -> None:
        status = 1
        try:
            await node.save(options)
            status = 0
        except NavigationError as error:
            sys.stderr.write(f'{error}\n')
        finally:
            end.set_result(status)

    executor.create_task(work)
    spin_until(executor, end)
    node.destroy_node()
    executor.shutdown()
    return end.result() if end.done() else 1
