# SPDX-License-Identifier: Apache-2.0
"""Tests of `ros2 launch` with real launch files."""

from collections.abc import Callable
import json
import os
from pathlib import Path
import signal
from subprocess import CompletedProcess
from typing import Any

import pytest

Ros2 = Callable[..., CompletedProcess[str]]
Start = Callable[..., Any]

LAUNCH_FILE = """\
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('word', default_value='hello', description='what to say'),
        ExecuteProcess(cmd=['echo', 'said', LaunchConfiguration('word')], output='screen'),
    ])
"""
SLEEPER = """\
from launch import LaunchDescription
from launch.actions import ExecuteProcess


def generate_launch_description():
    cmd = ['sh', '-c', 'echo pid $$; exec sleep 60']
    return LaunchDescription([ExecuteProcess(cmd=cmd, output='screen')])
"""


@pytest.fixture
def arm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, str]:
    """Install a package with launch files and return the environment that finds it."""
    index = tmp_path / 'share' / 'ament_index' / 'resource_index' / 'packages'
    index.mkdir(parents=True)
    (index / 'arm').touch()
    for name, text in {
        'launch/say.launch.py': LAUNCH_FILE,
        'launch/sleep.launch.py': SLEEPER,
        'launch/broken.launch.py': 'import nope_nope\n',
        'launch/twice.launch.py': '',
        'other/twice.launch.py': '',
    }.items():
        path = tmp_path / 'share' / 'arm' / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    monkeypatch.chdir(tmp_path)
    return {
        'AMENT_PREFIX_PATH': str(tmp_path),
        'COLCON_PREFIX_PATH': '',
        'ROS_LOG_DIR': str(tmp_path / 'log'),
    }


def test_package_and_file(ros2: Ros2, arm: dict[str, str]) -> None:
    """A launch file of a package runs with the arguments of the command line."""
    result = ros2('launch', 'arm', 'say.launch.py', 'word:=bye', extra=arm)
    lines = result.stdout.splitlines()
    assert lines[0].startswith('[INFO] [launch]: All log files can be found below ')
    assert lines[1] == '[INFO] [launch]: Default logging verbosity is set to INFO'
    assert '[echo-1] said bye' in lines
    assert (result.returncode, result.stderr) == (0, '')


def test_path_instead_of_package(ros2: Ros2, arm: dict[str, str]) -> None:
    """A launch file can be named by its path; what follows are its arguments."""
    path = 'share/arm/launch/say.launch.py'
    result = ros2('launch', path, 'word:=bye', extra=arm)
    assert '[echo-1] said bye' in result.stdout.splitlines()


def test_show_args(ros2: Ros2, arm: dict[str, str]) -> None:
    """The arguments are shown and nothing is started."""
    result = ros2('launch', 'arm', 'say.launch.py', '--show-args', extra=arm)
    assert result.stdout == (
        "Arguments (pass arguments as '<name>:=<value>'):\n\n"
        "    'word':\n        what to say\n        (default: 'hello')\n"
    )
    assert (result.returncode, result.stderr) == (0, '')


def test_show_args_of_a_noisy_file(ros2: Ros2, arm: dict[str, str]) -> None:
    """What a launch file prints while it is loaded comes below the heading."""
    Path('noisy.launch.py').write_text("print('printed')\n" + LAUNCH_FILE)
    result = ros2('launch', 'noisy.launch.py', '--show-args', extra=arm)
    assert result.stdout.startswith("Arguments (pass arguments as '<name>:=<value>'):\nprinted\n")
    assert result.stdout.endswith("        (default: 'hello')\n")


def test_prefix(ros2: Ros2, arm: dict[str, str]) -> None:
    """A prefix stands before the command of each process."""
    result = ros2('launch', '--launch-prefix', 'echo before', 'arm', 'say.launch.py', extra=arm)
    assert '[echo-1] before echo said hello' in result.stdout.splitlines()


@pytest.mark.parametrize(
    ('words', 'error'),
    [
        (['nopkg', 'x'], "Package 'nopkg' not found: \"package 'nopkg' not found, searching: ['"),
        (
            ['arm', 'sai.launch.py'],
            "file 'sai.launch.py' was not found in the share directory of package 'arm' which "
            "is at '",
        ),
        (
            ['arm', 'twice.launch.py'],
            "file 'twice.launch.py' was found more than once in the share directory of package "
            "'arm'",
        ),
        (['arm'], "file 'None' was not found in the share directory of package 'arm'"),
        (['/some/x.launch.py'], "the launch file '/some/x.launch.py' does not exist"),
        (['arm', 'say.launch.py', 'word:='], "malformed launch argument 'word:='"),
        (
            ['arm', 'say.launch.py', '--launch-prefix-filter', 'x'],
            '--launch-prefix must be specified if --launch-prefix-filter is provided',
        ),
        (['-s', 'arm', 'broken.launch.py'], "the launch file '"),
        (['--json', 'arm', 'say.launch.py'], '--json requires --dry-run'),
    ],
)
def test_errors(words: list[str], error: str, ros2: Ros2, arm: dict[str, str]) -> None:
    """What cannot be launched is an error on stderr, before anything starts."""
    result = ros2('launch', *words, extra=arm)
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr.startswith(error)


def test_file_that_is_not_here(ros2: Ros2, arm: dict[str, str], tmp_path: Path) -> None:
    """What is named as a file is looked for as one, beside others like it."""
    (tmp_path / 'main.launch.yaml').touch()
    result = ros2('launch', 'main_launch.yaml', extra=arm)
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr.splitlines() == [
        "the launch file 'main_launch.yaml' does not exist. Did you mean 'main.launch.yaml'?",
        f"It is looked up from '{tmp_path}'.",
    ]


def test_missing_file_lists_those_that_exist(ros2: Ros2, arm: dict[str, str]) -> None:
    """The error about a missing file ends with the installed ones and the closest."""
    error = ros2('launch', 'arm', 'sai.launch.py', extra=arm).stderr
    assert 'say.launch.py, sleep.launch.py' in error
    assert "Did you mean 'say.launch.py'?" in error


def test_misspelt_argument(ros2: Ros2, arm: dict[str, str]) -> None:
    """A name that comes close to a declared one is an error; nothing is started."""
    result = ros2('launch', 'arm', 'say.launch.py', 'wrd:=1', extra=arm)
    assert result.returncode == 1 and 'process started' not in result.stdout
    assert result.stdout.splitlines()[2:] == [
        '[ERROR] [launch]: Caught exception in launch (see debug for traceback): '
        "the launch file does not declare an argument 'wrd'. Did you mean 'word'? Pass "
        "--allow-unknown-args if 'wrd' is meant, or --show-args to see the arguments"
    ]


def test_unknown_argument(ros2: Ros2, arm: dict[str, str]) -> None:
    """A name that nothing has looked up is a warning, a magic one is not."""
    words = ['arm', 'say.launch.py', 'zone:=1', 'sigterm_timeout:=1']
    result = ros2('launch', *words, extra=arm)
    warnings = [line for line in result.stdout.splitlines() if line.startswith('[WARNING]')]
    assert result.returncode == 0 and '[echo-1] said hello' in result.stdout
    assert warnings == [
        "[WARNING] [launch]: no launch file declares the argument 'zone', and nothing has looked "
        'it up; --show-args shows the arguments, --allow-unknown-args silences this'
    ]


def test_dry_run(ros2: Ros2, arm: dict[str, str]) -> None:
    """With --dry-run the tree is shown; nothing is started, and no log is written."""
    result = ros2('launch', '--dry-run', 'arm', 'say.launch.py', 'word:=a b', extra=arm)
    assert (result.returncode, result.stderr) == (0, '')
    assert "  argv: echo said 'a b'" in result.stdout and 'process started' not in result.stdout
    assert not Path(arm['ROS_LOG_DIR']).exists()


def test_dry_run_as_json(ros2: Ros2, arm: dict[str, str]) -> None:
    """With --json the standard output is data, whatever else is said."""
    words = ['--dry-run', '--json', 'arm', 'say.launch.py', 'zone:=1']
    result = ros2('launch', *words, extra=arm)
    data = json.loads(result.stdout)
    assert data['status'] == 0 and 'the argument' in result.stderr
    assert data['actions'][0]['actions'][-1]['argv'] == ['echo', 'said', 'hello']


def test_json_of_a_noisy_file(ros2: Ros2, arm: dict[str, str]) -> None:
    """What a launch file and its programs write to the standard output is no part of the data."""
    noise = "import os\nprint('printed')\nos.system('echo from a program')\n"
    Path('noisy.launch.py').write_text(noise + LAUNCH_FILE)
    result = ros2('launch', '--dry-run', '--json', 'noisy.launch.py', extra=arm)
    assert json.loads(result.stdout)['status'] == 0
    assert 'printed' in result.stderr and 'from a program' in result.stderr


def test_path_of_no_file(ros2: Ros2, arm: dict[str, str]) -> None:
    """A folder, a link that leads nowhere and a pipe are called what they are."""
    Path('folder.launch.py').mkdir()
    Path('link.launch.py').symlink_to('/nope')
    os.mkfifo('pipe.launch.py')
    errors = [
        ros2('launch', f'./{name}.launch.py', extra=arm).stderr
        for name in ('folder', 'link', 'pipe')
    ]
    assert errors == [
        "the launch file './folder.launch.py' is a folder\n",
        "the launch file './link.launch.py' is a broken symbolic link to '/nope'\n",
        "the launch file './pipe.launch.py' is not a regular file\n",
    ]


def test_launch_file_that_closes_the_output(ros2: Ros2, arm: dict[str, str]) -> None:
    """A launch file that closes the standard output causes no traceback."""
    Path('closes.launch.py').write_text('import sys\nsys.stdout.close()\n' + LAUNCH_FILE)
    result = ros2('launch', 'closes.launch.py', extra=arm)
    assert (result.returncode, result.stderr) == (0, '')


def test_dry_run_of_what_fails(ros2: Ros2, arm: dict[str, str]) -> None:
    """A dry run ends with the errors and the status of a real one."""
    result = ros2('launch', '--dry-run', 'arm', 'broken.launch.py', extra=arm)
    assert result.returncode == 1
    assert result.stdout.startswith('[ERROR] [launch]: Caught exception in launch ')
    assert "No module named 'nope_nope'" in result.stdout


def test_print_description(ros2: Ros2, arm: dict[str, str]) -> None:
    """With -p the description is shown as a tree, without running it."""
    result = ros2('launch', '-p', 'arm', 'say.launch.py', extra=arm)
    assert result.returncode == 0
    assert result.stdout.splitlines()[1] == '    DeclareLaunchArgument(name=word)'
    assert ros2('launch', '-p', '-s', 'arm', 'say.launch.py', extra=arm).returncode == 2


def test_no_preflight(ros2: Ros2, arm: dict[str, str], tmp_path: Path) -> None:
    """With --no-preflight the programs that are there are started."""
    path = tmp_path / 'half.launch.py'
    path.write_text(
        LAUNCH_FILE.replace(
            '        ExecuteProcess(',
            "        ExecuteProcess(cmd=['no_such_one']),\n        ExecuteProcess(",
        )
    )
    assert 'process started' not in ros2('launch', str(path), extra=arm).stdout
    result = ros2('launch', '--no-preflight', str(path), extra=arm)
    assert 'said hello' in result.stdout and result.returncode == 0
    assert "the program 'no_such_one' was not found on the PATH" in result.stdout


def test_strict_exit(ros2: Ros2, arm: dict[str, str], tmp_path: Path) -> None:
    """With --strict-exit the first process that failed gives the status."""
    path = tmp_path / 'fail.launch.py'
    path.write_text(
        LAUNCH_FILE.replace("['echo', 'said', LaunchConfiguration('word')]", "['sh', '-c', WHAT]")
        + "\n\nWHAT = 'exit 3'\n"
    )
    assert ros2('launch', str(path), extra=arm).returncode == 0
    assert ros2('launch', '--strict-exit', str(path), extra=arm).returncode == 3
    path.write_text(path.read_text().replace('exit 3', 'kill -9 $$'))
    assert ros2('launch', '--strict-exit', str(path), extra=arm).returncode == 137


def test_undeclared_arguments_can_be_allowed(ros2: Ros2, arm: dict[str, str]) -> None:
    """A name that looks misspelt is accepted on demand."""
    words = ['--allow-unknown-args', 'arm', 'say.launch.py', 'wrd:=1']
    assert ros2('launch', *words, extra=arm).returncode == 0


@pytest.mark.parametrize('sent', [signal.SIGINT, signal.SIGTERM])
def test_signal_ends_all(sent: signal.Signals, start_ros2: Start, arm: dict[str, str]) -> None:
    """A signal ends the launch and its children; the status is 0."""
    process = start_ros2('launch', 'arm', 'sleep.launch.py', extra=arm)
    line = ''
    while '] pid ' not in line:
        line = process.stdout.readline()
        assert line
    child = int(line.split()[-1])
    process.send_signal(sent)
    output, errors = process.communicate(timeout=100)
    assert (process.returncode, errors) == (0, ''), output
    with pytest.raises(ProcessLookupError):
        os.kill(child, 0)
