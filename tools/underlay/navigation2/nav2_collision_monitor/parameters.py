# SPDX-License-Identifier: Apache-2.0
"""The parameters of the collision monitor and the collision detector."""

from __future__ import annotations

from dataclasses import dataclass
import math

from nav2_util import parameter

__all__ = [
    'CollisionDetectorParameters',
    'CollisionMonitorParameters',
    'CommonParameters',
    'PolygonParameters',
    'SourceParameters',
    'VelocityPolygonParameters',
]


@dataclass(frozen=True)
class CommonParameters:
    """Parameters that both nodes share."""

    base_frame_id: str = parameter('base_footprint', 'The frame of the robot.')
    odom_frame_id: str = parameter('odom', 'The frame in which the robot moves smoothly.')
    transform_tolerance: float = parameter(
        0.1, 'How far the time of a transform may be from that of the data (s).', low=0.0
    )
    source_timeout: float = parameter(
        2.0, 'How old data of sources may be (s); 0 for any age.', low=0.0
    )
    base_shift_correction: bool = parameter(
        True, 'Whether to account for the motion of the robot since the data was measured.'
    )
    polygons: list[str] = parameter([], 'The names of the zones.')
    observation_sources: list[str] = parameter([], 'The names of the sensors.')


@dataclass(frozen=True)
class CollisionMonitorParameters(CommonParameters):
    """Parameters of the collision monitor."""

    cmd_vel_in_topic: str = parameter('cmd_vel_smoothed', 'Where commands come from.')
    cmd_vel_out_topic: str = parameter('cmd_vel', 'Where safe velocities go.')
    state_topic: str = parameter('', 'Where to publish what is done; empty for nowhere.')
    stop_pub_timeout: float = parameter(
        1.0, 'After this long at rest (s) nothing more is published.', low=0.0
    )
    enable_stamped_cmd_vel: bool = parameter(
        False, 'Whether velocities in and out are TwistStamped instead of Twist.', read_only=True
    )


@dataclass(frozen=True)
class CollisionDetectorParameters(CommonParameters):
    """Parameters of the collision detector."""

    frequency: float = parameter(10.0, 'States a second.', low=0.1, high=1000.0)


@dataclass(frozen=True)
class PolygonParameters:
    """Parameters of a zone, `<name>.*`."""

    kind: str = parameter(
        '', 'What shape it has.', choices=('polygon', 'circle', 'velocity_polygon'), name='type'
    )
    action_type: str = parameter(
        '',
        'What is done when points are inside.',
        choices=('stop', 'slowdown', 'limit', 'approach', 'none'),
    )
    points: str = parameter('', 'Its corners as "[[x, y], ...]" in m in the base frame.')
    polygon_sub_topic: str = parameter('', 'Where its shape comes from, without points.')
    polygon_subscribe_transient_local: bool = parameter(
        False, 'Whether that topic keeps its last message for late subscribers.'
    )
    footprint_topic: str = parameter(
        'local_costmap/published_footprint',
        'Where the shape of a polygon with action_type approach comes from, without points.',
    )
    radius: float = parameter(0.0, 'The radius of a circle (m).', low=0.0)
    min_points: int = parameter(4, 'How many points inside trigger the action.', low=1)
    slowdown_ratio: float = parameter(0.5, 'The part of the speed that is left.', low=0, high=1)
    linear_limit: float = parameter(0.5, 'The greatest speed for limit (m/s).', low=0.0)
    angular_limit: float = parameter(0.5, 'The greatest turn rate for limit (rad/s).', low=0.0)
    time_before_collision: float = parameter(
        2.0, 'The time to keep until a collision, for approach (s).', low=0.0, high=1000.0
    )
    simulation_time_step: float = parameter(
        0.1, 'The step in which approach looks ahead (s).', low=0.001
    )
    visualize: bool = parameter(False, 'Whether to publish the shape.')
    enabled: bool = parameter(True, 'Whether the zone counts.')
    holonomic: bool = parameter(False, 'Whether the robot moves sideways (velocity_polygon).')
    velocity_polygons: list[str] = parameter([], 'The names of its polygons by velocity.')


@dataclass(frozen=True)
class VelocityPolygonParameters:
    """Parameters of a polygon for a range of velocities, `<zone>.<name>.*`."""

    points: str = parameter('', 'Its corners as "[[x, y], ...]" in m in the base frame.')
    linear_min: float = parameter(0.0, 'The least linear velocity (m/s).')
    linear_max: float = parameter(0.0, 'The greatest linear velocity (m/s).')
    theta_min: float = parameter(0.0, 'The least turn rate (rad/s).')
    theta_max: float = parameter(0.0, 'The greatest turn rate (rad/s).')
    direction_start_angle: float = parameter(
        -math.pi, 'Where the range of directions begins, if holonomic (rad).'
    )
    direction_end_angle: float = parameter(
        math.pi, 'Where the range of directions ends, if holonomic (rad).'
    )


@dataclass(frozen=True)
class SourceParameters:
    """Parameters of a sensor, `<name>.*`."""

    kind: str = parameter(
        '',
        'What it publishes.',
        choices=('scan', 'pointcloud', 'range', 'polygon'),
        name='type',
    )
    topic: str = parameter('scan', 'Where its data comes from.')
    enabled: bool = parameter(True, 'Whether the sensor counts.')
    min_height: float = parameter(0.05, 'The lowest points of a cloud that count (m).')
    max_height: float = parameter(0.5, 'The highest points of a cloud that count (m).')
    obstacles_angle: float = parameter(
        math.pi / 180.0, 'The angle between two points of a range (rad).', low=0.001
    )
    sampling_distance: float = parameter(
        0.1, 'The distance of two points along a polygon (m).', low=0.001
    )
