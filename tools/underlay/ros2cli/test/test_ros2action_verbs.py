# SPDX-License-Identifier: Apache-2.0
"""Tests of the verbs of `ros2 action` with a real server."""

from collections.abc import Callable
import re
import signal
from subprocess import CompletedProcess
import time
from typing import Any

import pytest
from rclpy.context import Context
from rclpy.node import Node

Ros2 = Callable[..., CompletedProcess[str]]
Start = Callable[..., Any]

TYPE = 'tf2_msgs/action/LookupTransform'
TIME = '       sec: 0\n       nanosec: 0\n'
GOAL = (
    'Waiting for an action server to become available...\nSending goal:\n'
    '     target_frame: {frame}\n'
    "     source_frame: ''\n"
    f'     source_time:\n{TIME}     timeout:\n{TIME}     target_time:\n{TIME}'
    "     fixed_frame: ''\n"
    '     advanced: false\n\n'
)


def test_list(ros2_robot: Ros2) -> None:
    """Actions are listed by name, with their types or as a number."""
    assert ros2_robot('action', 'list').stdout == '/look\n'
    assert ros2_robot('action', 'list', '-t').stdout == f'/look [{TYPE}]\n'
    assert ros2_robot('action', 'list', '-c').stdout == '1\n'


def test_type(ros2_robot: Ros2) -> None:
    """The type of an action is printed; an unknown action is a silent failure."""
    assert ros2_robot('action', 'type', '/look').stdout == f'{TYPE}\n'
    unknown = ros2_robot('action', 'type', '/nope')
    assert (unknown.returncode, unknown.stdout, unknown.stderr) == (1, '', '')


@pytest.mark.parametrize(
    ('words', 'output'),
    [
        (['/look'], 'Action: /look\nAction clients: 0\nAction servers: 1\n    /robot1/arm\n'),
        (
            ['/look', '-t'],
            f'Action: /look\nAction clients: 0\nAction servers: 1\n    /robot1/arm [{TYPE}]\n',
        ),
        (['/look', '-c'], 'Action: /look\nAction clients: 0\nAction servers: 1\n'),
        (['/nope'], 'Action: /nope\nAction clients: 0\nAction servers: 0\n'),
    ],
)
def test_info(words: list[str], output: str, ros2_robot: Ros2) -> None:
    """The nodes of an action are listed, with types on request; an unknown one has none."""
    result = ros2_robot('action', 'info', *words)
    assert (result.returncode, result.stdout, result.stderr) == (0, output, '')


def test_goal_with_feedback(ros2_robot: Ros2) -> None:
    """A goal is followed from its acceptance through feedback to its result."""
    result = ros2_robot('action', 'send_goal', '-f', 'look', TYPE, '{target_frame: torso}')
    goal = GOAL.format(frame='torso')
    assert result.stdout.startswith(goal)
    rest = result.stdout.removeprefix(goal)
    assert re.match(r'Goal accepted with ID: [0-9a-f]{32}\n\nFeedback:\n    \{\}\n\n', rest)
    assert rest.count('Feedback:') == 2
    assert '\nResult:\n    transform:\n      header:\n' in rest
    assert '      child_frame_id: torso\n' in rest
    assert rest.endswith("      error_string: ''\n\nGoal finished with status: SUCCEEDED\n")
    assert (result.returncode, result.stderr) == (0, '')


def test_aborted_goal(ros2_robot: Ros2) -> None:
    """The end of a goal names its status; without -f there is no feedback."""
    output = ros2_robot('action', 'send_goal', '/look', TYPE, '{target_frame: abort}').stdout
    assert output.endswith('\nGoal finished with status: ABORTED\n')
    assert 'Feedback' not in output


def test_rejected_goal(ros2_robot: Ros2) -> None:
    """A goal that the server refuses is no error."""
    result = ros2_robot('action', 'send_goal', '/look', TYPE, '{target_frame: reject}')
    assert result.stdout == f'{GOAL.format(frame="reject")}Goal was rejected.\n'
    assert (result.returncode, result.stderr) == (0, '')


def test_no_participant_outlives_the_goal(robot: dict[str, str], start_at_robot: Start) -> None:
    """The command leaves the domain, so that nobody waits for a reader that is no more."""
    context = Context()
    context.init(domain_id=int(robot['ROS_DOMAIN_ID']))
    node = Node('observer', context=context, enable_rosout=False, start_parameter_services=False)

    def participants() -> int:
        return len(node.get_publishers_info_by_topic('ros_discovery_info', no_mangle=True))

    def see(count: int) -> None:
        end_s = time.monotonic() + 10.0  # one that is killed is remembered for 20 s
        while participants() != count and time.monotonic() < end_s:
            time.sleep(0.02)
        assert participants() == count

    see(2)
    process = start_at_robot('action', 'send_goal', '/look', TYPE, '{target_frame: wait}')
    while not process.stdout.readline().startswith('Goal accepted'):
        pass
    see(3)
    process.send_signal(signal.SIGINT)
    process.wait(timeout=100)
    see(2)
    node.destroy_node()
    context.try_shutdown()


@pytest.mark.parametrize(('number', 'status'), [(signal.SIGINT, 2), (signal.SIGTERM, 15)])
def test_signal_cancels_the_goal(number: int, status: int, start_at_robot: Start) -> None:
    """Ctrl-C or SIGTERM cancels an active goal before the command ends with its status."""
    process = start_at_robot('action', 'send_goal', '/look', TYPE, '{target_frame: wait}')
    while not process.stdout.readline().startswith('Goal accepted'):
        pass
    process.send_signal(number)
    text = process.stdout.read().lstrip()
    assert text == 'Canceling goal...\nGoal canceled.\n', process.stderr.read()
    assert process.wait(timeout=100) == status
    assert process.stderr.read() == ''


@pytest.mark.parametrize(
    ('words', 'error'),
    [
        ([TYPE, '{nope: 1}'], 'Failed to populate message fields: AttributeError("'),
        ([TYPE, '[1]'], 'The passed value needs to be a dictionary in YAML format'),
        (['tf2_msgs/action/Nope'], 'The passed action type is invalid'),
        (['std_msgs/msg/String'], 'The passed action type is invalid'),
    ],
)
def test_wrong_goals(words: list[str], error: str, ros2_here: Ros2) -> None:
    """What is no goal is an error before anything is waited for."""
    result = ros2_here('action', 'send_goal', '/look', *words)
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr.startswith(error)


def test_missing_server_is_waited_for(start_at_robot: Start) -> None:
    """The wait for a server is announced, with the action that may be meant."""
    process = start_at_robot('action', 'send_goal', '/lok', TYPE)
    lines = iter(process.stderr.readline, '')
    assert next(line for line in lines if not line.startswith('WARNING: a ROS process')) == (
        "Still waiting for a server of the action '/lok' (Ctrl-C to stop). Did you mean '/look'?\n"
    )
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=100) == 2
    assert process.stderr.read() == ''
