# SPDX-License-Identifier: Apache-2.0
"""Tests of the verbs of `ros2 lifecycle` with a real node."""

from collections.abc import Callable
import subprocess
from subprocess import CompletedProcess
import sys
from types import SimpleNamespace

import pytest
from ros2cli.graph.watch import GraphWatch
import ros2lifecycle.api
from ros2node.api import known_nodes

Ros2 = Callable[..., CompletedProcess[str]]

SLOW = """
import time
import rclpy
from lifecycle_msgs.srv import GetState
rclpy.init()
node = rclpy.create_node('slow')
print('node', flush=True)
input()
time.sleep(0.3)
service = node.create_service(GetState, 'slow/get_state', lambda _, answer: answer)
rclpy.spin(node)
"""


def test_nodes(ros2_robot: Ros2) -> None:
    """Only nodes with a life cycle are listed."""
    assert ros2_robot('lifecycle', 'nodes').stdout == '/lamp\n'
    assert ros2_robot('lifecycle', 'nodes', '-c').stdout == '1\n'


def test_states_and_transitions(ros2_robot: Ros2) -> None:
    """A node is configured by label and cleaned up by number; each step shows in its state."""
    assert ros2_robot('lifecycle', 'get', 'lamp').stdout == 'unconfigured [1]\n'
    assert ros2_robot('lifecycle', 'list', '/lamp').stdout == (
        '- configure [1]\n\tStart: unconfigured\n\tGoal: configuring\n'
        '- shutdown [5]\n\tStart: unconfigured\n\tGoal: shuttingdown\n'
    )
    done = ros2_robot('lifecycle', 'set', '/lamp', 'configure')
    assert (done.returncode, done.stdout, done.stderr) == (0, 'Transitioning successful\n', '')
    assert ros2_robot('lifecycle', 'get').stdout == '/lamp: inactive [2]\n'
    back = ros2_robot('lifecycle', 'set', '/lamp', '2')
    assert back.stdout == 'Transitioning successful\n'


def test_all_transitions(ros2_robot: Ros2) -> None:
    """All transitions of the life cycle are listed when they are asked for."""
    output = ros2_robot('lifecycle', 'list', '/lamp', '--all').stdout
    assert '- activate [3]\n\tStart: inactive\n\tGoal: activating\n' in output


def test_unknown_transition_lists_available_ones(ros2_robot: Ros2) -> None:
    """A transition that is not possible is an error with those that are."""
    result = ros2_robot('lifecycle', 'set', '/lamp', 'configur')
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr == (
        'Unknown transition requested, available ones are:\n'
        "- configure [1]\n- shutdown [5]\nDid you mean 'configure'?\n"
    )


@pytest.mark.parametrize('words', [['get'], ['list'], ['set', 'configure']])
@pytest.mark.parametrize(
    ('node', 'hint'),
    [
        ('lmp', "Did you mean '/lamp'?"),
        ('/robot1/arm', "The node '/robot1/arm' is not a lifecycle node"),
    ],
)
def test_unknown_node(words: list[str], node: str, hint: str, ros2_robot: Ros2) -> None:
    """A node that is not there, or has no life cycle, is not found."""
    result = ros2_robot('lifecycle', words[0], node, *words[1:])
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr == f'Node not found\n{hint}\n'


@pytest.mark.usefixtures('domain')
def test_services_that_come_after_their_node(monkeypatch: pytest.MonkeyPatch) -> None:
    """A node that is seen while it is being created is a lifecycle node as soon as it is one."""
    monkeypatch.setattr(ros2lifecycle.api, 'DEFAULT_SPIN_TIME_S', 30.0)
    with subprocess.Popen(
        [sys.executable, '-c', SLOW], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as slow:

        def continue_when_known() -> None:
            if slow.stdin and known_nodes(watch.graph):
                slow.stdin.write('continue\n')
                slow.stdin.flush()

        try:
            assert slow.stdout and slow.stdout.readline() == 'node\n'
            with GraphWatch(check=continue_when_known) as watch:
                found = ros2lifecycle.api.find_lifecycle_node(SimpleNamespace(watch=watch), 'slow')
            assert found == '/slow'
        finally:
            slow.kill()
