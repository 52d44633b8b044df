# SPDX-License-Identifier: Apache-2.0
"""The conditions."""

from __future__ import annotations

from typing import Optional

from launch import Condition, LaunchContext
from launch.actions import SetLaunchConfiguration
from launch.conditions import (
    IfCondition,
    LaunchConfigurationEquals,
    LaunchConfigurationNotEquals,
    UnlessCondition,
)
from launch.substitutions import LaunchConfiguration
import pytest


@pytest.mark.parametrize(
    'text, value', [('true', True), (' TRUE ', True), ('1', True), ('False', False), ('0', False)]
)
def test_if_and_unless(context: LaunchContext, text: str, value: bool) -> None:
    """Four words are understood, in any case."""
    assert IfCondition(text).evaluate(context) is value
    assert UnlessCondition([text]).evaluate(context) is not value


@pytest.mark.parametrize('text', ['', 'yes', 'None', '2'])
def test_other_words(context: LaunchContext, text: str) -> None:
    """Anything else is an error that tells what it was and where it comes from."""
    context.launch_configurations['x'] = text
    with pytest.raises(
        Exception,
        match=(
            rf"one of \[true, 1, false, 0\] but got '{text.lower()}', expanded from "
            r"'LaunchConfig\('x'\)'"
        ),
    ):
        IfCondition(LaunchConfiguration('x')).evaluate(context)


def test_argument_must_be_like_a_text() -> None:
    """A truth value of Python is refused at once."""
    with pytest.raises(TypeError, match='predicate_expression'):
        IfCondition(True)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    'current, expected, equal',
    [
        ('a', 'a', True),
        ('a', 'b', False),
        (None, 'a', False),
        (None, None, True),
        ('a', None, False),
    ],
)
@pytest.mark.filterwarnings('ignore:LaunchConfiguration.*deprecated')
def test_launch_configuration_equals(
    context: LaunchContext,
    current: Optional[str],
    expected: Optional[str],
    equal: bool,
) -> None:
    """None stands for a launch configuration that is not set."""
    if current is not None:
        context.launch_configurations['x'] = current
    assert LaunchConfigurationEquals('x', expected).evaluate(context) is equal
    assert LaunchConfigurationNotEquals('x', expected).evaluate(context) is not equal


def test_deprecation() -> None:
    """The older conditions warn, with the line that uses them."""
    with pytest.warns(UserWarning, match='EqualsSubstitution') as found:
        LaunchConfigurationEquals('x', 'y')
    assert found[0].filename == __file__


def test_own_condition(context: LaunchContext) -> None:
    """A predicate gets the context; without one the condition is never fulfilled."""
    assert Condition(predicate=lambda c: c is context).evaluate(context)
    assert not Condition().evaluate(context)


def test_condition_of_an_action(context: LaunchContext) -> None:
    """An action is executed only if its condition is fulfilled when it is visited."""
    action = SetLaunchConfiguration('y', 'set', condition=IfCondition(LaunchConfiguration('x')))
    context.launch_configurations['x'] = 'false'
    action.visit(context)
    assert 'y' not in context.launch_configurations
    context.launch_configurations['x'] = 'true'
    action.visit(context)
    assert context.launch_configurations['y'] == 'set'
