# SPDX-License-Identifier: Apache-2.0
"""The tags of lifecycle nodes, containers and ROS timers in XML and YAML."""

from __future__ import annotations

import io
from typing import Any

from launch import LaunchContext
from launch.frontend import Parser
from launch_ros.actions import (
    ComposableNodeContainer,
    LifecycleNode,
    LoadComposableNodes,
    PushRosNamespace,
    ROSTimer,
)
from launch_ros.actions._load_request import LoadRequest
import pytest

NODE = """
<composable_node pkg="p" plugin="P" name="$(var n)" namespace="left">
  <param name="a" value="$(var five)"/>
  <param name="b"><param name="c" value="text"/></param>
  <remap from="in" to="out"/>
  <extra_arg name="use_intra_process_comms" value="true"/>
</composable_node>
<composable_node pkg="p" plugin="Q" name="second" if="$(var no)"/>
<composable_node pkg="p" plugin="R" name="third" unless="$(var no)"/>
"""
YAML_NODE = """
    composable_node:
    - pkg: p
      plugin: P
      name: $(var n)
      namespace: left
      param:
      - {name: a, value: $(var five)}
      - name: b
        param:
        - {name: c, value: text}
      remap:
      - {from: in, to: out}
      extra_arg:
      - {name: use_intra_process_comms, value: true}
    - {pkg: p, plugin: Q, name: second, if: $(var no)}
    - {pkg: p, plugin: R, name: third, unless: $(var no)}
"""


def _parse(content: str) -> Any:
    """Return the only action in the text of a launch file."""
    root, parser = Parser.load(io.StringIO(content))
    (action,) = parser.parse_description(root).entities
    return action


def _requests(action: LoadComposableNodes, context: LaunchContext) -> list[LoadRequest]:
    context.launch_configurations.update(n='first', five='5', no='false', target='/c')
    PushRosNamespace('robot').visit(context)
    return action._requests(context)


@pytest.mark.parametrize(
    'content',
    [
        f'<launch><load_composable_node target="$(var target)">{NODE}</load_composable_node>'
        '</launch>',
        f'launch:\n- load_composable_node:\n    target: $(var target)\n{YAML_NODE}',
    ],
)
def test_load_composable_node(context: LaunchContext, content: str) -> None:
    """The nodes are described by children, each with a condition of its own."""
    action = _parse(content)
    assert isinstance(action, LoadComposableNodes)
    first, third = _requests(action, context)
    assert (first.names.full_name, first.plugin) == ('/robot/left/first', 'P')
    assert first.parameters == [('a', 5), ('b.c', 'text')]
    assert first.remap_rules == ['in:=out']
    assert first.extra_arguments == [('use_intra_process_comms', True)]
    assert (third.names.full_name, third.plugin) == ('/robot/third', 'R')
    assert action._target(context) == ('/c', None)


@pytest.mark.parametrize(
    'content',
    [
        '<launch><node_container exec="/bin/true" name="c" namespace="box" args="-x" '
        f'output="screen">{NODE}<param name="d" value="1"/></node_container></launch>',
        'launch:\n- node_container:\n    exec: /bin/true\n    name: c\n    namespace: box\n'
        f'    args: -x\n    output: screen\n    param:\n    - {{name: d, value: 1}}\n{YAML_NODE}',
    ],
)
def test_node_container(context: LaunchContext, content: str) -> None:
    """A container is a node with such children."""
    action = _parse(content)
    assert isinstance(action, ComposableNodeContainer)
    action.prepare(context)
    assert action.node_name == '/box/c' and action.cmd[:3] == ['/bin/true', '-x', '--ros-args']
    assert '--params-file' in action.cmd
    load = LoadComposableNodes(
        composable_node_descriptions=action.composable_node_descriptions, target_container=action
    )
    assert len(_requests(load, context)) == 2


def test_lifecycle_node(context: LaunchContext) -> None:
    """A lifecycle node is a node with a name and a namespace."""
    action = _parse('<launch><lifecycle_node exec="/bin/true" name="n" namespace="a"/></launch>')
    action.prepare(context)
    assert isinstance(action, LifecycleNode) and action.node_name == '/a/n'


def test_ros_timer() -> None:
    """A timer has a period and children."""
    action = _parse('<launch><ros_timer period="1.5"><log message="x"/></ros_timer></launch>')
    assert isinstance(action, ROSTimer) and len(action.actions) == 1


@pytest.mark.parametrize(
    'content, text',
    [
        ('<lifecycle_node exec="x" name="n"/>', "Attribute 'namespace' of type"),
        ('<lifecycle_node exec="x" namespace="n"/>', "Attribute 'name' of type"),
        (
            '<lifecycle_node exec="x" node-name="n" name="n" namespace=""/>',
            'Unexpected attribute(s) found in `lifecycle_node`',
        ),
        ('<node_container exec="x" name="n"/>', "Attribute 'namespace' of type"),
        ('<load_composable_node/>', "Attribute 'target' of type"),
        (
            '<load_composable_node target="/c"><composable_node pkg="p" plugin="P"/>'
            '</load_composable_node>',
            "Attribute 'name' of type",
        ),
        (
            '<load_composable_node target="/c"><composable_node pkg="p" plugin="P" name="n" '
            'x="y"/></load_composable_node>',
            "Unexpected attribute(s) found in `composable_node`: {'x'}",
        ),
        (
            '<load_composable_node target="/c"><node exec="x"/></load_composable_node>',
            "Unexpected nested tag(s) found in `load_composable_node`: {'node'}",
        ),
        ('<composable_node pkg="p" plugin="P" name="n"/>', 'Unrecognized entity'),
    ],
)
def test_mistakes(content: str, text: str) -> None:
    """What is missing, and what is not known, is named."""
    with pytest.raises((AttributeError, ValueError, RuntimeError)) as error:
        _parse(f'<launch>{content}</launch>')
    assert text in str(error.value)
