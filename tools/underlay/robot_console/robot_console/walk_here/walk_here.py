# SPDX-License-Identifier: Apache-2.0
"""Tool that makes a robot walk straight to the clicked place, where there is no navigation."""

from __future__ import annotations

from collections.abc import Mapping
import math
import time
from typing import Any

from geometry_msgs.msg import Twist, Vector3
from nav_msgs.msg import Odometry
from rclpy.duration import Duration
from rclpy.qos import QoSProfile, ReliabilityPolicy
from robot_console.control_page import Connections
from robot_console.namespaces import below, NAMESPACE, topic_of_robot
from robot_console.panels.drive import SpeedLimits, Velocity
from robot_console.robot_link import COMMAND, LATCHED, link_of
from robot_console.small_page import SmallPage
from robot_console.walk_here.straight_walk import Place, Target
from robot_console.walk_here.walk_session import (
    present_goal,
    RobotNow,
    STALE_S,
    WalkGoal,
    WalkSession,
)
from rviz_common.context import Context
from rviz_common.frames import FrameError, Pose
from rviz_common.properties import Number, Topic
from rviz_common.tool import Point, Tool
from rviz_common.widget_order import ALWAYS_ORDER
from rviz_default_plugins.tools.publishing import heading, PoseArrow
from std_msgs.msg import String

__all__ = ['WalkHere']

ORDER = ALWAYS_ORDER + 1.0
"""The page is below the stop button."""
NEWEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
NAVIGATED = 'Navigation is running. Use the tool 2D Goal Pose: it walks around obstacles.'
NO_ODOMETRY = "There is no odometry on '{}', so nobody knows where the robot is."


class WalkHere(Tool):
    """
    Tool to send a robot to a place: click there, or press, drag to the final heading, and release.

    The robot turns towards the place and walks straight to it, without avoiding anything.

    Parameters
    ----------
    context, root, given
        As for `Tool`.

    """

    CLASS = 'robot_console/WalkHere'
    NAME = 'Walk here'
    HINT = (
        'Click on the ground: the robot walks straight there. Drag to choose where it faces then.'
    )
    PROPERTIES = (
        NAMESPACE,
        Topic('Topic', 'cmd_vel', 'Where the velocity is published.', 'geometry_msgs/msg/Twist'),
        Topic('Odometry Topic', 'odom', 'Where the robot is.', 'nav_msgs/msg/Odometry'),
        Number('Max Forward Speed', 0.3, 'In metres per second.', 0.05, 20.0),
        Number('Max Turn Speed', 0.6, 'In radians per second.', 0.15, 20.0),
    )

    def __init__(
        self, context: Context, root: str, given: Mapping[str, Any] | None = None
    ) -> None:
        super().__init__(context, root, given)
        self._arrow = PoseArrow(context, root)
        self._page: SmallPage | None = None
        self._goals: list[WalkGoal] = []
        self._now: RobotNow | None = None
        self._frame = self._walking = self._odometry_topic = ''
        self._odometry: Any = None
        self._is_up = False
        self._turn_rad = 0.0
        """The rotation of the fixed frame in the frame of the odometry."""

    def begin(self) -> None:
        """Create the publisher, and add the page that shows the walk."""
        namespace, node = self.values['Namespace'], self.context.node
        try:
            names = [
                topic_of_robot(node, namespace, self.values[name])
                for name in ('Topic', 'Odometry Topic')
            ]
        except ValueError as error:
            self._report(error)
            return
        link = link_of(self.context, namespace)
        limits = SpeedLimits(self.values['Max Forward Speed'], 0.0, self.values['Max Turn Speed'])
        publisher = self._publisher = node.create_publisher(Twist, names[0], COMMAND)

        def say(velocity: Velocity) -> None:
            publisher.publish(
                Twist(
                    linear=Vector3(x=velocity.forward_m_s, y=velocity.left_m_s),
                    angular=Vector3(z=velocity.turn_rad_s),
                )
            )

        self._odometry_topic = names[1]
        self._state = node.create_subscription(
            String, topic_of_robot(node, namespace, 'walking_state'), self._take_state, LATCHED
        )
        talks = Connections(
            link.people,
            lambda person: WalkSession(link, person, limits, say, self._goal, lambda: self._now),
        )
        try:
            self._page = SmallPage(self.context, 'walk_here', namespace, {}, talks, ORDER)
        except ValueError as error:
            self._report(error)
            self._destroy()

    def close(self) -> None:
        """Remove the page, which stops a robot that walks."""
        if self._page is None:
            return
        self._page.close()
        self._publisher.wait_for_all_acked(Duration(seconds=0.2))
        self._page, self._goals, self._is_up, self._walking = None, [], False, ''
        self._rest()
        self._destroy()

    def on_change(self, path: str) -> None:
        """
        Apply a property that was changed, which stops a robot that walks.

        Parameters
        ----------
        path
            As for `Tool.on_change`.

        """
        is_up = self._is_up
        super().on_change(path)
        if is_up:
            self.take_up()

    def take_up(self) -> None:
        """Activate the tool, and find out where the robot is."""
        self._is_up = True
        self._listen()

    def lay_down(self) -> None:
        """Deactivate the tool; the robot goes on walking."""
        self._is_up = False
        self._rest()

    def click(self, point: Point) -> bool:
        """
        Send the robot to a place, where it keeps its heading.

        Parameters
        ----------
        point
            As for `Tool.click`.

        """
        self._send(point, None)
        return True

    def drag(self, start: Point, end: Point, is_over: bool) -> bool:
        """
        Show the pose as an arrow, and send the robot there when the button is released.

        Parameters
        ----------
        start, end, is_over
            As for `Tool.drag`.

        """
        yaw = heading(start, end)
        self._arrow.show(start, yaw)
        if is_over:
            self._send(start, yaw)
        return is_over

    def _report(self, reason: ValueError) -> None:
        self.context.node.get_logger().error(f"Tool '{self.NAME}' cannot be used: {reason}")

    def _destroy(self) -> None:
        """Destroy the publisher and the subscription of `begin`."""
        self.context.node.destroy_subscription(self._state)
        self.context.node.destroy_publisher(self._publisher)

    def _goal(self) -> WalkGoal | None:
        """Return the goal that pages show."""
        return present_goal(self._goals)

    def _send(self, point: Point, yaw_rad: float | None) -> None:
        """Make a new goal, which the page of the person who has clicked takes."""
        goal = WalkGoal(*self._target(point, yaw_rad), self.browser)
        open_goals = [each for each in self._goals if not each.text]
        self._goals = [*open_goals, goal]
        if not goal.text and yaw_rad is None:
            self._arrow.show(point, self._bearing_rad(goal.target))

    def _bearing_rad(self, target: Target) -> float:
        """Return the direction from the robot to its target in the fixed frame."""
        if self._now is None:
            return 0.0
        place = self._now.place
        return math.atan2(target.y_m - place.y_m, target.x_m - place.x_m) - self._turn_rad

    def _target(self, point: Point, yaw_rad: float | None) -> tuple[Target, str]:
        """Convert a place to the frame of the odometry, or say why the robot cannot go there."""
        node = self.context.node
        nowhere = Target(0.0, 0.0)
        action = below(self.values['Namespace'], 'navigate_to_pose/_action/send_goal')
        if node.count_services(node.resolve_service_name(action)):
            return nowhere, NAVIGATED
        if self._now is None or time.monotonic() - self._now.heard_s > STALE_S:
            return nowhere, NO_ODOMETRY.format(self._odometry_topic)
        frames = self.context.frames
        try:
            fixed = frames.between(self._frame, frames.fixed_frame)
        except FrameError as error:
            return nowhere, str(error)
        turn_rad = self._turn_rad = _yaw_of(fixed)
        cosine, sine = math.cos(turn_rad), math.sin(turn_rad)
        return Target(
            fixed.position[0] + cosine * point[0] - sine * point[1],
            fixed.position[1] + sine * point[0] + cosine * point[1],
            None if yaw_rad is None else yaw_rad + turn_rad,
        ), ''

    def _listen(self) -> None:
        """Subscribe to the odometry."""
        if self._odometry is None and self._page is not None:
            self._odometry = self.context.node.create_subscription(
                Odometry, self._odometry_topic, self._take_odometry, NEWEST
            )

    def _rest(self) -> None:
        """Unsubscribe from the odometry while nobody wants to walk."""
        if self._is_up or any(goal.is_open for goal in self._goals):
            return
        self._arrow.hide()
        if self._odometry is not None:
            self.context.node.destroy_subscription(self._odometry)
            self._odometry = self._now = None

    def _take_state(self, message: String) -> None:
        self._walking = message.data

    def _take_odometry(self, message: Odometry) -> None:
        """Note down where the robot is; rest after the end of a walk."""
        pose, stamp = message.pose.pose, message.header.stamp
        turn = pose.orientation
        at = Pose((0.0, 0.0, 0.0), (turn.w, turn.x, turn.y, turn.z))
        self._frame = message.header.frame_id
        self._now = RobotNow(
            Place(pose.position.x, pose.position.y, _yaw_of(at)),
            stamp.sec + stamp.nanosec / 1e9,
            time.monotonic(),
            self._walking,
        )
        if not self._is_up:
            self.context.queue.post(self._rest)


def _yaw_of(pose: Pose) -> float:
    """Return the heading of a pose."""
    w, x, y, z = pose.wxyz
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
