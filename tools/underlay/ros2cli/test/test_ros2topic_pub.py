# SPDX-License-Identifier: Apache-2.0
"""Tests of `ros2 topic pub`, and of the verbs that measure, with real processes."""

from collections.abc import Callable
import signal
from subprocess import CompletedProcess
from typing import Any

import pytest

Ros2 = Callable[..., CompletedProcess[str]]
Start = Callable[..., Any]


def test_once_reaches_a_subscription(ros2_here: Ros2, start_ros2: Start) -> None:
    """A single message waits for a subscription and arrives there."""
    latched = ['--qos-durability', 'transient_local', '--qos-reliability', 'reliable']
    echo = start_ros2('topic', 'echo', '--once', '/chatter', 'std_msgs/msg/String', *latched)
    result = ros2_here(
        'topic',
        'pub',
        '--once',
        '/chatter',
        'std_msgs/String',
        'data: hi',
        *latched,
        '--keep-alive',
        '2',
    )
    assert result.stdout.endswith(
        "publisher: beginning loop\npublishing #1: std_msgs.msg.String(data='hi')\n\n"
    )
    assert (result.returncode, result.stderr) == (0, '')
    assert echo.communicate(timeout=20.0)[0] == 'data: hi\n---\n'


def test_times_and_print_without_subscription(ros2_here: Ros2) -> None:
    """A number of messages is published; only every second one is shown."""
    result = ros2_here(
        'topic',
        'pub',
        '-t',
        '4',
        '-p',
        '2',
        '-r',
        '100',
        '-w',
        '0',
        '/chatter',
        'std_msgs/msg/String',
    )
    assert [line for line in result.stdout.splitlines() if line] == [
        'publisher: beginning loop',
        "publishing #2: std_msgs.msg.String(data='')",
        "publishing #4: std_msgs.msg.String(data='')",
    ]


def test_no_subscription_in_time_is_an_error(ros2_here: Ros2) -> None:
    """The wait for a subscription is announced and has an end."""
    result = ros2_here(
        'topic', 'pub', '--once', '/chatter', 'std_msgs/msg/String', '--max-wait-time-secs', '0.2'
    )
    assert result.stdout == 'Waiting for at least 1 matching subscription(s)...\n'
    assert result.returncode == 1
    assert result.stderr.startswith('Timed out waiting for subscribers: Expected 1 ')


@pytest.mark.parametrize(('sent', 'status'), [(signal.SIGINT, 2), (signal.SIGTERM, 15)])
def test_signal_ends_pub_quietly(sent: signal.Signals, status: int, start_ros2: Start) -> None:
    """A signal ends an endless publication without a traceback."""
    process = start_ros2('topic', 'pub', '/chatter', 'std_msgs/msg/String')
    assert process.stdout.readline() == 'publisher: beginning loop\n'
    process.send_signal(sent)
    assert process.wait(timeout=20.0) == status
    assert process.stderr.read() == ''


@pytest.mark.usefixtures('talker')
def test_type_and_find(ros2_here: Ros2) -> None:
    """A topic has a type, and a type has topics; for unknown ones there is silence."""
    assert ros2_here('topic', 'type', '/joint_commands').stdout == 'sensor_msgs/msg/JointState\n'
    unknown = ros2_here('topic', 'type', '/nope')
    assert (unknown.returncode, unknown.stdout, unknown.stderr) == (1, '', '')
    found = ros2_here('topic', 'find', 'sensor_msgs/msg/JointState')
    assert (found.returncode, found.stdout) == (0, '/joint_commands\n')


@pytest.mark.usefixtures('talker')
def test_bandwidth_is_reported(start_ros2: Start) -> None:
    """The report has the size of the messages."""
    process = start_ros2('topic', 'bw', '/joint_commands')
    assert process.stdout.readline() == 'Subscribed to [/joint_commands]\n'
    assert 'B/s from ' in process.stdout.readline()
    assert process.stdout.readline().startswith('\tMessage size mean: ')


@pytest.mark.usefixtures('talker')
def test_delay_needs_a_header(ros2_here: Ros2) -> None:
    """A message without a header has no delay."""
    result = ros2_here('topic', 'delay', '/robot_description')
    assert result.returncode == 1
    assert result.stderr.endswith('msg does not have header\n')


@pytest.mark.parametrize('name', ['/x/', '1x', '/a b', '~/1x', '~~', '{node}', ''])
def test_what_is_no_topic_is_refused(name: str, ros2_here: Ros2) -> None:
    """A name that no topic can have is an error of one sentence, before anything is published."""
    result = ros2_here('topic', 'pub', name, 'std_msgs/msg/String')
    assert (result.returncode, result.stdout) == (1, '')
    assert 'is no name of a topic: parts of letters, digits and underscores' in result.stderr
