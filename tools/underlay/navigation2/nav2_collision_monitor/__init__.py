# SPDX-License-Identifier: Apache-2.0
"""Collision monitor: stops the robot or slows it down near obstacles that sensors detect."""

from nav2_collision_monitor.actions import (
    act_in_zone,
    Action,
    ActionType,
    collision_time,
    most_careful,
    Zone,
)
from nav2_collision_monitor.collision_detector_node import CollisionDetector
from nav2_collision_monitor.collision_monitor_node import CollisionMonitor
from nav2_collision_monitor.shapes import Circle, parse_points, Polygon

__all__ = [
    'Action',
    'ActionType',
    'Circle',
    'CollisionDetector',
    'CollisionMonitor',
    'Polygon',
    'Zone',
    'act_in_zone',
    'collision_time',
    'most_careful',
    'parse_points',
]
