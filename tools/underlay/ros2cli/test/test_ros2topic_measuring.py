# SPDX-License-Identifier: Apache-2.0
"""Tests of the whole output of the verbs that measure a topic until a signal comes."""

from collections.abc import Callable
import re
import signal
from typing import Any

import pytest

Start = Callable[..., Any]

SPREAD = r'\tmin: \d+\.\d{3}s max: \d+\.\d{3}s std dev: \d+\.\d{5}s window: \d+\n'
RATE = rf'average rate: \d+\.\d{{3}}\n{SPREAD}'
SIZES = r'\tMessage size mean: 76 B min: 76 B max: 76 B\n'
BANDWIDTH = rf'(\d+ B|\d+\.\d\d KB)/s from \d+ messages\n{SIZES}'
DELAY = rf'average delay: \d+\.\d{{3}}\n{SPREAD}'
WAITING = 'WARNING: topic [/nope] does not appear to be published yet\n'


@pytest.mark.parametrize(('sent', 'status'), [(signal.SIGINT, 2), (signal.SIGTERM, 15)])
def test_signal_while_nobody_publishes(sent: int, status: int, start_ros2: Start) -> None:
    """The wait for a publisher ends at once at Ctrl-C and SIGTERM."""
    process = start_ros2('topic', 'hz', '/nobody')
    assert process.stdout.readline().startswith('WARNING: topic [/nobody] does not appear')
    process.send_signal(sent)
    assert process.wait(timeout=100) == status
    assert 'Traceback' not in process.stderr.read()


@pytest.mark.usefixtures('talker')
@pytest.mark.parametrize(('sent', 'status'), [(signal.SIGINT, 2), (signal.SIGTERM, 15)])
@pytest.mark.parametrize(
    ('words', 'head', 'report'),
    [
        (['hz', '/joint_commands'], '', RATE),
        (['hz', '/joint_commands', '--filter', 'm.position[0] > 0', '-w', '9'], '', RATE),
        (['bw', '/joint_commands'], r'Subscribed to \[/joint_commands\]\n', BANDWIDTH),
        (['delay', '/joint_commands', '--window', '9'], '', DELAY),
    ],
    ids=['hz', 'filtered hz', 'bw', 'delay'],
)
def test_reports_until_a_signal(
    words: list[str],
    head: str,
    report: str,
    sent: signal.Signals,
    status: int,
    start_ros2: Start,
) -> None:
    """Each second there is a report of two lines; a signal ends it without a word."""
    process = start_ros2('topic', *words)
    lines = [process.stdout.readline() for _ in range(3 if head else 2)]
    process.send_signal(sent)
    output, errors = process.communicate(timeout=100)
    output = ''.join(lines) + output
    assert re.fullmatch(f'{head}({report})+', output), output
    assert (errors, process.returncode) == ('', status)


@pytest.mark.usefixtures('talker')
def test_rate_is_that_of_the_publisher(start_ros2: Start) -> None:
    """The average is near the rate at which the talker means to publish."""
    process = start_ros2('topic', 'hz', '/joint_commands')
    assert 5.0 < float(process.stdout.readline().split()[-1]) < 75.0


@pytest.mark.parametrize('verb', ['hz', 'bw', 'delay'])
def test_publisher_is_waited_for(verb: str, start_ros2: Start) -> None:
    """A topic that nobody publishes is waited for, and the wait is announced."""
    process = start_ros2('topic', verb, '/nope')
    assert process.stdout.readline() == WAITING
    assert process.stderr.readline() == (
        "Still waiting for a publisher of '/nope' (Ctrl-C to stop)\n"
    )
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=100) == ('', '')
    assert process.returncode == 2
