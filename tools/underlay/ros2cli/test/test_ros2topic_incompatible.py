# SPDX-License-Identifier: Apache-2.0
"""Tests of ends that do not connect: other policies, other names, impossible arguments."""

from collections.abc import Callable
import signal
from subprocess import CompletedProcess
from types import SimpleNamespace
from typing import Any

import pytest
from rclpy.duration import Infinite
from rclpy.qos import (
    DurabilityPolicy,
    LivelinessPolicy,
    qos_check_compatible,
    QoSCompatibility,
    QoSProfile,
)
from ros2topic.api.qos import as_discovered, Incompatibility

Ros2 = Callable[..., CompletedProcess[str]]
Start = Callable[..., Any]

pytestmark = pytest.mark.usefixtures('talker')


def test_echo_names_the_publisher(ros2_here: Ros2) -> None:
    """A publisher that offers too little is named, with the subscription and the cure."""
    result = ros2_here(
        'topic', 'echo', '/temperature', '--qos-reliability', 'reliable', '--timeout', '4'
    )
    assert (result.returncode, result.stdout) == (0, '')
    warning = result.stderr.splitlines()[0]
    assert warning.startswith("WARNING: messages from '/talker' do not reach '/_ros2cli_")
    assert warning.endswith(
        "on '/temperature': Best effort publisher and reliable subscription. "
        'Change the --qos options, or omit them to follow the publisher.'
    )


def test_pub_names_the_subscription(ros2_here: Ros2) -> None:
    """A subscription that asks for more than is published is named."""
    result = ros2_here(
        *('topic', 'pub', '/orders', 'std_msgs/msg/String', '{data: go}'),
        *('--qos-reliability', 'best_effort', '--once', '--max-wait-time-secs', '3'),
    )
    assert result.returncode == 1
    warning, waiting, timeout = result.stderr.splitlines()
    assert warning.startswith("WARNING: messages from '/_ros2cli_")
    assert "' do not reach '/talker' on '/orders': Best effort publisher and reliable" in warning
    assert waiting == "Still waiting for subscriptions of '/orders' (Ctrl-C to stop)"
    assert timeout == (
        'Timed out waiting for subscribers: Expected 1 subcribers but only got 0 subscribers'
    )


def test_only_real_differences_are_named() -> None:
    """What both ends leave open is no reason, though only one of them says so in words."""
    ours = as_discovered(QoSProfile(depth=10))
    theirs = QoSProfile(
        depth=10,
        deadline=Infinite,
        lifespan=Infinite,
        liveliness_lease_duration=Infinite,
        liveliness=LivelinessPolicy.MANUAL_BY_TOPIC,
    )
    status, reason = qos_check_compatible(ours, theirs)
    assert status == QoSCompatibility.ERROR
    assert reason == (
        "ERROR: Publisher's liveliness is automatic and subscription's is manual by topic;"
    )


def test_a_node_with_one_subscription_that_fits_is_reached(
    capsys: pytest.CaptureFixture[str],
) -> None:
    """A node that subscribes twice, as to the emergency stop, is named only if neither fits."""
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    infos = [
        subscription('robot', latched, b'1'),
        subscription('robot', QoSProfile(depth=1), b'2'),
        subscription('late', latched, b'3'),
    ]
    graph = SimpleNamespace(get_subscriptions_info_by_topic=lambda topic: infos)
    node = SimpleNamespace(
        watch=SimpleNamespace(updated=lambda: graph), get_name=lambda: '_ros2cli_1'
    )
    ours = Incompatibility(node, '/emergency_stop', QoSProfile(depth=10), publishes=True)
    ours.on_event(None)
    ours.check()
    (warning,) = capsys.readouterr().err.splitlines()
    assert warning.startswith("WARNING: messages from '/_ros2cli_1' do not reach '/late' on ")


def subscription(node: str, profile: QoSProfile, gid: bytes) -> SimpleNamespace:
    """Return a subscription as the graph describes it."""
    return SimpleNamespace(
        node_name=node,
        node_namespace='/',
        qos_profile=as_discovered(profile),
        endpoint_gid=gid,
    )


def test_other_type_is_named(start_ros2: Start) -> None:
    """A type that nobody uses on the topic is echoed in vain, and a warning says so."""
    process = start_ros2('topic', 'echo', '/temperature', 'std_msgs/msg/String')
    assert process.stderr.readline() == (
        "WARNING: '/temperature' has the type sensor_msgs/msg/Temperature, "
        'not std_msgs/msg/String.\n'
    )
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=100) == ('', '')


def test_pub_of_other_type_is_explained(ros2_here: Ros2) -> None:
    """Waiting for subscriptions that have another type is explained after a while."""
    words = ('topic', 'pub', '/orders', 'std_msgs/msg/Int8', '--once', '--max-wait-time-secs', '3')
    result = ros2_here(*words)
    assert result.returncode == 1
    assert result.stderr.splitlines()[0] == (
        "Still waiting for subscriptions of '/orders' (Ctrl-C to stop). '/orders' has the type "
        'std_msgs/msg/String, not std_msgs/msg/Int8.'
    )


def test_topic_of_two_types(ros2_here: Ros2, start_ros2: Start) -> None:
    """Both types are shown, and echo does not choose between them."""
    other = start_ros2('topic', 'pub', '-p', '0', '/orders', 'std_msgs/msg/Int8')
    assert other.stdout.readline() == 'publisher: beginning loop\n'
    types = ['std_msgs/msg/Int8', 'std_msgs/msg/String']
    assert ros2_here('topic', 'type', '/orders').stdout.splitlines() == types
    assert ros2_here('topic', 'info', '/orders').stdout == (
        f'Type: {types}\nPublisher count: 1\nSubscription count: 1\n'
    )
    for verb in ('echo', 'hz'):
        result = ros2_here('topic', verb, '/orders')
        assert (result.returncode, result.stdout) == (1, '')
        assert result.stderr == (
            "Cannot echo topic '/orders', as it contains more than one type: "
            f'[{", ".join(types)}]\n'
        )


def test_misspelt_topic_suggests(ros2_here: Ros2, start_ros2: Start) -> None:
    """The topic that may be meant is named when one is waited for in vain."""
    result = ros2_here('topic', 'echo', '/temperatur')
    assert result.stderr == (
        "Could not determine the type for the passed topic\nDid you mean '/temperature'?\n"
    )
    process = start_ros2('topic', 'hz', '/temperatur')
    assert process.stderr.readline().endswith("(Ctrl-C to stop). Did you mean '/temperature'?\n")
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=100) == 2


@pytest.mark.parametrize(
    ('words', 'status', 'error'),
    [
        (['/x y', 'std_msgs/msg/String'], 1, "'/x y' is not a valid topic name"),
        (['/1', 'std_msgs/msg/String'], 1, "'/1' is not a valid topic name"),
        (['/x', 'std_msgs/msg/String', '--qos-depth', '1.5'], 2, "'1.5' is not a whole number"),
        (['/x', 'std_msgs/msg/String', '--qos-depth', '9' * 20], 2, 'is too long: at most'),
        (['/x', 'std_msgs/msg/String', '-n', 'a/b'], 2, "'a/b' is not a valid node name"),
        (['/x', 'std_msgs/msg/String', '-w', 'two'], 2, "'two' is not a whole number"),
    ],
)
def test_impossible_arguments_of_pub(
    words: list[str], status: int, error: str, ros2_here: Ros2
) -> None:
    """Names and numbers that cannot be are told before anything is published."""
    result = ros2_here('topic', 'pub', *words, '--once')
    assert (result.returncode, result.stdout) == (status, '')
    assert error in result.stderr
    assert 'Traceback' not in result.stderr
