# SPDX-License-Identifier: Apache-2.0
"""Parameter files whose names match no node."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, Optional

from launch.actions import TimerAction
from launch_ros.actions import Node, SetParametersFromFile
from launch_ros.utilities.parameter_file_check import (
    key_matches,
    parameter_file_keys,
    parameter_file_problem,
)
import pytest

Run = Callable[..., Any]

FILE = """\
# a comment: with a colon
/**:
  ros__parameters:
    a: 1
    nested:
      b: 'x: y'
"talker":
  "ros__parameters": {rate: 1}
/ns/*:
    ros__parameters:
        c: [1]
outer:
  inner:
    ros__parameters:
      d: 1
"""


def test_keys(tmp_path: Path) -> None:
    """The names stand above ros__parameters; nested ones are joined."""
    path = tmp_path / 'p.yaml'
    path.write_text(FILE)
    assert parameter_file_keys(str(path)) == ['/**', 'talker', '/ns/*', 'outer/inner']
    assert parameter_file_keys(str(tmp_path / 'none')) == []


@pytest.mark.parametrize(
    'key, namespace, expected',
    [
        ('n', '/', True),
        ('/n', '/', True),
        ('n', '/a', False),
        ('/**', '/a/b', True),
        ('/**/n', '/', True),
        ('/**/n', '/a/b', True),
        ('/*/n', '/a', True),
        ('/*/n', '/', False),
        ('/*/n', '/a/b', False),
        ('/a/**', '/a/b', True),
        ('/b/**', '/a', False),
        ('/a/n', None, True),
        ('/a/m', None, False),
        ('/a/*', None, True),
    ],
)
def test_matching(key: str, namespace: Optional[str], expected: bool) -> None:
    """Keys match like in rcl; without a namespace only the name counts."""
    assert key_matches(key, 'n', namespace) is expected


def _warnings(run: Run, tmp_path: Path, key: str, *nodes: Any) -> list[str]:
    path = tmp_path / 'p.yaml'
    path.write_text(f'{key}:\n  ros__parameters:\n    a: 1\n')
    made = [each(str(path)) if callable(each) else each for each in nodes]
    return [line for line in run(*made)[1].splitlines() if 'is for ' in line]


def _node(name: Optional[str] = 'talker', **kwargs: Any) -> Callable[[str], Node]:
    return lambda path: Node(executable='/bin/true', name=name, parameters=[path], **kwargs)


def test_file_for_nobody(run: Run, tmp_path: Path) -> None:
    """A file that names none of the nodes is a warning with both names."""
    assert _warnings(run, tmp_path, '/talkr', _node(namespace='')) == [
        f"[WARNING] [launch_ros.actions.node]: the parameter file '{tmp_path}/p.yaml' is for "
        "'/talkr', but the nodes that are launched are '/talker': it has no effect"
    ]
    assert len(_warnings(run, tmp_path, 'talkr', SetParametersFromFile, _node())) == 1


@pytest.mark.parametrize(
    'key, nodes',
    [
        ('talker', [_node()]),
        ('/**', [_node()]),
        ('talkr', [_node(name=None)]),
        ('/other', [_node(), Node(executable='/bin/true', name='other', namespace='')]),
        (
            '/later',
            [
                _node(),
                TimerAction(period=0.1, actions=[Node(executable='/bin/true', name='later')]),
            ],
        ),
    ],
)
def test_no_false_alarm(run: Run, tmp_path: Path, key: str, nodes: list[Any]) -> None:
    """A node that may be meant is enough, be it another one, a later one or one without name."""
    assert _warnings(run, tmp_path, key, *nodes) == []


@pytest.mark.parametrize(
    'content, text',
    [
        (
            'a:\n  ros__parameters:\n    x: 1\ntalker:\n  ros_parameters:\n    b: 1\n',
            "line 4, below 'talker' there is no 'ros__parameters': is 'ros_para",
        ),
        ('talker:\n  rate: 1\n', "line 1, below 'talker' there is no 'ros__parameters', below"),
        ('talker:\n\tros__parameters:\n\t\ta: 1\n', 'line 2, it is not YAML, which allows'),
    ],
)
def test_useless_file(run: Run, tmp_path: Path, content: str, text: str) -> None:
    """A file that a node cannot read is one warning with the line."""
    path = tmp_path / 'p.yaml'
    path.write_text(content)
    found = run(_node()(str(path)), _node()(str(path)))[1]
    assert found.count(f"the parameter file '{path}' cannot be used: {text}") == 1


@pytest.mark.parametrize(
    'content',
    [
        FILE,
        'x: {ros__parameters: {a: 1}}\n',
        '/**:\n  ros__parameters:\n    a: |\n      x:\n      \ty: 1\n',
        'a: &a\n  ros__parameters: {}\nb:\n  <<: *a\n',
        'talker:\n',
    ],
)
def test_no_problem(tmp_path: Path, content: str) -> None:
    """Nothing is said to a file that is right, or that only YAML could judge."""
    path = tmp_path / 'p.yaml'
    path.write_text(content)
    assert parameter_file_problem(str(path)) is None


def test_missing_file_gets_advice(run: Run, tmp_path: Path) -> None:
    """The warning about a missing file is followed by one that names the closest."""
    (tmp_path / 'params.yaml').touch()
    status, text = run(Node(executable='/bin/true', parameters=[str(tmp_path / 'param.yaml')]))
    assert f'Parameter file path is not a file: {tmp_path}/param.yaml\n' in text
    assert "Did you mean 'params.yaml'?" in text.splitlines()[3]
    assert status == 0
