# SPDX-License-Identifier: Apache-2.0
"""What holds for all nodes in a scope."""

from __future__ import annotations

from collections.abc import Callable
import os
from pathlib import Path
from typing import Any

from launch import LaunchContext
from launch.actions import GroupAction
from launch.substitutions import LaunchConfiguration, SubstitutionFailure, TextSubstitution
from launch_ros.actions import (
    PushRosNamespace,
    SetParameter,
    SetParametersFromFile,
    SetRemap,
    SetROSLogDir,
    SetUseSimTime,
)
from launch_ros.substitutions import Parameter
import pytest

Words = Callable[..., list[str]]


def test_nothing_leaks_from_a_group(words: Words) -> None:
    """What is set in a group ends with it, also if something was set before."""
    found = words(
        SetParameter('a', 1),
        SetRemap('x', 'y'),
        GroupAction([PushRosNamespace('ns'), SetParameter('b', 2), SetRemap('z', 'w')]),
    )
    assert found == ['--ros-args', '-p', 'a:=1', '-r', 'x:=y']


@pytest.mark.parametrize(
    'value, text',
    [
        (True, 'True'),
        (2.5, '2.5'),
        ('text', 'text'),
        ([1, 2], '[1, 2]'),
        (TextSubstitution(text='true'), 'True'),
        (TextSubstitution(text='5'), '5'),
    ],
)
def test_values_on_the_command_line(words: Words, value: Any, text: str) -> None:
    """Values are written so that ROS reads them."""
    assert words(SetParameter('a', value)) == ['--ros-args', '-p', f'a:={text}']


def test_parameters_and_files_keep_their_order(words: Words, tmp_path: Path) -> None:
    """What is set later comes later."""
    path = tmp_path / 'p.yaml'
    path.touch()
    found = words(
        SetParameter(name='a', value=1),
        SetParametersFromFile([str(path)]),
        SetParameter(LaunchConfiguration('n', default='b'), 2),
    )
    assert found == ['--ros-args', '-p', 'a:=1', '--params-file', str(path), '-p', 'b:=2']


def test_missing_file(context: LaunchContext) -> None:
    """A file that is set for all nodes must be there."""
    with pytest.raises(FileNotFoundError, match="'/no.yaml' does not exist"):
        SetParametersFromFile('/no.yaml').visit(context)


def test_invalid_namespace(context: LaunchContext) -> None:
    """The error tells both namespaces and what is wrong."""
    context.launch_configurations['ros_namespace'] = '/a'
    with pytest.raises(
        RuntimeError,
        match=(
            r"invalid: \[previous_namespace='/a', pushed_namespace='1bad'\]. [^.]*number:\n"
            r"  '/a/1bad'\n"
        ),
    ):
        PushRosNamespace('1bad').visit(context)


def test_parameter_substitution(context: LaunchContext) -> None:
    """A parameter that is set for all nodes can be used as a text."""
    SetParameter('a', 1).visit(context)
    assert Parameter('a').perform(context) == '1'
    assert Parameter('b', default='x').perform(context) == 'x'
    with pytest.raises(SubstitutionFailure, match="parameter 'b' not found"):
        Parameter('b').perform(context)


def test_log_folder(context: LaunchContext) -> None:
    """A relative path adds to the folder of now."""
    os.environ['ROS_LOG_DIR'] = '/a'
    SetROSLogDir('b').visit(context)
    assert os.environ['ROS_LOG_DIR'] == '/a/b'
    SetROSLogDir('/c').visit(context)
    assert os.environ['ROS_LOG_DIR'] == '/c'


@pytest.mark.parametrize('value', [True, False, 'yes'])
def test_clock_of_the_launch(context: LaunchContext, words: Words, value: Any) -> None:
    """The clock of the launch itself does not concern the nodes."""
    assert words(SetUseSimTime(value)) == ['--ros-args']
    assert context.locals.launch_use_sim_time is (value is not False)
