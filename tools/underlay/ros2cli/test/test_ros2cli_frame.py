# SPDX-License-Identifier: Apache-2.0
"""Tests of the frame: help, unknown commands and what is imported."""

import io
from pathlib import Path
import subprocess
import sys
from typing import Any

import pytest
from ros2cli.cli import COMMANDS, main
from ros2cli.commands import PkgCommand
from ros2cli.entry import Entry

VERB_COMMANDS = [
    command
    for command in (entry.create() for entry in COMMANDS.values())
    if hasattr(command, 'VERBS')
]
ENTRIES = [
    *COMMANDS.values(),
    *(entry for command in VERB_COMMANDS for entry in command.VERBS.values()),
]


@pytest.mark.parametrize('words', [[], ['-h'], ['--help']])
def test_help_lists_commands(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    """The help goes to stdout, names all commands and is no error."""
    assert main(words) == 0
    output = capsys.readouterr().out
    assert output.startswith('usage: ros2 [-h]')
    assert '  pkg        Various package related sub-commands\n' in output
    assert output.endswith('Call `ros2 <command> -h` for more detailed usage.\n')


def test_command_without_verb_prints_help(capsys: pytest.CaptureFixture[str]) -> None:
    """A command without a verb prints its help."""
    assert main(['topic']) == 0
    assert capsys.readouterr().out.startswith('usage: ros2 topic [-h]')


def test_unknown_command_suggests(capsys: pytest.CaptureFixture[str]) -> None:
    """A misspelt command is a usage error which names the choices and the closest one."""
    assert main(['topc']) == 2
    error = capsys.readouterr().err
    assert (
        'ros2: error: argument Call `ros2 <command> -h` for more detailed usage.: '
        "invalid choice: 'topc' (choose from '"
    ) in error
    assert "Did you mean 'topic'?" in error


def test_unknown_verb_names_command(capsys: pytest.CaptureFixture[str]) -> None:
    """A misspelt verb is an error of its command."""
    assert main(['pkg', 'lst']) == 2
    error = capsys.readouterr().err
    assert 'ros2 pkg: error: argument Call `ros2 pkg <verb> -h`' in error
    assert "Did you mean 'list'?" in error


def test_unknown_option_is_error_of_root(capsys: pytest.CaptureFixture[str]) -> None:
    """An unknown option anywhere is reported by the root parser."""
    assert main(['pkg', 'list', '--nope']) == 2
    assert 'ros2: error: unrecognized arguments: --nope' in capsys.readouterr().err


@pytest.mark.parametrize(
    ('words', 'advice'),
    [
        (['pkg', 'prefix', 'rclpy', '--shar'], None),
        (['topic', 'list', '--show-tpes'], "Did you mean '--show-types'?"),
        (['topic', '--include-hidden-topcs', 'list'], "Did you mean '--include-hidden-topics'?"),
        (['topic', 'pub', '/x', 'T', '{data:', '1}'], 'A value with spaces needs quotes, as in '),
        (['topic', 'list', 'x'], 'ros2: error: unrecognized arguments: x'),
    ],
)
def test_advice_on_unknown_words(
    words: list[str], advice: str | None, capsys: pytest.CaptureFixture[str]
) -> None:
    """What was probably meant is said on a line after the error; abbreviations are none."""
    assert main(words) == (0 if advice is None else 2)
    if advice is not None:
        assert capsys.readouterr().err.splitlines()[-1].startswith(advice)


def test_missing_argument_is_error_of_verb(capsys: pytest.CaptureFixture[str]) -> None:
    """A missing argument is reported by the parser of the verb."""
    assert main(['topic', 'echo']) == 2
    expected = 'ros2 topic echo: error: the following arguments are required: topic_name'
    assert expected in capsys.readouterr().err


@pytest.mark.parametrize('entry', ENTRIES, ids=lambda entry: str(entry.target))
def test_table_agrees_with_docstring(entry: Entry) -> None:
    """The help in the static table is the first line of the class's docstring."""
    first_line = (type(entry.create()).__doc__ or '').strip().split('\n')[0]
    assert first_line == f'{entry.summary}.'


def test_verbs_of_other_packages_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """A verb which is not in the table is looked up among the entry points."""
    asked = []

    def find(group: str, name: str) -> None:
        asked.append((group, name))

    monkeypatch.setattr('ros2cli.entry.find_entry', find)
    assert main(['pkg', 'extra']) == 2
    assert asked == [(PkgCommand.VERB_GROUP, 'extra')]


@pytest.mark.parametrize(
    'words',
    [
        ['--help'],
        ['pkg', 'list'],
        ['pkg', 'prefix', 'rclpy'],
        ['topic', 'echo', '--help'],
        ['param', 'set', '--help'],
        ['interface', 'show', 'sensor_msgs/msg/JointState'],
        ['launch', '--help'],
        ['run', 'nope', 'nope'],
    ],
)
def test_heavy_modules_are_not_imported(
    words: list[str],
    ros_environment_variables: dict[str, str],
) -> None:
    """Commands without a node import neither rclpy nor the scanner of entry points."""
    heavy = {'rclpy', 'importlib.metadata', 'asyncio', 'yaml', 'shutil'}
    assert imported_by(words, heavy, ros_environment_variables) == []


def test_to_list_packages_takes_little(ros_environment_variables: dict[str, str]) -> None:
    """What is installed is found out without what takes longer to load than the answer."""
    heavy = {'inspect', 'pathlib', 'signal', 'threading', 'typing', 'urllib.parse'}
    assert imported_by(['pkg', 'list'], heavy, ros_environment_variables) == []


def test_rclpy_is_not_imported_to_show_arguments(
    ros_environment_variables: dict[str, str], tmp_path: Path
) -> None:
    """To show what a launch file declares, nothing of ROS is needed."""
    path = tmp_path / 'x.launch.py'
    path.write_text(
        'from launch import LaunchDescription\n'
        'from launch.actions import DeclareLaunchArgument\n'
        'from launch_ros.actions import Node\n'
        'def generate_launch_description():\n'
        "    node = Node(package='demo_pkg', executable='talk')\n"
        "    return LaunchDescription([DeclareLaunchArgument('robot'), node])\n"
    )
    words = ['launch', str(path), '--show-args']
    heavy = {'rclpy', 'importlib.metadata', 'yaml'}
    assert imported_by(words, heavy, ros_environment_variables) == []


def imported_by(words: list[str], modules: set[str], environment: dict[str, str]) -> list[str]:
    """Return which of some modules a command imports."""
    code = (
        'import sys\nearly = set(sys.modules)\n'
        'from ros2cli.cli import main\nmain(sys.argv[1:])\n'
        "print('imported:', *sorted(set(sys.modules) - early))\n"
    )
    result = subprocess.run(
        [sys.executable, '-c', code, *words],
        env=environment,
        check=True,
        capture_output=True,
        text=True,
    )
    *_, last_line = result.stdout.splitlines()
    return sorted(modules & set(last_line.split()))


def test_width_of_help(capsys: pytest.CaptureFixture[str], monkeypatch: Any) -> None:
    """The help is as wide as COLUMNS says, and 80 columns where there is no terminal."""
    widths = []
    for columns in ('60', '200', ''):
        monkeypatch.setenv('COLUMNS', columns)
        assert main(['topic', 'list', '--help']) == 0
        widths.append(max(map(len, capsys.readouterr().out.splitlines())))
    assert widths[0] <= 60 < widths[2] <= 80 < widths[1]


@pytest.mark.parametrize(
    ('words', 'line_buffering'),
    [(['pkg'], True), (['--use-python-default-buffering', 'pkg'], False)],
)
def test_output_comes_line_by_line(
    words: list[str], line_buffering: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each line of output is written at once, unless Python's buffering is asked for."""
    output = io.TextIOWrapper(io.BytesIO())
    monkeypatch.setattr('sys.stdout', output)
    assert main(words) == 0
    assert output.line_buffering is line_buffering
