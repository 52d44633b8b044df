# SPDX-License-Identifier: Apache-2.0
"""Convert costmaps to messages and back."""

from __future__ import annotations

from array import array

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Point32, Polygon
from map_msgs.msg import OccupancyGridUpdate
from nav2_costmap_2d.costs import occupancy_of
from nav2_costmap_2d.grid import Costmap2D, FloatArray
from nav2_costmap_2d.regions import Region
from nav2_msgs.msg import Costmap, CostmapUpdate
from nav_msgs.msg import OccupancyGrid
import numpy as np

__all__ = [
    'corners_of',
    'costmap_from',
    'make_costmap_message',
    'make_costmap_update',
    'make_grid',
    'make_grid_update',
    'make_polygon',
]


def make_grid(grid: Costmap2D, frame: str, stamp: Time, height_m: float = 0.0) -> OccupancyGrid:
    """
    Convert a costmap to an `OccupancyGrid`, with values from 0 to 100, and -1 for unknown.

    Parameters
    ----------
    grid
        The costmap.
    frame, stamp
        The header; the stamp is also the time of the map.
    height_m
        The z of its origin, so that displays show it above other objects.

    """
    message = OccupancyGrid()
    message.header.frame_id, message.header.stamp = frame, stamp
    info = message.info
    info.map_load_time, info.resolution = stamp, grid.resolution
    info.width, info.height = grid.size_x, grid.size_y
    at = info.origin.position
    at.x, at.y, at.z = grid.origin_x, grid.origin_y, height_m
    message.data = array('b', occupancy_of(grid.cells).tobytes())
    return message


def make_grid_update(
    grid: Costmap2D, region: Region, frame: str, stamp: Time
) -> OccupancyGridUpdate:
    """
    Convert a region of a costmap to an update of its `OccupancyGrid`.

    Parameters
    ----------
    grid
        The whole costmap.
    region
        The cells to send, all of them in the grid.
    frame, stamp
        The header.

    """
    message = OccupancyGridUpdate(
        x=region.x, y=region.y, width=region.x_end - region.x, height=region.y_end - region.y
    )
    message.header.frame_id, message.header.stamp = frame, stamp
    message.data = array('b', occupancy_of(grid.cells[region.slices]).tobytes())
    return message


def make_costmap_message(
    grid: Costmap2D, frame: str, stamp: Time, layer: str = 'master'
) -> Costmap:
    """
    Convert a costmap, or one of its layers, to a message with raw costs.

    Parameters
    ----------
    grid
        The costmap.
    frame, stamp
        The header; the stamp is also the time of the map.
    layer
        The name of the layer; `master` for all of them.

    """
    message = Costmap()
    message.header.frame_id, message.header.stamp = frame, stamp
    data = message.metadata
    data.map_load_time = data.update_time = stamp
    data.layer, data.resolution = layer, grid.resolution
    data.size_x, data.size_y = grid.size_x, grid.size_y
    data.origin.position.x, data.origin.position.y = grid.origin_x, grid.origin_y
    message.data = array('B', grid.cells.tobytes())
    return message


def make_costmap_update(grid: Costmap2D, region: Region, frame: str, stamp: Time) -> CostmapUpdate:
    """
    Convert a region of a costmap to an update with raw costs.

    Parameters
    ----------
    grid
        The whole costmap.
    region
        The cells to send, all of them in the grid.
    frame, stamp
        The header.

    """
    message = CostmapUpdate(
        x=region.x, y=region.y, size_x=region.x_end - region.x, size_y=region.y_end - region.y
    )
    message.header.frame_id, message.header.stamp = frame, stamp
    message.data = array('B', grid.cells[region.slices].tobytes())
    return message


def costmap_from(message: Costmap) -> Costmap2D:
    """
    Convert a message of `costmap_raw` to a grid.

    Parameters
    ----------
    message
        The whole costmap, not an update.

    Raises
    ------
    ValueError
        Its number of cells does not match its size.

    """
    data = message.metadata
    cells = np.asarray(message.data, np.uint8)
    if cells.size != data.size_x * data.size_y:
        raise ValueError(
            f'The costmap has {cells.size} cells instead of {data.size_x} x {data.size_y}.'
        )
    return Costmap2D(
        data.size_x,
        data.size_y,
        # The message has single precision.
        round(float(data.resolution), 7),
        data.origin.position.x,
        data.origin.position.y,
        cells=cells.reshape(data.size_y, data.size_x),
    )


def make_polygon(points: FloatArray) -> Polygon:
    """
    Convert corners to a polygon message.

    Parameters
    ----------
    points
        Corners (N, 2) in m.

    """
    return Polygon(points=[Point32(x=float(x), y=float(y)) for x, y in points])


def corners_of(polygon: Polygon) -> FloatArray:
    """
    Convert a polygon message to its corners.

    Parameters
    ----------
    polygon
        The message; z is ignored.

    Returns
    -------
    numpy.ndarray
        Corners (N, 2) in m.

    """
    return np.array([(point.x, point.y) for point in polygon.points], float).reshape(-1, 2)
