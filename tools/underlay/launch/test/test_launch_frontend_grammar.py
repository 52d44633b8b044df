# SPDX-License-Identifier: Apache-2.0
"""The grammar of texts with substitutions."""

from __future__ import annotations

from launch import LaunchContext
from launch.frontend import InvalidSubstitutionError
from launch.frontend.attributes import command_words
from launch.frontend.parse_substitution import (
    parse_if_substitutions,
    parse_substitution,
    replace_escaped_characters,
)
from launch.substitutions import LaunchConfiguration, TextSubstitution
from launch.utilities import perform_substitutions
import pytest


@pytest.fixture
def robot(context: LaunchContext) -> LaunchContext:
    """Return a context with some launch configurations."""
    context.launch_configurations.update(
        robot='r1', name='robot', spaces='p q', empty='', code='$(var robot)'
    )
    return context


@pytest.mark.parametrize(
    'text, result',
    [
        ('', ''),
        ('plain text', 'plain text'),
        ('$(var robot)', 'r1'),
        ('a/$(var robot)/b', 'a/r1/b'),
        ('$(var robot)$(var robot)', 'r1r1'),
        ('$(var $(var name))', 'r1'),
        ("$(var 'robot')", 'r1'),
        ('$(var "robot")', 'r1'),
        ('$(var ro$(var empty)bot)', 'r1'),
        ('$(var missing other)', 'other'),
        ('$(var missing $(var robot)x)', 'r1x'),
        ("$(var missing 'a b')", 'a b'),
        ('$(var missing \'a (b) "c"\')', 'a (b) "c"'),
        ("$(var missing '')", ''),
        ("$(var missing 'a $(var robot) b')", 'a r1 b'),
        ('$(var missing \'a $(var "robot") b\')', 'a r1 b'),
        (r"$(var missing 'it\'s')", "it's"),
        (r'$(var missing a\ b)', 'a b'),
        (r'$(var missing a\)b)', 'a)b'),
        ('$', '$'),
        ('$5 and $x', '$5 and $x'),
        ('a $ (b)', 'a $ (b)'),
        (r'\$(var robot)', '$(var robot)'),
        (r'$\(var robot)', '$(var robot)'),
        (r'a\b', 'ab'),
        (r'a\\b', r'a\b'),
        ('ends with \\', 'ends with \\'),
        ('(a) "b" \'c\'', '(a) "b" \'c\''),
        ('$(var code)', '$(var robot)'),
        ('two\nlines $(var robot)', 'two\nlines r1'),
        ("$(eval \"'$(var robot)'=='r1'\")", 'True'),
        ("$(eval '1 + 2')", '3'),
        ('$(eval \'"$(var robot)" == "r9"\')', 'False'),
    ],
)
def test_grammar(text: str, result: str, robot: LaunchContext) -> None:
    """Texts with substitutions become what the grammar says."""
    assert perform_substitutions(robot, parse_substitution(text)) == result


@pytest.mark.parametrize(
    'text, problem, character',
    [
        ('$()', 'begins with its name', 3),
        ('$( var x)', 'begins with its name', 3),
        ('$(1x)', 'begins with its name', 3),
        ('$(var  robot)', 'an extra space', 7),
        ('$(var robot )', 'an extra space', 13),
        ('$(dirname )', 'an extra space', 11),
        ('a $(var robot', "'var' is never closed", 3),
        ("$(var 'robot)", "quote ' is never closed", 7),
        ("$(var robot'x')", "''' is not allowed there", 12),
        ("$(var 'robot'x)", "'x' is not allowed there", 14),
        ('$(var ro(bot))', r"'\(' is not allowed there", 9),
        ("$(eval '$(var 'robot')')", "quote ' is already open", 15),
    ],
)
def test_syntax_errors(text: str, problem: str, character: int) -> None:
    """A syntax error says what is wrong and where."""
    with pytest.raises(InvalidSubstitutionError, match=f'(?s){problem}.*character {character} of'):
        parse_substitution(text)


@pytest.mark.parametrize(
    'text, problem',
    [
        ('$(bogus)', 'Unknown substitution: bogus\n'),
        ('$(evn HOME)', "Unknown substitution: evn\nDid you mean 'env'"),
        ('$(optenv HOME x)', r"Unknown substitution: optenv\nROS 2 has '\$\(env NAME DEFAULT"),
        ('$(arg robot)', r"Unknown substitution: arg\nROS 2 has '\$\(var NAME\)'"),
        ('$(var)', r'takes the arguments \(variable_name, \[default\]\), but 0 are given'),
        ('$(dirname x)', r'takes the arguments \(\), but 1 are given'),
        ('$(env A B C)', 'but 3 are given'),
    ],
)
def test_unknown_and_wrong_substitutions(text: str, problem: str) -> None:
    """An error names the substitution that is not known, or that is used wrongly."""
    with pytest.raises(InvalidSubstitutionError, match=problem):
        parse_substitution(text)


def test_place_of_an_error_in_a_long_text() -> None:
    """An error knows the line."""
    with pytest.raises(
        InvalidSubstitutionError, match="character 3 of 'b \\$\\(bogus\\)'"
    ) as caught:
        parse_substitution('a\nb $(bogus)\nc')
    assert caught.value.line == 2


def test_values_that_are_no_texts() -> None:
    """Only texts, and lists of them, are parsed."""
    assert parse_if_substitutions(1.5) == 1.5
    assert parse_if_substitutions([1, 2]) == [1, 2]
    assert isinstance(parse_if_substitutions('$(var x)')[0], LaunchConfiguration)
    [[first], [second]] = parse_if_substitutions(['$(var x)', 'y'])
    assert isinstance(first, LaunchConfiguration)
    assert isinstance(second, TextSubstitution)


def test_texts_without_substitutions() -> None:
    """Where no substitution can be, backslashes go all the same."""
    assert replace_escaped_characters(r'a\b \$(x) \\') == r'ab $(x) \ '.rstrip()


@pytest.mark.parametrize(
    'text, words',
    [
        ('', []),
        ('  ', []),
        ('-a b', ['-a', 'b']),
        ('-a $(var spaces) b$(var spaces)c', ['-a', 'p q', 'bp qc']),
        ('$(var empty)', ['']),
        ('a $(var empty) b', ['a', '', 'b']),
        ('a$(var empty)', ['a']),
        ("'a b' c", ['a b', 'c']),
        ('"a b"c', ['a bc']),
        ("'' x", ['', 'x']),
        ("'x $(var spaces) y' z", ['x p q y', 'z']),
        (r'a\\ b', ['a b']),
        (r"'a\\b' \"c\"", [r'a\b', 'c']),
        ('$(var spaces) $(var robot)', ['p q', 'r1']),
    ],
)
def test_command_words(text: str, words: list[str], robot: LaunchContext) -> None:
    """A command line is split as by a shell, but what substitutions become is not."""
    found = command_words(parse_substitution(text))
    assert [perform_substitutions(robot, word) for word in found] == words


def test_open_quote_in_a_command_line() -> None:
    """A quote that is never closed is an error."""
    with pytest.raises(ValueError, match='never closed'):
        command_words(parse_substitution("echo 'a"))
