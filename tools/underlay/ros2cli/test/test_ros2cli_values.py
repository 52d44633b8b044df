# SPDX-License-Identifier: Apache-2.0
"""Tests of the values of messages in YAML."""

from random import Random
import subprocess
import sys

import pytest
from ros2cli.messages.values import parse_values
import yaml

PIECES = (
    *(
        '{',
        '}',
        '{',
        '}',
        '[',
        ']',
        ', ',
        ': ',
        ': ',
        ' ',
        '  ',
        ',',
        ':',
        '-',
        '.',
        '+',
        "'",
        '"',
    ),
    *(
        'a',
        'b',
        'name',
        'x_1',
        'Yes',
        'no',
        'on',
        'null',
        'Null',
        '~',
        'true',
        'False',
        'TRUE',
        'y',
    ),
    *(
        '0',
        '-0',
        '1',
        '007',
        '0x1f',
        '0b1',
        '1_000',
        '-12',
        '+3',
        '9' * 18,
        '9' * 19,
        '1:30',
        '0o7',
    ),
    *('0.5', '-1.25', '.5', '1.', '1e3', '1.0e3', '1.5e+3', '.nan', 'inf', '1.0.0', '2026-11-22'),
    *('&a', '*a', '!!int', '#', '\n', '\t', 'ä', '=', '<<', '%', '@', '|', '>', '?', '- '),
)


def read(text: str, parse: object) -> object:
    """Return what a function makes of a text, with the types of all values, or that it fails."""
    try:
        value = parse(text)
    except (RuntimeError, yaml.YAMLError, LookupError, TypeError, ValueError):
        return 'refused'
    return repr(value) if isinstance(value, dict) else 'refused' if value is not None else '{}'


def some_text(chance: Random) -> str:
    """Return a text that is a mapping, or nearly one."""
    inner = ''.join(chance.choices(PIECES, k=chance.randrange(1, 5)))
    pairs = [
        f'{chance.choice("abc")}: {chance.choice(PIECES)}' for _ in range(chance.randrange(4))
    ]
    pairs.append(f'{chance.choice(PIECES)}{chance.choice((": ", ":", ": "))}{inner}')
    text = f'{{{", ".join(pairs)}}}'
    return text if chance.random() < 0.7 else f'{{list: [{inner}, 1], deep: {text}}}'


def test_simple_values_are_those_of_yaml() -> None:
    """Whatever is read without PyYAML is what PyYAML would read."""
    chance = Random(13)
    for _ in range(4000):
        text = some_text(chance)
        assert read(text, parse_values) == read(text, yaml.safe_load), text


@pytest.mark.parametrize(
    ('text', 'values'),
    [
        ('{}', {}),
        ('', {}),
        ('{data: hi}', {'data': 'hi'}),
        ('{linear: {x: 0.3, y: -1}, names: [a, b], on_top: true}', None),
        ("{data: 'two words', other: [], point: {x: 1.0}}", None),
        ('data: hi', {'data': 'hi'}),
        ('{' + 'a: {' * 30 + '}' * 31, None),
    ],
)
def test_values(text: str, values: dict[str, object] | None) -> None:
    """What users write is read."""
    assert parse_values(text) == (yaml.safe_load(text) if values is None else values)


@pytest.mark.parametrize(
    'text', ['{data: hi', 'data', '[1, 2]', '{a: 1, a', '{a: "}', '{a: !!int}']
)
def test_what_is_no_mapping(text: str) -> None:
    """What is not a mapping in YAML is refused with a sentence."""
    with pytest.raises(RuntimeError, match='The passed value'):
        parse_values(text)


def test_simple_values_need_no_yaml(ros_environment_variables: dict[str, str]) -> None:
    """The module of YAML, which takes a tenth of a command's time, is not loaded for them."""
    code = (
        'import sys\nfrom ros2cli.messages.values import parse_values\n'
        "parse_values('{linear: {x: 0.3, y: -1}, names: [a, b], on_top: true}')\n"
        "print('yaml' in sys.modules)"
    )
    command = [sys.executable, '-c', code]
    done = subprocess.run(command, env=ros_environment_variables, capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ('False\n', '')
