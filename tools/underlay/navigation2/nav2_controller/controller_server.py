# SPDX-License-Identifier: Apache-2.0
"""The controller server: hosts controllers and checkers, and the local costmap."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from nav2_controller.checkers import GoalChecker, ProgressChecker
from nav2_controller.control import Controller, SpeedLimit, Velocity
from nav2_controller.displays import DisplayPublisher
from nav2_controller.follow_path import PathFollower
from nav2_controller.plugins import (
    CONTROLLERS,
    GOAL_CHECKERS,
    PluginContext,
    PROGRESS_CHECKERS,
)
from nav2_costmap_2d.costmap_node import Costmap2DROS, make_costmap
from nav2_msgs.action import FollowPath
from nav2_msgs.msg import SpeedLimit as SpeedLimitMessage
from nav2_util.actions import ActionServer
from nav2_util.errors import ConfigurationError
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.odometry import subscribe_velocity
from nav2_util.parameters import parameter, ParameterSet
from nav2_util.plugins import find_plugin, plugin_type
from nav2_util.timing import now_s
from nav2_util.twist import TwistPublisher
from rclpy.lifecycle import TransitionCallbackReturn

__all__ = ['ControllerServer']

_DEFAULT_KINDS = {
    'FollowPath': 'dwb_core::DWBLocalPlanner',
    'progress_checker': 'nav2_controller::SimpleProgressChecker',
    'goal_checker': 'nav2_controller::SimpleGoalChecker',
}


_UNSUPPORTED = {
    'search_window': 'max_robot_pose_search_dist of the controller plugins limits the search',
    'controller_plugin_ids': 'set controller_plugins',
    'controller_plugin_types': 'set <name>.plugin for each name in controller_plugins',
}


@dataclass(frozen=True)
class ServerParameters:
    """The parameters of the controller server."""

    controller_frequency: float = parameter(
        20.0, 'How often in Hz a velocity is computed.', low=0.1, high=1000.0
    )
    costmap_update_timeout: float = parameter(
        0.3, 'How long in s to wait for a local costmap that is up to date.', low=0.0
    )
    publish_zero_velocity: bool = parameter(
        True, 'Whether to publish a zero velocity when a goal ends.'
    )
    controller_plugins: list[str] = parameter(['FollowPath'], 'The names of controllers.')
    progress_checker_plugins: list[str] = parameter(
        ['progress_checker'], 'The names of checkers of progress.'
    )
    goal_checker_plugins: list[str] = parameter(
        ['goal_checker'], 'The names of checkers of the goal.'
    )
    min_x_velocity_threshold: float = parameter(
        0.0001, 'A velocity of the odometry along x in m/s below which it counts as 0.', low=0.0
    )
    min_y_velocity_threshold: float = parameter(
        0.0001, 'A velocity of the odometry along y in m/s below which it counts as 0.', low=0.0
    )
    min_theta_velocity_threshold: float = parameter(
        0.0001, 'An angular velocity in rad/s below which it counts as 0.', low=0.0
    )
    failure_tolerance: float = parameter(
        0.0,
        'How long in s the robot stands and tries on when there is no velocity; -1: for ever.',
        low=-1.0,
    )
    speed_limit_topic: str = parameter('speed_limit', 'The topic of speed limits.')
    odom_topic: str = parameter('odom', 'The topic of the odometry.')
    odom_duration: float = parameter(
        0.3, 'The time in s over which velocities of the odometry are averaged.', low=0.0
    )
    use_realtime_priority: bool = parameter(
        False, 'Has no effect: all nodes of a process run with its priority.'
    )
    enable_stamped_cmd_vel: bool = parameter(
        False, "Whether TwistStamped is published on 'cmd_vel', and not Twist."
    )


class OdometryMonitor:
    """
    Moving average of the velocities from odometry.

    Parameters
    ----------
    node
        The node that subscribes.
    topic
        The topic of the odometry.
    duration_s
        The averaging window.
    now_s
        Function that returns the time in s.

    """

    def __init__(
        self, node: Any, topic: str, duration_s: float, now_s: Callable[[], float]
    ) -> None:
        self._duration_s, self._now_s = duration_s, now_s
        self._found: deque[tuple[float, Velocity]] = deque()
        self.topic = topic
        subscribe_velocity(node, topic, self._receive)

    def velocity(self, thresholds: Velocity = Velocity()) -> Velocity:
        """
        Compute the mean velocity over the window; 0 if none is known.

        Parameters
        ----------
        thresholds
            Components of the mean with a smaller magnitude count as 0 (m/s, m/s, rad/s).

        Returns
        -------
        Velocity
            In the base frame.

        """
        count = len(self._found)
        if not count:
            return Velocity()
        means = (sum(each[1][k] for each in self._found) / count for k in range(3))
        return Velocity(*(v if abs(v) >= low else 0.0 for v, low in zip(means, thresholds)))

    @property
    def age_s(self) -> float | None:
        """Return the time in s since the newest message; None before the first."""
        return self._now_s() - self._found[-1][0] if self._found else None

    def _receive(self, _: float, velocity: tuple[float, float, float]) -> None:
        now = self._now_s()
        if self._found and now < self._found[-1][0]:
            self._found.clear()
        self._found.append((now, Velocity(*velocity)))
        while now - self._found[0][0] > self._duration_s:
            self._found.popleft()


class ControllerServer(LifecycleNode):
    """
    Controller server: follows the paths of `follow_path` by velocities on `cmd_vel`.

    Parameters
    ----------
    node_name
        The node name, unless remapped.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    settings: ParameterSet[ServerParameters]
    server: ActionServer
    odometry: OdometryMonitor
    displays: DisplayPublisher

    def __init__(self, node_name: str = 'controller_server', **options: Any) -> None:
        super().__init__(node_name, **options)
        self.costmap: Costmap2DROS = make_costmap(self, 'local_costmap')
        self.period_s = 0.05
        self.controllers: dict[str, Controller] = {}
        self.goal_checkers: dict[str, GoalChecker] = {}
        self.progress_checkers: dict[str, ProgressChecker] = {}
        self._velocities: TwistPublisher | None = None

    def configure(self) -> None:
        """Create the plugins, publishers and subscriptions."""
        self.settings = self.parameters.declare(ServerParameters)
        self.parameters.declare_unsupported(_UNSUPPORTED)
        current = self.settings.current
        self.period_s = 1.0 / current.controller_frequency
        if current.use_realtime_priority:
            self.get_logger().warning(
                "The parameter 'use_realtime_priority' has no effect: all nodes of a process run "
                'with its priority.'
            )
        _require('local costmap', 'configured', self.costmap.trigger_configure())
        extent = 0.5 * max(self.costmap.grid.size_x_m, self.costmap.grid.size_y_m)
        context = PluginContext(self.parameters, '', self.period_s, extent)
        for made, names, kinds, what in (
            (
                self.progress_checkers,
                self._older_name('progress_checker_plugin', current.progress_checker_plugins),
                PROGRESS_CHECKERS,
                'progress checker',
            ),
            (
                self.goal_checkers,
                self._older_name('goal_checker_plugin', current.goal_checker_plugins),
                GOAL_CHECKERS,
                'goal checker',
            ),
            (self.controllers, current.controller_plugins, CONTROLLERS, 'controller'),
        ):
            self._make_plugins(made, names, kinds, what, context)
        self._velocities = TwistPublisher(
            self, 'cmd_vel', current.enable_stamped_cmd_vel, self.costmap.base_frame
        )
        self.displays = DisplayPublisher(self)
        self.odometry = OdometryMonitor(
            self, current.odom_topic, current.odom_duration, lambda: now_s(self)
        )
        self.create_subscription(
            SpeedLimitMessage, current.speed_limit_topic, self._limit_speed, 10
        )
        _ = self.transforms
        follower = PathFollower(self)
        self.server = self.offer_action(FollowPath, 'follow_path', follower.work, takes_over=True)

    def activate(self) -> None:
        """Activate the local costmap."""
        _require('local costmap', 'activated', self.costmap.trigger_activate())

    def deactivate(self) -> None:
        """Stop the robot, and deactivate the local costmap."""
        self.publish_velocity(Velocity())
        if self.costmap.state == 'active':
            self.costmap.trigger_deactivate()

    def cleanup(self) -> None:
        """Release the plugins, and clean up the costmap."""
        self._velocities = None
        for made in (self.controllers, self.goal_checkers, self.progress_checkers):
            made.clear()
        if self.costmap.state == 'inactive':  # not, if its process is ending
            self.costmap.trigger_cleanup()

    def publish_velocity(self, velocity: Velocity) -> None:
        """
        Publish a velocity command on `cmd_vel`; do nothing while the node is unconfigured.

        Parameters
        ----------
        velocity
            The velocity in the base frame.

        """
        if self._velocities is not None:
            self._velocities.publish(velocity)

    def _older_name(self, name: str, names: list[str]) -> list[str]:
        """Return plugin names, or the one from a deprecated parameter if that is set."""
        if name not in self.parameters.given:
            return names
        return [str(self.parameters.declare_value(name, names[0], 'The name of one checker.'))]

    def _make_plugins(
        self,
        made: dict[str, Any],
        names: list[str],
        kinds: Mapping[str, str],
        what: str,
        context: PluginContext,
    ) -> None:
        made.clear()
        if not names:
            raise ConfigurationError(f'There must be at least one {what}.')
        for name in names:
            default = _DEFAULT_KINDS.get(name, '')
            kind = plugin_type(self.parameters, name, what, default, kinds)
            made[name] = find_plugin(kinds, kind, what)(context.named(name))
            self.get_logger().info(f"The {what} '{name}' is {kind}.")

    def _limit_speed(self, message: SpeedLimitMessage) -> None:
        limit = None
        if message.speed_limit > 0.0:
            limit = SpeedLimit(float(message.speed_limit), bool(message.percentage))
        for controller in self.controllers.values():
            controller.speed_limit = limit


def _require(what: str, done: str, outcome: TransitionCallbackReturn) -> None:
    if outcome is not TransitionCallbackReturn.SUCCESS:
        raise ConfigurationError(f'The {what} could not be {done}; its log says why.')
