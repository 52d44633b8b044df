# SPDX-License-Identifier: Apache-2.0
"""Convert maps to messages and back, and resolve `map_url`s."""

from __future__ import annotations

from array import array

from builtin_interfaces.msg import Time
from nav2_map_server.map_io import MapError
from nav2_map_server.occupancy_map import OccupancyMap
from nav2_util.geometry import make_pose, planar_pose, Pose2D
from nav_msgs.msg import OccupancyGrid
import numpy as np

__all__ = ['make_grid', 'map_from', 'path_of']


def make_grid(found: OccupancyMap, frame: str, stamp: Time) -> OccupancyGrid:
    """
    Convert a map to an `OccupancyGrid` message.

    Parameters
    ----------
    found
        The map.
    frame, stamp
        The header of the message; the stamp is its `map_load_time`, too.

    """
    message = OccupancyGrid()
    message.header.frame_id, message.header.stamp = frame, stamp
    info = message.info
    info.map_load_time, info.resolution = stamp, found.resolution_m
    info.height, info.width = found.occupancies.shape
    info.origin = make_pose(Pose2D(*found.origin))
    message.data = array('b', found.occupancies.tobytes())
    return message


def map_from(message: OccupancyGrid) -> OccupancyMap:
    """
    Convert an `OccupancyGrid` message to a map.

    Parameters
    ----------
    message
        The map in cells of -1 and 0 to 100; of its origin, x, y and yaw are used.

    Raises
    ------
    MapError
        Its number of cells does not match its size.

    """
    info = message.info
    cells = np.asarray(message.data, dtype=np.int8)
    if not cells.size or cells.size != info.width * info.height:
        raise MapError(
            f'The map is not complete: it has {cells.size} cells instead of '
            f'{info.width} x {info.height}.'
        )
    origin = planar_pose(info.origin)
    return OccupancyMap(
        cells.reshape(info.height, info.width),
        # The message has single precision.
        round(float(info.resolution), 7),
        (origin.x, origin.y, origin.yaw),
    )


def path_of(url: str) -> str:
    """
    Resolve a `map_url` to a path.

    Parameters
    ----------
    url
        A path, `file:///path` or `package://<package>/path`.

    Raises
    ------
    MapError
        It is empty, or there is no such package.

    """
    if not url:
        raise MapError('No map was named: map_url is empty.')
    if url.startswith('file://'):
        return url.removeprefix('file://')
    if url.startswith('package://'):
        from ament_index_python.packages import get_package_share_directory, PackageNotFoundError

        package, _, rest = url.removeprefix('package://').partition('/')
        try:
            return f'{get_package_share_directory(package)}/{rest}'
        except (PackageNotFoundError, ValueError) as error:
            raise MapError(f"There is no package '{package}', which '{url}' names.") from error
    return url
