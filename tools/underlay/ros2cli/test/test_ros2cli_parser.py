# SPDX-License-Identifier: Apache-2.0
"""Tests of the order of options and other words on the command line."""

import argparse

import pytest
from ros2cli.parser import options_first, Parser


@pytest.fixture
def parser() -> Parser:
    """Return a parser with an option of each kind, among them one that looks like a number."""
    parser = Parser(prog='demo')
    parser.add_argument('topic')
    parser.add_argument('type', nargs='?')
    parser.add_argument('values', nargs='?')
    parser.add_argument('-1', '--once', action='store_true')
    parser.add_argument('-s', '--sim', action='store_true')
    parser.add_argument('-r', '--rate', type=float)
    parser.add_argument('--range', nargs=2)
    parser.add_argument('--names', nargs='+')
    parser.add_argument('--clock', nargs='?')
    return parser


@pytest.mark.parametrize(
    ('words', 'expected'),
    [
        (['T', 'X', '-r', '50', '{a: 1}'], ['-r', '50', '--', 'T', 'X', '{a: 1}']),
        (['T', '--once', 'X'], ['--once', '--', 'T', 'X']),
        (['T', '-1', 'X'], ['-1', '--', 'T', 'X']),
        (['T', 'X', '-1e3'], ['--', 'T', 'X', '-1e3']),
        (['T', '-r', '-5'], ['-r=-5', '--', 'T']),
        (['T', '--rat', '-5'], ['--rat=-5', '--', 'T']),
        (['T', '-r50', '--rate=5', 'X'], ['-r50', '--rate=5', '--', 'T', 'X']),
        (['-sr', '50', 'T'], ['-sr', '50', '--', 'T']),
        (['--range', '1', '2', 'T'], ['--range', '1', '2', '--', 'T']),
        (['--names', 'a', 'b', '-s', 'T'], ['--names', 'a', 'b', '-s', '--', 'T']),
        (['--names', 'a', '--', '-s'], ['--names', 'a', '--', '-s']),
        (['--xyz', 'T'], ['--xyz', '--', 'T']),
        (['- a', 'T'], ['--', '- a', 'T']),
        (['-', '', 'T'], ['--', '-', '', 'T']),
        (['-s'], ['-s']),
        ([], []),
    ],
)
def test_options_come_first(parser: Parser, words: list[str], expected: list[str]) -> None:
    """Options take their values along; all that is no option comes behind the `--`."""
    assert options_first(words, parser._option_string_actions) == expected


@pytest.mark.parametrize(
    'words',
    [
        ['T', 'X', '-r', '-50', '-1e3'],
        ['-r', '-50', 'T', 'X', '-1e3'],
        ['T', '-r', '-50', 'X', '--', '-1e3'],
        ['T', 'X', '-1e3', '--rate=-50'],
    ],
)
def test_order_does_not_matter(parser: Parser, words: list[str]) -> None:
    """An optional argument after an option, and negative numbers, are understood."""
    args = parser.parse_args(words)
    assert (args.topic, args.type, args.values, args.rate) == ('T', 'X', '-1e3', -50.0)


@pytest.mark.parametrize(
    ('words', 'text'),
    [
        ([], 'the following arguments are required: topic'),
        (['T', '--rate'], 'argument -r/--rate: expected one argument'),
        (['T', '--rate', 'x'], "argument -r/--rate: invalid float value: 'x'"),
        (['T', '--xyz', 'X', 'V', 'W'], 'unrecognized arguments: --xyz W'),
    ],
)
def test_errors_are_those_of_argparse(
    parser: Parser, words: list[str], text: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """What is missing or too much is named as ever."""
    with pytest.raises(SystemExit):
        parser.parse_args(words)
    assert capsys.readouterr().err.endswith(f'demo: error: {text}\n')


def test_words_of_another_program_stay_as_they_are() -> None:
    """A parser that passes the rest of the words on does not change their order."""
    parser = Parser()
    parser.add_argument('program')
    parser.add_argument('rest', nargs=argparse.REMAINDER)
    assert parser.parse_args(['p', 'a', '--b', '--', '-1']).rest == ['a', '--b', '--', '-1']


def test_help_is_as_wide_as_the_terminal(monkeypatch: pytest.MonkeyPatch, parser: Parser) -> None:
    """The width comes from COLUMNS where it is set."""
    monkeypatch.setenv('COLUMNS', '40')
    assert max(map(len, parser.format_help().splitlines())) <= 40
