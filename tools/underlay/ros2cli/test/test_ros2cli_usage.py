# SPDX-License-Identifier: Apache-2.0
"""Tests of bad arguments: every command and verb has a usage error for them."""

import pytest
from ros2cli.cli import COMMANDS, main

PASSING_WORDS_ON = ('run',)
VERBS = [
    (name, verb)
    for name, entry in COMMANDS.items()
    for verb in getattr(entry.create(), 'VERBS', ())
]
LEAVES = [
    *VERBS,
    *((name,) for name in COMMANDS if name not in PASSING_WORDS_ON and name not in dict(VERBS)),
]
WITHOUT_ARGUMENTS = [
    (['daemon', 'start'], 'x'),
    (['node', 'list'], 'x'),
    (['pkg', 'list'], 'x'),
    (['topic', 'list'], 'x'),
    (['topic', 'list', '-t'], '-1'),
]
REQUIRED = {
    'launch': 'package_name',
    'node info': 'node_name',
    'pkg prefix': 'package_name',
    'pkg xml': 'package_name',
    'run': 'package_name, executable_name',
    'topic bw': 'topic_name',
    'topic delay': 'topic_name',
    'topic echo': 'topic_name',
    'topic find': 'topic_type',
    'topic hz': 'topic_name',
    'topic info': 'topic_name',
    'topic pub': 'topic_name, message_type',
    'topic pub /x': 'message_type',
    'topic type': 'topic_name',
}
BAD_VALUES = [
    (['topic', 'echo', '/x', '--qos-reliability', 'x'], '--qos-reliability', 'invalid choice'),
    (['topic', 'echo', '/x', '--qos-profile', 'x'], '--qos-profile', 'invalid choice'),
    (['topic', 'echo', '/x', '-l', '-1'], '-l/--truncate-length', "'-1' is not a whole number"),
    (['topic', 'echo', '/x', '--timeout', '-1'], '--timeout', "'-1' is not a number above zero"),
    (['topic', 'hz', '/x', '-w', '0'], '-w/--window', "'0' is not a whole number above zero"),
    (['topic', 'hz', '/x', '--filter', 'm ='], '--filter', "'m =' is not an expression"),
    (['topic', 'bw', '/x', '--window', 'x'], '-w/--window', "'x' is not a whole number"),
    (['topic', 'delay', '/x', '-w', '1.5'], '-w/--window', "'1.5' is not a whole number"),
    (['topic', 'pub', '/x', 'T', '-r', '-5'], '-r/--rate', "'-5' is not a number above zero"),
    (['topic', 'pub', '/x', 'T', '-r', 'nan'], '-r/--rate', "'nan' is not a number above zero"),
    (['topic', 'pub', '/x', 'T', '-t', '0'], '-t/--times', "'0' is not a whole number above"),
    (['topic', 'pub', '/x', 'T', '-1', '-t', '2'], '-t/--times', 'not allowed with argument -1'),
    (['topic', 'pub', '/x', 'T', '-n', '1x'], '-n/--node-name', "'1x' is not a valid node name"),
    (['topic', 'list', '--spin-time', '0'], '--spin-time', "'0' is not a number above zero"),
    (['node', 'list', '--spin-time', 'inf'], '--spin-time', "'inf' is not a number above zero"),
    (['pkg', 'create', '--build-type', 'x'], '--build-type', 'invalid choice'),
    (['pkg', 'create', '--package-format', '4'], '--package-format', 'invalid choice'),
    (['pkg', 'create', '--dependencies'], '--dependencies', 'expected at least one argument'),
]


def usage_error(words: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """Return the last line of a command that is refused, after a look at the rest."""
    assert main(words) == 2
    output, errors = capsys.readouterr()
    assert output == ''
    assert errors.startswith('usage: ros2 ')
    assert 'Traceback' not in errors
    return str(errors.splitlines()[-1])


@pytest.mark.parametrize('words', LEAVES, ids=' '.join)
def test_unknown_option(words: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    """An unknown option is an error of the root, unless something else is missing."""
    line = usage_error([*words, '--xyz'], capsys)
    missing = f'ros2 {" ".join(words)}: error: the following arguments are required: '
    assert line == 'ros2: error: unrecognized arguments: --xyz' or line.startswith(missing)


@pytest.mark.parametrize(('words', 'extra'), WITHOUT_ARGUMENTS)
def test_one_word_too_many(
    words: list[str], extra: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """A word that no argument takes is an error of the root."""
    line = usage_error([*words, extra], capsys)
    assert line == f'ros2: error: unrecognized arguments: {extra}'


@pytest.mark.parametrize('words', REQUIRED)
def test_missing_argument(words: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A missing argument is named, with all that are missing; some Pythons name the rest too."""
    verb = ' '.join(word for word in words.split() if not word.startswith('/'))
    assert usage_error(words.split(), capsys).startswith(
        f'ros2 {verb}: error: the following arguments are required: {REQUIRED[words]}'
    )


@pytest.mark.parametrize(('words', 'option', 'reason'), BAD_VALUES)
def test_bad_value(
    words: list[str], option: str, reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """A value that an option cannot have is an error of the verb, with the reason."""
    line = usage_error(words, capsys)
    assert line.startswith(f'ros2 {words[0]} {words[1]}: error: argument {option}')
    assert reason in line


@pytest.mark.parametrize('name', [*dict(VERBS)])
def test_unknown_verb(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A verb that does not exist is an error of its command, which names those that do."""
    choices = ', '.join(repr(verb) for command, verb in VERBS if command == name)
    assert usage_error([name, 'nope'], capsys).startswith(
        f'ros2 {name}: error: argument Call `ros2 {name} <verb> -h` for more detailed usage.: '
        f"invalid choice: 'nope' (choose from {choices})"
    )
