# SPDX-License-Identifier: Apache-2.0
"""The sensors: their newest data as points, moved to the current frame of the robot."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass
from typing import Any

from geometry_msgs.msg import PolygonInstanceStamped, TransformStamped
from nav2_collision_monitor.observations import (
    points_of_cloud,
    points_of_polygon,
    points_of_range,
    points_of_scan,
    transformed,
)
from nav2_collision_monitor.parameters import CommonParameters, SourceParameters
from nav2_collision_monitor.shapes import FloatArray
from nav2_util import ConfigurationError, LifecycleNode, NavigationError
import numpy as np
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import LaserScan, PointCloud2, Range
from tf2_ros import TransformException

__all__ = ['Source', 'SourceInvalid', 'Sources']

_MESSAGES = {
    'scan': LaserScan,
    'pointcloud': PointCloud2,
    'range': Range,
    'polygon': PolygonInstanceStamped,
}


class SourceInvalid(NavigationError):
    """A sensor has no usable data."""


@dataclass(frozen=True)
class _Data:
    """(N, 3) points in m, in a frame, with their time."""

    stamp: Time
    frame: str
    points: FloatArray


class Source:
    """
    Sensor source. A message is converted once; its points are fixed in the odometry frame.

    Parameters
    ----------
    node
        The node that subscribes.
    name
        The name of the sensor, the prefix of its parameters.
    common
        The node's parameters.

    """

    def __init__(self, node: LifecycleNode, name: str, common: CommonParameters) -> None:
        self.name, self._node, self._common = name, node, common
        self._told = node.parameters.declare(SourceParameters, prefix=name)
        self.timeout_s = _timeout(node, name, common.source_timeout)
        current = self._told.current
        if not current.kind:
            raise ConfigurationError(
                f"The observation source '{name}' needs the parameter '{name}.type': one of "
                f'{", ".join(_MESSAGES)}.'
            )
        self._frame = (
            common.odom_frame_id if common.base_shift_correction else common.base_frame_id
        )
        self._new: dict[Hashable, _Data | Any] = {}
        self._located: dict[Hashable, _Data] = {}
        self._fault: str | None = None
        node.create_subscription(
            _MESSAGES[current.kind], current.topic, self._receive, qos_profile_sensor_data
        )

    @property
    def is_enabled(self) -> bool:
        """Whether the sensor is enabled."""
        return self._told.current.enabled

    def points(self, now: Time, base_from_fixed: FloatArray) -> FloatArray:
        """
        Return the (N, 2) points in m in the current base frame.

        Parameters
        ----------
        now
            The time of the node's clock.
        base_from_fixed
            (3, 4) matrix from the fixed frame of the points to the base frame.

        Raises
        ------
        SourceInvalid
            There is no data, it is too old, or its transform is not available.

        """
        reason = self._locate(now)
        for key, data in list(self._located.items()):
            if self._is_old(data, now) and (len(self._located) > 1 or reason is not None):
                del self._located[key]
        newest = max(self._located.values(), key=lambda data: data.stamp, default=None)
        if newest is None:
            if self.timeout_s == 0.0:
                return np.empty((0, 2))
            topic = self._told.current.topic
            raise SourceInvalid(
                reason
                or self._fault
                or f"No data of '{self.name}' has been received on '{topic}' yet."
            )
        if self._is_old(newest, now):
            age_s = (now - newest.stamp).nanoseconds * 1e-9
            raise SourceInvalid(
                f"The newest data of '{self.name}' is {age_s:.1f} s old, but its source_timeout "
                f'is {self.timeout_s:g} s.'
            )
        points = np.concatenate([data.points for data in self._located.values()])
        return np.asarray(points @ base_from_fixed[:2, :3].T + base_from_fixed[:2, 3])

    def _is_old(self, data: _Data, now: Time) -> bool:
        limit = self.timeout_s
        return limit > 0.0 and abs((now - data.stamp).nanoseconds) * 1e-9 > limit

    def _receive(self, message: Any) -> None:
        """Store a message; it is converted when its points are needed."""
        if self._node.is_active:
            is_polygon = isinstance(message, PolygonInstanceStamped)
            self._new[message.polygon.id if is_polygon else 0] = message

    def _converted(self, message: Any) -> _Data:
        clock = self._node.get_clock()
        stamp = Time.from_msg(message.header.stamp, clock_type=clock.clock_type)
        if not stamp.nanoseconds:
            stamp = clock.now()
        return _Data(stamp, message.header.frame_id, self._points_of(message))

    def _points_of(self, message: Any) -> FloatArray:
        current = self._told.current
        if current.kind == 'scan':
            return points_of_scan(
                message.ranges,
                message.angle_min,
                message.angle_increment,
                message.range_min,
                message.range_max,
            )
        if current.kind == 'pointcloud':
            return points_of_cloud(message)
        if current.kind == 'range':
            return points_of_range(
                message.range,
                message.field_of_view,
                message.min_range,
                message.max_range,
                current.obstacles_angle,
            )
        corners = np.array([(p.x, p.y) for p in message.polygon.polygon.points]).reshape(-1, 2)
        return points_of_polygon(corners, current.sampling_distance)

    def _locate(self, now: Time) -> str | None:
        """Transform new data to the fixed frame; return the error message if impossible."""
        reason = None
        for key, data in list(self._new.items()):
            try:
                if not isinstance(data, _Data):
                    data = self._new[key] = self._converted(data)
                points = self._placed(data)
            except ValueError as error:
                self._fault = f"The data of '{self.name}' cannot be used. {error}"
                del self._new[key]
                continue
            except TransformException as error:
                reason = f"The pose of '{self.name}' at the time of its data is unknown: {error}"
                if self._is_old(data, now):
                    del self._new[key]
                continue
            del self._new[key]
            self._located[key], self._fault = _Data(data.stamp, self._frame, points), None
        return reason

    def _placed(self, data: _Data) -> FloatArray:
        points = data.points
        current = self._told.current
        if current.kind == 'pointcloud':
            heights = transformed(points, self._matrix(self._common.base_frame_id, data))[:, 2]
            points = points[(heights >= current.min_height) & (heights <= current.max_height)]
        return transformed(points, self._matrix(self._frame, data))

    def _matrix(self, target: str, data: _Data) -> FloatArray:
        """Look up the transform at the time of the data, or the newest if its time is close."""
        buffer = self._node.transforms.buffer
        try:
            return matrix_of(buffer.lookup_transform(target, data.frame, data.stamp))
        except TransformException:
            newest = buffer.lookup_transform(target, data.frame, Time())
            stamp = Time.from_msg(newest.header.stamp, clock_type=data.stamp.clock_type)
            late_s = abs((data.stamp - stamp).nanoseconds) * 1e-9
            if stamp.nanoseconds and late_s > self._common.transform_tolerance:
                raise
            return matrix_of(newest)


class Sources:
    """
    All sensors of a node.

    Parameters
    ----------
    node
        The node that subscribes.
    common
        The node's parameters.

    Raises
    ------
    ConfigurationError
        `observation_sources` names no sensor, or a sensor is misconfigured.

    """

    def __init__(self, node: LifecycleNode, common: CommonParameters) -> None:
        if not common.observation_sources:
            raise ConfigurationError(
                "The parameter 'observation_sources' must name at least one sensor."
            )
        self._node, self._common = node, common
        self.all = [Source(node, name, common) for name in common.observation_sources]

    def points(self) -> tuple[dict[str, FloatArray], dict[str, str]]:
        """Return the points of each enabled sensor, and the error messages of the others."""
        found: dict[str, FloatArray] = {}
        invalid: dict[str, str] = {}
        enabled = [source for source in self.all if source.is_enabled]
        try:
            matrix = self._base_from_fixed()
        except TransformException as error:
            reason = f'The pose of the robot is unknown: {error}'
            return {}, {source.name: reason for source in enabled}
        now = self._node.get_clock().now()
        for source in enabled:
            try:
                found[source.name] = source.points(now, matrix)
            except SourceInvalid as error:
                invalid[source.name] = str(error)
        return found, invalid

    def _base_from_fixed(self) -> FloatArray:
        if not self._common.base_shift_correction:
            return np.eye(3, 4)
        base, odom = self._common.base_frame_id, self._common.odom_frame_id
        return matrix_of(self._node.transforms.buffer.lookup_transform(base, odom, Time()))


def matrix_of(transform: TransformStamped) -> FloatArray:
    """
    Convert a transform to a matrix.

    Parameters
    ----------
    transform
        As tf2 returns it; its quaternion is assumed to be normalised.

    Returns
    -------
    numpy.ndarray
        Rotation and translation in m (3, 4), from the child frame to the parent frame.

    """
    moved, turned = transform.transform.translation, transform.transform.rotation
    x, y, z, w = turned.x, turned.y, turned.z, turned.w
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), moved.x],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), moved.y],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), moved.z],
        ]
    )


def _timeout(node: LifecycleNode, name: str, default_s: float) -> float:
    value = node.parameters.declare_value(
        f'{name}.source_timeout', default_s, 'How old its data may be (s); 0 for any age.'
    )
    if not 0.0 <= value < float('inf'):
        raise ConfigurationError(
            f"The parameter '{name}.source_timeout' must be at least 0, but is {value}."
        )
    return float(value)
