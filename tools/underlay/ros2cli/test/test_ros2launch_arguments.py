# SPDX-License-Identifier: Apache-2.0
"""Tests of the arguments of launch files and of how they are shown."""

from types import SimpleNamespace

import pytest
from ros2launch.api.arguments import misspelt_argument_text, parse_launch_arguments
from ros2launch.api.running import argument_lines


def test_arguments_are_split_at_the_first_separator() -> None:
    """A value may contain the separator; the last value of a name wins."""
    assert parse_launch_arguments(['a:=1', 'b:=x:=y', 'a:=2']) == [('a', '2'), ('b', 'x:=y')]


@pytest.mark.parametrize('text', ['bad', 'a:=', ':=v', 'a=1'])
def test_malformed_argument(text: str) -> None:
    """An argument without name, value or separator is an error."""
    expected = f"malformed launch argument '{text}', expected format '<name>:=<value>'"
    with pytest.raises(RuntimeError) as caught:
        parse_launch_arguments([text])
    assert str(caught.value) == expected


def test_misspelt_name_is_found() -> None:
    """A name close to a declared one is an error, others are accepted."""
    declared = ['use_controller', 'robots']
    text = misspelt_argument_text(['use_controler'], declared)
    assert "Did you mean 'use_controller'?" in text
    assert misspelt_argument_text(['robots', 'emulate_tty'], declared) == ''


def argument(name: str, *defaults: str, conditional: bool = False) -> SimpleNamespace:
    """Return what looks like the declaration of an argument."""
    parts = [SimpleNamespace(describe=lambda text=text: text) for text in defaults]
    return SimpleNamespace(
        name=name,
        description=f'the {name}',
        default_value=parts or None,
        is_conditional=conditional,
    )


def test_no_arguments() -> None:
    """A file without arguments says so."""
    assert list(argument_lines([])) == ['', '  No arguments.']


def test_arguments_with_defaults_and_conditions() -> None:
    """Defaults are joined, conditional arguments are marked and explained."""
    arguments = [argument('must'), argument('rate', "'1'", "LaunchConfig('x')", conditional=True)]
    assert list(argument_lines(arguments)) == [
        '',
        "    'must':",
        '        the must',
        '',
        "    'rate':*",
        '        the rate',
        "        (default: '1' + LaunchConfig('x'))",
        '',
        '* argument(s) which are only used if specific conditions occur',
    ]
