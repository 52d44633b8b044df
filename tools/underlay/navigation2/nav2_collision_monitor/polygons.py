# SPDX-License-Identifier: Apache-2.0
"""The zones of a node: their parameters, and their shapes from parameters or topics."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import Point32, PolygonStamped
from nav2_collision_monitor.actions import ActionType, Zone
from nav2_collision_monitor.parameters import (
    CommonParameters,
    PolygonParameters,
    VelocityPolygonParameters,
)
from nav2_collision_monitor.shapes import (
    checked_corners,
    choose_polygon,
    Circle,
    FloatArray,
    parse_points,
    Polygon,
    Shape,
    VelocityPolygon,
)
from nav2_util import ConfigurationError, LifecycleNode, Pose2D, TransformError
from nav2_util.twist import Velocity
import numpy as np
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from std_msgs.msg import Float32

__all__ = ['MonitoredZone', 'make_zones']

_ACTIONS = {
    'stop': ActionType.STOP,
    'slowdown': ActionType.SLOWDOWN,
    'limit': ActionType.LIMIT,
    'approach': ActionType.APPROACH,
    'none': ActionType.DO_NOTHING,
}

_FIXED = {
    'type': 'kind',
    'action_type': 'action_type',
    'polygon_sub_topic': 'polygon_sub_topic',
    'polygon_subscribe_transient_local': 'polygon_subscribe_transient_local',
    'footprint_topic': 'footprint_topic',
    'visualize': 'visualize',
    'velocity_polygons': 'velocity_polygons',
}
"""Parameters that only take effect when a node is configured, and their attributes."""


class MonitoredZone:
    """
    Zone that is defined by parameters; its shape may come from a topic.

    Parameters
    ----------
    node
        The node with the subscription and the publisher.
    name
        The name of the zone, the prefix of its parameters.
    common
        The node's parameters.

    """

    def __init__(self, node: LifecycleNode, name: str, common: CommonParameters) -> None:
        self.name, self._node, self._common = name, node, common
        self.parameters = node.parameters.declare(PolygonParameters, prefix=name)
        self.parameters.on_change = None
        current = self.parameters.current
        for needed, value in (('type', current.kind), ('action_type', current.action_type)):
            if not value:
                raise ConfigurationError(
                    f"The polygon '{name}' needs the parameter '{name}.{needed}'."
                )
        node.parameters.declare_unsupported(
            {'max_points': "it is now named 'min_points', and is one greater"}, prefix=name
        )
        self.sources = _sources_of(node, name, common)
        self._shape: Shape | None = None
        self._moving: tuple[str, FloatArray] | None = None
        self._by_velocity: list[VelocityPolygon] = []
        self._prepare_shape(current)
        topic = node.parameters.declare_value(
            f'{name}.polygon_pub_topic', name, 'Where to publish the shape.'
        )
        self._publisher = (
            node.create_publisher(PolygonStamped, topic, 1) if current.visualize else None
        )
        self.parameters.on_change = self._change

    @property
    def is_enabled(self) -> bool:
        """Whether the zone is enabled."""
        return self.parameters.current.enabled

    def zone(self, command: Velocity) -> Zone | None:
        """
        Take a snapshot of the zone, with its current shape and parameters.

        Parameters
        ----------
        command
            The commanded velocity in the base frame, which selects a velocity polygon.

        Returns
        -------
        Zone or None
            None while its shape is unknown.

        """
        shape = self._shape_now(command)
        if shape is None:
            return None
        now = self.parameters.current
        return Zone(
            self.name,
            _ACTIONS[now.action_type],
            shape,
            now.min_points,
            now.slowdown_ratio,
            now.linear_limit,
            now.angular_limit,
            now.time_before_collision,
            now.simulation_time_step,
        )

    def publish(self) -> None:
        """Publish the shape, if enabled and if there are subscribers."""
        if self._publisher is None or not self._publisher.get_subscription_count():
            return
        shape = self._shape_now(None)
        if shape is not None:
            message = PolygonStamped()
            message.header.frame_id = self._common.base_frame_id
            message.header.stamp = self._node.get_clock().now().to_msg()
            message.polygon.points = [Point32(x=float(x), y=float(y)) for x, y in shape.outline]
            self._publisher.publish(message)

    def close(self) -> None:
        """Unlock all parameters, for the next configuration."""
        self.parameters.on_change = None

    def _change(self, new: PolygonParameters) -> None:
        """Apply a changed shape; raise ValueError for parameters that cannot be changed now."""
        old = self.parameters.current
        for name, attribute in _FIXED.items():
            if getattr(new, attribute) != getattr(old, attribute):
                raise ValueError(
                    f"'{self.name}.{name}' takes effect only when the node is configured: "
                    'clean it up, set it, and configure it again.'
                )
        if new.kind == 'polygon' and new.points != old.points:
            try:
                self._shape = Polygon(parse_points(new.points))
            except ValueError as error:
                raise ValueError(f"The points of '{self.name}' {error}.") from error
            self._moving = None
        elif new.kind == 'circle' and new.radius != old.radius:
            if new.radius <= 0.0:
                raise ValueError(f"The radius of '{self.name}' must be more than 0.")
            self._shape = Circle(new.radius)

    def _prepare_shape(self, current: PolygonParameters) -> None:
        if current.kind == 'velocity_polygon':
            self._by_velocity = _velocity_polygons(self._node, self.name, current)
        elif current.kind == 'circle':
            self._prepare_circle(current)
        elif current.points:
            self._shape = _polygon(self.name, current.points)
        elif current.action_type == 'approach' and current.footprint_topic:
            self._subscribe(PolygonStamped, current.footprint_topic, self._on_footprint)
        elif current.polygon_sub_topic:
            self._subscribe(PolygonStamped, current.polygon_sub_topic, self._on_polygon)
        else:
            raise ConfigurationError(
                f"The polygon '{self.name}' has no shape: set '{self.name}.points', or the topic "
                f"'{self.name}.polygon_sub_topic'."
            )

    def _prepare_circle(self, current: PolygonParameters) -> None:
        if current.radius > 0.0:
            self._shape = Circle(current.radius)
        elif current.polygon_sub_topic:
            self._subscribe(Float32, current.polygon_sub_topic, self._on_radius)
        else:
            raise ConfigurationError(
                f"The circle '{self.name}' has no radius: set '{self.name}.radius', or the topic "
                f"'{self.name}.polygon_sub_topic'."
            )

    def _subscribe(self, kind: Any, topic: str, callback: Any) -> None:
        qos = QoSProfile(depth=1)
        if self.parameters.current.polygon_subscribe_transient_local:
            qos.durability = DurabilityPolicy.TRANSIENT_LOCAL
        self._node.create_subscription(kind, topic, callback, qos)

    def _shape_now(self, command: Velocity | None) -> Shape | None:
        if self._moving is not None:
            frame, corners = self._moving
            try:
                self._shape = Polygon(self._in_base(frame, corners, None))
            except TransformError as error:
                self._warn(f"The polygon '{self.name}' stays where it was. {error}")
        elif self._by_velocity and command is not None:
            is_holonomic = self.parameters.current.holonomic
            chosen = choose_polygon(self._by_velocity, command, is_holonomic)
            if chosen is not None:
                self._shape = chosen.shape
            else:
                self._warn(
                    f"No velocity polygon of '{self.name}' covers the velocity x {command.x:.3g}, "
                    f'y {command.y:.3g} m/s, yaw rate {command.yaw:.3g} rad/s; the previous one '
                    'is kept.'
                )
        if self._shape is None:
            self._warn(f"The shape of '{self.name}' is not known yet; the zone has no effect.")
        return self._shape

    def _on_radius(self, message: Float32) -> None:
        if 0.0 < message.data < float('inf'):
            self._shape = Circle(float(message.data))
        else:
            self._warn(f"Ignored a radius of '{self.name}' that is {message.data}.")

    def _on_polygon(self, message: PolygonStamped) -> None:
        corners = self._corners_of(message)
        if corners is not None:
            self._moving = message.header.frame_id or self._common.base_frame_id, corners

    def _on_footprint(self, message: PolygonStamped) -> None:
        corners = self._corners_of(message)
        if corners is None:
            return
        stamp = Time.from_msg(message.header.stamp, clock_type=self._node.get_clock().clock_type)
        try:
            corners = self._in_base(message.header.frame_id, corners, stamp)
        except TransformError:
            try:
                corners = self._in_base(message.header.frame_id, corners, None)
            except TransformError as error:
                self._warn(f"The footprint of '{self.name}' cannot be used. {error}")
                return
        self._shape = Polygon(corners)

    def _corners_of(self, message: PolygonStamped) -> FloatArray | None:
        points = np.array([(p.x, p.y) for p in message.polygon.points], dtype=np.float64)
        try:
            return checked_corners(points.reshape(-1, 2))
        except ValueError as error:
            self._warn(f"Ignored a shape of '{self.name}': the points {error}.")
            return None

    def _in_base(self, frame: str, corners: FloatArray, time: Time | None) -> FloatArray:
        base = self._common.base_frame_id
        if frame == base:
            return corners
        pose: Pose2D = self._node.transforms.pose_of(frame, base, time)
        cos, sin = np.cos(pose.yaw), np.sin(pose.yaw)
        return np.asarray(corners @ np.array([[cos, sin], [-sin, cos]]) + pose[:2])

    def _warn(self, text: str) -> None:
        self._node.get_logger().warning(text, throttle_duration_sec=5.0)


def make_zones(
    node: LifecycleNode, common: CommonParameters, allowed: tuple[str, ...]
) -> list[MonitoredZone]:
    """
    Make the zones that the parameters of a node define.

    Parameters
    ----------
    node, common
        The node and its parameters.
    allowed
        The allowed action types of its zones.

    Raises
    ------
    ConfigurationError
        There is no zone, or a zone is misconfigured.

    """
    if not common.polygons:
        raise ConfigurationError("The parameter 'polygons' must name at least one zone.")
    zones = [MonitoredZone(node, name, common) for name in common.polygons]
    for zone in zones:
        kind = zone.parameters.current.action_type
        if kind not in allowed:
            raise ConfigurationError(
                f"The parameter '{zone.name}.action_type' must be one of {', '.join(allowed)} "
                f"in this node, but is '{kind}'."
            )
    return zones


def _sources_of(node: LifecycleNode, name: str, common: CommonParameters) -> list[str]:
    sources = node.parameters.declare_value(
        f'{name}.sources_names', common.observation_sources, 'Which sensors it heeds.'
    )
    for each in sources:
        if each not in common.observation_sources:
            raise ConfigurationError(
                f"'{name}.sources_names' has '{each}', which is not one of the "
                f'observation_sources: {", ".join(common.observation_sources)}.'
            )
    return list(sources)


def _polygon(name: str, text: str) -> Polygon:
    try:
        return Polygon(parse_points(text))
    except ValueError as error:
        raise ConfigurationError(f"The points of '{name}' {error}.") from error


def _velocity_polygons(
    node: LifecycleNode, name: str, current: PolygonParameters
) -> list[VelocityPolygon]:
    if not current.velocity_polygons:
        raise ConfigurationError(
            f"The parameter '{name}.velocity_polygons' must name at least one polygon."
        )
    polygons = []
    for each in current.velocity_polygons:
        full = f'{name}.{each}'
        values = node.parameters.declare(VelocityPolygonParameters, prefix=full).current
        for low, high in (('linear_min', 'linear_max'), ('theta_min', 'theta_max')):
            if getattr(values, low) > getattr(values, high):
                raise ConfigurationError(
                    f"The parameter '{full}.{low}' must be at most '{full}.{high}'."
                )
        polygons.append(
            VelocityPolygon(
                each,
                _polygon(full, values.points),
                values.linear_min,
                values.linear_max,
                values.theta_min,
                values.theta_max,
                values.direction_start_angle,
                values.direction_end_angle,
            )
        )
    return polygons
