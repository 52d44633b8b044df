# SPDX-License-Identifier: Apache-2.0
"""The nodes of slam_toolbox: scans in, map, pose and transforms out; and their main functions."""

from __future__ import annotations

from collections.abc import Callable
import math
from typing import Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav2_util import ConfigurationError, LifecycleNode, ParameterSet
from nav2_util.geometry import yaw_of
from nav2_util.main import main
from nav2_util.timing import STEADY
from nav_msgs.msg import MapMetaData, OccupancyGrid
import numpy as np
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, qos_profile_sensor_data, QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from rclpy.timer import Timer
from sensor_msgs.msg import LaserScan
from slam_toolbox_py.conversions import (
    make_graph_markers,
    make_map,
    make_placement,
    make_transform,
)
from slam_toolbox_py.parameters import settings_of, SlamParameters, UNSUPPORTED
from slam_toolbox_py.poses import FloatArray
from slam_toolbox_py.scan_intake import project, ScanIntake, TimedScan
from slam_toolbox_py.services import SlamServices
from slam_toolbox_py.session import Session, SessionSettings
from slam_toolbox_py.storage import PoseGraphFileError
from tf2_ros import TransformBroadcaster
from visualization_msgs.msg import MarkerArray

__all__ = [
    'AsynchronousSlamToolbox',
    'LocalizationSlamToolbox',
    'SlamToolbox',
    'SynchronousSlamToolbox',
]

_WORK_PERIOD_S = 0.05
_WORK_AT_ONCE_S = 0.015
_QUIET_S = 5.0
_LEVEL_RAD = 0.15
_LATCHED = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)


class SlamToolbox(LifecycleNode):
    """
    Node that builds a map from laser scans, and localizes the robot in it.

    Parameters
    ----------
    node_name, options
        As for `LifecycleNode`.

    """

    only_localizes = False
    """Whether the loaded map is left unchanged."""
    keeps_all_scans = False
    """Whether every scan is processed, in order, instead of the newest one only."""

    def __init__(self, node_name: str = 'slam_toolbox', **options: Any) -> None:
        super().__init__(node_name, **options)
        self.told: ParameterSet[SlamParameters]
        self.session: Session
        self.is_paused = False
        """Whether new scans are ignored."""
        self.offered: SlamServices
        self._out: dict[str, Any] = {}
        self._broadcaster: Any = None
        self._intake: ScanIntake | None = None
        self._active: list[tuple[str, Any]] = []
        self._count = 0
        self._stamp: Any = None

    def configure(self) -> None:
        """Read the parameters, load a map if one is given, and offer the services."""
        self.parameters.declare_unsupported(UNSUPPORTED)
        self.told = self.parameters.declare(SlamParameters)
        told = self.told.current
        if told.enable_interactive_mode:
            self.get_logger().warning('No interactive mode: keyframes cannot be moved by hand.')
        self.session = Session(_session_settings(told), self.get_logger().info)
        self.told.on_change = lambda new: self.session.change(_session_settings(new))
        self.is_paused, self._count, self._stamp = False, 0, None
        self._load()
        self._out = {
            'map': self.create_publisher(OccupancyGrid, told.map_name, _LATCHED),
            'size': self.create_publisher(MapMetaData, f'{told.map_name}_metadata', _LATCHED),
            'pose': self.create_publisher(PoseWithCovarianceStamped, 'pose', 10),
            'graph': self.create_publisher(MarkerArray, 'slam_toolbox/graph_visualization', 1),
        }
        self._broadcaster = TransformBroadcaster(self)
        self.offered = SlamServices(self, told.use_map_saver)

    def activate(self) -> None:
        """Subscribe to scans."""
        told = self.told.current
        self._intake = ScanIntake(
            self.transforms.buffer,
            told.odom_frame,
            told.base_frame,
            self.keeps_all_scans,
            lambda text: self.get_logger().warning(text, throttle_duration_sec=_QUIET_S),
        )
        self._active = [
            (
                'subscription',
                self.create_subscription(
                    LaserScan, told.scan_topic, self._on_scan, qos_profile_sensor_data
                ),
            ),
            ('timer', self._timer(_WORK_PERIOD_S, self._if_active(self._work))),
            (
                'timer',
                self.create_timer(told.map_update_interval, self._if_active(self._update_map)),
            ),
        ]
        if told.transform_publish_period > 0.0:
            period = told.transform_publish_period
            publish = self._if_active(self._publish_transform)
            self._active.append(('timer', self.create_timer(period, publish)))
        self.session.draw(self._publish_map)

    def deactivate(self) -> None:
        """Unsubscribe from scans; the map is kept."""
        for kind, each in self._active:
            getattr(self, f'destroy_{kind}')(each)
        self._active, self._intake = [], None

    def _if_active(self, callback: Callable[[], None]) -> Callable[[], None]:
        """Wrap a timer callback, to do nothing if it is called after deactivation."""

        def call() -> None:
            if self._active:
                callback()

        return call

    def restart(self) -> None:
        """Start over after the map was replaced: clear the queue, and publish the new map."""
        self._stamp = None
        self.clear_queue()
        self.session.draw(self._publish_map)

    def clear_queue(self) -> int:
        """Drop all queued scans; return their number."""
        return 0 if self._intake is None else self._intake.clear()

    def start_pose(self) -> FloatArray | None:
        """Return the pose of the robot in a loaded map, (3,); None for the origin of that map."""
        given = self.told.current.map_start_pose
        if not given:
            return None
        if len(given) != 3:
            raise ConfigurationError(
                "The parameter 'map_start_pose' must be [x, y, yaw] in m and rad, but is "
                f'{list(given)}.'
            )
        return np.array(given, dtype=float)

    @property
    def _takes_scans(self) -> bool:
        has_map = not self.only_localizes or self.session.localizer is not None
        return has_map and not self.is_paused

    def _load(self) -> None:
        name = self.told.current.map_file_name
        start = self.start_pose()
        if not name:
            return
        try:
            self.session.load(name, start, self.only_localizes)
        except PoseGraphFileError as error:
            raise ConfigurationError(f"The parameter 'map_file_name': {error}") from error
        count = len(self.session.mapper.keyframes)
        self.get_logger().info(f"Loaded the map '{name}' with {count} keyframes.")

    def _timer(self, period_s: float, callback: Any) -> Timer:
        """Create a timer of the steady clock: work continues while simulated time is paused."""
        return self.create_timer(period_s, callback, clock=STEADY)

    def _on_scan(self, message: LaserScan) -> None:
        self._count += 1
        if self._intake is None or not self._takes_scans:
            return
        if (self._count - 1) % self.told.current.throttle_scans == 0:
            self._intake.offer(message)

    def _work(self) -> None:
        """Process a scan whose transforms are available; continue loop closure and map drawing."""
        if self._intake is not None and self._takes_scans:
            now_s = self.get_clock().now().nanoseconds * 1e-9
            timed = self._intake.next_scan(now_s, self.told.current.transform_timeout)
            if timed is not None:
                self._process(timed)
        self.session.work(_WORK_AT_ONCE_S)

    def _process(self, timed: TimedScan) -> None:
        told = self.told.current
        is_first = self.session.map_to_odom is None
        stamp = self._stamp = timed.message.header.stamp
        if timed.tilt_rad > _LEVEL_RAD:
            self.get_logger().warning(
                f'Scans are ignored: the scanner is tilted by {math.degrees(timed.tilt_rad):.0f} '
                f'degrees; the limit is {math.degrees(_LEVEL_RAD):.0f}. Has the robot fallen?',
                throttle_duration_sec=_QUIET_S,
            )
            return
        placement = self.session.process(
            timed.odometry,
            timed.stamp_s,
            lambda: project(timed, told.min_laser_range, told.max_laser_range),
        )
        if placement is None:
            return
        if told.debug_logging:
            self.get_logger().info(f'Placed a scan; its response is {placement.response:.2f}.')
        scales = told.position_covariance_scale, told.yaw_covariance_scale
        self._out['pose'].publish(make_placement(placement, told.map_frame, stamp, *scales))
        if is_first:
            self._publish_transform()
            self.session.draw(self._publish_map)

    def _publish_transform(self) -> None:
        told, pose = self.told.current, self.session.map_to_odom
        if pose is None or self._stamp is None:
            return
        kind = self.get_clock().clock_type
        time = self.get_clock().now() if told.restamp_tf else Time.from_msg(self._stamp, kind)
        stamp = (time + Duration(seconds=told.transform_timeout)).to_msg()
        transform = make_transform(pose, told.map_frame, told.odom_frame, stamp)
        self._broadcaster.sendTransform(transform)

    def _update_map(self) -> None:
        self.session.draw(self._publish_map)
        graph = self._out['graph']
        if graph.get_subscription_count():
            stamp = self.get_clock().now().to_msg()
            frame = self.told.current.map_frame
            graph.publish(make_graph_markers(self.session.mapper.graph, frame, stamp))

    def _publish_map(self) -> None:
        grid = self.session.grid()
        if grid is None:
            return
        stamp = self.get_clock().now().to_msg()
        message = make_map(grid, self.told.current.map_frame, stamp)
        self._out['map'].publish(message)
        self._out['size'].publish(message.info)


def _session_settings(told: SlamParameters) -> SessionSettings:
    return SessionSettings(
        mapper=settings_of(told),
        minimum_time_interval_s=told.minimum_time_interval,
        enough_travel=1.0 if told.check_min_dist_and_heading_precisely else 0.9,
        resolution_m=told.resolution,
        min_pass_through=told.min_pass_through,
        occupancy_threshold=told.occupancy_threshold,
    )


class AsynchronousSlamToolbox(SlamToolbox):
    """Node that processes the newest scan, and drops those that arrived while it was busy."""


class SynchronousSlamToolbox(SlamToolbox):
    """Node that processes every scan in order, however long that takes: for recorded data."""

    keeps_all_scans = True

    def configure(self) -> None:
        """Also offer the service that clears the scan queue."""
        super().configure()
        self.offered.offer_clear_queue()


class LocalizationSlamToolbox(SlamToolbox):
    """Node that localizes in a map from `map_file_name` or the service `deserialize_map`."""

    only_localizes = True

    def configure(self) -> None:
        """Also subscribe to initial pose estimates."""
        super().configure()
        self.offered.offer_clear_localization_buffer()
        self.create_subscription(
            PoseWithCovarianceStamped, 'initialpose', self._on_initial_pose, 10
        )

    def activate(self) -> None:
        """Warn if there is no map yet."""
        super().activate()
        if self.session.localizer is None:
            self.get_logger().warning(
                "There is no map to localize in. Set the parameter 'map_file_name', or call "
                "'slam_toolbox/deserialize_map'."
            )

    def _on_initial_pose(self, message: PoseWithCovarianceStamped) -> None:
        frame, pose = message.header.frame_id, message.pose.pose
        if frame != self.told.current.map_frame:
            self.get_logger().error(
                f"The initial pose is in '{frame}'. Give it in '{self.told.current.map_frame}'."
            )
        elif self.session.localizer is None:
            self.get_logger().error('There is no map yet, so the initial pose is ignored.')
        else:
            position = pose.position
            self.session.localizer.start_at(
                np.array([position.x, position.y, yaw_of(pose.orientation)])
            )


def run_asynchronous() -> int:
    """Run async_slam_toolbox_node; return the exit status."""
    return main(AsynchronousSlamToolbox)


def run_synchronous() -> int:
    """Run sync_slam_toolbox_node; return the exit status."""
    return main(SynchronousSlamToolbox)


def run_localization() -> int:
    """Run localization_slam_toolbox_node; return the exit status."""
    return main(LocalizationSlamToolbox)
