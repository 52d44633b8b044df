# SPDX-License-Identifier: Apache-2.0
"""Map files, and the servers that publish and save maps."""

from nav2_map_server.map_io import MapError, read_map, write_map
from nav2_map_server.occupancy_map import OccupancyMap

__all__ = ['MapError', 'OccupancyMap', 'read_map', 'write_map']
