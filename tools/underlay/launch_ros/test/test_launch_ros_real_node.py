# SPDX-License-Identifier: Apache-2.0
"""Real nodes: what rclpy makes of the command line that launch gives."""

from __future__ import annotations

from collections.abc import Callable
import json
from pathlib import Path
import sys
from typing import Any

from launch.actions import GroupAction
from launch.substitutions import TextSubstitution
from launch_ros.actions import Node, PushRosNamespace, SetParameter, SetRemap
from launch_ros.parameter_descriptions import Parameter
from launch_ros.utilities.node_names import (
    InvalidNameError,
    validate_namespace,
    validate_node_name,
)
import pytest

rclpy = pytest.importorskip('rclpy')

SCRIPT = """
import json, rclpy
from rclpy.node import Node
rclpy.init()
node = Node('given', allow_undeclared_parameters=True,
            automatically_declare_parameters_from_overrides=True)
values = {name: p.value for name, p in node.get_parameters_by_prefix('').items()}
values = {n: list(v) if hasattr(v, 'typecode') else v for n, v in values.items()}
print(json.dumps({'name': node.get_fully_qualified_name(), 'topic': node.resolve_topic_name('a'),
                  'parameters': values}))
node.destroy_node()
rclpy.shutdown()
"""


def _told(run: Callable[..., Any], tmp_path: Path, *before: Any, **kwargs: Any) -> dict[str, Any]:
    """Return what a real node knows of itself."""
    script = tmp_path / 'node.py'
    script.write_text(SCRIPT)
    node = Node(
        executable=sys.executable,
        arguments=[str(script)],
        output='screen',
        output_format='{line}',
        **kwargs,
    )
    status, out = run(GroupAction([*before, node]))
    assert status == 0
    answer: dict[str, Any] = json.loads(
        next(line for line in out.splitlines() if line.startswith('{'))
    )
    return answer


def test_node(run: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Names, remappings and the types of parameters arrive."""
    monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'OFF')
    plain = {
        'flag': True,
        'number': 5,
        'ratio': 1e-07,
        'text': 'true',
        'empty': '',
        'digits': '0x10',
        'exponent': '1e3',
        'quote': "it's \n \u00e9",
        'list': [1, 2],
        'texts': ['a', '1'],
        'ratios': [1, 2.5],
    }
    answer = _told(
        run,
        tmp_path,
        PushRosNamespace('robot'),
        SetParameter('all', [1.5, 2.0]),
        SetRemap('a', 'b'),
        name='walker',
        parameters=[
            plain,
            {'nested': {'deep': TextSubstitution(text='1e3')}},
            Parameter('single', 'no'),
        ],
    )
    assert (answer['name'], answer['topic']) == ('/robot/walker', '/robot/b')
    parameters = answer['parameters']
    assert {name: parameters[name] for name in plain} == {**plain, 'ratios': [1.0, 2.5]}
    assert (parameters['all'], parameters['nested.deep']) == ([1.5, 2.0], 1000.0)
    assert parameters['single'] is False


NAMES = (
    'a',
    'a1',
    '_a',
    '',
    '1a',
    'a-b',
    'a b',
    'a/b',
    'a' * 255,
    'a' * 256,
    '\u00e9',
    '~a',
    'A_b',
)
NAMESPACES = ('/', '/a', '/a/b', 'a', '', '/a/', '//a', '/a//b', '/1a', '/a b', '/_a', '/a-b')


@pytest.mark.parametrize('name', NAMES)
def test_names_of_nodes(name: str) -> None:
    """A name is valid if rclpy finds it valid."""
    from rclpy.exceptions import InvalidNodeNameException
    from rclpy.validate_node_name import validate_node_name as judge

    assert _is_valid(validate_node_name, name, InvalidNameError) == _is_valid(
        judge, name, InvalidNodeNameException
    )


@pytest.mark.parametrize('namespace', NAMESPACES)
def test_namespaces(namespace: str) -> None:
    """A namespace is valid if rclpy finds it valid."""
    from rclpy.exceptions import InvalidNamespaceException
    from rclpy.validate_namespace import validate_namespace as judge

    assert _is_valid(validate_namespace, namespace, InvalidNameError) == _is_valid(
        judge, namespace, InvalidNamespaceException
    )


def _is_valid(check: Callable[[str], Any], name: str, error: Any) -> bool:
    try:
        check(name)
    except error:
        return False
    return True
