# SPDX-License-Identifier: Apache-2.0
"""Check parameters on a node."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from humanoid_common.node_parameters import NodeParameters
from humanoid_common.parameters import parameter, ParameterError
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
import pytest
from rcl_interfaces.msg import Log
from rclpy.node import Node
from rclpy.parameter import Parameter


@dataclass(frozen=True)
class Settings:
    """A few parameters."""

    rate_hz: float = parameter(50.0, 'The rate.', at_least=1.0, at_most=100.0)
    joints: tuple[str, ...] = parameter(('a', 'b'), 'The joints.')
    gains: tuple[float, ...] = parameter((1.0, 2.0), 'The gains.', at_least=0.0, at_most=9.0)
    mode: str = parameter('walk', 'The mode.', choices=('walk', 'stand'))
    seed: int = parameter(1, 'The seed.', at_least=0, read_only=True)

    def __post_init__(self) -> None:
        """Check the lengths."""
        if len(self.joints) != len(self.gains):
            raise ParameterError('One gain a joint, please.', 'joints', 'gains')


class Sample(Node):
    """A node that remembers the changes of its parameters."""

    def __init__(self, **options: Any) -> None:
        """Declare the parameters."""
        super().__init__('sample', **options)
        self.changes: list[Settings] = []
        self.settings = NodeParameters(self, Settings, self.changes.append)


@pytest.fixture(name='ros')
def _ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


def test_values_at_the_start(ros: RosSandbox) -> None:
    """Values given at the start replace defaults; integers become numbers."""
    node = ros.start(Sample, {'rate_hz': 20, 'gains': [3, 4]})
    assert node.settings.current == Settings(rate_hz=20.0, gains=(3.0, 4.0))
    assert node.get_parameter('rate_hz').value == 20.0
    assert node.changes == []


def test_bad_value_at_the_start(ros: RosSandbox) -> None:
    """A bad value stops the node, with the node and the reason in the sentence."""
    with pytest.raises(ParameterError, match="Node '/sample' cannot start.*between 1.0 and 100"):
        ros.start(Sample, {'rate_hz': 0.0})


def test_accepted_change(ros: RosSandbox) -> None:
    """An accepted change replaces the snapshot and is handed on once."""
    node = ros.start(Sample)
    assert node.set_parameters([Parameter('rate_hz', value=60.0)])[0].successful
    assert node.changes == [Settings(rate_hz=60.0)]
    assert node.settings.current is node.changes[0]


def test_integer_at_run_time(ros: RosSandbox) -> None:
    """An integer is accepted where a number is meant, also in lists."""
    node = ros.start(Sample)
    results = node.set_parameters(
        [Parameter('rate_hz', value=60), Parameter('gains', value=[5, 6])]
    )
    assert [result.successful for result in results] == [True, True]
    assert node.settings.current == Settings(rate_hz=60.0, gains=(5.0, 6.0))


@pytest.mark.parametrize(
    ('name', 'value', 'words'),
    [
        ('rate_hz', 1000.0, 'out of range'),
        ('rate_hz', float('nan'), 'out of range'),
        ('rate_hz', 'fast', 'Wrong parameter type'),
        ('gains', [1.0, 10.0], 'contains 10.0, but must be between 0.0 and 9.0'),
        ('gains', [1.0], 'One gain a joint'),
        ('mode', 'run', "must be one of 'walk', 'stand'"),
        ('seed', 2, 'read-only'),
    ],
)
def test_refused_change(ros: RosSandbox, name: str, value: Any, words: str) -> None:
    """A bad change is refused with the reason, and all stays as it is."""
    node = ros.start(Sample)
    result = node.set_parameters([Parameter(name, value=value)])[0]
    assert not result.successful and words in result.reason
    assert node.settings.current == Settings() and node.changes == []
    assert node.get_parameter(name).value not in (value, [value])


def test_atomic_change(ros: RosSandbox) -> None:
    """Values that fit only together are accepted in one atomic request."""
    node = ros.start(Sample)
    result = node.set_parameters_atomically(
        [Parameter('joints', value=['c']), Parameter('gains', value=[7.0])]
    )
    assert result.successful
    assert node.changes == [Settings(joints=('c',), gains=(7.0,))]


def test_description(ros: RosSandbox) -> None:
    """ROS learns meaning, limits and choices."""
    node = ros.start(Sample)
    rate, seed, mode, gains = node.describe_parameters(['rate_hz', 'seed', 'mode', 'gains'])
    assert rate.description == 'The rate.'
    assert (rate.floating_point_range[0].from_value, rate.floating_point_range[0].to_value) == (
        1.0,
        100.0,
    )
    assert seed.read_only and seed.integer_range[0].from_value == 0
    assert mode.additional_constraints == 'One of: walk, stand'
    assert gains.additional_constraints == 'Each element between 0.0 and 9.0'


def test_unknown_parameter_is_warned_of(ros: RosSandbox) -> None:
    """A misspelt parameter is logged with the name that was meant; others are not."""
    logs: list[str] = []
    ros.observer().create_subscription(Log, '/rosout', lambda log: logs.append(log.msg), 10)
    ros.start(Sample, {'ratehz': 5.0, 'use_sim_time': False})
    ros.wait_until(lambda: bool(logs), what='a log message')
    assert len(logs) == 1
    assert "'ratehz'" in logs[0] and "Did you mean 'rate_hz'?" in logs[0]
