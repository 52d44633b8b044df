# SPDX-License-Identifier: Apache-2.0
"""Parameters as dataclasses: types, limits, changes, and what is said about unknown ones."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import Any

from nav2_util import ConfigurationError, parameter
from nav2_util.parameters import ParameterServer, Unsupported
import pytest
from rclpy.node import Node
from rclpy.parameter import Parameter


@dataclass(frozen=True)
class Told:
    """What a node of these tests is told."""

    rate: float = parameter(2.0, 'A rate, Hz.', low=0.5, high=10.0)
    count: int = parameter(3, 'A number.', low=1)
    is_on: bool = parameter(True, 'Whether.')
    frame: str = parameter('map', 'A frame.', choices=['map', 'odom'])
    sizes: list[float] = parameter([1.0, 2.0], 'Sizes, m.')
    names: list[str] = parameter([], 'Names.')
    fixed: int = parameter(1, 'Fixed.', read_only=True)
    deep: float = parameter(0.0, 'Within another.', name='a.b')


@pytest.fixture
def made(ros: Any) -> Any:
    """Return a function that makes a node with overrides, and its server of parameters."""

    def make(**values: Any) -> tuple[Node, ParameterServer]:
        node = ros.make(Node, values, node_name='told')
        return node, ParameterServer(node)

    return make


def _set(node: Node, name: str, value: Any) -> Any:
    return node.set_parameters([Parameter(name, value=value)])[0]


def _said(capfd: pytest.CaptureFixture[str]) -> list[str]:
    lines = capfd.readouterr().err.splitlines()
    return [line.split(']: ', 1)[1] for line in lines if ' [told]: ' in line]


def test_defaults(made):
    """What nobody sets has its default, with the type of it also in the node."""
    node, server = made()
    assert server.declare(Told).current == Told()
    assert node.get_parameter('a.b').type_ is Parameter.Type.DOUBLE
    assert node.describe_parameter('rate').description == 'A rate, Hz.'


def test_given_values(made):
    """Integers are taken for floating-point numbers, and whole numbers for integers."""
    node, server = made(rate=4, count=7.0, sizes=[1, 2, 3], names=['x'], frame='odom', is_on=False)
    assert server.declare(Told).current == Told(
        rate=4.0, count=7, sizes=[1.0, 2.0, 3.0], names=['x'], frame='odom', is_on=False
    )
    assert node.get_parameter('rate').type_ is Parameter.Type.DOUBLE
    assert node.get_parameter('sizes').type_ is Parameter.Type.DOUBLE_ARRAY


def test_file_with_parameters(ros, tmp_path):
    """Values of a file arrive, an empty list among them."""
    path = tmp_path / 'told.yaml'
    path.write_text(
        '/**:\n  ros__parameters:\n    rate: 3\n    sizes: [1, 2]\n    names: []\n    a: {b: 1}\n'
    )
    node = ros.node('told', cli_args=['--ros-args', '--params-file', str(path)])
    current = ParameterServer(node).declare(Told).current
    assert (current.rate, list(current.sizes), current.names, current.deep) == (
        3.0,
        [1.0, 2.0],
        [],
        1.0,
    )


@pytest.mark.parametrize(
    ('name', 'value', 'sentence'),
    [
        ('rate', 'fast', "The parameter 'rate' must be a number, but is 'fast'."),
        ('rate', True, "The parameter 'rate' must be a number, but is True."),
        ('rate', 11.0, "The parameter 'rate' must be at most 10, but is 11."),
        ('rate', 0, "The parameter 'rate' must be at least 0.5, but is 0."),
        ('rate', math.nan, "The parameter 'rate' must be a number, but is nan."),
        ('count', 1.5, "The parameter 'count' must be a whole number, but is 1.5."),
        ('count', 0, "The parameter 'count' must be at least 1, but is 0."),
        ('is_on', 1, "The parameter 'is_on' must be true or false, but is 1."),
        ('is_on', 'true', "The parameter 'is_on' must be true or false, but is 'true'."),
        ('frame', 'odon', "must be one of 'map', 'odom', but is 'odon'; did you mean 'odom'?"),
        ('sizes', 1.0, "The parameter 'sizes' must be a list, but is 1.0."),
        ('sizes', ['a'], "The parameter 'sizes' must be a number, but is 'a'."),
        ('sizes', [1.0, math.nan], "The parameter 'sizes' must be a number, but is nan."),
    ],
)
def test_values_that_are_not_allowed(made, name, value, sentence):
    """At the start they are an error with a sentence, and later refused with the same."""
    with pytest.raises(ConfigurationError) as raised:
        made(**{name: value})[1].declare(Told)
    assert sentence in str(raised.value)

    node, server = made()
    told = server.declare(Told)
    outcome = _set(node, name, value)
    assert not outcome.successful and outcome.reason
    assert told.current == Told()


def test_change_at_run_time(made):
    """A change makes a new snapshot; the old one stays as it was."""
    node, server = made()
    told = server.declare(Told)
    before = told.current
    assert _set(node, 'rate', 5).successful  # as `ros2 param set` sends it
    assert _set(node, 'sizes', [4, 5]).successful
    assert (before.rate, told.current.rate, told.current.sizes) == (2.0, 5.0, [4.0, 5.0])
    assert isinstance(told.current.rate, float)


def test_read_only(made):
    """It has its value from the start, and keeps it."""
    node, server = made(fixed=4)
    told = server.declare(Told)
    outcome = _set(node, 'fixed', 5)
    assert not outcome.successful and 'read-only' in outcome.reason
    assert told.current.fixed == 4


def test_change_that_the_node_refuses(made):
    """A node may refuse a change with a reason; then all sets keep their values."""
    node, server = made()
    first, second = server.declare(Told), server.declare(Told, 'plugin')
    seen = []
    first.on_change = lambda new: seen.append((first.current.rate, new.rate))

    def refuse(new: Told) -> None:
        raise ValueError(f'There is no frame {new.frame} now.')

    second.on_change = refuse
    outcome = node.set_parameters_atomically(
        [Parameter('rate', value=3.0), Parameter('plugin.frame', value='odom')]
    )
    assert not outcome.successful and outcome.reason == 'There is no frame odom now.'
    assert first.current == second.current == Told()
    assert seen == [(2.0, 3.0), (3.0, 2.0)]  # what was applied is taken back
    assert node.get_parameter('rate').value == 2.0


def test_prefixes_and_sets_that_share_a_name(made):
    """Each prefix has its own set; two classes with the same name below it both follow."""

    @dataclass(frozen=True)
    class Other:
        rate: float = parameter(2.0, 'A rate, Hz.')

    node, server = made(**{'left.rate': 3.0})
    left, right = server.declare(Told, 'left'), server.declare(Told, 'right')
    other = server.declare(Other, 'left')
    assert (left.current.rate, right.current.rate, other.current.rate) == (3.0, 2.0, 3.0)
    assert server.declare(Told, 'left') is left
    assert _set(node, 'left.rate', 4.0).successful
    assert (left.current.rate, right.current.rate, other.current.rate) == (4.0, 2.0, 4.0)


def test_single_values(made):
    """Names that are known late only are declared one by one, as often as wanted."""
    _, server = made(**{'plugin.max': 3})
    assert server.declare_value('plugin.max', 1.0, 'A limit.') == 3.0
    assert server.declare_value('plugin.max', 1.0, 'A limit.') == 3.0
    assert server.declare_value('plugin.list', ['a'], 'A list.') == ['a']


def test_unknown_and_unsupported_are_said_once(made, capfd):
    """What has no effect is said, with what was meant or what happens instead."""
    _, server = made(**{'rte': 1.0, 'colour': 'x', 'qos_overrides.t': 1, 'p.old': 2})
    server.declare(Told)
    server.declare_unsupported({'old': 'there is a better way'}, 'p')
    server.report()
    assert _said(capfd) == [
        "There is no parameter 'colour'. It has no effect.",
        "There is no parameter 'rte'. Did you mean 'rate'?",
        "The parameter 'p.old' has no effect: there is a better way.",
    ]
    server.report()
    assert _said(capfd) == []


@pytest.mark.parametrize(
    ('given', 'said'),
    [
        ({'a': False, 'b': 1667, 'c': 0.5}, []),
        ({'a': True, 'b': 1669}, ["The parameter 'a' has no effect: it is never so."]),
        ({'a': True, 'c': 1.0}, ["The parameters 'a', 'c' have no effect: it is never so."]),
    ],
)
def test_usual_values_without_effect_need_no_word(made, capfd, given, said):
    """Those that ask for what happens anyway; what has the same reason is said together."""
    _, server = made(**given)
    reason = 'it is never so'
    server.declare_unsupported(
        {
            'a': Unsupported(reason, (False,)),
            'b': Unsupported(reason),
            'c': Unsupported(reason, (0.5,)),
        }
    )
    server.report()
    assert _said(capfd) == said


def test_parameters_without_effect_are_read_and_set(made, capfd):
    """They are declared by their values or usual values; a value that promises more is said."""
    node, server = made(b=1669)
    reason = 'it is never so'
    names = {each: Unsupported(reason) for each in ('b', 'not_given')}
    server.declare_unsupported({'a': Unsupported(reason, (False,)), **names})
    server.report()
    assert (node.get_parameter('a').value, node.get_parameter('b').value) == (False, 1669)
    assert not node.has_parameter('not_given')
    assert node.describe_parameter('a').description == 'Without effect: it is never so.'
    assert _said(capfd) == []
    assert _set(node, 'a', False).successful and _set(node, 'b', 1670).successful
    assert _said(capfd) == []
    assert _set(node, 'a', True).successful
    assert _said(capfd) == ["The parameter 'a' has no effect: it is never so."]
    assert node.get_parameter('a').value is True
