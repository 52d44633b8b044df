# SPDX-License-Identifier: Apache-2.0
"""Check the timer for what moves in the world."""

from __future__ import annotations

from statistics import median

from humanoid_common.periodic import PeriodicTimer
from humanoid_common.qos import STATE
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
import pytest
from rclpy.node import Node
from rosgraph_msgs.msg import Clock


class SimulatedTime:
    """A publisher of /clock."""

    def __init__(self, ros: RosSandbox, listener: Node) -> None:
        """Wait until the node hears."""
        self._ros, self._listener = ros, listener
        self._publisher = ros.observer().create_publisher(Clock, '/clock', STATE)
        ros.wait_until(lambda: self._publisher.get_subscription_count() > 0, what='a listener')

    def tell(self, time_ms: int) -> None:
        """Tell a time, and wait until the node has heard it."""
        message = Clock()
        message.clock.sec, rest_ms = divmod(time_ms, 1000)
        message.clock.nanosec = rest_ms * 1_000_000
        self._publisher.publish(message)
        clock = self._listener.get_clock()
        self._ros.wait_until(
            lambda: clock.now().nanoseconds == time_ms * 1_000_000, what=f'{time_ms} ms'
        )

    def run(self, from_ms: int, to_ms: int) -> None:
        """Let time pass as a simulator does."""
        for time_ms in range(from_ms, to_ms + 1, 10):
            self.tell(time_ms)


def test_rate_and_change_of_rate() -> None:
    """The timer keeps its rate, follows a new one at once, and its time never goes back."""
    times: list[float] = []
    with ros_sandbox() as ros:
        timer = PeriodicTimer(ros.observer(), 0.01, times.append)
        timer.set_rate(100.0)
        ros.wait_until(lambda: len(times) > 50, what='50 ticks')
    assert times == sorted(times)
    typical_s = median(later - earlier for earlier, later in zip(times, times[1:]))
    assert 0.009 < typical_s < 0.015
    assert times[0] == 0.0


def test_simulated_time() -> None:
    """With use_sim_time the calls come by /clock alone: none while it stands still."""
    times: list[float] = []
    with ros_sandbox() as ros:
        node = ros.start(lambda **given: Node('mover', **given), {'use_sim_time': True})
        timer = PeriodicTimer(node, 50.0, times.append)
        waited: list[None] = []
        time = SimulatedTime(ros, node)
        time.run(10, 1000)
        # The first time that comes sets the timer anew, which may cost a call.
        ros.wait_until(lambda: len(times) >= 49, what='49 calls in a second of the world')
        steady = PeriodicTimer(ros.observer(), 100.0, lambda now_s: waited.append(None))
        ros.wait_until(lambda: len(waited) > 20, what='a while of real time')
        assert len(times) <= 50
        assert times == [pytest.approx(0.02 * call) for call in range(len(times))]
        assert 0.95 < timer.now_s() < 1.001 and steady.now_s() > 0.1


def test_simulated_time_that_begins_anew() -> None:
    """When another simulator begins at zero, calls go on with times that never go back."""
    times: list[float] = []
    with ros_sandbox() as ros:
        node = ros.start(lambda **given: Node('mover', **given), {'use_sim_time': True})
        PeriodicTimer(node, 50.0, times.append)
        time = SimulatedTime(ros, node)
        time.run(50_000, 50_100)
        ros.wait_until(lambda: len(times) >= 4, what='calls')
        before = len(times)
        time.run(10, 400)
        ros.wait_until(lambda: len(times) >= before + 15, what='calls after the new beginning')
    assert times == [pytest.approx(0.02 * call) for call in range(len(times))]
