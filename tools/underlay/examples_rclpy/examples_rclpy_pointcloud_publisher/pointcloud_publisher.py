# SPDX-License-Identifier: Apache-2.0
"""A node that publishes a surface of points with waves, which RViz shows."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

import numpy as np
from rclpy.node import Node
from sensor_msgs.msg import PointCloud2, PointField
from sensor_msgs_py import point_cloud2
from std_msgs.msg import Header
from tf2_ros.program import run_node

__all__ = ['PointCloudPublisher', 'main']

EXTENT_M = 2.0
"""The surface reaches so far from the origin, along x and y."""
HEIGHT_M = 0.3
WAVES_PER_M = 1.0
WAVES_PER_S = 0.5


class PointCloudPublisher(Node):
    """
    Publishes `test_cloud` in the frame `map`: rings of waves that run outwards.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    rate = 30
    moving = True
    width = 100
    height = 100
    fields = tuple(
        PointField(name=name, offset=4 * index, datatype=PointField.FLOAT32, count=1)
        for index, name in enumerate(('x', 'y', 'z', 'intensity'))
    )

    def __init__(self, **options: Any) -> None:
        super().__init__('pc_publisher', **options)
        self._publisher = self.create_publisher(PointCloud2, 'test_cloud', 10)
        self._number = 0
        self.create_timer(1.0 / self.rate, self.timer_callback)

    def timer_callback(self) -> None:
        """Publish the next cloud."""
        header = Header(stamp=self.get_clock().now().to_msg(), frame_id='map')
        points = self.points(self._number / self.rate)
        self._publisher.publish(point_cloud2.create_cloud(header, self.fields, points))
        self._number += self.moving

    def points(self, time_s: float) -> np.ndarray[Any, np.dtype[np.float32]]:
        """
        Compute the points of the surface.

        Parameters
        ----------
        time_s
            The time since the beginning, in s.

        Returns
        -------
        numpy.ndarray
            Rows of x, y and z in m, and the intensity: z as a part of the highest one.

        """
        along = np.linspace(-EXTENT_M, EXTENT_M, self.width, dtype=np.float32)
        across = np.linspace(-EXTENT_M, EXTENT_M, self.height, dtype=np.float32)
        x, y = (each.ravel() for each in np.meshgrid(along, across))
        waves = WAVES_PER_M * np.hypot(x, y) - WAVES_PER_S * time_s
        crest = np.sin(2.0 * np.pi * waves)
        return np.stack([x, y, HEIGHT_M * crest, crest], axis=-1).astype(np.float32)


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: PointCloudPublisher(), args)


if __name__ == '__main__':
    sys.exit(main())
