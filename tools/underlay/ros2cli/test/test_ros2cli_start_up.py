# SPDX-License-Identifier: Apache-2.0
"""Tests of how the interpreter of a command starts and ends."""

from pathlib import Path
import subprocess
import sys

import pytest

END = 'from ros2cli.start_up import end\n'


def run(code: str, environment: dict[str, str]) -> subprocess.CompletedProcess[str]:
    """Run Python code in a process of its own."""
    return subprocess.run(
        [sys.executable, '-c', code], env=environment, capture_output=True, text=True
    )


@pytest.fixture
def variables(ros_environment_variables: dict[str, str]) -> dict[str, str]:
    """Return the environment of a shell, in which Python holds its output back."""
    return {k: v for k, v in ros_environment_variables.items() if k != 'PYTHONUNBUFFERED'}


def test_a_package_with_the_name_of_a_standard_module_does_no_harm(
    variables: dict[str, str], tmp_path: Path
) -> None:
    """The folders of PYTHONPATH come behind the standard library."""
    (tmp_path / 'argparse.py').write_text("raise RuntimeError('not the one of Python')\n")
    path = f'{tmp_path}:{variables["PYTHONPATH"]}'
    result = subprocess.run(
        ['ros2', 'pkg', 'list'],
        env={**variables, 'PYTHONPATH': path},
        capture_output=True,
        text=True,
    )
    assert (result.returncode, result.stderr) == (0, '')
    assert 'rclpy' in result.stdout.split()


def test_order_of_other_folders_is_kept(variables: dict[str, str], tmp_path: Path) -> None:
    """An overlay still comes before what it lies over."""
    folders = [str(tmp_path / name) for name in ('overlay', 'underlay')]
    code = (
        'import sys\nfrom ros2cli.start_up import prepare\nbefore = list(sys.path)\nprepare()\n'
        'assert sorted(before) == sorted(sys.path), (before, sys.path)\n'
        "print(*[path for path in sys.path if path.endswith('erlay')], sep='\\n')"
    )
    path = ':'.join([*folders, variables['PYTHONPATH']])
    result = run(code, {**variables, 'PYTHONPATH': path})
    assert (result.stdout.split(), result.stderr) == (folders, '')


def test_what_is_to_happen_at_the_end_does(variables: dict[str, str]) -> None:
    """Functions of atexit are called, output is written, and the status is kept."""
    code = f"import atexit\n{END}atexit.register(print, 'last')\nprint('first')\nend(3)\n"
    result = run(code, variables)
    assert (result.returncode, result.stdout) == (3, 'first\nlast\n')


def test_threads_are_waited_for(variables: dict[str, str]) -> None:
    """A thread that is still at work ends before the process does."""
    code = (
        f'import threading\n{END}going = threading.Event()\n'
        "def work():\n    going.wait(0.2)\n    print('done')\n"
        'threading.Thread(target=work).start()\nend(0)\n'
    )
    result = run(code, variables)
    assert (result.returncode, result.stdout) == (0, 'done\n')


def test_closed_streams_are_no_error(variables: dict[str, str]) -> None:
    """A command may have closed its output."""
    result = run(f'import sys\n{END}sys.stdout.close()\nend(0)\n', variables)
    assert (result.returncode, result.stderr) == (0, '')
