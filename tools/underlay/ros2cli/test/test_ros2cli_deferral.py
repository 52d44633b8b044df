# SPDX-License-Identifier: Apache-2.0
"""Tests of packages of interfaces of which only what is used is imported."""

from pathlib import Path
import subprocess
import sys

import pytest

LAZY = (
    'from ros2cli.deferral import import_interfaces_when_used\n'
    'import_interfaces_when_used()\nimport sys\n'
)


def run(code: str, environment: dict[str, str]) -> str:
    """Return what some code prints in a process of its own; an error fails the test."""
    result = subprocess.run(
        [sys.executable, '-c', LAZY + code], env=environment, capture_output=True, text=True
    )
    assert (result.returncode, result.stderr) == (0, '')
    return result.stdout


@pytest.mark.parametrize('kind', ['msg.String', 'srv.Trigger', 'action.LookupTransform'])
def test_an_interface_is_the_same_one(
    kind: str, ros_environment_variables: dict[str, str]
) -> None:
    """The class is that of its module, from both places."""
    folder, name = kind.split('.')
    package = {'msg': 'std_msgs', 'srv': 'std_srvs', 'action': 'tf2_msgs'}[folder]
    code = (
        f'from {package}.{folder} import {name}\nimport {package}.{folder}\n'
        f'assert {package}.{folder}.{name} is {name}\n'
        f'print({name}.__module__, {name!r} in dir({package}.{folder}))\n'
    )
    module, is_listed = run(code, ros_environment_variables).split()
    assert module.startswith(f'{package}.{folder}._')
    assert is_listed == 'True'


def test_others_are_not_imported(ros_environment_variables: dict[str, str]) -> None:
    """Of a package of thirty messages one is loaded."""
    code = (
        'from std_msgs.msg import String\n'
        "print(*[name for name in sys.modules if name.startswith('std_msgs.msg._')])\n"
    )
    assert run(code, ros_environment_variables) == 'std_msgs.msg._string\n'


def test_all_can_be_imported(ros_environment_variables: dict[str, str]) -> None:
    """A star takes all, and what does not exist is an error as usual."""
    code = (
        'from std_msgs.msg import *\nprint(Header.__name__, Float64.__name__)\n'
        'try:\n    from std_msgs.msg import Strin\n'
        'except ImportError as error:\n    print(error.name)\n'
    )
    assert run(code, ros_environment_variables).split() == ['Header', 'Float64', 'std_msgs.msg']


def test_other_packages_are_left_alone(
    ros_environment_variables: dict[str, str], tmp_path: Path
) -> None:
    """A package named msg that does more than to import is executed as it stands."""
    folder = tmp_path / 'mail' / 'msg'
    folder.mkdir(parents=True)
    (folder.parent / '__init__.py').touch()
    (folder / '__init__.py').write_text("from os import sep\nTEXT = 'read'\n")
    path = f'{tmp_path}:{ros_environment_variables["PYTHONPATH"]}'
    variables = {**ros_environment_variables, 'PYTHONPATH': path}
    assert run('import mail.msg\nprint(mail.msg.TEXT)\n', variables) == 'read\n'
