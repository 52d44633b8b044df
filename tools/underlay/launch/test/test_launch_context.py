# SPDX-License-Identifier: Apache-2.0
"""The launch context."""

from __future__ import annotations

import os

from launch import Event, EventHandler, LaunchContext
from launch.actions import (
    AppendEnvironmentVariable,
    PopEnvironment,
    PopLaunchConfigurations,
    ResetEnvironment,
    ResetLaunchConfigurations,
    SetEnvironmentVariable,
    UnsetEnvironmentVariable,
    UnsetLaunchConfiguration,
)
import pytest


def test_environment_is_that_of_the_process(context: LaunchContext) -> None:
    """A variable that is set can be read from os.environ."""
    SetEnvironmentVariable('LAUNCH_TEST', 'x').visit(context)
    assert os.environ['LAUNCH_TEST'] == 'x'
    UnsetEnvironmentVariable('LAUNCH_TEST').visit(context)
    assert 'LAUNCH_TEST' not in os.environ


def test_append_to_the_environment(context: LaunchContext) -> None:
    """A value comes behind or before the others; the first one stands alone."""
    AppendEnvironmentVariable('LAUNCH_TEST', 'b').visit(context)
    AppendEnvironmentVariable('LAUNCH_TEST', 'c').visit(context)
    AppendEnvironmentVariable('LAUNCH_TEST', 'a', prepend=True, separator=';').visit(context)
    assert os.environ['LAUNCH_TEST'] == 'a;b:c'


def test_prepend_may_be_a_text(context: LaunchContext) -> None:
    """A text is read as a truth value by YAML rules."""
    os.environ['LAUNCH_TEST'] = 'b'
    AppendEnvironmentVariable('LAUNCH_TEST', 'a', prepend='yes').visit(context)
    assert os.environ['LAUNCH_TEST'] == 'a:b'


def test_scope_of_the_environment(context: LaunchContext) -> None:
    """A pop restores what was changed, added and removed."""
    os.environ.update(LAUNCH_KEPT='1', LAUNCH_GONE='1')
    context._push_environment()
    os.environ.update(LAUNCH_KEPT='2', LAUNCH_NEW='1')
    del os.environ['LAUNCH_GONE']
    context._pop_environment()
    found = [os.environ.get(f'LAUNCH_{name}') for name in ('KEPT', 'GONE', 'NEW')]
    assert found == ['1', '1', None]


def test_reset_of_the_environment() -> None:
    """A reset goes back to when the context was made."""
    os.environ['LAUNCH_TEST'] = 'first'
    context = LaunchContext()
    os.environ['LAUNCH_TEST'] = 'second'
    ResetEnvironment().visit(context)
    assert os.environ['LAUNCH_TEST'] == 'first'


@pytest.mark.parametrize('action', [PopEnvironment(), PopLaunchConfigurations()])
def test_pop_without_push(context: LaunchContext, action: PopEnvironment) -> None:
    """There must be something to restore."""
    with pytest.raises(RuntimeError, match='cannot pop'):
        action.visit(context)


def test_reset_of_launch_configurations(context: LaunchContext) -> None:
    """Values to keep are evaluated before the others are removed."""
    from launch.substitutions import LaunchConfiguration

    context.launch_configurations.update(a='1', b='2')
    ResetLaunchConfigurations({'c': [LaunchConfiguration('a'), 'x']}).visit(context)
    assert context.launch_configurations == {'c': '1x'}


def test_unset_of_what_is_not_set(context: LaunchContext) -> None:
    """Removing a launch configuration that is not set is no error."""
    context.launch_configurations['a'] = '1'
    UnsetLaunchConfiguration('a').visit(context)
    UnsetLaunchConfiguration('a').visit(context)
    assert context.launch_configurations == {}


def test_locals(context: LaunchContext) -> None:
    """Locals are attributes which last until the pop; globals stay."""
    context.run.locals.push()
    context.extend_locals({'a': 1})
    context.extend_globals({'b': 2})
    assert (context.locals.a, context.locals.b) == (1, 2)
    context.run.locals.pop()
    assert context.get_locals_as_dict() == {'b': 2}
    with pytest.raises(AttributeError, match="'a'; the available ones are: 'b'"):
        _ = context.locals.a
    with pytest.raises(AttributeError, match='extend_locals'):
        context.locals.b = 3


def test_handlers_are_prepended(context: LaunchContext) -> None:
    """The newest handler is the first, unless it is appended."""
    first, second, third = (EventHandler(matcher=lambda event: True) for _ in range(3))
    context.register_event_handler(first)
    context.register_event_handler(second)
    context.register_event_handler(third, append=True)
    assert list(context.run.event_handlers) == [second, first, third]


def test_unregister_of_an_unknown_handler(context: LaunchContext) -> None:
    """Only a handler that is registered can be removed."""
    with pytest.raises(ValueError, match='not registered'):
        context.unregister_event_handler(EventHandler(matcher=lambda event: True))


def test_would_handle_event(context: LaunchContext) -> None:
    """The matchers of the handlers decide."""
    handler = EventHandler(matcher=lambda event: isinstance(event, Event))
    assert not context.would_handle_event(Event())
    context.register_event_handler(handler)
    assert context.would_handle_event(Event())
