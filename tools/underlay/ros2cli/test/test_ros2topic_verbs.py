# SPDX-License-Identifier: Apache-2.0
"""Tests of the whole output of the verbs of `ros2 topic` that end by themselves."""

from collections.abc import Callable
import re
import signal
from subprocess import CompletedProcess
from typing import Any

import pytest

Ros2 = Callable[..., CompletedProcess[str]]
Start = Callable[..., Any]

LIST = """\
/joint_commands
/mixed
/orders
/parameter_events
/robot_description
/rosout
/temperature
"""
LIST_WITH_TYPES = """\
/joint_commands [sensor_msgs/msg/JointState]
/mixed [std_msgs/msg/String]
/orders [std_msgs/msg/String]
/parameter_events [rcl_interfaces/msg/ParameterEvent]
/robot1/_secret [std_msgs/msg/String]
/robot_description [std_msgs/msg/String]
/rosout [rcl_interfaces/msg/Log]
/temperature [sensor_msgs/msg/Temperature]
"""
VERBOSE_LIST = """\
Published topics:
 * /joint_commands [sensor_msgs/msg/JointState] 1 publisher
 * /mixed [std_msgs/msg/String] 2 publishers
 * /parameter_events [rcl_interfaces/msg/ParameterEvent] 2 publishers
 * /robot_description [std_msgs/msg/String] 1 publisher
 * /rosout [rcl_interfaces/msg/Log] 2 publishers
 * /temperature [sensor_msgs/msg/Temperature] 1 publisher

Subscribed topics:
 * /orders [std_msgs/msg/String] 1 subscriber
"""
TEMPERATURE = """\
header:
  stamp:
    sec: 0
    nanosec: 0
  frame_id: ''
temperature: 21.5
variance: 0.0
---
"""
JOINTS_WITHOUT_CONTENT = """\
header:
  stamp:
    sec: 0
    nanosec: 0
  frame_id: '<string length: <0>>'
name: '<sequence type: string, length: 2>'
position: '<sequence type: float64, length: 2>'
velocity: '<sequence type: float64, length: 0>'
effort: '<sequence type: float64, length: 0>'
---
"""
JOINTS_CUT = """\
header:
  stamp:
    sec: 0
    nanosec: 0
  frame_id: ''
name:
- l...
- '...'
position:
- 0.25
- '...'
velocity: []
effort: []
---
"""
JOINTS_ON_ONE_LINE = (
    "{header: {stamp: {sec: 0, nanosec: 0}, frame_id: ''}, name: [left, right], "
    'position: [0.25, -0.5], velocity: [], effort: []}\n---\n'
)
VERBOSE_INFO = """\
Type: sensor_msgs/msg/Temperature

Publisher count: 1

Node name: talker
Node namespace: /
Topic type: sensor_msgs/msg/Temperature
Topic type hash: RIHS01_HASH
Endpoint type: PUBLISHER
GID: GID_VALUE
QoS profile:
  Reliability: BEST_EFFORT
  History (Depth): UNKNOWN
  Durability: VOLATILE
  Lifespan: Infinite
  Deadline: Infinite
  Liveliness: AUTOMATIC
  Liveliness lease duration: Infinite

Subscription count: 0

"""
MIXED_POLICIES = [
    ('ReliabilityPolicy.RELIABLE', 'ReliabilityPolicy.BEST_EFFORT'),
    ('DurabilityPolicy.TRANSIENT_LOCAL', 'DurabilityPolicy.VOLATILE'),
]
INFO = 'Type: {}\nPublisher count: {}\nSubscription count: {}\n'
JOINT_STATE = 'sensor_msgs/msg/JointState'
ECHO_JOINTS = ['echo', '/joint_commands', '--once']

ROWS = [
    (['list'], LIST),
    (['list', '-t', '--include-hidden-topics'], LIST_WITH_TYPES),
    (['--include-hidden-topics', 'list', '--show-types'], LIST_WITH_TYPES),
    (['list', '-c'], '7\n'),
    (['list', '--count-topics', '--include-hidden-topics', '--no-daemon'], '8\n'),
    (['list', '-v', '--spin-time', '1'], VERBOSE_LIST),
    (['info', '/joint_commands'], INFO.format(JOINT_STATE, 1, 0)),
    (['info', '/orders'], INFO.format('std_msgs/msg/String', 0, 1)),
    (['type', '/joint_commands'], f'{JOINT_STATE}\n'),
    (['type', '/robot1/_secret'], 'std_msgs/msg/String\n'),
    (['find', JOINT_STATE], '/joint_commands\n'),
    (['find', 'std_msgs/msg/String', '-c'], '3\n'),
    (
        ['find', 'std_msgs/msg/String', '--include-hidden-topics'],
        '/mixed\n/orders\n/robot1/_secret\n/robot_description\n',
    ),
    (['find', 'std_msgs/msg/Nope'], ''),
    (['echo', '--once', '/temperature', 'sensor_msgs/Temperature'], TEMPERATURE),
    (['echo', 'robot_description', '--once', '-l', '12'], 'data: <robot/><rob...\n---\n'),
    (['echo', 'robot_description', '--once'], f'data: {"<robot/>" * 16}...\n---\n'),
    (['echo', 'robot_description', '--once', '-f'], f'data: {"<robot/>" * 40}\n---\n'),
    ([*ECHO_JOINTS, '--field', 'position'], '- 0.25\n- -0.5\n---\n'),
    ([*ECHO_JOINTS, '--field', 'header.stamp.sec'], '0\n---\n'),
    ([*ECHO_JOINTS, '--field', 'name', '--flow-style'], '[left, right]\n---\n'),
    ([*ECHO_JOINTS, '--csv'], '0,0,,left,right,0.25,-0.5\n'),
    ([*ECHO_JOINTS, '--csv', '--field', 'header.stamp'], '0,0\n'),
    ([*ECHO_JOINTS, '--no-arr', '--no-str'], JOINTS_WITHOUT_CONTENT),
    ([*ECHO_JOINTS, '--truncate-length', '1'], JOINTS_CUT),
    ([*ECHO_JOINTS, '--flow-style'], JOINTS_ON_ONE_LINE),
    ([*ECHO_JOINTS, '--field', 'name', '--filter', 'm.position[0] > 0'], '- left\n- right\n---\n'),
    (['echo', '/temperature', '--filter', 'm.temperature < 0', '--timeout', '0.5'], ''),
    (['echo', '/silent', 'std_msgs/String', '--timeout', '0.3'], ''),
]

NO_TYPE = 'Could not determine the type for the passed topic\n'
NOT_PUBLISHED = 'WARNING: topic [/temperatur] does not appear to be published yet\n'
ERRORS = [
    (
        ['info', 'temperature'],
        '',
        "Unknown topic 'temperature'\nDid you mean '/temperature'?\n",
    ),
    (['info', '/nope'], '', "Unknown topic '/nope'\n"),
    (['type', '/nope'], '', ''),
    (['type', 'temperature'], '', ''),
    (['echo', '/temperatur'], NOT_PUBLISHED, f"{NO_TYPE}Did you mean '/temperature'?\n"),
    (
        ['echo', '/nope', 'std_msgs/msg/Strin'],
        '',
        "The passed message type is invalid\n'std_msgs/msg' has no type 'Strin'. "
        "Did you mean 'String'?\n",
    ),
    (
        [*ECHO_JOINTS, '--field', 'nope'],
        '',
        "Invalid field 'nope': 'JointState' object has no attribute 'nope'\n",
    ),
    (
        [*ECHO_JOINTS, '--field', '__class__'],
        '',
        "Invalid field '__class__': 'JointState' object has no attribute '__class__'\n",
    ),
    (
        [*ECHO_JOINTS, '--field', 'header.stamp.sec.real'],
        '',
        "Invalid field 'header.stamp.sec.real': 'int' object has no attribute 'real'\n",
    ),
    (
        [*ECHO_JOINTS, '--field', 'positions'],
        '',
        "Invalid field 'positions': 'JointState' object has no attribute 'positions'\n"
        "Did you mean 'position'?\n",
    ),
    (
        [*ECHO_JOINTS, '--filter', 'm.nope'],
        '',
        "The filter 'm.nope' cannot be applied: 'JointState' object has no field 'nope'\n",
    ),
    (['delay', '/robot_description'], '', 'msg does not have header\n'),
]

pytestmark = pytest.mark.usefixtures('talker')


@pytest.mark.parametrize(('words', 'output'), ROWS, ids=lambda words: ' '.join(words))
def test_output(words: list[str], output: str, ros2_here: Ros2) -> None:
    """The verb prints this and nothing else."""
    result = ros2_here('topic', *words)
    assert (result.stdout, result.stderr, result.returncode) == (output, '', 0)


@pytest.mark.parametrize(('words', 'output', 'errors'), ERRORS)
def test_error(words: list[str], output: str, errors: str, ros2_here: Ros2) -> None:
    """What cannot be done has status 1 and a sentence, or the silence that is expected."""
    result = ros2_here('topic', *words)
    assert (result.stdout, result.stderr, result.returncode) == (output, errors, 1)


def test_verbose_info_describes_endpoints(ros2_here: Ros2) -> None:
    """The verbose info has a block for each endpoint, with its quality of service."""
    pattern = re.escape(VERBOSE_INFO).replace('HASH', '[0-9a-f]{64}')
    pattern = pattern.replace('GID_VALUE', r'[0-9a-f]{2}(\.[0-9a-f]{2}){15}')
    result = ros2_here('topic', 'info', '/temperature', '--verbose')
    assert re.fullmatch(pattern, result.stdout), result.stdout
    assert (result.stderr, result.returncode) == ('', 0)


def test_echo_with_message_info(ros2_here: Ros2) -> None:
    """The info about the message stands before it."""
    result = ros2_here('topic', *ECHO_JOINTS, '-i', '--field', 'name')
    assert re.fullmatch(
        r'publication_sequence_number: \d+\nreceived_timestamp: \d{19}\n'
        r'reception_sequence_number: (null|\d+)\nsource_timestamp: \d{19}\n'
        r'- left\n- right\n---\n',
        result.stdout,
    )
    assert (result.stderr, result.returncode) == ('', 0)


def test_raw_echo_shows_bytes(ros2_here: Ros2) -> None:
    """The raw form is that of Python's bytes, also where commas are asked for."""
    for words in (['--raw'], ['--raw', '--csv']):
        result = ros2_here('topic', 'echo', 'robot_description', '--once', *words)
        data = b'\x00\x01\x00\x00A\x01\x00\x00' + b'<robot/>' * 40 + b'\x00' + bytes(3)
        assert (result.stdout, result.stderr) == (f'{data!r}\n---\n', '')


def test_echo_of_mixed_publishers_tells(ros2_here: Ros2) -> None:
    """A fallback to a weaker quality of service is not silent."""
    result = ros2_here('topic', 'echo', '/mixed', '--timeout', '0.2')
    assert result.stdout == ''.join(
        f'Some, but not all, publishers are offering {strong}. Falling back to {weak} as it '
        'will connect to all publishers\n'
        for strong, weak in MIXED_POLICIES
    )
    assert (result.stderr, result.returncode) == ('', 0)


def test_closed_pipe_ends_quietly(start_ros2: Start) -> None:
    """A reader that goes away ends the command without a complaint."""
    process = start_ros2('topic', 'echo', '/joint_commands')
    assert process.stdout.readline() == 'header:\n'
    process.stdout.close()
    assert process.wait(timeout=100) == 128 + signal.SIGPIPE
    assert process.stderr.read() == ''


@pytest.mark.parametrize(('sent', 'status'), [(signal.SIGINT, 2), (signal.SIGTERM, 15)])
def test_signal_ends_echo_quietly(sent: signal.Signals, status: int, start_ros2: Start) -> None:
    """Messages are printed until a signal comes, whose number becomes the status."""
    process = start_ros2('topic', 'echo', '/joint_commands', '--csv')
    assert process.stdout.readline() == '0,0,,left,right,0.25,-0.5\n'
    process.send_signal(sent)
    assert process.wait(timeout=100) == status
    assert process.stderr.read() == ''
