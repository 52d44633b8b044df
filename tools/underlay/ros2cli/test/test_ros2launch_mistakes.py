# SPDX-License-Identifier: Apache-2.0
"""The mistakes that people make in launch files, and what `ros2 launch` says to each."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any, NamedTuple

import pytest

Ros2 = Callable[..., CompletedProcess[str]]

HEAD = """\
from launch import *
from launch.actions import *
from launch.conditions import *
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.substitutions import *
def generate_launch_description():
    return LaunchDescription([
        ExecuteProcess(cmd=['echo', 'started']),
"""
LINE = 10
CAUGHT = '[ERROR] [launch]: Caught exception in launch (see debug for traceback): '
SEVERAL = CAUGHT + 'Caught multiple exceptions when trying to load file of format [py]:\n - '
FORMAT = (
    '\n - InvalidFrontendLaunchFileError: '
    'The launch file may have a syntax error, or its format is unknown'
)
TEXT = 'a string, a substitution or a list of them'


class Mistake(NamedTuple):
    """A line of a launch file, what is said to it, and the action that is named."""

    entity: str
    error: str
    action: str = ''


def _type_error(text: str) -> str:
    return f'{SEVERAL}TypeError: {text}{FORMAT}'


def _wrong(keyword: str, expected: str, value: str) -> str:
    return _type_error(f"the argument '{keyword}' must be {expected}, but it is {value}")


ONE = "5 of type 'int'"
NO_LIST = f"{ONE} ('int' object is not iterable)"

MISTAKES = {
    'package': Mistake(
        "Node(package='arn', executable='drive')",
        CAUGHT
        + "\"package 'arn' not found, searching: ['{prefix}']\"\n"
        + "It is not in any folder of AMENT_PREFIX_PATH. Did you mean 'arm'?",
        'Node',
    ),
    'executable': Mistake(
        "Node(package='arm', executable='driv')",
        CAUGHT
        + "executable 'driv' not found on the libexec directory '{prefix}/lib/arm' \n"
        + "The executables of 'arm': drive. Did you mean 'drive'?",
        'Node',
    ),
    'program': Mistake(
        "ExecuteProcess(cmd=['tuoch', 'x'])",
        CAUGHT + "the program 'tuoch' was not found on the PATH. Did you mean 'touch'?",
        'ExecuteProcess',
    ),
    'program that waits': Mistake(
        "TimerAction(period=9.0, actions=[Node(package='arm', executable='driv')])",
        CAUGHT
        + "executable 'driv' not found on the libexec directory '{prefix}/lib/arm' \n"
        + "The executables of 'arm': drive. Did you mean 'drive'?",
        'Node',
    ),
    'parameter file of all nodes': Mistake(
        "SetParametersFromFile('{prefix}/share/arm/arn.yaml')",
        CAUGHT + "the parameter file '{prefix}/share/arm/arn.yaml' does not exist. "
        "Did you mean 'arm.yaml'?",
        'SetParametersFromFile',
    ),
    'include': Mistake(
        "IncludeLaunchDescription([FindPackageShare('arm'), '/sai.launch.py'])",
        CAUGHT + "the launch file '{prefix}/share/arm/sai.launch.py' does not exist. "
        "Did you mean 'say.launch.py'?",
        'IncludeLaunchDescription',
    ),
    'folder of an include': Mistake(
        "IncludeLaunchDescription('{prefix}/shar/arm/say.launch.py')",
        CAUGHT + "the launch file '{prefix}/shar/arm/say.launch.py' does not exist: there is no "
        "folder '{prefix}/shar/arm'",
        'IncludeLaunchDescription',
    ),
    'file of a command': Mistake(
        "LogInfo(msg=Command('cat {prefix}/share/arm/arm.xacr'))",
        CAUGHT
        + 'executed command failed. Command: cat {prefix}/share/arm/arm.xacr\n'
        + 'Captured stderr output: cat: {prefix}/share/arm/arm.xacr: No such file or directory\n'
        + "the file '{prefix}/share/arm/arm.xacr' does not exist. Did you mean 'arm.xacro'?",
        'LogInfo',
    ),
    'condition': Mistake(
        "LogInfo(msg='x', condition=IfCondition('yes'))",
        CAUGHT
        + 'invalid condition expression, expected one of [true, 1, false, 0] but got '
        + "'yes', expanded from ''yes''",
        'LogInfo',
    ),
    'launch configuration': Mistake(
        "DeclareLaunchArgument('speed', default_value='1'),"
        "LogInfo(msg=LaunchConfiguration('sped'))",
        CAUGHT + "launch configuration 'sped' does not exist. Did you mean 'speed'?",
        'LogInfo',
    ),
    'expression': Mistake(
        "LogInfo(msg=PythonExpression('1 + one'))",
        CAUGHT
        + "name 'one' is not defined\nThe expression is: 1 + one\n"
        + 'A string in it needs quotes of its own, also around a substitution: '
        + """["'", LaunchConfiguration('x'), "' == 'y'"]""",
        'LogInfo',
    ),
    'required argument': Mistake(
        "DeclareLaunchArgument('must', description='so')",
        CAUGHT + "Included launch description missing required argument 'must' "
        "(description: 'so'), given: []",
    ),
    'circle': Mistake(
        "IncludeLaunchDescription('{file}')",
        CAUGHT
        + "circular include: '{file}' includes itself endlessly\n"
        + "  '{file}', line 10 includes '{file}'\n"
        + '  Remove one of these lines, or give it a condition that breaks the cycle.',
        'IncludeLaunchDescription',
    ),
    'misspelt keyword': Mistake(
        "Node(executable='true', ouput='screen')",
        _type_error("Node() got an unexpected keyword argument 'ouput'. Did you mean 'output'?"),
    ),
    'None in a list': Mistake(
        'GroupAction([None])',
        CAUGHT + "'NoneType' object has no attribute 'visit': the entities of GroupAction must be "
        'actions or launch descriptions, but one is None',
        'GroupAction',
    ),
    'Node package': Mistake("Node(package=5, executable='x')", _wrong('package', TEXT, NO_LIST)),
    'Node executable': Mistake('Node(executable=5)', _wrong('executable', TEXT, NO_LIST)),
    'Node name': Mistake("Node(executable='x', name=5)", _wrong('name', TEXT, NO_LIST)),
    'Node namespace': Mistake(
        "Node(executable='x', namespace=5)", _wrong('namespace', TEXT, NO_LIST)
    ),
    'Node parameters': Mistake(
        "Node(executable='x', parameters={'a': 1})",
        _type_error(
            "the parameters of a node must be a list of dictionaries and files, but got {'a': 1} "
            "of type 'dict'; put it in square brackets"
        ),
    ),
    'Node remappings': Mistake(
        "Node(executable='x', remappings=[['a', 'b']])",
        _type_error(
            "a remapping must be a tuple such as ('from', 'to'), but got ['a', 'b'] of type 'list'"
        ),
    ),
    'Node arguments': Mistake(
        "Node(executable='x', arguments='-d x')",
        _type_error(
            "the argument 'arguments' must be a list, but it is the string '-d x'; write "
            "arguments=['-d', 'x']"
        ),
    ),
    'item of arguments': Mistake(
        "Node(executable='x', arguments=[5])", _wrong('arguments', TEXT, NO_LIST)
    ),
    'cmd': Mistake(
        "ExecuteProcess(cmd='ls -l')", _wrong('cmd', 'a list of words', "'ls -l' of type 'str'")
    ),
    'output': Mistake("ExecuteProcess(cmd=['x'], output=5)", _wrong('output', TEXT, NO_LIST)),
    'cwd': Mistake("ExecuteProcess(cmd=['x'], cwd=5)", _wrong('cwd', TEXT, NO_LIST)),
    'env': Mistake("ExecuteProcess(cmd=['x'], env=5)", _wrong('env', 'a dictionary', ONE)),
    'value of env': Mistake(
        "ExecuteProcess(cmd=['x'], additional_env={'A': 5})",
        _wrong("additional_env['A']", TEXT, NO_LIST),
    ),
    'shell': Mistake(
        "ExecuteProcess(cmd=['x'], shell='no')",
        _wrong('shell', 'True or False', "'no' of type 'str'"),
    ),
    'respawn': Mistake(
        "ExecuteProcess(cmd=['x'], respawn=5)",
        _wrong('respawn', 'a bool or a substitution', ONE),
    ),
    'respawn_delay': Mistake(
        "ExecuteProcess(cmd=['x'], respawn_delay='5')",
        _wrong('respawn_delay', 'a number of seconds', "'5' of type 'str'"),
    ),
    'on_exit': Mistake(
        "ExecuteProcess(cmd=['x'], on_exit=['x'])",
        _wrong('on_exit', 'a list of actions', "'x' of type 'str'"),
    ),
    'condition keyword': Mistake(
        "LogInfo(msg='x', condition='true')",
        _wrong('condition', 'a condition such as IfCondition(...)', "'true' of type 'str'"),
    ),
    'include source': Mistake(
        'IncludeLaunchDescription(5)', _wrong('launch_description_source', TEXT, NO_LIST)
    ),
    'launch_arguments': Mistake(
        "IncludeLaunchDescription('x', launch_arguments={'a': 'b'})",
        _type_error(
            "the argument 'launch_arguments' must be a list of pairs, but it is a dictionary: "
            'append .items() to it'
        ),
    ),
    'declared name': Mistake('DeclareLaunchArgument(5)', _wrong('name', 'a string', ONE)),
    'default_value': Mistake(
        "DeclareLaunchArgument('a', default_value=True)",
        _wrong('default_value', TEXT, "True of type 'bool' ('bool' object is not iterable)"),
    ),
    'description': Mistake(
        "DeclareLaunchArgument('a', description=5)", _wrong('description', 'a string', ONE)
    ),
    'choices': Mistake(
        "DeclareLaunchArgument('a', choices=5)", _wrong('choices', 'a list of strings', ONE)
    ),
    'group': Mistake('GroupAction(5)', _wrong('actions', 'a list of actions', ONE)),
    'timer period': Mistake(
        'TimerAction(period=5, actions=[])',
        _type_error(
            'the period of a TimerAction must be a float or a substitution, but it is the int 5: '
            'write 5.0 instead'
        ),
    ),
    'timer actions': Mistake(
        'TimerAction(period=5.0, actions=5)', _wrong('actions', 'a list of actions', ONE)
    ),
}


@pytest.fixture
def arm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, str]:
    """Install a package and return the environment that finds it."""
    for name in (
        'share/ament_index/resource_index/packages/arm',
        'share/arm/arm.yaml',
        'share/arm/arm.xacro',
        'share/arm/say.launch.py',
        'lib/arm/drive',
    ):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text('#!/bin/sh\n')
        path.chmod(0o755)
    monkeypatch.chdir(tmp_path)
    return {
        'AMENT_PREFIX_PATH': str(tmp_path),
        'COLCON_PREFIX_PATH': '',
        'ROS_LOG_DIR': str(tmp_path / 'log'),
    }


def _launch(ros2: Ros2, arm: dict[str, str], text: str, *words: str) -> Any:
    """Return the lines behind the first two, of a launch that fails before anything starts."""
    path = Path(arm['AMENT_PREFIX_PATH']) / 'it.launch.py'
    path.write_text(text)
    result = ros2('launch', str(path), *words, extra=arm)
    lines = result.stdout.splitlines()
    assert lines[0].startswith('[INFO] [launch]: All log files can be found below ')
    assert (result.returncode, result.stderr) == (1, '')
    assert 'process started' not in result.stdout
    return '\n'.join(lines[2:])


@pytest.mark.parametrize('name', MISTAKES)
def test_mistake(name: str, ros2: Ros2, arm: dict[str, str]) -> None:
    """One error that says what is wrong, with file and line; status 1, nothing is started."""
    mistake, prefix = MISTAKES[name], arm['AMENT_PREFIX_PATH']
    file = f'{prefix}/it.launch.py'
    entity, error = (
        each.replace('{prefix}', prefix).replace('{file}', file)
        for each in (mistake.entity, mistake.error)
    )
    text = _launch(ros2, arm, f'{HEAD}        {entity},\n    ])\n')
    action = f' ({mistake.action})' if mistake.action else ''
    assert text.startswith(error + '\n')
    places = text.replace(error + '\n', '', 1).splitlines()
    assert places[0] == f"[ERROR] [launch]: It comes from '{file}', line {LINE}{action}"


@pytest.mark.parametrize(
    'text, error, line',
    [
        (
            'def generate_launch_description(:\n',
            SEVERAL + 'SyntaxError: ',
            ', line 1',
        ),
        (
            'import os\n',
            SEVERAL + "InvalidPythonLaunchFileError: launch file at '{file}' does not contain the "
            "required function 'generate_launch_description()'" + FORMAT + '\n',
            '',
        ),
        (
            '\nimport nope_nope\n',
            SEVERAL + "ModuleNotFoundError: No module named 'nope_nope'" + FORMAT + '\n',
            ', line 2',
        ),
        (
            'from launch.actions import Node\n',
            SEVERAL + "ImportError: cannot import name 'Node' from 'launch.actions'",
            ', line 1',
        ),
        (
            'def generate_launch_description():\n    pass\n',
            SEVERAL + "AttributeError: 'NoneType' object has no attribute 'visit': the function "
            "generate_launch_description() of '{file}' must return a LaunchDescription",
            '',
        ),
        (
            'from launch import *\nfrom launch.actions import *\ndef fail(context):\n'
            "    int('x')\ndef generate_launch_description():\n"
            '    return LaunchDescription([OpaqueFunction(function=fail)])\n',
            CAUGHT + "invalid literal for int() with base 10: 'x'\n",
            ', line 4 (OpaqueFunction)',
        ),
    ],
)
def test_mistake_in_python(
    text: str, error: str, line: str, ros2: Ros2, arm: dict[str, str]
) -> None:
    """A file that is no launch file is an error with the line, as far as there is one."""
    file = f'{arm["AMENT_PREFIX_PATH"]}/it.launch.py'
    found = _launch(ros2, arm, text)
    assert found.startswith(error.replace('{file}', file))
    assert found.splitlines()[-1] == f"[ERROR] [launch]: It comes from '{file}'{line}"


def test_misspelt_required_argument(ros2: Ros2, arm: dict[str, str]) -> None:
    """When a required argument is missing because its name was misspelt, that is said, too."""
    text = f"{HEAD}        DeclareLaunchArgument('speed'),\n    ])\n"
    found = _launch(ros2, arm, text, 'sped:=1')
    assert "missing required argument 'speed'" in found
    assert "does not declare an argument 'sped'. Did you mean 'speed'?" in found


def test_missing_parameter_file(ros2: Ros2, arm: dict[str, str]) -> None:
    """A parameter file of one node that does not exist is no error, but two warnings."""
    path = Path(arm['AMENT_PREFIX_PATH']) / 'it.launch.py'
    entity = f"Node(executable='true', parameters=['{path.parent}/share/arm/arn.yaml'])"
    path.write_text(f'{HEAD}        {entity},\n    ])\n')
    result = ros2('launch', str(path), extra=arm)
    start = '[WARNING] [launch_ros.actions.node]: '
    file = f'{path.parent}/share/arm/arn.yaml'
    assert result.returncode == 0
    assert result.stdout.splitlines()[2:4] == [
        f'{start}Parameter file path is not a file: {file}',
        f"{start}The node gets no parameters from it, because the file '{file}' does not exist. "
        "Did you mean 'arm.yaml'?",
    ]
