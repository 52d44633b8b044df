# SPDX-License-Identifier: Apache-2.0
"""Tests of what all commands and verbs have in common; those of the tables, so new ones too."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
import os
from pathlib import Path
import shlex
import signal
import subprocess
import sys
import time

import pytest
from ros2cli.cli import BROKEN_PIPE_STATUS, COMMANDS, create_parser, main

SCRIPT = Path(__file__).parents[1] / 'scripts' / 'ros2'
HELP_WIDTH = 80
FULL = 'The output cannot be written: No space left on device\n'
INTERRUPTED = (int(signal.SIGINT), -int(signal.SIGINT))
ROS2 = (sys.executable, '-m', 'ros2cli')


def lines() -> Iterator[tuple[str, ...]]:
    """Yield the words of the root, of each command and of each verb."""
    yield ()
    for name, entry in COMMANDS.items():
        yield (name,)
        for verb in getattr(entry.create(), 'VERBS', ()):
            yield (name, verb)


EVERY_LINE = pytest.mark.parametrize('words', list(lines()), ids=' '.join)


def arguments(words: tuple[str, ...]) -> Iterator[argparse.Action]:
    """Yield what a command line can have after some words."""
    parser = create_parser(words)
    for word in words:
        parser = next(a.choices[word] for a in parser._actions if isinstance(a.choices, dict))
    yield from (a for a in parser._actions if not isinstance(a.choices, dict))


@EVERY_LINE
def test_help(
    words: tuple[str, ...],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The help goes to stdout, begins with the usage, says what it does, and fits a terminal."""
    monkeypatch.setenv('COLUMNS', str(HELP_WIDTH))
    assert main([*words, '--help']) == 0
    output, errors = capsys.readouterr()
    assert errors == ''
    usage, description, *_ = output.split('\n\n')
    assert usage.startswith(' '.join(['usage: ros2', *words, '[']))
    assert description.strip() != '' and not description.startswith('options:')
    lines_of_help = [line for line in output.splitlines() if 'for more detailed' not in line]
    assert max(map(len, lines_of_help)) <= HELP_WIDTH


@EVERY_LINE
def test_every_argument_is_described(words: tuple[str, ...]) -> None:
    """Each argument and option says what it is for."""
    assert [each.dest for each in arguments(words) if not each.help] == []


def shell(line: str, environment: dict[str, str]) -> subprocess.CompletedProcess[str]:
    """Run a line of bash in which the function `ros2` is the command line."""
    return subprocess.run(
        ['bash', '-c', f'ros2() {{ exec {shlex.join(ROS2)} "$@"; }}; {line}'],
        env=environment,
        capture_output=True,
        text=True,
        timeout=60,
    )


OUTPUTS = ('--help', 'topic', 'topic echo --help', 'pkg list', 'interface list')
EVERY_OUTPUT = pytest.mark.parametrize('words', OUTPUTS)


@EVERY_OUTPUT
def test_output_to_a_full_disk(words: str, ros_environment_variables: dict[str, str]) -> None:
    """What cannot be written is an error in one sentence, for help as well."""
    result = shell(f'(ros2 {words}) >/dev/full', ros_environment_variables)
    assert (result.returncode, result.stderr) == (1, FULL)


@EVERY_OUTPUT
def test_output_to_a_closed_pipe(words: str, ros_environment_variables: dict[str, str]) -> None:
    """A reader that ends first, or at once, is no reason for a complaint."""
    result = shell(
        f'ros2 {words} | head -1 >/dev/null; echo ${{PIPESTATUS[0]}}; ros2 {words} | true',
        ros_environment_variables,
    )
    assert result.stderr == ''
    assert int(result.stdout) in (0, BROKEN_PIPE_STATUS)


@EVERY_OUTPUT
def test_streams_that_are_closed(words: str, ros_environment_variables: dict[str, str]) -> None:
    """Who closes the streams wants no output, on none of them."""
    result = shell(f'(ros2 {words}) <&- >&-', ros_environment_variables)
    assert (result.returncode, result.stdout, result.stderr) == (0, '', '')
    assert shell(f'(ros2 {words}) >&- 2>&-', ros_environment_variables).returncode == 0


def test_closed_stream_is_not_replaced_by_a_socket(
    ros_environment_variables: dict[str, str],
) -> None:
    """The descriptors of streams that are closed are not those of the next files."""
    code = (
        'from ros2cli.start_up import open_standard_streams\n'
        'open_standard_streams()\n'
        "raise SystemExit(open('/dev/null').fileno())\n"
    )
    line = f'{shlex.quote(sys.executable)} -c "{code}" <&- >&- 2>&-'
    assert shell(line, ros_environment_variables).returncode == 3


@pytest.mark.parametrize('delay_s', [0.05, 0.2, 0.5, 1.0, 2.0])
@pytest.mark.parametrize(
    'words', [('topic', 'hz', '/nope'), ('service', 'call', '/nope', 'std_srvs/srv/Trigger')]
)
def test_interrupt_at_any_time(
    ros_environment_variables: dict[str, str], words: tuple[str, ...], delay_s: float
) -> None:
    """Ctrl-C ends a command quietly, also while modules are imported, and if pressed twice."""
    start = (
        f"names = {{'__name__': '__main__', '__file__': '{SCRIPT}'}}; "
        f"code = compile(open('{SCRIPT}').read(), '{SCRIPT}', 'exec'); "
        'print(flush=True); exec(code, names)'
    )
    with subprocess.Popen(
        [sys.executable, '-c', start, *words],
        env=ros_environment_variables,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as process:
        assert process.stdout is not None
        process.stdout.readline()  # what Python itself does before is not ours
        time.sleep(delay_s)
        for _ in range(2):
            os.killpg(process.pid, signal.SIGINT)
            time.sleep(0.01)
        _, errors = process.communicate(timeout=60)
    assert process.returncode in INTERRUPTED
    assert 'Traceback' not in errors
    assert 'ignored' not in errors
