# SPDX-License-Identifier: Apache-2.0
"""The node that publishes the topic of a filter mask, and the meaning of its values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from nav2_msgs.msg import CostmapFilterInfo
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter
from nav2_util.qos import LATCHED

__all__ = ['CostmapFilterInfoServer', 'FilterInfoParameters']


@dataclass(frozen=True)
class FilterInfoParameters:
    """The parameters of `nav2_map_server::CostmapFilterInfoServer`."""

    filter_info_topic: str = parameter('costmap_filter_info', 'The topic of this information.')
    kind: int = parameter(
        0,
        'What the mask is: 0 keepout areas and preferred lanes, 1 speed limits in percent, 2 '
        'speed limits in m/s, 3 areas with another state.',
        choices=(0, 1, 2, 3),
        name='type',
    )
    mask_topic: str = parameter('filter_mask', 'The topic of the mask.')
    base: float = parameter(0.0, 'What a mask of 0 means.')
    multiplier: float = parameter(1.0, 'What is added for each unit of the mask.')


class CostmapFilterInfoServer(LifecycleNode):
    """
    Node that publishes the info of a costmap filter on its mask.

    Parameters
    ----------
    node_name
        Its name.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, node_name: str = 'costmap_filter_info_server', **options: Any) -> None:
        super().__init__(node_name, **options)
        self._publisher: Any = None

    def configure(self) -> None:
        """Read the parameters."""
        values = self.parameters.declare(FilterInfoParameters).current
        self._publisher = self.create_publisher(
            CostmapFilterInfo, values.filter_info_topic, LATCHED
        )

    def activate(self) -> None:
        """Publish the information."""
        values = self.parameters.declare(FilterInfoParameters).current
        message = CostmapFilterInfo(
            type=values.kind,
            filter_mask_topic=values.mask_topic,
            base=values.base,
            multiplier=values.multiplier,
        )
        message.header.frame_id = 'map'
        message.header.stamp = self.get_clock().now().to_msg()
        self._publisher.publish(message)
