# SPDX-License-Identifier: Apache-2.0
"""Substitutions of nodes are performed once, when the action is executed, and never later."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from launch import LaunchContext, Substitution
from launch.actions import GroupAction, SetLaunchConfiguration
from launch_ros.actions import Node, SetParameter, SetRemap
from launch_ros.actions._load_request import build_load_request
from launch_ros.descriptions import ComposableNode
import pytest

Performed = list[tuple[str, str]]
MakeSpy = Callable[[str, str], Substitution]


class Spy(Substitution):
    """A text that notes in which scope it is asked for."""

    def __init__(self, name: str, text: str, performed: Performed) -> None:
        """Note under a name; the scope is what the launch configuration `scope` says."""
        super().__init__()
        self._name = name
        self._text = text
        self._performed = performed

    def perform(self, context: LaunchContext) -> str:
        """Return the text."""
        scope = context.launch_configurations.get('scope', 'none')
        self._performed.append((self._name, scope))
        return self._text


@pytest.fixture
def performed() -> Performed:
    """Return what was performed, with the scope."""
    return []


@pytest.fixture
def spy(performed: Performed) -> MakeSpy:
    """Return a function that makes a spy of a name and a text."""
    return lambda name, text: Spy(name, text, performed)


def test_all_that_a_node_is_given(
    run: Callable[..., Any],
    prefix: Callable[..., Any],
    performed: Performed,
    spy: MakeSpy,
) -> None:
    """Each is performed once, although the node is started again when its scope is closed."""
    prefix('robot', 'talker')
    node = Node(
        package=spy('package', 'robot'),
        executable=spy('executable', 'talker'),
        name=spy('name', 'it'),
        namespace=spy('namespace', 'arm'),
        exec_name=spy('exec_name', 'label'),
        arguments=[spy('argument', '-x')],
        ros_arguments=['--log-level', spy('ros_argument', 'debug')],
        parameters=[{spy('key', 'a'): spy('value', '1')}, spy('file', '/no.yaml')],
        remappings=[(spy('from', 'x'), spy('to', 'y'))],
        output=spy('output', 'screen'),
        respawn=spy('respawn', 'true'),
        respawn_max_retries=1,
    )
    status, text = run(
        GroupAction(
            [
                SetLaunchConfiguration('scope', 'open'),
                SetParameter(spy('global_key', 'b'), spy('global_value', '2')),
                SetRemap(spy('global_from', 'z'), spy('global_to', 'w')),
                node,
            ]
        )
    )
    assert status == 0 and text.count('] talker -x') == 2
    names = 'package executable name namespace exec_name argument ros_argument key value file from'
    names += ' to output respawn global_key global_value global_from global_to'
    assert sorted(performed) == sorted((name, 'open') for name in names.split())


def test_all_that_a_composable_node_is_given(
    context: LaunchContext, performed: Performed, spy: MakeSpy
) -> None:
    """The request is complete when it is built; sending it needs nothing of the scope."""
    description = ComposableNode(
        package=spy('package', 'p'),
        plugin=spy('plugin', 'P'),
        name=spy('name', 'n'),
        namespace=spy('namespace', 'a'),
        parameters=[{spy('key', 'a'): spy('value', '1')}],
        remappings=[(spy('from', 'x'), spy('to', 'y'))],
        extra_arguments=[{'use_intra_process_comms': spy('extra', 'true')}],
    )
    context.launch_configurations['scope'] = 'open'
    request = build_load_request(context, description)
    context.launch_configurations.clear()
    request.to_message()
    request.as_data()
    names = 'package plugin name namespace key value from to extra'
    assert sorted(performed) == sorted((name, 'open') for name in names.split())
