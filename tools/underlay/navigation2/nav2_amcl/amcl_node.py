# SPDX-License-Identifier: Apache-2.0
"""The node `amcl`: localises the robot in the map from laser scans and odometry."""

from __future__ import annotations

import time
from typing import Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav2_amcl.amcl_parameters import AmclParameters, settings_of
from nav2_amcl.clusters import Cluster
from nav2_amcl.conversions import (
    cloud_bytes,
    covariance_of,
    map_of,
    pose_message,
    scan_of,
    transform_message,
)
from nav2_amcl.localizer import DEFAULT_COVARIANCE, Localizer
from nav2_amcl.missing import describe_missing, Inputs, Reminder
from nav2_amcl.scan_queue import LocatedScan, ScanQueue
from nav2_msgs.msg import ParticleCloud
from nav2_msgs.srv import SetInitialPose
from nav2_util import ConfigurationError, LifecycleNode, ParameterSet, Pose2D, TransformError
from nav2_util.geometry import planar_pose
from nav2_util.qos import LATCHED
from nav2_util.timing import steady_clock
from nav_msgs.msg import OccupancyGrid
import numpy as np
from rclpy.duration import Duration
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Empty
from tf2_ros import TransformBroadcaster

__all__ = ['AmclNode']

_LOOK_S = 2.0


class AmclNode(LifecycleNode):
    """
    AMCL node; see `AmclParameters`, and `Localizer` for the algorithm.

    It publishes `amcl_pose`, `particle_cloud` and the transform from the map to odometry,
    subscribes to `scan`, `map` and `initialpose`, and offers `set_initial_pose`,
    `request_nomotion_update` and `reinitialize_global_localization`.

    Parameters
    ----------
    node_name, options
        As for `LifecycleNode`.

    """

    def __init__(self, node_name: str = 'amcl', **options: Any) -> None:
        super().__init__(node_name, **options)
        self._config: ParameterSet[AmclParameters]
        self._localizer: Localizer
        self._scans: ScanQueue | None = None
        self._known: Cluster | None = None
        self._kept_s = self._scan_s = -np.inf
        self._last_scan_ns = 0
        self._has_map = False

    def configure(self) -> None:
        """Create the localizer, topics and services."""
        self._config = self.parameters.declare(AmclParameters)
        values = self._config.current
        try:
            settings = settings_of(values)
        except ValueError as error:
            raise ConfigurationError(f'The parameters are inconsistent: {error}.') from error
        seed = values.random_seed
        random = np.random.default_rng(seed if seed >= 0 else None)
        self._localizer = Localizer(settings, random)
        self._config.on_change = lambda new: self._localizer.use(settings_of(new))
        self._has_map = False
        self._scans = ScanQueue(
            self.transforms, values.odom_frame_id, values.base_frame_id, self._take_scan
        )
        self._reminder = Reminder()
        self._offer(values)

    def activate(self) -> None:
        """Start at the initial pose, or at the last pose of the previous activation."""
        values = self._config.current
        self._scan_s = time.monotonic()
        if self._known is not None and not values.always_reset_initial_pose:
            self._localizer.start_at(Pose2D(*self._known.pose), self._known.covariance)
        elif values.set_initial_pose:
            x, y, yaw = values.initial_pose_x, values.initial_pose_y, values.initial_pose_yaw
            self._localizer.start_at(Pose2D(x, y, yaw), DEFAULT_COVARIANCE)
            self.get_logger().info(f'The initial pose is x {x:.2f}, y {y:.2f}, yaw {yaw:.2f}.')

    def deactivate(self) -> None:
        """Save the pose of the robot; drop queued scans."""
        if self._localizer.estimate is not None and self._config.current.save_pose_rate > 0.0:
            self._known = self._localizer.estimate
        if self._scans is not None:
            self._scans.clear()

    def cleanup(self) -> None:
        """Release the scans; the pose is kept."""
        self._scans = None

    def _offer(self, values: AmclParameters) -> None:
        """Create topics, services, and the timer that reports missing inputs."""
        sensor = qos_profile_sensor_data
        self._poses = self.create_lifecycle_publisher(
            PoseWithCovarianceStamped, 'amcl_pose', LATCHED
        )
        self._clouds = self.create_lifecycle_publisher(ParticleCloud, 'particle_cloud', sensor)
        self._broadcaster = TransformBroadcaster(self)
        self.create_subscription(OccupancyGrid, values.map_topic, self._take_map, LATCHED)
        self.create_subscription(LaserScan, values.scan_topic, self._queue_scan, sensor)
        self.create_subscription(
            PoseWithCovarianceStamped, 'initialpose', self._take_initial_pose, 1
        )
        self.create_service(SetInitialPose, 'set_initial_pose', self._set_initial_pose)
        self.create_service(Empty, 'request_nomotion_update', self._force_update)
        self.create_service(Empty, 'reinitialize_global_localization', self._start_anywhere)
        self.create_timer(_LOOK_S, self._remind, clock=steady_clock())

    def _take_map(self, message: OccupancyGrid) -> None:
        values = self._config.current
        if self._has_map and values.first_map_only:
            return
        try:
            grid = map_of(message)
        except ValueError as error:
            self.get_logger().error(f'Ignored a map: {error}.')
            return
        if message.header.frame_id != values.global_frame_id:
            self.get_logger().warning(
                f"The map is in frame '{message.header.frame_id}', but global_frame_id is "
                f"'{values.global_frame_id}'. Poses are published in the latter."
            )
        self._has_map = True
        self._localizer.set_map(grid)
        rows, columns = grid.cells.shape
        self.get_logger().info(
            f'Received a map of {columns} x {rows} cells of {grid.resolution:.3g} m.'
        )

    def _queue_scan(self, message: LaserScan) -> None:
        self._scan_s = time.monotonic()
        if not self.is_active or self._scans is None:
            return
        stamp_ns = Time.from_msg(message.header.stamp).nanoseconds
        if stamp_ns < self._last_scan_ns:
            # Time has jumped back: earlier odometry is no longer valid.
            self._scans.clear()
            self._localizer.forget_odometry()
        self._last_scan_ns = stamp_ns
        self._scans.add(message)

    def _take_scan(self, scan: LocatedScan) -> None:
        localizer, stamp = self._localizer, scan.message.header.stamp
        if localizer.observe(scan_of(scan.message), scan.rotation, scan.translation, scan.odom):
            self._publish_estimate(stamp)
        if localizer.map_to_odom is not None and self._config.current.tf_broadcast:
            self._broadcast(localizer.map_to_odom, stamp)

    def _publish_estimate(self, stamp: Any) -> None:
        frame, found = self._config.current.global_frame_id, self._localizer.estimate
        assert found is not None
        self._keep(found)
        self._poses.publish(pose_message(found, frame, stamp))
        if self._clouds.get_subscription_count():
            particles = self._localizer.filter
            self._clouds.publish(cloud_bytes(particles.particles, particles.weights, frame, stamp))

    def _keep(self, estimate: Cluster) -> None:
        """Save the pose for the next activation, at a limited rate."""
        rate_hz, now_s = self._config.current.save_pose_rate, time.monotonic()
        if rate_hz > 0.0 and now_s - self._kept_s >= 1.0 / rate_hz:
            self._known, self._kept_s = estimate, now_s

    def _broadcast(self, map_to_odom: Pose2D, stamp: Any) -> None:
        """Broadcast the transform from the map to odometry, post-dated beyond the scan's stamp."""
        values = self._config.current
        until = Time.from_msg(stamp) + Duration(seconds=values.transform_tolerance)
        self._broadcaster.sendTransform(
            transform_message(
                map_to_odom, values.global_frame_id, values.odom_frame_id, until.to_msg()
            )
        )

    def _take_initial_pose(self, message: PoseWithCovarianceStamped) -> None:
        frame = self._config.current.global_frame_id
        if message.header.frame_id not in (frame, f'/{frame}', ''):
            self.get_logger().error(
                f"Ignored an initial pose in frame '{message.header.frame_id}'. "
                f"Give it in '{frame}', the fixed frame in RViz."
            )
            return
        pose = planar_pose(message.pose.pose) @ self._motion_since(message.header.stamp)
        if not np.isfinite(pose).all():
            self.get_logger().error('Ignored an initial pose that is not finite.')
            return
        self._localizer.start_at(pose, covariance_of(message))
        self.get_logger().info(
            f'The initial pose is x {pose.x:.2f}, y {pose.y:.2f}, yaw {pose.yaw:.2f}.'
        )

    def _motion_since(self, stamp: Any) -> Pose2D:
        """Look up the motion of the robot since a time, according to odometry."""
        values = self._config.current
        frames = values.base_frame_id, values.odom_frame_id
        if not (stamp.sec or stamp.nanosec):
            return Pose2D(0.0, 0.0, 0.0)
        try:
            then = self.transforms.pose_of(*frames, Time.from_msg(stamp))
            return then.inverse() @ self.transforms.pose_of(*frames)
        except TransformError:
            return Pose2D(0.0, 0.0, 0.0)

    def _set_initial_pose(
        self, request: SetInitialPose.Request, response: SetInitialPose.Response
    ) -> SetInitialPose.Response:
        self._take_initial_pose(request.pose)
        return response

    def _force_update(self, _: Empty.Request, response: Empty.Response) -> Empty.Response:
        self._localizer.force_update()
        return response

    def _start_anywhere(self, _: Empty.Request, response: Empty.Response) -> Empty.Response:
        self._localizer.start_anywhere()
        self.get_logger().info('The robot may be anywhere in the map now. Let it move and turn.')
        return response

    def _remind(self) -> None:
        """Log missing inputs while the node is active."""
        if not self.is_active or self._scans is None:
            return
        values, now_s = self._config.current, time.monotonic()
        inputs = Inputs(
            has_map=self._has_map,
            is_started=self._localizer.is_started,
            scan_age_s=now_s - self._scan_s,
            transform_problem=self._scans.problem,
            map_topic=self.resolve_topic_name(values.map_topic),
            scan_topic=self.resolve_topic_name(values.scan_topic),
        )
        text = self._reminder.text_for(describe_missing(inputs), now_s)
        if text:
            self.get_logger().warning(text)
