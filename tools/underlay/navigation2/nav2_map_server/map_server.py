# SPDX-License-Identifier: Apache-2.0
"""The node that publishes a map from a file."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import Any

from nav2_map_server.map_io import (
    MapDataError,
    MapError,
    MapMetadataError,
    MissingMapError,
    read_map,
)
from nav2_map_server.map_messages import make_grid, path_of
from nav2_msgs.srv import LoadMap
from nav2_util.errors import ConfigurationError
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter
from nav2_util.qos import LATCHED
from nav_msgs.msg import OccupancyGrid
from nav_msgs.srv import GetMap

__all__ = ['MapServer', 'MapServerParameters']

_RESULTS = (
    (MissingMapError, LoadMap.Response.RESULT_MAP_DOES_NOT_EXIST),
    (MapDataError, LoadMap.Response.RESULT_INVALID_MAP_DATA),
    (MapMetadataError, LoadMap.Response.RESULT_INVALID_MAP_METADATA),
)


@dataclass(frozen=True)
class MapServerParameters:
    """The parameters of `nav2_map_server::MapServer`."""

    yaml_filename: str = parameter('', 'The path of the map; without one it comes by load_map.')
    topic_name: str = parameter('map', 'The topic of the map.')
    frame_id: str = parameter('map', 'The frame of the map.')


class MapServer(LifecycleNode):
    """
    Node that publishes a map, and loads another one on request.

    Parameters
    ----------
    node_name
        Its name.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, node_name: str = 'map_server', **options: Any) -> None:
        super().__init__(node_name, **options)
        self._map: OccupancyGrid | None = None
        self._publisher: Any = None
        self._frame = 'map'

    def configure(self) -> None:
        """Read the map."""
        values = self.parameters.declare(MapServerParameters).current
        self._frame = values.frame_id
        if values.yaml_filename:
            try:
                self._map = self._read(values.yaml_filename)
            except MapError as error:
                raise ConfigurationError(str(error)) from error
        else:
            self.get_logger().info(
                "There is no map yet: the parameter 'yaml_filename' is empty. Call the service "
                'load_map.'
            )
        self._publisher = self.create_publisher(OccupancyGrid, values.topic_name, LATCHED)
        self.create_service(GetMap, '~/map', self._tell)
        self.create_service(LoadMap, '~/load_map', self._load)

    def activate(self) -> None:
        """Publish the map."""
        self._publish()

    def cleanup(self) -> None:
        """Release the map."""
        self._map = None

    def _read(self, url: str) -> OccupancyGrid:
        path = path_of(url)
        found = read_map(path)
        rows, columns = found.occupancies.shape
        self.get_logger().info(
            f"Read the map '{path}': {columns} x {rows} cells of {found.resolution_m:g} m"
        )
        if abs(found.origin[2]) > 1e-6:
            self.get_logger().warning(
                f"The map '{path}' is rotated by {math.degrees(found.origin[2]):.1f} degrees; "
                'costmaps and localization ignore the rotation. Rotate the image instead.'
            )
        return make_grid(found, self._frame, self.get_clock().now().to_msg())

    def _publish(self) -> None:
        if self._map is not None:
            self._map.header.stamp = self.get_clock().now().to_msg()
            self._publisher.publish(self._map)

    def _tell(self, _: GetMap.Request, response: GetMap.Response) -> GetMap.Response:
        if not self.is_active:
            self.get_logger().warning('The service map is not available: the node is not active.')
        elif self._map is not None:
            response.map = self._map
        return response

    def _load(self, request: LoadMap.Request, response: LoadMap.Response) -> LoadMap.Response:
        if not self.is_active:
            self.get_logger().warning(
                'The service load_map is not available: the node is not active.'
            )
            response.result = LoadMap.Response.RESULT_UNDEFINED_FAILURE
            return response
        try:
            self._map = self._read(request.map_url)
        except MapError as error:
            self.get_logger().error(str(error))
            codes = [code for kind, code in _RESULTS if isinstance(error, kind)]
            response.result = [*codes, LoadMap.Response.RESULT_MAP_DOES_NOT_EXIST][0]
            return response
        self._publish()
        response.map, response.result = self._map, LoadMap.Response.RESULT_SUCCESS
        return response
