# SPDX-License-Identifier: Apache-2.0
"""The node `loopback_simulator`: converts commands to odometry, transforms, scans and time."""

from __future__ import annotations

import array
from dataclasses import dataclass
import math
from typing import Any

from geometry_msgs.msg import PoseWithCovarianceStamped, TransformStamped
from nav2_amcl.conversions import map_of, transform_message
from nav2_loopback_sim.loopback_robot import LaserShape, LoopbackRobot, SimulatedLaser
from nav2_util.geometry import make_quaternion, planar_pose, Pose2D, yaw_of
from nav2_util.parameters import parameter, ParameterServer
from nav2_util.timing import steady_clock
from nav2_util.twist import subscribe_twist
from nav_msgs.msg import Odometry
from nav_msgs.srv import GetMap
from rclpy.clock import Clock
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.time import Time
from rosgraph_msgs.msg import Clock as ClockMessage
from sensor_msgs.msg import LaserScan
from tf2_ros import (
    Buffer,
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformException,
    TransformListener,
)

__all__ = ['LoopbackSimulator']

_LOOK_S = 0.5
_LASER_LOOKS = 4
_MAP_LOOKS = 20
_LONGEST_STEP_S = 0.1


@dataclass(frozen=True)
class LoopbackParameters:
    """The parameters of `loopback_simulator`."""

    update_duration: float = parameter(
        0.01, 'How far the robot moves on at once (simulated s).', low=0.001, high=1.0
    )
    base_frame_id: str = parameter('base_footprint', 'The frame of the robot.')
    odom_frame_id: str = parameter('odom', 'The frame of odometry.')
    map_frame_id: str = parameter('map', 'The frame of the map.')
    scan_frame_id: str = parameter('base_scan', 'The frame of the laser scanner.')
    enable_stamped_cmd_vel: bool = parameter(False, 'Take TwistStamped on cmd_vel and not Twist.')
    scan_publish_dur: float = parameter(0.1, 'Time between scans (s).', low=0.001)
    publish_scan: bool = parameter(True, 'Publish scans.')
    publish_map_odom_tf: bool = parameter(
        True, 'Publish the transform from the map to odometry; not beside a localisation.'
    )
    publish_clock: bool = parameter(True, 'Publish simulated time on /clock.')
    scan_range_min: float = parameter(0.05, 'The shortest range (m).', low=0.0)
    scan_range_max: float = parameter(30.0, 'The longest range (m).', low=0.1)
    scan_angle_min: float = parameter(-math.pi, 'The angle of the first beam (rad).')
    scan_angle_max: float = parameter(math.pi, 'The angle of the last beam (rad).')
    scan_angle_increment: float = parameter(
        0.0261, 'The angle between beams (rad).', low=1e-4, high=math.pi
    )
    scan_use_inf: bool = parameter(
        True, 'Where nothing is seen, use inf, and not 0.1 m below the longest range.'
    )
    speed: float = parameter(
        1.0,
        'How many simulated seconds pass in a real one, if publish_clock is on. At another value '
        'than 1, nodes need use_sim_time, and time slows down on a computer that is too slow.',
        low=0.01,
        high=1000.0,
    )

    def laser_shape(self) -> LaserShape:
        """Compute the beam angles and range limits of the scanner."""
        return LaserShape(
            self.scan_angle_min,
            self.scan_angle_max,
            self.scan_angle_increment,
            self.scan_range_min,
            self.scan_range_max,
            self.scan_use_inf,
        )


class LoopbackSimulator(Node):
    """
    Node that simulates an ideal robot; see `LoopbackParameters`.

    It subscribes to `cmd_vel` and `initialpose`, and publishes `odom`, `scan`, `/clock` and
    transforms. It stands still until the first initial pose. The map comes from `map_server/map`.

    Parameters
    ----------
    node_name
        The node name, unless remapped.
    **options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, node_name: str = 'loopback_simulator', **options: Any) -> None:
        super().__init__(node_name, **options)
        parameters = ParameterServer(self)
        values = self._values = parameters.declare(LoopbackParameters).current
        self._odom_period_s = parameters.declare_value(
            'odom_publish_dur', values.update_duration, 'Time between odometry messages (s).'
        )
        parameters.report()
        self._robot = LoopbackRobot()
        self._laser = SimulatedLaser(values.laser_shape())
        self._laser_in_base: Pose2D | None = None
        self._looks = 0
        self._map_answer: Any = None
        self._clock_in = Clock() if values.publish_clock else self.get_clock()
        self._is_real_time = not values.publish_clock or values.speed == 1.0
        self._now_ns = self._clock_in.now().nanoseconds
        self._odom_rhythm = _Rhythm(self._odom_period_s)
        self._scan_rhythm = _Rhythm(values.scan_publish_dur)
        self._offer(values)

    def _offer(self, values: LoopbackParameters) -> None:
        """Create publishers, subscriptions, clients and timers."""
        subscribe_twist(
            self, 'cmd_vel', values.enable_stamped_cmd_vel, lambda v, _: self._robot.command(v)
        )
        self.create_subscription(
            PoseWithCovarianceStamped, 'initialpose', self._take_initial_pose, 10
        )
        self._odometry = self.create_publisher(Odometry, 'odom', QoSProfile(depth=10))
        self._scans = self.create_publisher(LaserScan, 'scan', QoSProfile(depth=10))
        self._clocks = self.create_publisher(ClockMessage, '/clock', QoSProfile(depth=10))
        self._broadcaster = TransformBroadcaster(self)
        self._static_broadcaster = StaticTransformBroadcaster(self)
        self._map_client = self.create_client(GetMap, 'map_server/map')
        self._buffer = Buffer()
        self._listener: TransformListener | None = TransformListener(self._buffer, self)
        pace = values.speed if values.publish_clock else 1.0
        self.create_timer(values.update_duration / pace, self._update, clock=steady_clock())
        self.create_timer(_LOOK_S, self._look, clock=steady_clock())

    def _update(self) -> None:
        """Step the simulation, and publish its state."""
        self._robot.step(self._advance())
        stamp = Time(nanoseconds=self._now_ns).to_msg()
        self._broadcaster.sendTransform(self._transforms(stamp))
        if self._odom_rhythm.is_due(self._now_ns):
            self._odometry.publish(self._odometry_message(stamp))
        if self._values.publish_scan and self._scan_rhythm.is_due(self._now_ns):
            self._publish_scan(stamp)
        if self._values.publish_clock:  # last, after the messages stamped with it
            self._clocks.publish(ClockMessage(clock=stamp))

    def _advance(self) -> float:
        """
        Advance the time; return the time step in s.

        At a speed other than 1, time advances in equal steps, so that it is delayed on a busy
        computer. Otherwise it is the system time, which other nodes may use instead of /clock.
        """
        if not self._is_real_time:
            self._now_ns += round(self._values.update_duration * 1e9)
            return self._values.update_duration
        before_ns, self._now_ns = self._now_ns, self._clock_in.now().nanoseconds
        return float(min(max(self._now_ns - before_ns, 0) * 1e-9, _LONGEST_STEP_S))

    def _transforms(self, stamp: Any) -> list[TransformStamped]:
        values, robot = self._values, self._robot
        frames = values.odom_frame_id, values.base_frame_id
        found = [transform_message(robot.odom, *frames, stamp)]
        if values.publish_map_odom_tf and robot.map_to_odom is not None:
            frames = values.map_frame_id, values.odom_frame_id
            found.append(transform_message(robot.map_to_odom, *frames, stamp))
        return found

    def _odometry_message(self, stamp: Any) -> Odometry:
        message, robot = Odometry(child_frame_id=self._values.base_frame_id), self._robot
        message.header.stamp, message.header.frame_id = stamp, self._values.odom_frame_id
        message.pose.pose.position.x, message.pose.pose.position.y = robot.odom.x, robot.odom.y
        message.pose.pose.orientation = make_quaternion(robot.odom.yaw)
        twist, velocity = message.twist.twist, robot.velocity
        twist.linear.x, twist.linear.y, twist.angular.z = map(float, velocity)
        return message

    def _publish_scan(self, stamp: Any) -> None:
        if self._laser_in_base is None or not self._scans.get_subscription_count():
            return
        base, shape = self._robot.pose_in_map, self._laser.shape
        pose = None if base is None else base @ self._laser_in_base
        message = LaserScan(
            angle_min=shape.angle_min_rad,
            angle_max=shape.angle_min_rad + (shape.count - 1) * shape.angle_increment_rad,
            angle_increment=shape.angle_increment_rad,
            scan_time=self._values.scan_publish_dur,
            range_min=shape.range_min_m,
            range_max=shape.range_max_m,
        )
        message.header.stamp, message.header.frame_id = stamp, self._values.scan_frame_id
        message.ranges = array.array('f', self._laser.scan(pose).astype('float32').tobytes())
        self._scans.publish(message)

    def _take_initial_pose(self, message: PoseWithCovarianceStamped) -> None:
        if message.header.frame_id.lstrip('/') not in (self._values.map_frame_id, ''):
            self.get_logger().error(
                f"Ignored an initial pose in frame '{message.header.frame_id}'. "
                f"Give it in '{self._values.map_frame_id}'."
            )
            return
        pose = planar_pose(message.pose.pose)
        self._robot.place(pose)
        self.get_logger().info(
            f'The robot is at x {pose.x:.2f}, y {pose.y:.2f}, yaw {pose.yaw:.2f} in the map now.'
        )
        if self._laser.has_map:
            self._ask_for_map()  # another map may be available meanwhile

    def _look(self) -> None:
        """Look up the map and the pose of the laser until both are available."""
        self._looks += 1
        if self._laser_in_base is None:
            self._look_for_laser()
        if not self._laser.has_map and self._values.publish_scan:
            self._ask_for_map()
            if self._looks % _MAP_LOOKS == 0:
                self.get_logger().warning(
                    f"The service '{self._map_client.srv_name}' has given no map, so that scans "
                    'see nothing. Start map_server, and activate it.',
                    throttle_duration_sec=60.0,
                )

    def _look_for_laser(self) -> None:
        """Look up the pose of the laser in the robot's model; without one, it is at the base."""
        base, laser = self._values.base_frame_id, self._values.scan_frame_id
        try:
            moved = self._buffer.lookup_transform(base, laser, Time()).transform
        except TransformException:
            if self._looks < _LASER_LOOKS:
                return
            self.get_logger().info(
                f"There is no transform from '{laser}' to '{base}': the identity is published."
            )
            self._laser_in_base = Pose2D(0.0, 0.0, 0.0)
            self._static_broadcaster.sendTransform(
                transform_message(
                    self._laser_in_base, base, laser, Time(nanoseconds=self._now_ns).to_msg()
                )
            )
        else:
            yaw = yaw_of(moved.rotation)
            self._laser_in_base = Pose2D(moved.translation.x, moved.translation.y, yaw)
        if self._listener is not None:
            self._listener.unregister()
            self._listener = None

    def _ask_for_map(self) -> None:
        if self._map_answer is None and self._map_client.service_is_ready():
            self._map_answer = self._map_client.call_async(GetMap.Request())
            self._map_answer.add_done_callback(self._take_map)

    def _take_map(self, answer: Any) -> None:
        self._map_answer = None
        response = answer.result()
        if response is None or not response.map.data:  # the map server is not active yet
            return
        try:
            self._laser.set_map(map_of(response.map))
        except ValueError as error:
            self.get_logger().warning(f'Ignored a map: {error}.', throttle_duration_sec=10.0)


class _Rhythm:
    """Rate limiter that is due once per period of a clock that may jump."""

    def __init__(self, period_s: float) -> None:
        self._period_ns = round(period_s * 1e9)
        self._next_ns = 0

    def is_due(self, now_ns: int) -> bool:
        """Whether a tick is due; the next one is due after a period."""
        if 0 < self._next_ns - now_ns <= self._period_ns:
            return False
        self._next_ns += self._period_ns
        if not 0 < self._next_ns - now_ns <= self._period_ns:
            self._next_ns = now_ns + self._period_ns
        return True
