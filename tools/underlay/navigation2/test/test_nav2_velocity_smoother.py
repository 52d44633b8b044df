# SPDX-License-Identifier: Apache-2.0
"""The velocity smoother: limits, timeout, deadband, feedback and wrong parameters."""

from __future__ import annotations

import math

from geometry_msgs.msg import Twist, TwistStamped
from nav2_velocity_smoother import Limits, OdometryAverage, smooth, VelocitySmoother
from nav2_velocity_smoother.smoothing import apply_deadband
from nav_msgs.msg import Odometry
import numpy as np
import pytest
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.parameter import Parameter

FAST = {'smoothing_frequency': 50.0}
LIMITS = Limits.checked(
    [0.5, 0.2, 1.0], [-0.3, -0.2, -1.0], [1.0, 1.0, 2.0], [-2.0, -2.0, -4.0], [0.0, 0.0, 0.0]
)


def scaling(limits: Limits = LIMITS) -> Limits:
    return Limits(*(getattr(limits, name) for name in _NAMES), scale_velocities=True)


_NAMES = ('max_velocity', 'min_velocity', 'max_accel', 'max_decel', 'deadband_velocity')


class TestSmooth:
    def test_accelerates_by_max_accel(self):
        """From rest, each axis gains its acceleration times the period."""
        velocity = smooth(np.array([0.5, 0.2, 1.0]), np.zeros(3), LIMITS, 0.1)
        assert velocity == pytest.approx([0.1, 0.1, 0.2])

    def test_decelerates_by_max_decel(self):
        """Speed shrinks by the deceleration, also on the way to the other direction."""
        moving = np.array([0.5, 0.0, -1.0])
        velocity = smooth(np.array([0.0, 0.0, 1.0]), moving, LIMITS, 0.1)
        assert velocity == pytest.approx([0.3, 0.0, -0.6])

    def test_keeps_to_the_greatest_velocities(self):
        """A command beyond the limits is reached as far as they go."""
        velocity = np.zeros(3)
        for _ in range(100):
            velocity = smooth(np.array([9.0, -9.0, -9.0]), velocity, LIMITS, 0.1)
        assert velocity == pytest.approx([0.5, -0.2, -1.0])

    def test_reaches_the_command_exactly(self):
        """A command that is near is reached in one period."""
        command = np.array([0.05, 0.0, 0.01])
        assert smooth(command, np.zeros(3), LIMITS, 0.1) == pytest.approx(command)

    def test_scales_all_axes(self):
        """With scale_velocities the curve stays the same while the speed grows."""
        command = np.array([0.5, 0.0, 0.4])
        velocity = smooth(command, np.zeros(3), scaling(), 0.1)
        assert velocity == pytest.approx([0.1, 0.0, 0.08])

    def test_scaling_keeps_the_limits(self):
        """No axis exceeds its acceleration because another one scales it."""
        rng = np.random.default_rng(1)
        for _ in range(200):
            command, current = rng.uniform(-1, 1, (2, 3))
            current = np.clip(current, LIMITS.min_velocity, LIMITS.max_velocity)
            change = smooth(command, current, scaling(), 0.1) - current
            assert np.all(np.abs(change) <= -LIMITS.max_decel * 0.1 + 1e-9)

    def test_deadband(self):
        """Parts that are too small to move the robot become zero."""
        limits = Limits.checked([1] * 3, [-1] * 3, [1] * 3, [-1] * 3, [0.1, 0.1, 0.2])
        assert apply_deadband(np.array([0.09, -0.1, -0.15]), limits) == pytest.approx([0, -0.1, 0])

    @pytest.mark.parametrize(
        'change, sentence',
        [
            ({'max_velocity': [1.0]}, "'max_velocity' needs 3 numbers, for x, y and theta"),
            ({'max_velocity': [-1.0, 0, 0]}, "'max_velocity' must be positive"),
            ({'min_velocity': [0, 0, 0.5]}, "'min_velocity' must be negative"),
            ({'max_decel': [0, 0, 0.5]}, "'max_decel' must be negative"),
            ({'max_accel': [0, 0, -0.5]}, "'max_accel' must be positive"),
            ({'max_accel': [0, 0, math.nan]}, 'must be finite'),
        ],
    )
    def test_wrong_limits(self, change, sentence):
        """Wrong lists are refused with a sentence."""
        right = {name: [0.0, 0.0, 0.0] for name in _NAMES}
        with pytest.raises(ValueError, match=sentence):
            Limits.checked(**{**right, **change})


class TestOdometryAverage:
    def test_averages_the_last_moments(self):
        """Older samples do not count."""
        average = OdometryAverage(0.1)
        for now, speed in ((0.0, 9.0), (0.95, 1.0), (1.0, 2.0)):
            average.add(now, [speed, 0.0, 0.0])
        assert average.velocity(1.0, 0.5) == pytest.approx([1.5, 0.0, 0.0])

    def test_old_odometry_does_not_count(self):
        """Odometry that stopped is no feedback."""
        average = OdometryAverage(0.1)
        assert average.velocity(0.0, 0.5) is None
        average.add(0.0, [1.0, 0.0, 0.0])
        average.add(0.1, [math.nan, 0.0, 0.0])
        assert average.velocity(0.2, 0.5) == pytest.approx([1.0, 0.0, 0.0])
        assert average.velocity(1.0, 0.5) is None


class Bench:
    """A smoother, commands for it, and what it publishes."""

    def __init__(self, ros, parameters, is_stamped=False):
        self.ros, self.received = ros, []
        kind = TwistStamped if is_stamped else Twist
        overrides = {**FAST, **parameters, 'enable_stamped_cmd_vel': is_stamped}
        self.node = ros.make(VelocitySmoother, overrides)
        tester = ros.node()
        self.commands = tester.create_publisher(kind, 'cmd_vel', 1)
        self.odometry = tester.create_publisher(Odometry, 'odom', 1)
        tester.create_subscription(kind, 'cmd_vel_smoothed', self.received.append, 50)
        assert self.node.trigger_configure() == TransitionCallbackReturn.SUCCESS
        assert self.node.trigger_activate() == TransitionCallbackReturn.SUCCESS
        ros.wait_until(lambda: self.commands.get_subscription_count(), what='the smoother')

    def command(self, x, turn=0.0):
        message = Twist()
        message.linear.x, message.angular.z = x, turn
        self.commands.publish(message)

    def last(self):
        return self.received[-1].linear.x if self.received else None

    def drive(self, x, until, what):
        sender = self.ros.node(f'sender_{len(self.received)}')
        timer = sender.create_timer(0.02, lambda: self.command(x))
        self.ros.wait_until(until, what=what)
        sender.destroy_timer(timer)


class TestNode:
    def test_ramps_up_and_down_and_is_silent(self, ros):
        """A command is reached in steps; without one the robot slows down, then all is silent."""
        bench = Bench(ros, {'velocity_timeout': 0.2, 'max_accel': [2.0, 0.0, 3.0]})
        bench.drive(0.3, lambda: bench.last() == pytest.approx(0.3), 'the commanded velocity')
        speeds = [0.0] + [each.linear.x for each in bench.received]
        assert all(0.0 <= b - a <= 0.04 + 1e-9 for a, b in zip(speeds, speeds[1:]))
        ros.wait_until(lambda: bench.last() == 0.0, what='rest')
        count = len(bench.received)
        ros.spin(0.3)
        assert len(bench.received) == count
        bench.drive(0.1, lambda: bench.last() == pytest.approx(0.1), 'motion after rest')

    def test_deadband_does_not_hold_the_ramp_back(self, ros):
        """Speeds below the deadband are published as zero, and passed nevertheless."""
        bench = Bench(ros, {'deadband_velocity': [0.1, 0.0, 0.0], 'max_accel': [1.0, 0.0, 3.0]})
        bench.drive(0.3, lambda: bench.last() == pytest.approx(0.3), 'the commanded velocity')
        speeds = {round(each.linear.x, 3) for each in bench.received}
        assert 0.0 in speeds and not any(0.0 < each < 0.0999 for each in speeds)

    def test_ignores_what_is_not_finite(self, ros):
        """A command that is not a number changes nothing."""
        bench = Bench(ros, {})
        bench.drive(0.2, lambda: bench.last() == pytest.approx(0.2), 'the commanded velocity')
        for value in (math.nan, math.inf):
            bench.command(value)
            bench.command(0.1, value)
        bench.drive(0.2, lambda: len(bench.received) > 30, 'more velocities')
        assert all(math.isfinite(each.linear.x) for each in bench.received)
        assert bench.last() == pytest.approx(0.2)

    def test_stamped(self, ros):
        """Stamped commands give stamped velocities with their header."""
        bench = Bench(ros, {}, is_stamped=True)
        message = TwistStamped()
        message.header.frame_id, message.header.stamp.sec = 'base_link', 7
        message.twist.angular.z = 0.5

        def moved():
            bench.commands.publish(message)
            return bench.received

        ros.wait_until(moved, what='a stamped velocity')
        assert bench.received[0].header == message.header
        assert bench.received[0].twist.angular.z > 0.0

    def test_closed_loop_goes_on_from_odometry(self, ros):
        """With feedback the velocity is at most one step from the measured one."""
        parameters = {'feedback': 'CLOSED_LOOP', 'max_accel': [1.0, 0.0, 3.0]}
        bench = Bench(ros, parameters)
        odometry = Odometry()
        odometry.twist.twist.linear.x = 0.2
        ros.wait_until(lambda: bench.odometry.get_subscription_count(), what='the subscription')
        bench.ros.node('odometry').create_timer(0.02, lambda: bench.odometry.publish(odometry))
        ros.spin(0.2)
        bench.drive(0.5, lambda: len(bench.received) > 10, 'velocities')
        assert bench.last() == pytest.approx(0.22)

    def test_deactivation_stops_the_robot(self, ros):
        """A smoother that is deactivated in motion publishes zero, and nothing more."""
        bench = Bench(ros, {})
        bench.drive(0.3, lambda: (bench.last() or 0) > 0.1, 'motion')
        bench.node.trigger_deactivate()
        ros.wait_until(lambda: bench.last() == 0.0, what='zero')
        count = len(bench.received)
        bench.command(0.3)
        ros.spin(0.2)
        assert len(bench.received) == count

    def test_wrong_parameters_are_refused(self, ros):
        """A node with wrong limits is not configured; later changes are refused."""
        wrong = ros.make(VelocitySmoother, {'max_velocity': [0.5, 0.0]}, node_name='wrong')
        assert wrong.trigger_configure() == TransitionCallbackReturn.FAILURE
        typo = ros.make(VelocitySmoother, {'feedback': 'OPENLOOP'}, node_name='typo')
        assert typo.trigger_configure() == TransitionCallbackReturn.FAILURE
        bench = Bench(ros, {})
        refused = bench.node.set_parameters([Parameter('max_decel', value=[1.0, 0.0, 0.0])])[0]
        assert not refused.successful and 'negative' in refused.reason
        taken = bench.node.set_parameters([Parameter('max_velocity', value=[0.1, 0.0, 0.0])])[0]
        assert taken.successful
        bench.drive(0.5, lambda: bench.last() == pytest.approx(0.1), 'the new limit')


class TestAttacks:
    """Commands and parameters that nobody should give."""

    def test_random_commands_keep_to_the_limits(self):
        """Whatever is commanded, speeds and changes stay within the limits."""
        rng = np.random.default_rng(2)
        for limits in (LIMITS, scaling()):
            velocity = np.zeros(3)
            for _ in range(2000):
                command = rng.normal(size=3) * 10.0 ** rng.uniform(-9, 300)
                before, velocity = velocity, smooth(command, velocity, limits, 0.05)
                assert np.all(np.isfinite(velocity))
                assert np.all(velocity <= limits.max_velocity)
                assert np.all(velocity >= limits.min_velocity)
                assert np.all(np.abs(velocity - before) <= -limits.max_decel * 0.05 + 1e-9)

    def test_huge_commands(self, ros):
        """The largest numbers are limited like others."""
        bench = Bench(ros, {})
        bench.drive(1e308, lambda: bench.last() == pytest.approx(0.5), 'the greatest velocity')

    def test_no_deceleration_ends_nevertheless(self, ros):
        """A robot that may not slow down is stopped at the timeout."""
        parameters = {'max_decel': [0.0, 0.0, 0.0], 'velocity_timeout': 0.2}
        bench = Bench(ros, parameters)
        bench.drive(0.3, lambda: bench.last() == pytest.approx(0.3), 'the commanded velocity')
        ros.wait_until(lambda: bench.last() == 0.0, what='rest')
        count = len(bench.received)
        ros.spin(0.2)
        assert len(bench.received) == count

    @pytest.mark.parametrize(
        'parameters',
        [
            {'smoothing_frequency': 0.0},
            {'smoothing_frequency': -20.0},
            {'smoothing_frequency': math.nan},
            {'velocity_timeout': -1.0},
            {'velocity_timeout': math.nan},
            {'max_velocity': [math.inf, 0.0, 1.0]},
            {'max_velocity': 'fast'},
            {'max_accel': []},
            {'deadband_velocity': [-0.1, 0.0, 0.0]},
        ],
    )
    def test_parameters_that_make_no_sense(self, ros, parameters):
        """Each is refused when the node is configured."""
        node = ros.make(VelocitySmoother, parameters)
        assert node.trigger_configure() == TransitionCallbackReturn.FAILURE
