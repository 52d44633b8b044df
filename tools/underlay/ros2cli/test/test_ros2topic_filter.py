# SPDX-License-Identifier: Apache-2.0
"""Tests of filters of messages and of the count of lost ones."""

import argparse
from collections.abc import Callable
from subprocess import CompletedProcess
from typing import Any

import pytest
from ros2topic.api.echo import LossCounter
from ros2topic.api.filtering import MessageFilter
from sensor_msgs.msg import JointState

Ros2 = Callable[..., CompletedProcess[str]]
JOINTS = JointState(name=['left', 'right'], position=[0.25, -0.5])


@pytest.mark.parametrize(
    ('text', 'expected'),
    [
        ('m.position[0] > 0.2', True),
        ('m.position[0] > 0.2 and m.position[1] > 0', False),
        ('not m.effort[:1] or m.effort[0] == 1', True),
        ("'left' in m.name", True),
        ("m.name[1:] == ['right'] and m.name[-1] not in ('a', 'b')", True),
        ('abs(m.position[1]) * 2 == 1.0', True),
        ('-1 < min(m.position) < max(m.position) <= 0.25', True),
        ('any(p < 0 for p in m.position if p != 1)', True),
        ('all(len(n) == 4 for n in m.name)', False),
        ('m.header.stamp.sec + 7 % 4 // 2 == 1', True),
        ('m.header.frame_id', False),
        ("m.name[0].startswith('le') and m.name[1].upper() == 'RIGHT'", True),
        ("int('a: 12'.split(':')[1]) % 2 == 0", True),
        ("[n for n in m.name if n.count('t') == 1] == sorted(m.name)", True),
        ('round(sum(m.position), 1) == -0.2 and m.position.count(0.25) == 1', True),
        ("(1 if 'up' in m.name else 2) == 2", True),
        (' True ', True),
    ],
)
def test_filters_are_evaluated(text: str, expected: bool) -> None:
    """Comparisons, logic, arithmetic, fields, indices and the listed functions work."""
    assert MessageFilter(text)(JOINTS) is expected


@pytest.mark.parametrize(
    'text',
    [
        "__import__('os')",
        'm.__class__',
        'm._position',
        'open("/etc/passwd")',
        'm.get_fields_and_field_types()',
        '(lambda: 1)()',
        '{x: 1 for x in m.name}',
        'm.name[0].format(m)',
        "'a'.ljust(99999999999)",
        'len(obj=m)',
        'print',
        'm := 1',
        '9 ** 9 ** 9',
        "f'{m}'",
        'm.position[0] >',
        '',
        'any(1 for a in m.name for b in m.name)',
        '(' * 5000,
    ],
)
def test_everything_else_is_refused(text: str) -> None:
    """What could do harm, or is no expression, is an error before a message comes."""
    with pytest.raises(argparse.ArgumentTypeError):
        MessageFilter(text)


@pytest.mark.parametrize(
    'text',
    [
        'm.nope',
        'm.name.clear',
        'm.get_fields_and_field_types',
        'm.header.SLOT_TYPES',
        'm.position[9]',
        'm.name + 1',
        'm.name * 99999999999',
        "'a' * 99999999999",
        "'%99999999999d' % 1",
        '1 / 0',
        'len(1)',
        'm.header.count(1)',
        "int('x')",
    ],
)
def test_filter_that_does_not_fit_is_explained(text: str) -> None:
    """A condition that the message cannot answer is a sentence."""
    with pytest.raises(RuntimeError, match='cannot be applied: '):
        MessageFilter(text)(JOINTS)


@pytest.mark.usefixtures('talker')
def test_echo_prints_what_passes(ros2_here: Ros2) -> None:
    """A message that passes the filter is printed; without one the time runs out."""
    words = ('topic', 'echo', '/joint_commands', '--field', 'name', '--filter')
    passing = ros2_here(*words, 'm.position[0] > 0', '--once')
    assert passing.stdout == '- left\n- right\n---\n'
    refused = ros2_here(*words, 'm.position[0] < 0', '--timeout', '1')
    assert (refused.returncode, refused.stdout) == (0, '')


def test_wrong_filter_is_a_usage_error(ros2_here: Ros2) -> None:
    """A filter that is not allowed is named before anything is waited for."""
    for verb in ('echo', 'hz'):
        result = ros2_here('topic', verb, '/x', '--filter', 'exit()')
        assert result.returncode == 2
        assert "argument --filter: 'exit()' is not a call that filters support" in result.stderr


def feed(counter: LossCounter, numbers: list[Any]) -> list[str]:
    """Return the reports about messages with these numbers."""
    return [counter.report_gap({'publication_sequence_number': number}) for number in numbers]


def test_gaps_are_counted() -> None:
    """A gap is reported with its size and the sum so far."""
    counter = LossCounter(lambda: True)
    assert feed(counter, [5, 6, 9, 10, 12]) == [
        '',
        '',
        'A message was lost!!!\n\ttotal count change:2\n\ttotal count: 2---\n',
        '',
        'A message was lost!!!\n\ttotal count change:1\n\ttotal count: 3---\n',
    ]


def test_gaps_without_meaning_are_not_reported() -> None:
    """Several publishers, a publisher that starts anew, and unknown numbers are no loss."""
    assert feed(LossCounter(lambda: False), [1, 50, 2, 51]) == [''] * 4
    assert feed(LossCounter(lambda: True), [7, 1, 2, None]) == [''] * 4
