# SPDX-License-Identifier: Apache-2.0
"""Tests of completion in a shell with a terminal."""

from __future__ import annotations

from collections.abc import Iterator
import json
import os
from pathlib import Path
import pty
import select
from shlex import quote
import shutil
import signal
import subprocess
import sys
import time

import pytest

SCRIPTS = Path(__file__).parents[1] / 'completion'
PROMPT = 'ready> '
TIMEOUT_S = 100.0
INTERRUPT = '\x03'
DELETE_LINE = '\x15'

pytestmark = pytest.mark.skipif(not shutil.which('bash'), reason='there is no bash')


class Terminal:
    """A shell in a terminal of its own, and what it has shown."""

    def __init__(self, command: list[str], environment: dict[str, str]) -> None:
        """Start the shell and wait for its prompt."""
        self.shown = ''
        self.pid, self._descriptor = pty.fork()
        if self.pid == 0:
            os.execvpe(command[0], command, environment)
        self.wait_for(PROMPT)

    def press(self, text: str) -> None:
        """Press keys."""
        self.shown = ''
        os.write(self._descriptor, text.encode())

    def wait_for(self, text: str) -> None:
        """Read until a text is shown."""
        end = time.monotonic() + TIMEOUT_S
        while text not in self.shown:
            assert time.monotonic() < end, f'{text!r} is not in {self.shown!r}'
            self.read(0.1)

    def read(self, duration_s: float) -> None:
        """Read what is shown within some time."""
        if select.select([self._descriptor], [], [], duration_s)[0]:
            self.shown += os.read(self._descriptor, 4096).decode(errors='replace')

    def children(self) -> list[str]:
        """Return the processes that the shell has started and that still run."""
        path = Path(f'/proc/{self.pid}/task/{self.pid}/children')
        return [pid for pid in path.read_text().split() if _state(pid) not in ('', 'Z')]

    def close(self) -> None:
        """End the shell."""
        os.kill(self.pid, signal.SIGKILL)
        os.waitpid(self.pid, 0)
        os.close(self._descriptor)


def _state(pid: str) -> str:
    """Return the state of a process, empty if there is none: Z has ended but not been noticed."""
    try:
        return Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()[0]
    except OSError:
        return ''


@pytest.fixture
def environment(tmp_path: Path, ros_environment_variables: dict[str, str]) -> dict[str, str]:
    """Return the environment of a shell that finds this `ros2`."""
    program = tmp_path / 'bin' / 'ros2'
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nexec {quote(sys.executable)} -m ros2cli "$@"\n')
    program.chmod(0o755)
    return {
        **ros_environment_variables,
        'PATH': f'{program.parent}:{os.environ["PATH"]}',
        'ROS_HOME': str(tmp_path),
        'TERM': 'dumb',
        'ZDOTDIR': str(tmp_path),
    }


def start_shell(name: str, folder: Path, environment: dict[str, str]) -> Terminal:
    """Start an interactive shell with the completion of `ros2`, as strict as a shell can be."""
    if not shutil.which(name):
        pytest.skip(f'there is no {name}')
    script = quote(str(SCRIPTS / f'ros2.{name}'))
    rc = folder / '.zshrc'
    options, command = {
        'bash': (
            "bind 'set bell-style none' 'set enable-bracketed-paste off'; set -u -o noclobber",
            ['bash', '--noprofile', '--rcfile', str(rc), '-i'],
        ),
        'zsh': ('unsetopt prompt_cr; setopt nounset ksharrays shwordsplit', ['zsh', '-d', '-i']),
    }[name]
    rc.write_text(f"PS1='{PROMPT}'\nset -e\nsource {script}\n{options}\n")
    return Terminal(command, environment)


@pytest.fixture
def bash(tmp_path: Path, environment: dict[str, str]) -> Iterator[Terminal]:
    """Run bash."""
    terminal = start_shell('bash', tmp_path, environment)
    yield terminal
    terminal.close()


@pytest.fixture(params=['bash', 'zsh'])
def shell(
    request: pytest.FixtureRequest, tmp_path: Path, environment: dict[str, str]
) -> Iterator[Terminal]:
    """Run each of the shells."""
    terminal = start_shell(request.param, tmp_path, environment)
    yield terminal
    terminal.close()


def test_tab_completes_a_word(bash: Terminal) -> None:
    """TAB adds the rest of a word and a space, and nothing else reaches the terminal."""
    bash.press('ros2 topic ec\t')
    bash.wait_for('echo ')
    bash.read(0.5)
    assert bash.shown == 'ros2 topic echo '
    assert bash.children() == []


@pytest.mark.parametrize('quotation', ['', '"', "'"])
def test_launch_arguments(shell: Terminal, tmp_path: Path, quotation: str) -> None:
    """An argument's name ends with `:=`, directly after which its value is completed."""
    folder = tmp_path / 'two words'
    folder.mkdir()
    (folder / 'x.launch.py').write_text(
        'import sys\n'
        "print('noise')\n"
        "print('noise', file=sys.stderr)\n"
        'from launch import LaunchDescription\n'
        'from launch.actions import DeclareLaunchArgument\n'
        'def generate_launch_description():\n'
        '    return LaunchDescription([\n'
        "        DeclareLaunchArgument('robot', choices=['nao', 'wolfgang'])])\n"
    )
    begin = str(folder) if quotation else str(folder).replace(' ', '\\ ')
    shell.press(f'ros2 launch {quotation}{begin}/x\t')
    shell.wait_for('.launch.py')
    shell.press(' ro\t')
    shell.wait_for('bot:=')
    shell.press('w\t')
    shell.wait_for('olfgang')
    assert 'noise' not in shell.shown


def test_message(shell: Terminal) -> None:
    """A whole message is inserted between quotes, in which it can be edited."""
    shell.press('ros2 topic pub /x std_msgs/msg/String \t')
    shell.wait_for('"{data: \'\'}"')


def test_program_is_missing(shell: Terminal) -> None:
    """Where there is no `ros2` (any more), TAB does nothing, and the shell lives on."""
    shell.press('PATH=/nowhere\n')
    shell.wait_for(PROMPT)
    shell.press('ros2 la\t')
    shell.read(1.0)
    shell.press(f'{DELETE_LINE}echo $((1 + 1))alive\n')
    shell.wait_for('2alive')
    assert 'not found' not in shell.shown


def test_two_tabs_show_the_choices(bash: Terminal) -> None:
    """Where there are several words, TAB pressed twice lists them."""
    bash.press('ros2 pkg \t\t')
    bash.wait_for(f'{PROMPT}ros2 pkg ')
    for verb in ('create', 'executables', 'list', 'prefix', 'xml'):
        assert verb in bash.shown


def test_interrupt_while_completing(bash: Terminal) -> None:
    """Ctrl-C during completion leaves no process and no text of one."""
    bash.press('ros2 topic echo /\t')
    end = time.monotonic() + TIMEOUT_S
    while not bash.children() and time.monotonic() < end:
        bash.read(0.005)
    bash.press(INTERRUPT)
    while bash.children() and time.monotonic() < end:
        bash.read(0.1)
    assert bash.children() == []
    assert 'Traceback' not in bash.shown


@pytest.mark.parametrize('shell', ['bash', 'zsh'])
def test_nothing_happens_without_a_terminal(shell: str) -> None:
    """A script that sources the environment gets no completion and no word of it."""
    if not shutil.which(shell):
        pytest.skip(f'there is no {shell}')
    result = subprocess.run(
        [
            shell,
            '-euc',
            f'. {quote(str(SCRIPTS))}/ros2.{shell}; typeset -f _ros2_complete || echo none',
        ],
        capture_output=True,
        text=True,
    )
    assert (result.returncode, result.stdout, result.stderr) == (0, 'none\n', '')


def test_hooks_are_installed() -> None:
    """The hooks that set-up files source are files of this package."""
    hooks = json.loads((SCRIPTS.parent / 'colcon.pkg').read_text())['hooks']
    assert [os.path.dirname(hook) for hook in hooks] == ['share/ros2cli/completion'] * 2
    assert all((SCRIPTS / os.path.basename(hook)).is_file() for hook in hooks)
