# SPDX-License-Identifier: Apache-2.0
"""The node that smooths velocity commands: `cmd_vel` in, `cmd_vel_smoothed` out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from nav2_util import ConfigurationError, LifecycleNode, parameter, ParameterSet
from nav2_util.odometry import subscribe_velocity
from nav2_util.parameters import Unsupported
from nav2_util.timing import clock_of, now_s
from nav2_util.twist import subscribe_twist, TwistPublisher, Velocity
from nav2_velocity_smoother.smoothing import apply_deadband, Limits, OdometryAverage, smooth
import numpy as np
from rclpy.timer import Timer
from std_msgs.msg import Header

__all__ = ['VelocitySmoother', 'VelocitySmootherParameters']

_REST = np.zeros(3)
_STALE_ODOMETRY_S = 0.5


@dataclass(frozen=True)
class VelocitySmootherParameters:
    """The parameters of the velocity smoother; lists are x (m), y (m) and theta (rad)."""

    smoothing_frequency: float = parameter(20.0, 'Velocities a second.', low=0.1, high=1000.0)
    scale_velocities: bool = parameter(
        False, 'Whether the limit of one axis scales the whole velocity, to keep its curve.'
    )
    feedback: str = parameter(
        'OPEN_LOOP',
        'Whether to go on from the last command or from the odometry.',
        choices=('OPEN_LOOP', 'CLOSED_LOOP'),
    )
    max_velocity: list[float] = parameter(
        [0.5, 0.0, 2.5], 'Greatest velocities forwards (m/s, m/s, rad/s).'
    )
    min_velocity: list[float] = parameter(
        [-0.5, 0.0, -2.5], 'Greatest velocities backwards, negative (m/s, m/s, rad/s).'
    )
    max_accel: list[float] = parameter(
        [2.5, 0.0, 3.2], 'How fast speeds may grow (m/s^2, m/s^2, rad/s^2).'
    )
    max_decel: list[float] = parameter(
        [-2.5, 0.0, -3.2], 'How fast speeds may shrink, negative (m/s^2, m/s^2, rad/s^2).'
    )
    deadband_velocity: list[float] = parameter(
        [0.0, 0.0, 0.0], 'Speeds below these become zero (m/s, m/s, rad/s).'
    )
    velocity_timeout: float = parameter(
        1.0, 'Without a command for this long (s) the robot is brought to rest.', low=0.0
    )
    odom_topic: str = parameter('odom', 'Where the odometry comes from, for CLOSED_LOOP.')
    odom_duration: float = parameter(
        0.1, 'How long the velocity of the odometry is averaged (s).', low=0.0
    )
    enable_stamped_cmd_vel: bool = parameter(
        False, 'Whether commands in and out are TwistStamped instead of Twist.', read_only=True
    )
    stamp_smoothed_velocity_with_smoothing_time: bool = parameter(
        False, 'Whether velocities have the time of smoothing instead of that of their command.'
    )


class VelocitySmoother(LifecycleNode):
    """
    Node that publishes velocities that follow the commands of `cmd_vel` within limits.

    It publishes at `smoothing_frequency` while commands are received, decelerates to rest after
    none was received for `velocity_timeout`, and then stops publishing.

    Parameters
    ----------
    node_name, options
        As for `LifecycleNode`.

    """

    def __init__(self, node_name: str = 'velocity_smoother', **options: Any) -> None:
        super().__init__(node_name, **options)
        self._told: ParameterSet[VelocitySmootherParameters]
        self._limits: Limits
        self._publisher: TwistPublisher
        self._odometry = OdometryAverage(0.1)
        self._timer: Timer | None = None
        self._command = self._velocity = _REST
        self._header: Header | None = None
        self._command_time_s = 0.0
        self._is_at_rest = True
        self._is_configured = False

    def configure(self) -> None:
        """Read and validate the parameters; subscribe to commands and odometry."""
        self.parameters.declare_unsupported(
            {
                'use_realtime_priority': Unsupported(
                    'Python has no threads of real-time priority', (False,)
                )
            }
        )
        self._told = self.parameters.declare(VelocitySmootherParameters)
        current = self._told.current
        try:
            self._limits = _limits_of(current)
        except ValueError as error:
            raise ConfigurationError(str(error)) from error
        self._told.on_change = self._change
        self._is_configured = True
        self._odometry = OdometryAverage(current.odom_duration)
        is_stamped = current.enable_stamped_cmd_vel
        self._publisher = TwistPublisher(self, 'cmd_vel_smoothed', is_stamped)
        subscribe_twist(self, 'cmd_vel', is_stamped, self._on_command)
        if current.feedback == 'CLOSED_LOOP':
            subscribe_velocity(self, current.odom_topic, self._on_odometry)

    def activate(self) -> None:
        """Start publishing, as soon as a command is received."""
        self._command = self._velocity = _REST
        self._is_at_rest = True
        self._start(self._told.current.smoothing_frequency)

    def deactivate(self) -> None:
        """Stop the robot, and stop publishing."""
        self._stop()
        if not self._is_at_rest:
            self._publisher.publish(Velocity(), self._header)
            self._is_at_rest = True

    def cleanup(self) -> None:
        """Unlock all parameters."""
        self._is_configured = False

    def _start(self, rate_hz: float) -> None:
        self._stop()
        self._timer = self.create_timer(1.0 / rate_hz, self._step, clock=clock_of(self))

    def _stop(self) -> None:
        if self._timer is not None:
            self.destroy_timer(self._timer)
            self._timer = None

    def _change(self, new: VelocitySmootherParameters) -> None:
        """Apply changed parameters; raise ValueError if they are invalid."""
        old = self._told.current
        if not self._is_configured:
            return
        if (new.feedback, new.odom_topic) != (old.feedback, old.odom_topic):
            raise ValueError(
                'feedback and odom_topic take effect when the node is configured: clean it up, '
                'set them, and configure it again.'
            )
        self._limits = _limits_of(new)
        self._odometry.duration_s = new.odom_duration
        if new.smoothing_frequency != old.smoothing_frequency and self._timer is not None:
            self._start(new.smoothing_frequency)

    def _on_command(self, velocity: Velocity, header: Header | None) -> None:
        if self.is_active:
            self._command, self._header = np.array(velocity), header
            self._command_time_s, self._is_at_rest = now_s(self), False

    def _on_odometry(self, _: float, velocity: Velocity) -> None:
        self._odometry.add(now_s(self), velocity)

    def _step(self) -> None:
        """Publish the next velocity, unless the robot is at rest without a command."""
        if self._is_at_rest:
            return
        current = self._told.current
        is_over = not 0.0 <= now_s(self) - self._command_time_s <= current.velocity_timeout
        if is_over:
            self._command = _REST
        before = self._velocity_now()
        self._velocity = smooth(
            self._command, before, self._limits, 1.0 / current.smoothing_frequency
        )
        # With a deceleration limit of zero the robot would never come to rest.
        is_stuck = is_over and np.array_equal(self._velocity, before)
        if is_stuck or (is_over and self._is_small()):
            self._velocity, self._is_at_rest = _REST, True
        velocity = apply_deadband(self._velocity, self._limits)
        self._publisher.publish(Velocity(*map(float, velocity)), self._stamped(current))

    def _is_small(self) -> bool:
        return bool(np.all(np.abs(self._velocity) < 1e-3))

    def _velocity_now(self) -> Any:
        """Return the velocity to start from: the last command, or that of the odometry."""
        if self._told.current.feedback == 'OPEN_LOOP':
            return self._velocity
        measured = self._odometry.velocity(now_s(self), _STALE_ODOMETRY_S)
        if measured is None:
            self.get_logger().warning(
                f"No odometry is received on '{self._told.current.odom_topic}'; "
                'smoothing continues from the last command.',
                throttle_duration_sec=5.0,
            )
            return self._velocity
        return measured

    def _stamped(self, current: VelocitySmootherParameters) -> Header | None:
        if self._header is not None and current.stamp_smoothed_velocity_with_smoothing_time:
            self._header.stamp = self.get_clock().now().to_msg()
        return self._header


def _limits_of(parameters: VelocitySmootherParameters) -> Limits:
    return Limits.checked(
        parameters.max_velocity,
        parameters.min_velocity,
        parameters.max_accel,
        parameters.max_decel,
        parameters.deadband_velocity,
        parameters.scale_velocities,
    )
