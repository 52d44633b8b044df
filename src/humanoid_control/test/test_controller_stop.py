# SPDX-License-Identifier: Apache-2.0
"""Stop the joint controller over the network, and release it."""

from __future__ import annotations

from collections.abc import Iterator

from humanoid_common.qos import LATCHED
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_control.joint_controller import HumanoidJointController
import pytest
from rcl_interfaces.msg import Log
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, String

BEST_EFFORT = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
VOLATILE = QoSProfile(
    depth=1, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.VOLATILE
)


class Watch:
    """A joint controller, and what it says."""

    def __init__(self, ros: RosSandbox) -> None:
        """Start the controller and listen."""
        self.ros = ros
        self.commands: list[JointState] = []
        self.logs: list[str] = []
        self.states: list[str] = []
        self.node = ros.observer()
        self.node.create_subscription(JointState, 'joint_commands', self.commands.append, 100)
        self.node.create_subscription(Log, '/rosout', lambda log: self.logs.append(log.msg), 100)
        self.node.create_subscription(
            String, 'stop_state', lambda state: self.states.append(state.data), LATCHED
        )

    def start(self, **parameters: float) -> None:
        """Start the controller."""
        self.ros.start(HumanoidJointController, parameters)
        self.ros.wait_until(lambda: len(self.commands) > 5, what='commands')

    def publisher(self, topic: str, qos: QoSProfile) -> Publisher:
        """Return a publisher that the controller has found."""
        publisher = self.node.create_publisher(Bool, topic, qos)
        self.ros.wait_until(lambda: publisher.get_subscription_count() >= 1, what=topic)
        return publisher

    def holds(self) -> bool:
        """Tell whether the last commands are to stay."""
        last = self.commands[-5:]
        return (
            len(last) == 5
            and all(list(each.velocity) == [0.0] * 4 for each in last)
            and all(each.position == last[0].position for each in last)
        )

    def told(self, words: str) -> int:
        """Return how often the log has some words."""
        return sum(words in line for line in self.logs)


@pytest.fixture(name='watch')
def _watch() -> Iterator[Watch]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield Watch(sandbox)


@pytest.mark.parametrize('qos', [LATCHED, VOLATILE, BEST_EFFORT])
def test_stop_and_release(watch: Watch, qos: QoSProfile) -> None:
    """Whoever says stop is obeyed, once in the log; the release goes on from there."""
    watch.start()
    publisher = watch.publisher('emergency_stop', qos)
    publisher.publish(Bool(data=True))
    watch.ros.wait_until(watch.holds, what='still joints')
    held = list(watch.commands[-1].position)
    watch.ros.wait_until(lambda: watch.states[-1:] == ['the emergency stop is pressed'])
    watch.ros.wait_until(lambda: watch.told('Holding still: the emergency stop') > 0)
    count = len(watch.commands)
    watch.ros.wait_until(lambda: len(watch.commands) > count + 10, what='commands meanwhile')
    assert watch.told('Holding still') == 1
    publisher.publish(Bool(data=False))
    watch.ros.wait_until(lambda: not watch.holds(), what='moving joints')
    first = next(each for each in watch.commands[count:] if list(each.position) != held)
    assert list(first.position) == pytest.approx(held, abs=0.01)
    watch.ros.wait_until(lambda: watch.states[-1:] == [''], what='the state')
    watch.ros.wait_until(lambda: watch.told('Released: moving again') == 1, what='the log')


def test_stop_from_before(watch: Watch) -> None:
    """A stop that was pressed before the controller started holds it too."""
    watch.node.create_publisher(Bool, 'emergency_stop', LATCHED).publish(Bool(data=True))
    watch.ros.start(HumanoidJointController)
    watch.ros.wait_until(lambda: watch.states[-1:] == ['the emergency stop is pressed'])


def test_console_is_gone(watch: Watch) -> None:
    """When the console in control is silent, the joints are held until they are released."""
    watch.start()
    heartbeat = watch.publisher('console_heartbeat', BEST_EFFORT)
    heartbeat.publish(Bool(data=True))
    watch.ros.wait_until(watch.holds, what='still joints')
    watch.ros.wait_until(lambda: watch.told('the console in control is lost') == 1, what='the log')
    heartbeat.publish(Bool(data=True))
    heartbeat.publish(Bool(data=False))
    count = len(watch.commands)
    watch.ros.wait_until(lambda: len(watch.commands) > count + 20, what='commands meanwhile')
    assert watch.holds()
    watch.publisher('emergency_stop', VOLATILE).publish(Bool(data=False))
    watch.ros.wait_until(lambda: not watch.holds(), what='moving joints')


def test_control_given_back(watch: Watch) -> None:
    """A console that gave control back may go."""
    watch.start(heartbeat_timeout_s=0.2)
    heartbeat = watch.publisher('console_heartbeat', BEST_EFFORT)
    heartbeat.publish(Bool(data=False))
    count = len(watch.commands)
    watch.ros.wait_until(lambda: len(watch.commands) > count + 50, what='commands meanwhile')
    assert not watch.holds() and watch.told('Holding still') == 0


def test_stop_in_a_pause(watch: Watch) -> None:
    """While the time of the world stands still, a stop is heard, and a console is missed."""
    watch.ros.start(HumanoidJointController, {'use_sim_time': True})
    heartbeat = watch.publisher('console_heartbeat', BEST_EFFORT)
    heartbeat.publish(Bool(data=True))
    watch.ros.wait_until(lambda: 'is lost' in ''.join(watch.states), what='the console is missed')
    stop = watch.publisher('emergency_stop', LATCHED)
    stop.publish(Bool(data=False))
    watch.ros.wait_until(lambda: watch.states[-1] == '', what='the release')
    stop.publish(Bool(data=True))
    watch.ros.wait_until(lambda: watch.states[-1] == 'the emergency stop is pressed')
    assert watch.commands == []
