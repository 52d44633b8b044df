# SPDX-License-Identifier: Apache-2.0
"""Texts that get a type."""

from __future__ import annotations

from collections.abc import Callable
import typing
from typing import Any

from launch import LaunchContext
from launch.substitutions import LaunchConfiguration
from launch.utilities.type_utils import (
    coerce_to_type,
    normalize_typed_substitution,
    perform_typed_substitution,
    read_boolean,
    read_yaml,
)
import pytest
import yaml

TEXTS = (
    '0',
    '1',
    '-1',
    '+5',
    '007',
    '08',
    '0x1F',
    '0b1',
    '1_000',
    '1.0',
    '1.',
    '.5',
    '-1.5e+3',
    '1e3',
    '1.0e3',
    '12:30:45',
    'true',
    'True',
    'TRUE',
    'tRUE',
    'yes',
    'No',
    'on',
    'OFF',
    'y',
    'n',
    'null',
    'Null',
    '~',
    '',
    'word',
    'a/b',
    '/a_b',
    'a-b.c',
    'a b',
    '2020-01-01',
    '.inf',
    '.nan',
    '[1, 2]',
    '{a: 1}',
    "'1'",
    '"x"',
    '- a',
    'a: 1',
    '<<',
    '=',
    '!x y',
    '# c',
    'NULL',
    'nullx',
)


def _outcome(read: Callable[[str], Any], text: str) -> str:
    """Return what reading a text gives."""
    try:
        return repr(read(text))
    except (yaml.YAMLError, ValueError):
        return 'error'


@pytest.mark.parametrize('text', TEXTS)
def test_scalars_agree_with_yaml(text: str) -> None:
    """Reading a scalar without the parser gives what the parser gives."""
    assert _outcome(read_yaml, text) == _outcome(yaml.safe_load, text)


@pytest.mark.parametrize(
    'text, value', [('1', True), ('0', False), (' yes ', True), ('Off', False)]
)
def test_booleans(text: str, value: bool) -> None:
    """The words of YAML, 1 and 0 are truth values."""
    assert read_boolean(text) is value


@pytest.mark.parametrize(
    'text, data_type, value',
    [
        ('5', int, 5),
        ('5', float, 5.0),
        ('5', str, '5'),
        ('no', bool, False),
        ('5', None, 5),
        ('1e-3', None, 0.001),
        ('[1, 2]', list[int], [1, 2]),
        ('[1, 2]', list[float], [1.0, 2.0]),
        ('x', None, 'x'),
        ("['a']", list[str], ['a']),
    ],
)
def test_coercion(text: str, data_type: Any, value: Any) -> None:
    """A text becomes a value of the type that is asked for."""
    assert repr(coerce_to_type(text, data_type)) == repr(value)


@pytest.mark.parametrize(
    'text, data_type',
    [
        ('x', int),
        ('1.5', int),
        ('x', bool),
        ('[1, a]', list[int]),
        ('[1, a]', None),
        ('{a: 1}', None),
        ('x', dict),
        ('[true]', list[int]),
    ],
)
def test_impossible_coercion(text: str, data_type: Any) -> None:
    """A text that has no value of the type is an error."""
    with pytest.raises(ValueError):
        coerce_to_type(text, data_type)


def test_older_spelling_of_list_types() -> None:
    """Launch files may write `List[float]` from typing."""
    assert coerce_to_type('[1]', vars(typing)['List'][float]) == [1.0]


def test_typed_substitution(context: LaunchContext) -> None:
    """A substitution is performed first; a value of the type stays as it is."""
    context.launch_configurations['x'] = '2'
    value = normalize_typed_substitution(['1', LaunchConfiguration('x')], int)
    assert perform_typed_substitution(context, value, int) == 12
    assert normalize_typed_substitution(True, bool) is True
    with pytest.raises(TypeError, match="not of type 'bool'"):
        normalize_typed_substitution(1, bool)
