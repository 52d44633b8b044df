# SPDX-License-Identifier: Apache-2.0
"""Tests of the verbs of `ros2 node`."""

from collections.abc import Callable
from subprocess import CompletedProcess

from domain_coordinator import domain_id
import pytest
from ros2node.api import get_node_names, NodeName, shared_names

Ros2 = Callable[..., CompletedProcess[str]]


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


@pytest.mark.usefixtures('talker')
def test_list_hides_hidden_nodes(ros2_here: Ros2) -> None:
    """The list has full names; hidden ones only with `--all`."""
    assert ros2_here('node', 'list').stdout == '/talker\n'
    assert ros2_here('node', 'list', '--all').stdout == '/robot1/_helper\n/talker\n'
    assert ros2_here('node', 'list', '--count-nodes').stdout == '1\n'


@pytest.mark.usefixtures('talker')
def test_info_has_all_sections(ros2_here: Ros2) -> None:
    """The info lists what a node offers under six headings."""
    lines = ros2_here('node', 'info', '/talker').stdout.splitlines()
    assert lines[:3] == ['/talker', '  Subscribers:', '    /orders: std_msgs/msg/String']
    assert '    /joint_commands: sensor_msgs/msg/JointState' in lines
    assert [line for line in lines if line.startswith('  ') and line[2] != ' '] == [
        '  Subscribers:',
        '  Publishers:',
        '  Service Servers:',
        '  Service Clients:',
        '  Action Servers:',
        '  Action Clients:',
    ]
    assert lines[-1] == ''


@pytest.mark.usefixtures('talker')
def test_info_of_unknown_node_suggests(ros2_here: Ros2) -> None:
    """A name without its slash is unknown, and the error says so."""
    result = ros2_here('node', 'info', 'talker')
    assert result.returncode == 1
    assert result.stderr == "Unable to find node 'talker'\nDid you mean '/talker'?\n"


def test_empty_graph_prints_nothing(ros2_here: Ros2) -> None:
    """A graph without nodes has no nodes and no topics."""
    with domain_id() as empty:
        for words in (['node', 'list'], ['topic', 'list']):
            result = ros2_here(*words, ROS_DOMAIN_ID=str(empty))
            assert (result.returncode, result.stdout, result.stderr) == (0, '', '')
