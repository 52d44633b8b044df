# SPDX-License-Identifier: Apache-2.0
"""The node that reports which zones contain obstacles, without changing velocities."""

from __future__ import annotations

from typing import Any

from nav2_collision_monitor.actions import is_occupied
from nav2_collision_monitor.markers import PointMarkers
from nav2_collision_monitor.parameters import CollisionDetectorParameters
from nav2_collision_monitor.polygons import make_zones, MonitoredZone
from nav2_collision_monitor.sources import Sources
from nav2_msgs.msg import CollisionDetectorState
from nav2_util import ConfigurationError, LifecycleNode, ParameterSet
from nav2_util.timing import clock_of
from nav2_util.twist import Velocity
import numpy as np
from rclpy.timer import Timer

__all__ = ['CollisionDetector']


class CollisionDetector(LifecycleNode):
    """
    Node that publishes on `collision_detector_state` which zones contain obstacles.

    Parameters
    ----------
    node_name, options
        As for `LifecycleNode`.

    """

    def __init__(self, node_name: str = 'collision_detector', **options: Any) -> None:
        super().__init__(node_name, **options)
        self._told: ParameterSet[CollisionDetectorParameters]
        self._sources: Sources
        self._zones: list[MonitoredZone] = []
        self._markers: PointMarkers
        self._publisher: Any = None
        self._timer: Timer | None = None

    def configure(self) -> None:
        """Read the parameters; create zones, sensors and publishers."""
        self._told = self.parameters.declare(CollisionDetectorParameters)
        current = self._told.current
        self._zones = make_zones(self, current, ('none',))
        for zone in self._zones:
            if zone.parameters.current.kind == 'velocity_polygon':
                raise ConfigurationError(
                    f"The polygon '{zone.name}' is a velocity_polygon; the collision detector "
                    'does not know the velocity. Use polygon or circle.'
                )
        self._sources = Sources(self, current)
        self._markers = PointMarkers(self, current.base_frame_id)
        self._publisher = self.create_publisher(
            CollisionDetectorState, 'collision_detector_state', 10
        )
        _ = self.transforms  # subscribes from now on

    def activate(self) -> None:
        """Start the detection."""
        period_s = 1.0 / self._told.current.frequency
        self._timer = self.create_timer(period_s, self._detect, clock=clock_of(self))

    def deactivate(self) -> None:
        """Stop the detection."""
        if self._timer is not None:
            self.destroy_timer(self._timer)
            self._timer = None

    def cleanup(self) -> None:
        """Release the zones."""
        for zone in self._zones:
            zone.close()
        self._zones = []

    def _detect(self) -> None:
        points, invalid = self._sources.points()
        for reason in invalid.values():
            self.get_logger().warning(reason, throttle_duration_sec=5.0)
        state = CollisionDetectorState()
        for each in self._zones:
            zone = each.zone(Velocity()) if each.is_enabled else None
            if zone is not None:
                found = [points[name] for name in each.sources if name in points]
                seen = np.concatenate(found) if found else np.empty((0, 2))
                state.polygons.append(each.name)
                state.detections.append(is_occupied(zone, seen))
        self._publisher.publish(state)
        self._markers.publish(points)
        for each in self._zones:
            each.publish()
