# SPDX-License-Identifier: Apache-2.0
"""Launch files that include others."""

from __future__ import annotations

from collections.abc import Callable
import os
import sys
from typing import Any

from launch import (
    InvalidLaunchFileError,
    LaunchContext,
    LaunchDescription,
    LaunchDescriptionSource,
    LaunchService,
)
from launch.actions import GroupAction, IncludeLaunchDescription, LogInfo, SetEnvironmentVariable
from launch.launch_description_sources import (
    AnyLaunchDescriptionSource,
    load_python_launch_file_as_module,
    PythonLaunchDescriptionSource,
)
from launch.substitutions import LaunchConfiguration, ThisLaunchFileDir
import pytest

CHILD = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.substitutions import LaunchConfiguration, ThisLaunchFileDir
def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('who', default_value='nobody'),
        LogInfo(msg=['hello ', LaunchConfiguration('who'), ' in ', ThisLaunchFileDir()])])
"""
REQUIRED = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument('must', description='so')])
"""
Write = Callable[[str, str], str]
Run = Callable[..., Any]


def test_include_is_no_scope(run: Run, write: Write) -> None:
    """What an include sets is set for the includes that follow, too."""
    path = write('sub/child.launch.py', CHILD)
    result = run(
        IncludeLaunchDescription(path, launch_arguments={'who': 'you'}.items()),
        IncludeLaunchDescription(path),
        LogInfo(msg=LaunchConfiguration('who')),
    )
    folder = path.rpartition('/')[0]
    assert result.lines == [
        f'[INFO] [launch.user]: hello you in {folder}',
        f'[INFO] [launch.user]: hello you in {folder}',
        '[INFO] [launch.user]: you',
    ]


def test_arguments_see_those_before_them(run: Run, write: Write) -> None:
    """The values of arguments are evaluated one after the other."""
    path = write('child.launch.py', CHILD)
    result = run(
        IncludeLaunchDescription(
            path, launch_arguments=[('a', 'x'), ('who', [LaunchConfiguration('a'), 'y'])]
        )
    )
    assert 'hello xy in' in result.text


@pytest.fixture
def top_file(write: Write) -> str:
    """Return the path of a launch file that tells its folder behind an include."""
    write('sub/child.launch.py', CHILD)
    return write(
        'top.launch.py',
        (
            'from launch import LaunchDescription\n'
            'from launch.actions import IncludeLaunchDescription, LogInfo\n'
            'from launch.substitutions import ThisLaunchFileDir\n'
            'def generate_launch_description():\n'
            '    return LaunchDescription([IncludeLaunchDescription([ThisLaunchFileDir(),'
            ' "/sub/child.launch.py"]), LogInfo(msg=ThisLaunchFileDir()),'
            ' LogInfo(msg=ThisLaunchFileDir())])\n'
        ),
    )


def test_location_after_an_include(run: Run, top_file: str) -> None:
    """The folder is that of the included file, as in ROS 2 Jazzy; one warning says so."""
    result = run(IncludeLaunchDescription(top_file))
    folder = top_file.rpartition('/')[0]
    assert result.lines[-1] == f'[INFO] [launch.user]: {folder}/sub'
    [warning] = [line for line in result.lines if 'WARNING' in line]
    assert warning.startswith(
        f"[WARNING] [launch]: ThisLaunchFileDir in '{top_file}' stands for "
        f"'{folder}/sub/child.launch.py'"
    )


def test_location_is_scoped_if_wanted(capfd: Any, top_file: str) -> None:
    """The folder is again that of the including file if the context is told so."""
    service = LaunchService(noninteractive=True)
    service.context.run.scopes_location = True
    service.include_launch_description(LaunchDescription([IncludeLaunchDescription(top_file)]))
    assert service.run() == 0
    text = capfd.readouterr().out
    assert text.splitlines()[-1] == f'[INFO] [launch.user]: {top_file.rpartition("/")[0]}'
    assert 'WARNING' not in text


def test_location_of_a_description_without_file(run: Run) -> None:
    """Without a launch file there is no folder of one."""
    result = run(LogInfo(msg=ThisLaunchFileDir()))
    assert result.status == 1 and 'no launch file is being read' in result.text


def test_required_argument_must_be_given_to_the_include(run: Run, write: Write) -> None:
    """A launch configuration that is set already does not count."""
    path = write('child.launch.py', REQUIRED)
    result = run(IncludeLaunchDescription(path, launch_arguments=[('other', '1')]))
    assert result.status == 1
    assert (
        "Included launch description missing required argument 'must' "
        "(description: 'so'), given: [other]"
    ) in result.text
    assert run(IncludeLaunchDescription(path, launch_arguments=[('must', '1')])).status == 0


def test_line_of_the_include_that_gives_too_little(run: Run, write: Write) -> None:
    """The error is at the include to be corrected; those around it follow."""
    child = write('child.launch.py', REQUIRED)
    middle = write(
        'middle.launch.py',
        (
            'from launch import LaunchDescription\n'
            'from launch.actions import IncludeLaunchDescription\n'
            'def generate_launch_description():\n'
            f'    return LaunchDescription([IncludeLaunchDescription({child!r})])\n'
        ),
    )
    lines = run(IncludeLaunchDescription(middle)).lines
    assert lines[1] == (
        f"[ERROR] [launch]: It comes from '{middle}', line 4 (IncludeLaunchDescription)"
    )
    assert lines[2].startswith(f"  included from '{__file__}', line ")
    assert len(lines) == 3


def test_file_is_loaded_once(run: Run, write: Write) -> None:
    """Looking for arguments and including need only one run of the file."""
    count = "with open(__file__ + '.log', 'a') as log:\n    log.write('x')\n"
    child = write('child.launch.py', count + CHILD)
    top = LaunchDescription([IncludeLaunchDescription(child)])
    source = LaunchDescriptionSource(top)
    assert run(IncludeLaunchDescription(source)).status == 0
    with open(child + '.log', encoding='utf-8') as log:
        assert log.read() == 'x'


def test_file_is_loaded_again_in_another_environment(run: Run, write: Write) -> None:
    """A file may depend on the environment, which the launch may change before."""
    child = write(
        'child.launch.py',
        (
            'import os\nfrom launch import LaunchDescription\nfrom launch.actions import LogInfo\n'
            "found = os.environ.get('LAUNCH_TEST', 'nothing')\n"
            'def generate_launch_description():\n'
            '    return LaunchDescription([LogInfo(msg=found)])\n'
        ),
    )
    top = LaunchDescription(
        [SetEnvironmentVariable('LAUNCH_TEST', 'something'), IncludeLaunchDescription(child)]
    )
    result = run(IncludeLaunchDescription(LaunchDescriptionSource(top)))
    assert result.lines == ['[INFO] [launch.user]: something']


@pytest.mark.parametrize(
    'body, text',
    [
        ('x = 1\n', "does not contain the required function 'generate_launch_description()'"),
        ('def generate_launch_description():\n    return None\n', "has no attribute 'visit'"),
        ('import no_such_module\n', "ModuleNotFoundError: No module named 'no_such_module'"),
        ('def f(:\n', 'SyntaxError: '),
    ],
)
def test_broken_files(run: Run, write: Write, body: str, text: str) -> None:
    """The error tells what each loader found."""
    result = run(IncludeLaunchDescription(write('bad.launch.py', body)))
    assert result.status == 1
    head = 'Caught multiple exceptions when trying to load file of format [py]:\n - '
    assert head in result.text
    assert text in result.text


def test_tree_that_is_too_deep(run: Run) -> None:
    """Python's limit is explained."""
    entity: Any = LogInfo(msg='deep')
    for _ in range(sys.getrecursionlimit()):
        entity = GroupAction([entity])
    result = run(entity)
    assert result.status == 1 and 'The launch file nests groups or other actions' in result.text


def test_misspelt_function(run: Run, write: Write) -> None:
    """The function that is meant perhaps is named."""
    path = write('bad.launch.py', 'def generate_launch_descripton():\n    pass\n')
    text = run(IncludeLaunchDescription(PythonLaunchDescriptionSource(path))).text
    assert (
        "required function 'generate_launch_description()'\nDid you mean 'generate_launch_de"
        in text
    )


def test_source_of_another_format(run: Run, write: Write) -> None:
    """Python reads no XML; the error says what does."""
    path = write('child.launch.xml', '<launch/>\n')
    text = run(IncludeLaunchDescription(PythonLaunchDescriptionSource(path))).text
    assert 'XMLLaunchDescriptionSource, or with AnyLaunchDescriptionSource.' in text
    assert f"It comes from '{path}', line 1\n  included from '{__file__}', line" in text


def test_error_names_the_line(run: Run, write: Write) -> None:
    """An error in a launch file is reported with its line."""
    path = write('bad.launch.py', 'import os\n\nraise RuntimeError("because")\n')
    result = run(IncludeLaunchDescription(PythonLaunchDescriptionSource(path)))
    assert result.lines[:-1] == [
        '[ERROR] [launch]: Caught exception in launch (see debug for traceback): because',
        f"[ERROR] [launch]: It comes from '{path}', line 3",
    ]
    assert result.lines[-1].startswith(f"  included from '{__file__}', line ")


def test_error_names_the_line_of_the_action(run: Run, write: Write) -> None:
    """An error of an action is reported with the line that creates it."""
    path = write(
        'bad.launch.py',
        (
            'from launch import LaunchDescription\nfrom launch.actions import LogInfo\n'
            'from launch.substitutions import LaunchConfiguration\n'
            'def generate_launch_description():\n    return LaunchDescription([\n'
            '        LogInfo(msg=LaunchConfiguration("typo"))])\n'
        ),
    )
    result = run(IncludeLaunchDescription(path))
    assert result.lines[-2] == f"[ERROR] [launch]: It comes from '{path}', line 6 (LogInfo)"


def test_missing_file(run: Run, write: Write) -> None:
    """The error of a missing file names the closest one."""
    path = write('robot.launch.py', CHILD)
    result = run(IncludeLaunchDescription(path.replace('robot', 'robto')))
    assert "robto.launch.py' does not exist. Did you mean 'robot.launch.py'?" in result.text


def test_missing_file_beside_the_including_one(
    run: Run, write: Write, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A file that is being read is never suggested; a relative path is explained."""
    path = write(
        'robot.launch.py',
        (
            'from launch import LaunchDescription\n'
            'from launch.actions import IncludeLaunchDescription\n'
            'def generate_launch_description():\n'
            "    return LaunchDescription([IncludeLaunchDescription('robto.launch.py')])\n"
        ),
    )
    monkeypatch.chdir(os.path.dirname(path))
    text = run(IncludeLaunchDescription(path)).text
    assert "the launch file 'robto.launch.py' does not exist" in text
    assert 'Did you mean' not in text
    folder = os.getcwd()
    assert f"A relative path starts at the current folder, '{folder}'. Beside this launch" in text
    text = run(IncludeLaunchDescription(path + '/child.launch.py')).text
    assert f"there is no folder '{path}'" in text
    assert 'Did you mean' not in text and 'relative path' not in text


def test_unknown_format(write: Write, context: LaunchContext) -> None:
    """A file that no parser accepts, and that is not Python, is refused with that reason."""
    source = AnyLaunchDescriptionSource(write('x.txt', 'this is: [no launch file\n'))
    with pytest.raises(InvalidLaunchFileError, match='a syntax error, or its format is unknown$'):
        source.get_launch_description(context)


def test_file_as_module(write: Write) -> None:
    """A file can be loaded as a module, which is not registered."""
    import sys

    path = write('x.launch.py', 'def f():\n    return __file__, __name__\n')
    module = load_python_launch_file_as_module(path)
    assert module.f() == (path, 'python_launch_file')
    assert 'python_launch_file' not in sys.modules


def test_wrong_value_of_an_argument(run: Run, write: Write) -> None:
    """The value of a launch argument must be like a text."""
    path = write('child.launch.py', CHILD)
    result = run(IncludeLaunchDescription(path, launch_arguments={'who': True}.items()))
    assert result.status == 1 and "'bool' object is not iterable" in result.text


def test_deprecated_description(run: Run) -> None:
    """A deprecated description warns when it is visited."""
    result = run(LaunchDescription([], deprecated_reason='old'))
    assert result.lines == ['[WARNING] [root]: launch file [unknown] is deprecated: old']
