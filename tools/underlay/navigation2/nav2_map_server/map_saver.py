# SPDX-License-Identifier: Apache-2.0
"""The node that saves maps from topics to files."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from nav2_map_server.map_io import MapError, write_map
from nav2_map_server.map_messages import map_from, path_of
from nav2_map_server.occupancy_map import Thresholds
from nav2_msgs.srv import SaveMap
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter
from nav2_util.services import create_async_service, wait_for
from nav_msgs.msg import OccupancyGrid
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.task import Future

__all__ = ['MapSaver', 'MapSaverParameters', 'SaveOptions']


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
