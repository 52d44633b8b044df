# SPDX-License-Identifier: Apache-2.0
"""Values of parameters from what somebody types."""

from __future__ import annotations

from typing import Any

import pytest
from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    ParameterType,
    ParameterValue,
)
from robot_console.parameter_values import (
    described,
    Limits,
    parameter_value,
    typed_value,
    value_text,
)


@pytest.mark.parametrize(
    ('kind', 'text', 'value'),
    [
        ('boolean', ' True ', True),
        ('integer', '-7', -7),
        ('integer', '0x10', 16),
        ('double', '3', 3.0),
        ('double', '1e-3', 0.001),
        ('double', '.inf', float('inf')),
        ('string', ' 12 ', ' 12 '),
        ('string', '', ''),
        ('double array', '[1, 2.5]', [1.0, 2.5]),
        ('integer array', '[]', []),
        ('string array', '["a, b", 1]', ['a, b', '1']),
        ('boolean array', '[true, false]', [True, False]),
        ('byte array', '[0, 255]', [b'\x00', b'\xff']),
    ],
)
def test_values(kind: str, text: str, value: Any) -> None:
    """A text becomes a value of the type that the parameter has."""
    found = typed_value(kind, text)
    assert found == value and type(found) is type(value)


@pytest.mark.parametrize(
    ('kind', 'text', 'reason'),
    [
        ('boolean', '1', 'must be true or false'),
        ('integer', '1.5', "must be a whole number, not '1.5'"),
        ('integer', str(2**63), 'has 64 bits'),
        ('double', 'fast', "must be a number, not 'fast'"),
        ('double array', '1, 2', 'must be a list such as'),
        ('double array', '[1, [2]]', 'must be a list such as'),
        ('double array', '[1, x]', "must be a number, not 'x'"),
        ('byte array', '[256]', 'from 0 to 255'),
        ('matrix', '1', 'cannot be changed here'),
        ('integer array', '[1, 2', 'must be a list such as'),
    ],
)
def test_wrong_values(kind: str, text: str, reason: str) -> None:
    """What is no value of the type is refused with the reason."""
    with pytest.raises(ValueError, match=reason):
        typed_value(kind, text)


def test_limits() -> None:
    """Numbers beyond the limits and between the steps are refused; the greatest one never."""
    limits = Limits(0.0, 1.0, 0.3)
    assert typed_value('double', '0.6', limits) == 0.6
    assert typed_value('double', '1', limits) == 1.0
    for text, reason in (('1.5', 'from 0 to 1'), ('.nan', 'from 0 to 1'), ('0.5', 'steps of 0.3')):
        with pytest.raises(ValueError, match=reason):
            typed_value('double', text, limits)


def test_read_only() -> None:
    """What can only be set at the start is not sent at all."""
    with pytest.raises(ValueError, match='when the node starts'):
        parameter_value(
            '1', ParameterValue(type=ParameterType.PARAMETER_INTEGER), _about(read_only=True)
        )


def test_any_type() -> None:
    """A parameter of any type, or without a value, takes what YAML makes of the text."""
    unset = ParameterValue()
    assert parameter_value('2.0', unset, _about()).double_value == 2.0
    number = ParameterValue(type=ParameterType.PARAMETER_INTEGER)
    changed = parameter_value('hello', number, _about(dynamic_typing=True))
    assert (changed.type, changed.string_value) == (ParameterType.PARAMETER_STRING, 'hello')
    with pytest.raises(ValueError, match='too large'):
        parameter_value(str(2**70), unset, _about())


@pytest.mark.parametrize('text', ['[0.5, 2.0]', '[]', '[.nan]', '[1e-07]'])
def test_there_and_back(text: str) -> None:
    """The text of a value can be typed again."""
    kind = ParameterValue(type=ParameterType.PARAMETER_DOUBLE_ARRAY)
    value = parameter_value(text, kind, _about())
    again = parameter_value(value_text(value), kind, _about())
    assert value_text(again) == value_text(value)


def test_described() -> None:
    """The page is told the type, the limits and the description."""
    integer = ParameterValue(type=ParameterType.PARAMETER_INTEGER, integer_value=3)
    about = _about(
        description='How many.', integer_range=[IntegerRange(from_value=1, to_value=9, step=2)]
    )
    told = described(integer, about)
    assert (told['kind'], told['text'], told['about']) == ('integer', '3', 'How many.')
    assert told['limits'] == 'from 1 to 9 in steps of 2'
    double = _about(floating_point_range=[FloatingPointRange(from_value=0.0, to_value=0.5)])
    assert described(integer, double)['limits'] == 'from 0 to 0.5'
    assert described(ParameterValue(), None) == {'kind': 'not set', 'text': ''}


def _about(**fields: Any) -> ParameterDescriptor:
    return ParameterDescriptor(**fields)
