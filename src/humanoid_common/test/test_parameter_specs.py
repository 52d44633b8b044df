# SPDX-License-Identifier: Apache-2.0
"""Check what is read from a parameter dataclass."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_common.naming import did_you_mean, shortened
from humanoid_common.parameters import (
    build,
    parameter,
    ParameterError,
    specs_of,
    unknown_parameter_warnings,
    values_of,
)
import pytest


@dataclass(frozen=True)
class Sample:
    """Two parameters."""

    rate_hz: float = parameter(50.0, 'The rate.', at_least=1.0)
    joints: tuple[str, ...] = parameter(('a', 'b'), 'The joints.', read_only=True)


@dataclass(frozen=True)
class Grouped:
    """A parameter, and a group of others."""

    name: str = parameter('x', 'The name.')
    inside: Sample = Sample()


@dataclass(frozen=True)
class WrongType:
    """A parameter of a type that ROS does not have."""

    table: complex = parameter(1j, 'A number that ROS lacks.')


@dataclass(frozen=True)
class PlainField:
    """A field that is not a parameter."""

    rate_hz: float = 1.0


def test_groups_have_their_names_before_those_of_their_parameters() -> None:
    """They are checked, built and listed as others are."""
    specs = specs_of(Grouped)
    assert list(specs) == ['name', 'inside.rate_hz', 'inside.joints']
    assert specs['inside.rate_hz'].name == 'inside.rate_hz'
    built = build(Grouped, {'inside.rate_hz': 3, 'name': 'y'})
    assert built == Grouped('y', Sample(3.0))
    assert values_of(built) == {
        'name': 'y',
        'inside.rate_hz': 3.0,
        'inside.joints': ('a', 'b'),
    }
    with pytest.raises(ParameterError, match=r"'inside.rate_hz' is 0.0, but must be at least 1"):
        build(Grouped, {'inside.rate_hz': 0.0})


def test_specs() -> None:
    """Name, type, default and rules are read from each field."""
    rate, joints = specs_of(Sample).values()
    assert (rate.name, rate.element, rate.is_list, rate.default) == ('rate_hz', float, False, 50.0)
    assert (rate.rules.description, rate.rules.at_least) == ('The rate.', 1.0)
    assert (joints.element, joints.is_list, joints.rules.read_only) == (str, True, True)


def test_type_that_ros_lacks() -> None:
    """A type that ROS does not have is named, together with those that it has."""
    with pytest.raises(TypeError, match="'table' has type.*tuple"):
        specs_of(WrongType)


def test_plain_field() -> None:
    """A field that was not declared as a parameter is named."""
    with pytest.raises(TypeError, match="'rate_hz' is not declared"):
        specs_of(PlainField)


def test_unknown_name_close_to_a_known_one() -> None:
    """A misspelt parameter is met with the name that was meant."""
    [warning] = unknown_parameter_warnings(['ratehz'], ['rate_hz', 'joints'])
    assert "'ratehz'" in warning and "Did you mean 'rate_hz'?" in warning


def test_unknown_name_far_from_all() -> None:
    """A parameter like no other is met with the list of all."""
    [warning] = unknown_parameter_warnings(['zzz'], ['rate_hz', 'joints'])
    assert 'It has: joints, rate_hz.' in warning
    (warning,) = unknown_parameter_warnings(['zzz'], specs_of(Grouped))
    assert 'It has: inside.*, name.' in warning


def test_known_names() -> None:
    """Nothing is said about known names."""
    assert unknown_parameter_warnings(['rate_hz'], ['rate_hz', 'joints']) == []


@pytest.mark.parametrize(
    ('name', 'answer'), [('sholder', "Did you mean 'shoulder'?"), ('qqq', '')]
)
def test_did_you_mean(name: str, answer: str) -> None:
    """Only a close name is offered."""
    assert did_you_mean(name, ['shoulder', 'elbow']) == answer


def test_shortened() -> None:
    """An endless name does not fill the log; others stay as they are."""
    assert shortened('left_elbow') == 'left_elbow'
    assert len(shortened('x' * 100_000)) < 100
