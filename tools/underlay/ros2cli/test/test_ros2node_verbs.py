# SPDX-License-Identifier: Apache-2.0
"""Tests of the verbs of `ros2 node`."""

from collections.abc import Callable
from subprocess import CompletedProcess
from typing import Any

from domain_coordinator import domain_id
import pytest
from ros2node.api import get_node_names, NodeName, shared_names

Ros2 = Callable[..., CompletedProcess[str]]
Start = Callable[..., Any]


class FakeNode:
    """A node that knows a graph of three."""

    def get_name(self) -> str:
        """Return the name of the node itself."""
        return '_ros2cli_1'

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """Return what the graph has."""
        return [('b', '/'), ('_ros2cli_1', '/'), ('a', '/robot1'), ('b', '/')]


def test_names_are_sorted_and_complete() -> None:
    """The names come with their namespaces; duplicates stay and the asking node is left out."""
    names = get_node_names(node=FakeNode())
    assert [name.full_name for name in names] == ['/b', '/b', '/robot1/a']


def test_shared_names_are_found() -> None:
    """A full name that two nodes have is shared, a name in two namespaces is not."""
    names = [NodeName('a', '/', '/a'), NodeName('a', '/x', '/x/a'), NodeName('a', '/', '/a')]
    assert shared_names(names) == ['/a']


INFO_OF_TALKER = """\
/talker
  Subscribers:
    /orders: std_msgs/msg/String
  Publishers:
    /joint_commands: sensor_msgs/msg/JointState
    /mixed: std_msgs/msg/String
    /parameter_events: rcl_interfaces/msg/ParameterEvent
    /robot_description: std_msgs/msg/String
    /rosout: rcl_interfaces/msg/Log
    /temperature: sensor_msgs/msg/Temperature
  Service Servers:
    /talker/describe_parameters: rcl_interfaces/srv/DescribeParameters
    /talker/get_parameter_types: rcl_interfaces/srv/GetParameterTypes
    /talker/get_parameters: rcl_interfaces/srv/GetParameters
    /talker/get_type_description: type_description_interfaces/srv/GetTypeDescription
    /talker/list_parameters: rcl_interfaces/srv/ListParameters
    /talker/set_parameters: rcl_interfaces/srv/SetParameters
    /talker/set_parameters_atomically: rcl_interfaces/srv/SetParametersAtomically
  Service Clients:

  Action Servers:

  Action Clients:

"""
END_OF_INFO_OF_ARM = """\
  Service Clients:
    /fire: std_srvs/srv/Trigger
  Action Servers:
    /look: tf2_msgs/action/LookupTransform
  Action Clients:

"""
ROWS = [
    (['list'], '/talker\n'),
    (['list', '--all'], '/robot1/_helper\n/talker\n'),
    (['list', '-c', '--no-daemon'], '1\n'),
    (['list', '--count-nodes', '-a', '--spin-time', '1'], '2\n'),
    (['info', '/talker'], INFO_OF_TALKER),
]
ERRORS = [
    ('talker', "Unable to find node 'talker'\nDid you mean '/talker'?\n"),
    ('/taller', "Unable to find node '/taller'\nDid you mean '/talker'?\n"),
    ('/x', "Unable to find node '/x'\n"),
    ('', "Unable to find node ''\n"),
]


@pytest.mark.usefixtures('talker')
@pytest.mark.parametrize(('words', 'output'), ROWS, ids=lambda words: ' '.join(words))
def test_output(words: list[str], output: str, ros2_here: Ros2) -> None:
    """The verb prints this and nothing else."""
    result = ros2_here('node', *words)
    assert (result.stdout, result.stderr, result.returncode) == (output, '', 0)


@pytest.mark.usefixtures('talker')
@pytest.mark.parametrize(('name', 'errors'), ERRORS)
def test_unknown_node(name: str, errors: str, ros2_here: Ros2) -> None:
    """A name that is not complete is unknown; one that comes close is offered."""
    result = ros2_here('node', 'info', name)
    assert (result.stdout, result.stderr, result.returncode) == ('', errors, 1)


def test_info_hides_hidden_names(ros2_robot: Ros2) -> None:
    """Actions have a section of their own; the parts they consist of are shown if asked for."""
    result = ros2_robot('node', 'info', '/robot1/arm')
    assert result.stdout.endswith(END_OF_INFO_OF_ARM)
    assert '/_' not in result.stdout
    everything = ros2_robot('node', 'info', '--include-hidden', '/robot1/arm').stdout
    hidden = sorted(set(everything.splitlines()) - set(result.stdout.splitlines()))
    assert hidden == [
        '    /flip/_service_event: std_srvs/srv/SetBool_Event',
        '    /look/_action/cancel_goal: action_msgs/srv/CancelGoal',
        '    /look/_action/feedback: tf2_msgs/action/LookupTransform_FeedbackMessage',
        '    /look/_action/get_result: tf2_msgs/action/LookupTransform_GetResult',
        '    /look/_action/send_goal: tf2_msgs/action/LookupTransform_SendGoal',
        '    /look/_action/status: action_msgs/msg/GoalStatusArray',
        '    /robot1/_secret: std_srvs/srv/Trigger',
    ]


def test_nodes_of_one_name_are_warned_about(ros2_here: Ros2, start_ros2: Start) -> None:
    """Each of two nodes with one name is listed, and a warning names them."""
    with domain_id() as domain:
        variables = {'ROS_DOMAIN_ID': str(domain)}
        words = ('topic', 'pub', '/x', 'std_msgs/msg/String', '--node-name', 'twin', '-p', '0')
        twins = [start_ros2(*words, extra=variables) for _ in range(2)]
        assert [twin.stdout.readline() for twin in twins] == ['publisher: beginning loop\n'] * 2
        result = ros2_here('node', 'list', **variables)
    assert (result.stdout, result.returncode) == ('/twin\n/twin\n', 0)
    assert result.stderr == (
        'WARNING: Be aware that there are nodes in the graph that share an exact name, which '
        'can have unintended side effects: /twin\n'
    )


def test_empty_graph_prints_nothing(ros2_here: Ros2) -> None:
    """A graph without nodes has no nodes and no topics."""
    with domain_id() as empty:
        for words in (['node', 'list'], ['topic', 'list']):
            result = ros2_here(*words, ROS_DOMAIN_ID=str(empty))
            assert (result.returncode, result.stdout, result.stderr) == (0, '', '')
