# SPDX-License-Identifier: Apache-2.0
"""Launch arguments, and scopes of launch configurations."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from launch import LaunchContext, LaunchDescription
from launch.actions import (
    DeclareLaunchArgument,
    GroupAction,
    LogInfo,
    OpaqueFunction,
    SetEnvironmentVariable,
    SetLaunchConfiguration,
    TimerAction,
)
from launch.conditions import IfCondition
from launch.substitutions import EnvironmentVariable, LaunchConfiguration
import pytest


def test_default_and_given_value(context: LaunchContext) -> None:
    """The default is used, and evaluated, only if there is no value yet."""
    default = LaunchConfiguration('missing')
    context.launch_configurations['given'] = 'x'
    DeclareLaunchArgument('given', default_value=default).visit(context)
    other = DeclareLaunchArgument('other', default_value=['a', LaunchConfiguration('given')])
    other.visit(context)
    assert context.launch_configurations == {'given': 'x', 'other': 'ax'}


def test_required_argument(context: LaunchContext) -> None:
    """An argument without a default must be given."""
    with pytest.raises(
        RuntimeError,
        match=(r'Required launch argument "robot" \(description: "which"\) was not provided'),
    ):
        DeclareLaunchArgument('robot', description='which').visit(context)


@pytest.mark.parametrize('choices', [['a', 'b'], ('a', 'b')])
def test_choices(context: LaunchContext, choices: Any) -> None:
    """A value must be one of the choices."""
    argument = DeclareLaunchArgument('x', default_value='a', choices=choices)
    argument.visit(context)
    context.launch_configurations['x'] = 'c'
    with pytest.raises(
        RuntimeError, match=('Argument "x" provided value "c" is not valid. Valid options are: ')
    ):
        argument.visit(context)


def test_a_choice_that_was_meant(context: LaunchContext) -> None:
    """A value that is nearly one of the choices is refused with the one that was meant."""
    context.launch_configurations['scene'] = 'rom'
    with pytest.raises(RuntimeError, match="'room'\\]. Did you mean 'room'\\?$"):
        DeclareLaunchArgument('scene', choices=['flat', 'room']).visit(context)


def test_wrong_choices() -> None:
    """Choices must not be empty, and a plain default must be among them."""
    with pytest.raises(RuntimeError, match='empty list of choices'):
        DeclareLaunchArgument('x', choices=[])
    with pytest.raises(
        RuntimeError,
        match=(r'''Provided default_value "z" is not in provided choices "\['a'\]"'''),
    ):
        DeclareLaunchArgument('x', default_value='z', choices=['a'])


@pytest.mark.parametrize(
    'description, choices, text',
    [
        (None, None, 'no description given'),
        ('which', None, 'which'),
        (None, ['a'], "One of: ['a']"),
        ('which', ['a'], "which. Valid choices are: ['a']"),
        ('which.', ('a',), "which. Valid choices are: ('a',)"),
    ],
)
def test_description(description: Any, choices: Any, text: str) -> None:
    """The choices are part of the description."""
    argument = DeclareLaunchArgument('x', description=description, choices=choices)
    assert argument.description == text


def test_discovery() -> None:
    """Arguments are found in groups, once each; those under a condition are marked."""
    on = IfCondition('true')
    description = LaunchDescription(
        [
            DeclareLaunchArgument('a'),
            DeclareLaunchArgument('b', condition=on),
            GroupAction([DeclareLaunchArgument('a'), DeclareLaunchArgument('c')]),
            GroupAction(
                [DeclareLaunchArgument('d'), GroupAction([DeclareLaunchArgument('e')])],
                condition=on,
            ),
            TimerAction(period=1.0, actions=[DeclareLaunchArgument('f')]),
            GroupAction([DeclareLaunchArgument('hidden')], forwarding=False),
            OpaqueFunction(function=lambda context: [DeclareLaunchArgument('opaque')]),
        ]
    )
    found = [
        (argument.name, argument.is_conditional) for argument in description.get_launch_arguments()
    ]
    assert found == [
        ('a', False),
        ('b', True),
        ('c', False),
        ('d', True),
        ('e', False),
        ('f', True),
    ]


def _note(into: list[str]) -> OpaqueFunction:
    """Return an action that notes two launch configurations and an environment variable."""
    parts = [
        LaunchConfiguration('x', default='-'),
        LaunchConfiguration('y', default='-'),
        EnvironmentVariable('LAUNCH_TEST', default_value='-'),
    ]
    return OpaqueFunction(
        function=lambda context: into.append(''.join(part.perform(context) for part in parts))
    )


def test_scoped_group(run: Callable[..., Any]) -> None:
    """A scope restores launch configurations and the environment."""
    seen: list[str] = []
    run(
        SetLaunchConfiguration('x', '1'),
        GroupAction(
            [
                SetLaunchConfiguration('x', '2'),
                SetEnvironmentVariable('LAUNCH_TEST', 'e'),
                _note(seen),
            ],
            launch_configurations={'y': '3'},
        ),
        _note(seen),
    )
    assert seen == ['23e', '1--']


def test_unscoped_group(run: Callable[..., Any]) -> None:
    """Without a scope everything stays."""
    seen: list[str] = []
    run(
        GroupAction(
            [SetEnvironmentVariable('LAUNCH_TEST', 'e')],
            scoped=False,
            launch_configurations={'y': '3'},
        ),
        _note(seen),
    )
    assert seen == ['-3e']


def test_group_without_forwarding(run: Callable[..., Any]) -> None:
    """Only what is given gets in; it is evaluated outside."""
    seen: list[str] = []
    run(
        SetLaunchConfiguration('x', '1'),
        SetEnvironmentVariable('LAUNCH_TEST', 'e'),
        GroupAction(
            [_note(seen)], forwarding=False, launch_configurations={'y': LaunchConfiguration('x')}
        ),
        _note(seen),
    )
    assert seen == ['-1-', '1-e']


def test_group_under_a_condition(run: Callable[..., Any]) -> None:
    """A condition that is not fulfilled leaves out everything."""
    result = run(GroupAction([LogInfo(msg='inside')], condition=IfCondition('false')))
    assert result.lines == []
