# SPDX-License-Identifier: Apache-2.0
"""What is found out before the first process starts, and where errors come from."""

from __future__ import annotations

from collections.abc import Callable
import os
from typing import Any

from launch.actions import (
    ExecuteProcess,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    OpaqueFunction,
    RegisterEventHandler,
    SetLaunchConfiguration,
    TimerAction,
)
from launch.conditions import IfCondition
from launch.event_handlers import OnProcessExit, OnShutdown
from launch.substitutions import FindExecutable, LaunchConfiguration
import pytest

Run = Callable[..., Any]
Write = Callable[[str, str], str]

HEAD = """\
from launch import LaunchDescription
from launch.actions import *
from launch.conditions import *
from launch.substitutions import *
def generate_launch_description():
    return LaunchDescription([
"""


def _file(*entities: str) -> str:
    return HEAD + ''.join(f'        {each},\n' for each in entities) + '    ])\n'


def _fails_at_once(result: Any, text: str) -> None:
    assert result.status == 1 and 'process started' not in result.text
    assert text in result.text


def test_missing_program_keeps_all_from_starting(run: Run) -> None:
    """A program that is not there is an error before anything starts."""
    result = run(ExecuteProcess(cmd=['true']), ExecuteProcess(cmd=['slepp', '1']))
    _fails_at_once(result, "the program 'slepp' was not found on the PATH. Did you mean 'sle")
    assert f"It comes from '{__file__}', line " in result.text


def test_words_in_one_text(run: Run) -> None:
    """A whole command line as the program gets advice."""
    _fails_at_once(run(ExecuteProcess(cmd=['ls -l'])), 'A command line in one text needs shell=')


@pytest.mark.parametrize('is_file', [False, True])
def test_missing_folder_is_an_error_of_its_process(run: Run, write: Write, is_file: bool) -> None:
    """It is a warning before the start, as it may be made until then, and the rest goes on."""
    folder = write('file', '') if is_file else '/no'
    result = run(ExecuteProcess(cmd=['true'], cwd=folder, name='it'), ExecuteProcess(cmd=['true']))
    assert result.status == 0 and result.text.count('process started') == 1
    missing = 'is a file' if is_file else 'does not exist'
    warning, *_ = [line for line in result.lines if line.startswith('[WARNING]')]
    assert f"the folder '{folder}', in which process[it-" in warning and missing in warning
    assert "exception occurred while executing process: the folder '" in result.text


def test_path_of_the_process_counts(run: Run, write: Write) -> None:
    """The program is searched on the PATH that the process gets, and from its folder."""
    program = write('bin/tool', '#!/bin/sh\n')
    os.chmod(program, 0o755)
    folder = os.path.dirname(program)
    found = ExecuteProcess(cmd=['tool'], additional_env={'PATH': folder})
    assert run(found, ExecuteProcess(cmd=['./tool'], cwd=folder)).status == 0
    assert run(ExecuteProcess(cmd=['no_tool || true'], shell=True)).status == 0


@pytest.mark.parametrize(
    'wrap',
    [
        lambda action: TimerAction(period=60.0, actions=[action]),
        lambda action: RegisterEventHandler(OnShutdown(on_shutdown=[action])),
        lambda action: ExecuteProcess(cmd=['true'], on_exit=[GroupAction([action])]),
        lambda action: RegisterEventHandler(
            OnProcessExit(on_exit=[RegisterEventHandler(OnShutdown(on_shutdown=action))])
        ),
    ],
)
@pytest.mark.parametrize(
    'make, text',
    [
        (lambda: ExecuteProcess(cmd=['slepp']), "the program 'slepp' was not found"),
        (lambda: ExecuteProcess(cmd=[FindExecutable(name='slepp')]), "executable 'slepp' not"),
        (lambda: IncludeLaunchDescription('/no/x.launch.py'), "file '/no/x.launch.py' does not"),
    ],
)
def test_what_waits_is_checked(run: Run, wrap: Any, make: Any, text: str) -> None:
    """What an action that waits for an event names for good must be there."""
    result = run(ExecuteProcess(cmd=['true']), wrap(make()))
    _fails_at_once(result, text)
    assert f"It comes from '{__file__}', line " in result.text


@pytest.mark.parametrize(
    'action',
    [
        lambda: ExecuteProcess(cmd=['slepp'], condition=IfCondition('false')),
        lambda: ExecuteProcess(cmd=[LaunchConfiguration('later')]),
        lambda: ExecuteProcess(cmd=['slepp || true'], shell=True),
    ],
)
def test_what_cannot_be_known(run: Run, action: Any) -> None:
    """What depends on something is left alone until its event comes."""
    handler = RegisterEventHandler(
        OnProcessExit(
            on_exit=[SetLaunchConfiguration('later', 'true'), action()], handle_once=True
        )
    )
    assert run(handler, ExecuteProcess(cmd=['true'])).status == 0


def test_file_that_may_be_made_until_then(run: Run, write: Write) -> None:
    """A path that waits is only a warning, because another process may make the file."""
    path = write('made', '') + '.sh'
    maker = ExecuteProcess(cmd=['sh', '-c', f'echo "#!/bin/sh" > {path}; chmod +x {path}'])
    user = ExecuteProcess(cmd=[path], name='user')
    handler = RegisterEventHandler(OnProcessExit(target_action=maker, on_exit=[user]))
    result = run(maker, handler)
    assert result.status == 0
    assert 'it waits for an event and may be created by then' in result.text
    assert '[user-' in result.text and 'finished cleanly' in result.text


def test_chain_of_includes(run: Run, write: Write) -> None:
    """An error names the line of the action and each include that led to it."""
    bottom = write('bottom.launch.py', _file('LogInfo(msg=LaunchConfiguration("typo"))'))
    middle = write(
        'middle.launch.py', _file('LogInfo(msg="x")', f'IncludeLaunchDescription("{bottom}")')
    )
    top = write('top.launch.py', _file(f'GroupAction([IncludeLaunchDescription("{middle}")])'))
    lines = run(IncludeLaunchDescription(top)).lines
    assert lines[-4:-1] == [
        f"[ERROR] [launch]: It comes from '{bottom}', line 7 (LogInfo)",
        f"  included from '{middle}', line 8",
        f"  included from '{top}', line 7",
    ]


def test_chain_of_what_waited(run: Run, write: Write) -> None:
    """The chain is known also when the error comes from an event."""
    inner = write(
        'inner.launch.py',
        _file('TimerAction(period=0.01, actions=[LogInfo(msg=LaunchConfiguration("typo"))])'),
    )
    outer = write('outer.launch.py', _file(f'IncludeLaunchDescription("{inner}")'))
    text = run(IncludeLaunchDescription(outer)).text
    assert (
        f"It comes from '{inner}', line 7 (LogInfo)\n  included from '{outer}', line 7\n" in text
    )


def test_line_in_the_function(run: Run) -> None:
    """An error in an OpaqueFunction names the line of the function that raised it."""

    def function(context: Any) -> None:
        LogInfo(msg='x')
        int('many')

    result = run(OpaqueFunction(function=function))
    line = function.__code__.co_firstlineno + 2
    assert f"It comes from '{__file__}', line {line} (OpaqueFunction)" in result.text


def test_syntax_error(run: Run, write: Write) -> None:
    """A syntax error names its line."""
    path = write('bad.launch.py', 'import os\n\ndef generate_launch_description(:\n')
    result = run(IncludeLaunchDescription(path))
    _fails_at_once(result, f"It comes from '{path}', line 3\n")


def test_circular_include(run: Run, write: Write) -> None:
    """A circle is shown, step by step."""
    one, two = write('one.launch.py', ''), write('two.launch.py', '')
    write('one.launch.py', _file('LogInfo(msg="x")', f'IncludeLaunchDescription("{two}")'))
    write('two.launch.py', _file(f'IncludeLaunchDescription("{one}")'))
    result = run(ExecuteProcess(cmd=['true']), IncludeLaunchDescription(one))
    _fails_at_once(
        result,
        f"circular include: '{one}' includes itself endlessly\n"
        f"  '{one}', line 8 includes '{two}'\n  '{two}', line 7 includes '{one}'\n",
    )
    assert 'Recursion' not in result.text


def test_include_of_itself_that_ends(run: Run, write: Write) -> None:
    """A file may include itself as long as something changes."""
    path = write('count.launch.py', '')
    write(
        'count.launch.py',
        _file(
            'DeclareLaunchArgument("n", default_value="5")',
            'LogInfo(msg=LaunchConfiguration("n"))',
            f'IncludeLaunchDescription("{path}", launch_arguments=[("n", PythonExpression('
            '[LaunchConfiguration("n"), " - 1"]))], condition=IfCondition(PythonExpression('
            '[LaunchConfiguration("n"), " > 1"])))',
        ),
    )
    result = run(IncludeLaunchDescription(path))
    assert result.status == 0
    assert [line[-1] for line in result.lines] == ['5', '4', '3', '2', '1']


def test_installed_file_that_is_old(run: Run, write: Write) -> None:
    """A file that was changed in the workspace after it had been installed is a warning."""
    write('src/arm/package.xml', '<package><name>arm</name></package>')
    texts = ['install/arm/share/arm/it.launch.py', 'install/arm/share/arm/arm.xacro']
    installed = [write(texts[0], ''), write(texts[1], 'model')]
    write(texts[0], _file(f'LogInfo(msg=Command("cat {installed[1]}"))'))
    sources = [write('src/arm/it.launch.py', 'new'), write('src/arm/arm.xacro', 'new')]
    for path in installed:
        os.utime(path, (0, 0))
    lines = run(IncludeLaunchDescription(installed[0])).lines
    assert lines[1:] == [
        f"[WARNING] [launch]: '{source}' is newer than the installed '{path}', which is used; "
        'run colcon build'
        for source, path in zip(sources, installed)
    ]
