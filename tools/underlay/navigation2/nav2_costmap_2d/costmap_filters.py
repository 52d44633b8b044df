# SPDX-License-Identifier: Apache-2.0
"""Costmap filters, which look up the robot in a mask: the base class, speed limits and areas."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import Any, TYPE_CHECKING

from nav2_costmap_2d.grid import Costmap2D
from nav2_costmap_2d.layers import Layer
from nav2_costmap_2d.regions import Region
from nav2_msgs.msg import CostmapFilterInfo, SpeedLimit
from nav2_util.errors import ConfigurationError
from nav2_util.geometry import planar_pose, Pose2D
from nav2_util.parameters import parameter
from nav2_util.qos import LATCHED
from nav2_util.transforms import TransformError
from nav_msgs.msg import OccupancyGrid
import numpy as np
from rclpy.qos import QoSProfile
from std_msgs.msg import Bool
from std_srvs.srv import SetBool

if TYPE_CHECKING:
    from nav2_costmap_2d.costmap_node import Costmap2DROS

__all__ = [
    'UNKNOWN',
    'BinaryFilter',
    'CostmapFilter',
    'FilterParameters',
    'SpeedFilter',
]

_QUIET_S = 5.0
_SPEED_PERCENTAGE, _SPEED_ABSOLUTE, _BINARY = 1, 2, 3
UNKNOWN = 255
"""The value of a mask where it says nothing."""


@dataclass(frozen=True)
class FilterParameters:
    """The parameters of all costmap filters."""

    enabled: bool = parameter(True, 'Whether the filter takes part.')
    filter_info_topic: str = parameter('', 'The topic that names the mask and what it means.')
    transform_tolerance: float = parameter(
        0.1, 'How old the pose of the frame of the mask may be, in s; the newest counts.', low=0.0
    )


@dataclass(frozen=True)
class SpeedParameters(FilterParameters):
    """The parameters of `nav2_costmap_2d::SpeedFilter`."""

    speed_limit_topic: str = parameter('speed_limit', 'The topic of the limits.')


@dataclass(frozen=True)
class BinaryParameters(FilterParameters):
    """The parameters of `nav2_costmap_2d::BinaryFilter`."""

    default_state: bool = parameter(False, 'The state outside of the areas.')
    binary_state_topic: str = parameter('binary_state', 'The topic of the state.')
    flip_threshold: float = parameter(50.0, 'The state is the other one above this value.')


class CostmapFilter(Layer):
    """
    Base class of the filters, which receives a filter mask and its info.

    Parameters
    ----------
    node
        The costmap's node.
    name
        The name of the filter.

    """

    parameters_kind: Any = FilterParameters
    types: tuple[int, ...] = ()
    """The types of CostmapFilterInfo that the filter accepts."""

    def __init__(self, node: Costmap2DROS, name: str) -> None:
        super().__init__(name)
        self._node = node
        self._settings = node.parameters.declare(self.parameters_kind, name)
        self._settings.on_change = lambda _: node.touch()
        self._is_enabled: bool = self._settings.current.enabled
        self._info: CostmapFilterInfo | None = None
        self._mask: Costmap2D | None = None
        self._mask_frame = ''
        self._subscription: Any = None
        if not self._settings.current.filter_info_topic:
            raise ConfigurationError(
                f"The filter '{name}' has no topic. Set the parameter '{name}.filter_info_topic' "
                'to that of a costmap_filter_info_server.'
            )
        topic = node.resolve_beside(self._settings.current.filter_info_topic)
        node.create_subscription(CostmapFilterInfo, topic, self._take_info, LATCHED)
        node.create_service(SetBool, f'{name}/toggle_filter', self._toggle)

    @property
    def is_enabled(self) -> bool:
        """Whether the filter is enabled."""
        return self._is_enabled

    def _take_info(self, info: CostmapFilterInfo) -> None:
        log = self._node.get_logger()
        if info.type not in self.types:
            log.error(
                f"Filter '{self.name}': masks of type {info.type} are for another filter; this "
                f'one takes {" and ".join(map(str, self.types))}.'
            )
            return
        if self._info is not None and self._info.filter_mask_topic == info.filter_mask_topic:
            self._info = info
            self._node.touch()
            return
        self._info = info
        if self._subscription is not None:
            self._node.destroy_subscription(self._subscription)
        topic = self._node.resolve_beside(info.filter_mask_topic)
        self._subscription = self._node.create_subscription(
            OccupancyGrid, topic, self._take_mask, LATCHED
        )
        log.info(f"Filter '{self.name}': waiting for the mask on '{topic}'")

    def _take_mask(self, message: OccupancyGrid) -> None:
        info = message.info
        cells = np.asarray(message.data, dtype=np.int8).view(np.uint8)
        if not info.width or cells.size != info.width * info.height or info.resolution <= 0.0:
            self._node.get_logger().error(
                f"Filter '{self.name}': ignored a mask of {cells.size} cells instead of "
                f'{info.width} x {info.height}.'
            )
            return
        origin = planar_pose(info.origin)
        self._mask = Costmap2D(
            info.width,
            info.height,
            round(float(info.resolution), 7),
            origin.x,
            origin.y,
            cells=cells.reshape(info.height, info.width),
        )
        self._mask_frame = message.header.frame_id
        self._node.touch()
        self._node.get_logger().info(f"Filter '{self.name}': received the mask")

    def _toggle(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        self._is_enabled = request.data
        response.success = True
        response.message = 'Enabled' if request.data else 'Disabled'
        return response

    def _pose_in_mask(self) -> Pose2D | None:
        """Look up the frame of the costmap in that of the mask; None if unavailable."""
        if self._mask_frame in ('', self._node.global_frame):
            return Pose2D(0.0, 0.0, 0.0)
        try:
            return self._node.transforms.pose_of(self._node.global_frame, self._mask_frame)
        except TransformError as error:
            self._node.get_logger().warning(
                f"Filter '{self.name}': {error}", throttle_duration_sec=_QUIET_S
            )
            return None

    def _mask_at(self, robot: Pose2D | None) -> int | None:
        """Look up the mask at the robot, 0 outside of it; None if unavailable."""
        if robot is None or self._mask is None:
            return None
        pose = self._pose_in_mask()
        if pose is None:
            return None
        at = pose @ robot
        cell = self._mask.world_to_map(at.x, at.y)
        value = 0 if cell is None else int(self._mask.cells[cell[1], cell[0]])
        return None if value == UNKNOWN else value

    def _meaning(self, value: int) -> float:
        """Convert a mask value by the base and multiplier of the filter info."""
        if self._info is None:
            return 0.0
        return float(self._info.base + self._info.multiplier * value)


class SpeedFilter(CostmapFilter):
    """
    Speed filter: publishes the speed limit at the robot's position.

    Parameters
    ----------
    node, name
        As for `CostmapFilter`.

    Raises
    ------
    ConfigurationError
        `filter_info_topic` is not set.

    """

    parameters_kind = SpeedParameters
    types = (_SPEED_PERCENTAGE, _SPEED_ABSOLUTE)

    def __init__(self, node: Costmap2DROS, name: str) -> None:
        super().__init__(node, name)
        topic = node.resolve_beside(self._settings.current.speed_limit_topic)
        self._publisher = node.create_publisher(SpeedLimit, topic, QoSProfile(depth=10))
        self._limit = 0.0

    def update(self, grid: Costmap2D, robot: Pose2D | None) -> Region | None:
        """
        Publish the speed limit at the robot when it changes.

        Parameters
        ----------
        grid, robot
            As for `Layer.update`.

        Returns
        -------
        Region or None
            Always None: no costs change.

        """
        value = self._mask_at(robot)
        if value is None or self._info is None:
            return None
        is_percentage = self._info.type == _SPEED_PERCENTAGE
        # 0 means no limit, in a mask and in the message.
        limit = self._meaning(value) if value else 0.0
        if value and not 0.0 < limit <= (100.0 if is_percentage else math.inf):
            self._node.get_logger().warning(
                f"Filter '{self.name}': a speed limit of {limit:g} is not possible; no limit "
                'applies.',
                throttle_duration_sec=_QUIET_S,
            )
            limit = 0.0
        if limit != self._limit:
            self._limit = limit
            message = SpeedLimit(percentage=is_percentage, speed_limit=limit)
            message.header.frame_id = self._mask_frame
            message.header.stamp = self._node.get_clock().now().to_msg()
            self._publisher.publish(message)
        return None


class BinaryFilter(CostmapFilter):
    """
    Binary filter: publishes whether the robot is in an area.

    Parameters
    ----------
    node, name
        As for `CostmapFilter`.

    Raises
    ------
    ConfigurationError
        `filter_info_topic` is not set.

    """

    parameters_kind = BinaryParameters
    types = (_BINARY,)

    def __init__(self, node: Costmap2DROS, name: str) -> None:
        super().__init__(node, name)
        topic = node.resolve_beside(self._settings.current.binary_state_topic)
        self._publisher = node.create_publisher(Bool, topic, QoSProfile(depth=10))
        self._state: bool | None = None

    def update(self, grid: Costmap2D, robot: Pose2D | None) -> Region | None:
        """
        Publish the state at the robot when it changes.

        Parameters
        ----------
        grid, robot
            As for `Layer.update`.

        Returns
        -------
        Region or None
            Always None: no costs change.

        """
        values: BinaryParameters = self._settings.current
        value = self._mask_at(robot)
        if value is None or self._info is None:
            return None
        state = values.default_state != (self._meaning(value) > values.flip_threshold)
        if state != self._state:
            self._state = state
            self._publisher.publish(Bool(data=state))
        return None
