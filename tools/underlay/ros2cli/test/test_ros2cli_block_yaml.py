# SPDX-License-Identifier: Apache-2.0
"""The fast writer of YAML agrees with PyYAML, to the letter."""

import random
from typing import Any

import pytest
from ros2cli.messages.block_yaml import dump, NeedsPyYaml, to_block_yaml
from ros2cli.messages.text import plain_to_yaml

NAMES = ('x', 'y', 'on', 'no', 'null', 'frame_id', 'data', 'position', 'true')
TEXTS = (
    '', ' ', 'torso', 'left_ankle_roll', '/robot1/tf', 'true', 'null', 'no', 'on', 'y', '1',
    '1.5', '0x10', '1e3', '1_000', '.inf', '12:30:45', '2020-01-01', 'a: b', 'a #b', '#a', '- a',
    '-', '?', "it's", '"', "'...'", '...', '---', '[a]', '{a}', '*a', '&a', '!a', '%a', '@a',
    '`a', '<<', '=', 'größe', '漢字', '\x01', '\t', ' a', 'a ', 'a\\b', '\x85', '\u2028',
    '\ufeff', '😀', '~', 'a,b',
)  # fmt: skip
NUMBERS = (
    0, -1, 2**64 - 1, 0.0, -0.0, 0.1, 1e-7, 1e16, 1.5e300, 1e22, -2.5e-9, float('inf'),
    float('-inf'), True, False,
)  # fmt: skip


def random_value(source: random.Random, depth: int) -> Any:
    """Return a scalar, or a list or mapping of values."""
    kind = source.choice(['text', 'number', 'list', 'dict'] if depth else ['text', 'number'])
    if kind == 'text':
        return source.choice(TEXTS)
    if kind == 'number':
        return source.choice(NUMBERS)
    count = source.randrange(4)
    if kind == 'list':
        return [random_value(source, depth - 1) for _ in range(count)]
    return {source.choice(NAMES): random_value(source, depth - 1) for _ in range(count)}


@pytest.mark.parametrize('seed', range(10))
def test_random_values_are_written_as_pyyaml_does(seed: int) -> None:
    """Nested mappings and lists of all kinds of scalars come out the same."""
    source = random.Random(seed)
    for _ in range(300):
        plain = {'first': random_value(source, 4), 'list': [random_value(source, 3)]}
        assert plain_to_yaml(plain) == dump(plain, flow_style=False)


@pytest.mark.parametrize('scalar', [*TEXTS, *NUMBERS, float('nan'), 'a\nb', None, b'a'])
def test_scalars_are_written_as_pyyaml_does(scalar: Any) -> None:
    """Each scalar is quoted as it must be, as a value, as an item, and alone."""
    for plain in ({'a': scalar}, [scalar], {'a': [{'b': scalar}]}, scalar):
        assert plain_to_yaml(plain) == dump(plain, flow_style=False)


def test_text_of_several_lines_is_left_to_pyyaml() -> None:
    """What depends on the indentation is not attempted."""
    with pytest.raises(NeedsPyYaml):
        to_block_yaml({'a': 'first\nsecond'})
