# SPDX-License-Identifier: Apache-2.0
"""Tests of the verbs of `ros2 topic` with real nodes."""

from collections.abc import Callable
import signal
from subprocess import CompletedProcess
from typing import Any

import pytest

Ros2 = Callable[..., CompletedProcess[str]]
Start = Callable[..., Any]

TOPICS = [
    '/joint_commands',
    '/mixed',
    '/orders',
    '/parameter_events',
    '/robot_description',
    '/rosout',
    '/temperature',
]

pytestmark = pytest.mark.usefixtures('talker')


def test_list_is_sorted_without_hidden_topics(ros2_here: Ros2) -> None:
    """The list has one name a line, and no name with a leading underscore in a part."""
    result = ros2_here('topic', 'list')
    assert result.stdout.splitlines() == TOPICS
    assert (result.returncode, result.stderr) == (0, '')


def test_list_with_hidden_topics_and_types(ros2_here: Ros2) -> None:
    """Hidden topics appear when they are asked for; types follow in brackets."""
    output = ros2_here('topic', 'list', '-t', '--include-hidden-topics').stdout.splitlines()
    assert '/robot1/_secret [std_msgs/msg/String]' in output
    assert '/joint_commands [sensor_msgs/msg/JointState]' in output
    assert len(output) == len(TOPICS) + 1


def test_list_counts(ros2_here: Ros2) -> None:
    """The number of topics replaces their names."""
    assert ros2_here('topic', 'list', '--count-topics').stdout == f'{len(TOPICS)}\n'


def test_list_verbose(ros2_here: Ros2) -> None:
    """The verbose list is in two parts, with counts."""
    published, _, subscribed = ros2_here('topic', 'list', '-v').stdout.partition('\n\n')
    assert published.startswith('Published topics:\n * /joint_commands ')
    assert ' * /mixed [std_msgs/msg/String] 2 publishers' in published
    assert subscribed == ('Subscribed topics:\n * /orders [std_msgs/msg/String] 1 subscriber\n')


def test_info_counts_endpoints(ros2_here: Ros2) -> None:
    """The info names the type and counts the endpoints of others only."""
    expected = 'Type: sensor_msgs/msg/JointState\nPublisher count: 1\nSubscription count: 0\n'
    assert ros2_here('topic', 'info', '/joint_commands').stdout == expected


def test_info_verbose_shows_endpoints(ros2_here: Ros2) -> None:
    """The verbose info describes each endpoint."""
    output = ros2_here('topic', 'info', '-v', '/temperature').stdout
    assert output.startswith(
        'Type: sensor_msgs/msg/Temperature\n\nPublisher count: 1\n\nNode name: talker\n'
    )
    assert 'Reliability: BEST_EFFORT' in output
    assert output.endswith('Subscription count: 0\n\n')


def test_info_of_unknown_topic_suggests(ros2_here: Ros2) -> None:
    """A name without its slash is unknown, and the error says so."""
    result = ros2_here('topic', 'info', 'temperature')
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr == "Unknown topic 'temperature'\nDid you mean '/temperature'?\n"


def test_echo_once_prints_yaml(ros2_here: Ros2) -> None:
    """A message is printed as YAML, followed by a separator."""
    result = ros2_here('topic', 'echo', '--once', '/temperature')
    assert result.stdout == (
        "header:\n  stamp:\n    sec: 0\n    nanosec: 0\n  frame_id: ''\n"
        'temperature: 21.5\nvariance: 0.0\n---\n'
    )
    assert (result.returncode, result.stderr) == (0, '')


def test_echo_receives_latched_message(ros2_here: Ros2) -> None:
    """A message published long ago arrives, because the publisher's durability is copied."""
    output = ros2_here('topic', 'echo', '--once', 'robot_description', '-l', '12').stdout
    assert output == 'data: <robot/><rob...\n---\n'


def test_echo_field_and_csv(ros2_here: Ros2) -> None:
    """A single field and comma separated values can be chosen."""
    field = ros2_here('topic', 'echo', '--once', '/joint_commands', '--field', 'position')
    assert field.stdout == '- 0.25\n- -0.5\n---\n'
    values = ros2_here('topic', 'echo', '--once', '/joint_commands', '--csv')
    assert values.stdout == '0,0,,left,right,0.25,-0.5\n'


def test_echo_with_message_info(ros2_here: Ros2) -> None:
    """The info about the message stands before it."""
    result = ros2_here('topic', 'echo', '--once', '-i', '/joint_commands', '--field', 'name')
    names = [line.partition(':')[0] for line in result.stdout.splitlines()]
    assert names == [
        'publication_sequence_number',
        'received_timestamp',
        'reception_sequence_number',
        'source_timestamp',
        '- left',
        '- right',
        '---',
    ]


def test_echo_of_mixed_publishers_tells(ros2_here: Ros2) -> None:
    """A fallback to a weaker quality of service is not silent."""
    output = ros2_here('topic', 'echo', '/mixed', '--timeout', '0.2').stdout
    assert 'Some, but not all, publishers are offering' in output


@pytest.mark.parametrize(
    ('words', 'error'),
    [
        (
            ['/joint_commands', '--field', 'nope', '--once'],
            "Invalid field 'nope': 'JointState' object has no attribute 'nope'",
        ),
        (['/nope'], 'Could not determine the type for the passed topic'),
        (['/nope', 'std_msgs/msg/Strin'], 'The passed message type is invalid'),
    ],
)
def test_echo_errors(words: list[str], error: str, ros2_here: Ros2) -> None:
    """What cannot be echoed is an error of one sentence or two."""
    result = ros2_here('topic', 'echo', *words)
    assert result.returncode == 1
    assert result.stderr.splitlines()[0] == error


def test_echo_timeout_is_no_error(ros2_here: Ros2) -> None:
    """The end of the time limit is success, also without a message."""
    result = ros2_here('topic', 'echo', '/silent', 'std_msgs/String', '--timeout', '0.3')
    assert (result.returncode, result.stdout, result.stderr) == (0, '', '')


def test_closed_pipe_ends_quietly(start_ros2: Start) -> None:
    """A reader that goes away ends the command without a complaint."""
    process = start_ros2('topic', 'echo', '/joint_commands')
    assert process.stdout.readline() == 'header:\n'
    process.stdout.close()
    assert process.wait(timeout=20.0) == 128 + signal.SIGPIPE
    assert process.stderr.read() == ''


@pytest.mark.parametrize(('sent', 'status'), [(signal.SIGINT, 2), (signal.SIGTERM, 15)])
def test_signal_ends_hz_quietly(sent: signal.Signals, status: int, start_ros2: Start) -> None:
    """The rate is reported until a signal comes, whose number becomes the status."""
    process = start_ros2('topic', 'hz', '/joint_commands', '--window', '100')
    first, second = process.stdout.readline(), process.stdout.readline()
    assert first.startswith('average rate: ')
    assert 1.0 < float(first.split()[-1]) < 55.0
    assert second.startswith('\tmin: ')
    process.send_signal(sent)
    assert process.wait(timeout=20.0) == status
    assert process.stderr.read() == ''


def test_hz_waits_for_a_publisher(start_ros2: Start) -> None:
    """A topic that nobody publishes is waited for, and the wait is announced."""
    process = start_ros2('topic', 'hz', '/nope')
    expected = 'WARNING: topic [/nope] does not appear to be published yet\n'
    assert process.stdout.readline() == expected
    assert process.stderr.readline().startswith("Still waiting for a publisher of '/nope'")
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=20.0) == 2
