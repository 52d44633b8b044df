# SPDX-License-Identifier: Apache-2.0
"""Check how values are accepted and refused."""

from __future__ import annotations

from array import array
from dataclasses import dataclass, FrozenInstanceError
import math
from typing import Any

from humanoid_common.parameters import build, parameter, ParameterError
import pytest


@dataclass(frozen=True)
class Sample:
    """Parameters of every kind."""

    rate_hz: float = parameter(50.0, 'The rate.', at_least=1.0, at_most=1000.0)
    count: int = parameter(3, 'The count.', at_least=1)
    depth_m: float = parameter(-1.0, 'The depth.', at_most=0.0)
    mode: str = parameter('walk', 'The mode.', choices=('walk', 'stand'))
    is_loud: bool = parameter(False, 'Loud or not.')
    gains: tuple[float, ...] = parameter((1.0, 2.0), 'The gains.', at_least=0.0)

    def __post_init__(self) -> None:
        """Check what must hold for all together."""
        if self.count > self.rate_hz:
            raise ParameterError('Parameter count must not exceed rate_hz.', 'count', 'rate_hz')


def refusal(**values: Any) -> str:
    """Return the reason for which the values are refused."""
    with pytest.raises(ParameterError) as caught:
        build(Sample, values)
    return caught.value.reason


def test_defaults() -> None:
    """Without values, the parameters take their defaults."""
    assert build(Sample, {}) == Sample(50.0, 3, -1.0, 'walk', False, (1.0, 2.0))


def test_integer_for_float() -> None:
    """An integer is good enough where a number is meant, and becomes one."""
    built = build(Sample, {'rate_hz': 60, 'gains': [1, 2.5]})
    assert built.rate_hz == 60.0 and isinstance(built.rate_hz, float)
    assert built.gains == (1.0, 2.5) and isinstance(built.gains[0], float)


def test_array_of_ros() -> None:
    """The arrays that ROS hands out become tuples."""
    assert build(Sample, {'gains': array('d', [3.0])}).gains == (3.0,)


@pytest.mark.parametrize(
    ('values', 'words'),
    [
        ({'rate_hz': 'fast'}, ["'rate_hz' is 'fast'", 'must be a number', 'The rate.']),
        ({'rate_hz': True}, ['is True', 'must be a number']),
        ({'count': 2.0}, ["'count' is 2.0", 'must be an integer']),
        ({'is_loud': 1}, ['must be true or false']),
        ({'gains': 1.0}, ["'gains' is 1.0", 'must be a list of numbers']),
        ({'gains': [1.0, 'x']}, ["'gains' contains 'x'", 'must be a list of numbers']),
        ({'gains': []}, ["'gains' is []", 'must not be empty']),
        ({'mode': None}, ["'mode' is None", 'must be a string']),
    ],
)
def test_wrong_type(values: dict[str, Any], words: list[str]) -> None:
    """A value of a wrong type is refused with name, value and expectation."""
    reason = refusal(**values)
    assert [word for word in words if word not in reason] == []


@pytest.mark.parametrize(
    ('values', 'words'),
    [
        ({'rate_hz': 0.0}, 'is 0.0, but must be between 1.0 and 1000.0'),
        ({'rate_hz': 1000.1}, 'must be between 1.0 and 1000.0'),
        ({'count': 0}, 'is 0, but must be at least 1'),
        ({'depth_m': 0.5}, 'is 0.5, but must be at most 0.0'),
        ({'gains': [1.0, -2.0]}, 'contains -2.0, but must be at least 0.0'),
        ({'rate_hz': math.nan}, 'is nan, but must be finite'),
        ({'gains': [math.inf]}, 'contains inf, but must be finite'),
    ],
)
def test_out_of_limits(values: dict[str, Any], words: str) -> None:
    """A number outside the limits, or none at all, is refused."""
    assert words in refusal(**values)


def test_limits_are_allowed() -> None:
    """The limits themselves are good values."""
    assert build(Sample, {'rate_hz': 1000.0, 'count': 1}).rate_hz == 1000.0


def test_wrong_choice() -> None:
    """A text outside the choices is refused, with the closest choice."""
    reason = refusal(mode='wakl')
    assert "must be one of 'walk', 'stand'" in reason and "Did you mean 'walk'?" in reason


def test_values_that_do_not_fit_together() -> None:
    """The dataclass refuses what only together is wrong, and names those concerned."""
    with pytest.raises(ParameterError) as caught:
        build(Sample, {'count': 51})
    assert caught.value.names == ('count', 'rate_hz')


def test_snapshot_is_immutable() -> None:
    """A snapshot cannot be changed by accident."""
    with pytest.raises(FrozenInstanceError):
        build(Sample, {}).rate_hz = 1.0  # type: ignore[misc]
