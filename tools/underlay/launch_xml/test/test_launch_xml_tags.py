# SPDX-License-Identifier: Apache-2.0
"""The tags of launch in XML."""

from __future__ import annotations

from collections.abc import Callable
import io
import os
from typing import Any

from launch import LaunchContext
from launch.actions import (
    DeclareLaunchArgument,
    ExecuteProcess,
    GroupAction,
    IncludeLaunchDescription,
    Shutdown,
    TimerAction,
)
from launch.frontend import Parser
from launch.utilities import perform_substitutions
import pytest

Run = Callable[..., list[str]]


def parse(content: str) -> Any:
    """Return the only action in a launch file."""
    root, parser = Parser.load(io.StringIO(f'<launch>{content}</launch>'))
    [action] = parser.parse_description(root).entities
    return action


def logged(lines: list[str]) -> list[str]:
    """Return what was logged for the user."""
    mark = '[INFO] [launch.user]: '
    return [line.replace(mark, '') for line in lines if line.startswith(mark)]


def test_arg(run: Run) -> None:
    """An argument has its default, or the value that it is given."""
    content = '<launch><arg name="a" default="$(var b x)y"/><log message="$(var a)"/></launch>'
    assert logged(run(content)) == ['xy']
    assert logged(run(content, a='z')) == ['z']


def test_description_and_choices_of_an_arg() -> None:
    """An argument is described, and may have choices."""
    action = parse(
        '<arg name="a" default="x" description="what $(it) is">'
        '<choice value="x"/><choice value="y"/></arg>'
    )
    assert isinstance(action, DeclareLaunchArgument)
    assert action.choices == ['x', 'y']
    assert action.description == "what $(it) is. Valid choices are: ['x', 'y']"


def test_let_and_log(run: Run) -> None:
    """A variable is set, under a condition."""
    lines = run(
        '<launch><let name="a" value="1"/><let name="b" value="$(var a)2"/>'
        '<let name="b" value="no" if="false"/><let name="b" value="no" unless="$(var a)"/>'
        '<log message="$(var b)"/></launch>'
    )
    assert logged(lines) == ['12']


def test_group_scope(run: Run) -> None:
    """A group is a scope unless it says otherwise, for which there may be a substitution."""
    lines = run(
        '<launch><let name="a" value="0"/>'
        '<group><let name="a" value="1"/></group><log message="$(var a)"/>'
        '<group scoped="false"><let name="a" value="2"/></group><log message="$(var a)"/>'
        '<let name="open" value="false"/>'
        '<group scoped="$(var open)"><let name="a" value="3"/></group><log message="$(var a)"/>'
        '<group if="false"><log message="no"/></group></launch>'
    )
    assert logged(lines) == ['0', '2', '3']


def test_group_that_keeps(run: Run) -> None:
    """A group that forwards nothing keeps what it is told to."""
    lines = run(
        '<launch><let name="a" value="1"/><let name="b" value="2"/>'
        '<group forwarding="false"><keep name="c" value="$(var a)$(var b)"/>'
        '<log message="$(var c) $(var a gone)"/></group><log message="$(var a)"/></launch>'
    )
    assert logged(lines) == ['12 gone', '1']


def test_include(run: Run, write: Callable[[str, str], str]) -> None:
    """An include passes arguments in order, as `arg` or as `let`."""
    write(
        'child.launch.xml',
        '<launch><arg name="a"/><arg name="b"/><arg name="c" default="d"/>'
        '<log message="$(var a) $(var b) $(var c) $(filename)"/></launch>',
    )
    lines = run(
        '<launch><include file="$(dirname)/child.launch.xml">'
        '<let name="a" value="1"/><arg name="b" value="$(var a)2"/></include></launch>'
    )
    assert logged(lines)[0].startswith('1 12 d ')
    assert lines[0].endswith('child.launch.xml')
    assert isinstance(parse('<include file="x"/>'), IncludeLaunchDescription)


def test_environment(run: Run) -> None:
    """Environment variables are set, extended and removed."""
    os.environ['OUTER'] = 'outer'
    lines = run(
        '<launch><set_env name="A" value="$(env OUTER)"/><append_env name="A" value="b"/>'
        '<append_env name="A" value="c" prepend="true" separator="+"/><log message="$(env A)"/>'
        '<unset_env name="A"/><log message="$(env A gone)"/>'
        '<group><set_env name="OUTER" value="x"/><reset_env/><log message="$(env OUTER)"/></group>'
        '</launch>'
    )
    assert logged(lines) == ['c+outer:b', 'gone', 'outer']


def test_reset(run: Run) -> None:
    """Variables are removed but for those that are kept."""
    lines = run(
        '<launch><let name="a" value="1"/><reset><keep name="b" value="$(var a)"/></reset>'
        '<log message="$(var a gone) $(var b)"/></launch>'
    )
    assert logged(lines) == ['gone 1']


def test_executable(run: Run) -> None:
    """A command is run with its attributes and variables."""
    lines = run(
        '<launch><let name="x" value="p q"/><executable cmd="sh -c \'echo $A \\$1\' - $(var x)" '
        'output="screen" name="me" cwd="/" launch-prefix="env B=1">'
        '<env name="A" value="$(var x)"/></executable></launch>'
    )
    assert [line for line in lines if line.startswith('[me-') and line.endswith('] p q p q')]


def test_options_of_an_executable() -> None:
    """The typed attributes of a process have their types."""
    action = parse(
        '<executable cmd="x" shell="true" emulate_tty="True" respawn="$(var r)" '
        'respawn_delay="1" respawn_max_retries="2" sigterm_timeout="3" '
        'sigkill_timeout="$(var t)" on_exit="shutdown"/>'
    )
    assert isinstance(action, ExecuteProcess)
    assert (action.shell, action.emulate_tty) == (True, True)
    assert isinstance(action.get_sub_entities()[0], Shutdown)


def test_respawn(run: Run) -> None:
    """A process that is to respawn runs again, as often as is said."""
    lines = run('<launch><executable cmd="true" respawn="true" respawn_max_retries="1"/></launch>')
    assert len([line for line in lines if 'process started' in line]) == 2


def test_shutdown(run: Run) -> None:
    """The launch ends for a reason."""
    lines = run('<launch><executable cmd="sleep 60"/><shutdown reason="enough"/></launch>')
    assert any("sending signal 'SIGINT'" in line for line in lines)


@pytest.mark.parametrize('period', ['0', '0.1', '$(var period)'])
def test_timer(period: str, run: Run) -> None:
    """A timer does things later, in its own scope; the period may be a substitution."""
    lines = run(
        f'<launch><let name="period" value="0.1"/><timer period="{period}">'
        '<let name="period" value="x"/><log message="later"/></timer><log message="now"/></launch>'
    )
    assert logged(lines) == ['now', 'later']


def test_timer_that_is_not_cancelled() -> None:
    """A timer may outlast the begin of the shutdown."""
    action = parse('<timer period="1" cancel_on_shutdown="false"><log message="x"/></timer>')
    assert isinstance(action, TimerAction)
    assert action.period == 1.0


def test_conditions() -> None:
    """A condition reads what substitutions become; both together make no sense."""
    context = LaunchContext()
    context.launch_configurations['x'] = 'y'
    wanted = parse('<log message="x" if="$(eval \'&quot;$(var x)&quot; == &quot;y&quot;\')"/>')
    unwanted = parse('<log message="x" unless="$(equals $(var x) y)"/>')
    assert wanted.condition.evaluate(context) is True
    assert unwanted.condition.evaluate(context) is False
    with pytest.raises(RuntimeError, match="^if and unless conditions can't be used simultan"):
        parse('<log message="x" if="true" unless="true"/>')


def test_group_keeps_the_order_of_its_children() -> None:
    """Children are visited in the order of the file."""
    group = parse('<group scoped="false"><let name="a" value="1"/><log message="x"/></group>')
    assert isinstance(group, GroupAction)
    assert [type(each).__name__ for each in group.get_sub_entities()] == [
        'SetLaunchConfiguration',
        'LogInfo',
    ]


def test_command_words() -> None:
    """Only what stands in the file is split, not what substitutions become."""
    context = LaunchContext()
    context.launch_configurations['ex'] = 'p q'
    action = parse('<executable cmd="x -a $(var ex) b$(var ex)c"/>')
    assert [perform_substitutions(context, word) for word in action.cmd] == [
        'x',
        '-a',
        'p q',
        'bp qc',
    ]
