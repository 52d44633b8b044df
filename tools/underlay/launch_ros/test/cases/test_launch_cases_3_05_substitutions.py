# SPDX-License-Identifier: Apache-2.0
"""Cases of section 3.5: substitutions."""

from __future__ import annotations

import re
from typing import Any

import pytest


def _results(launch: Any, before: str, *substitutions: str, **options: Any) -> list[str]:
    """Return the texts that some substitutions stand for, without that of their error."""
    entities = ''.join(f'LogInfo(msg=[{text}, "|"]),\n' for text in substitutions)
    out = launch(f'{before}\n---\n{entities}', **options)
    assert out.status == 0
    return [text.removesuffix('|') for text in re.split(r'(?<=\|)\n', '\n'.join(_said(out)))]


def _said(out: Any) -> list[str]:
    return [line.removeprefix('[INFO] [launch.user]: ') for line in out.lines]


def test_parts_concatenate(launch: Any) -> None:
    """3.5 A text, a substitution, or several of them, of which the texts follow each other."""
    assert _results(
        launch,
        'from pathlib import Path',
        "'a'",
        "TextSubstitution(text='a'), 'b', TextSubstitution(text='')",
        "*('x' for _ in range(3))",
        "PathJoinSubstitution([Path('p'), 'q'])",
    ) == ['a', 'ab', 'xxx', 'p/q']


def test_paths_of_python_are_texts(launch: Any) -> None:
    """3.5 A pathlib.Path stands for its text, wherever a text may stand (3.0)."""
    out = launch(
        """
        from pathlib import Path
        ---
        DeclareLaunchArgument('p', default_value=Path('/a')),
        LogInfo(msg=[Path('/b'), 'c', LaunchConfiguration('p')]),
        SetEnvironmentVariable('CASE_P', Path('/c')),
        Node(package='stub', executable=Path('rec'), parameters=[Path('p.yaml')],
             arguments=[Path('/d')], cwd=Path('sub')),
        """,
        files={'p.yaml': '{}', 'sub/p.yaml': '{}'},
    )
    assert out.said == ['/bc/a']
    assert out.run.args == ['/d', '--ros-args', '--params-file', 'p.yaml']
    assert (out.run.env['CASE_P'], out.run.cwd) == ('/c', str(out.here / 'sub'))


def test_what_is_no_text(launch: Any) -> None:
    """3.5 Other values, and lists in lists, are refused when the action is made."""
    nested, *others = launch.errors(
        "LogInfo(msg=['a', ['b']])",
        'LogInfo(msg=5)',
        'TextSubstitution(text=5)',
        "TextSubstitution('positional')",
    )
    assert "Failed to normalize given item of type '<class 'list'>'" in nested
    assert all(error.startswith('TypeError') for error in others), others


def test_failures_are_runtime_errors(launch: Any) -> None:
    """3.5 What fails is a SubstitutionFailure, which is a RuntimeError."""
    out = launch.script(
        """
        from launch.substitutions.substitution_failure import SubstitutionFailure
        try:
            LaunchConfiguration('x').perform(LaunchContext())
        except SubstitutionFailure as error:
            print(isinstance(error, RuntimeError), str(error)[:38])
        """
    )
    assert out.stdout == "True launch configuration 'x' does not exis\n"


def test_paths(launch: Any) -> None:
    """3.5 Paths join like os.path.join; an element may be a list; / joins too."""
    assert _results(
        launch,
        '',
        "PathJoinSubstitution(['a', TextSubstitution(text='b'), 'c.txt'])",
        "PathJoinSubstitution(['a', '/b', 'c'])",
        "PathJoinSubstitution(['a', ['b', TextSubstitution(text='-c'), '.txt']])",
        "PathJoinSubstitution(['a', ''])",
        "PathSubstitution(TextSubstitution(text='a')) / 'b' / TextSubstitution(text='c')",
        "PathSubstitution('a') / ['b', '.txt']",
        "PathJoinSubstitution(['a', 'b']) / 'c'",
        "FindPackageShare('stub') / 'data.txt'",
        "FindPackagePrefix('stub') / 'x'",
        "ThisLaunchFileDir() / 'x'",
    ) == [
        *['a/b/c.txt', '/b/c', 'a/b-c.txt', 'a/', 'a/b/c', 'a/b.txt', 'a/b/c'],
        *['PREFIX/share/stub/data.txt', 'PREFIX/x', 'HERE/x'],
    ]


def test_packages_and_executables(launch: Any) -> None:
    """3.5 Packages are found in the index, executables in a package or on the PATH."""
    assert _results(
        launch,
        '',
        "FindPackageShare('stub')",
        "FindPackagePrefix(['st', TextSubstitution(text='ub')])",
        "FindPackageShare(package='stub')",
        "ExecutableInPackage('rec', 'stub')",
        "ExecutableInPackage(executable='rec', package='stub')",
        "FindExecutable(name='rec')",
        "FindExecutable(name=['r', 'ec'])",
    ) == [
        *['PREFIX/share/stub', 'PREFIX', 'PREFIX/share/stub'],
        *['PREFIX/lib/stub/rec'] * 4,
    ]


FAILURES = [
    ("FindPackageShare('no_such')", "package 'no_such' not found, searching: ['PREFIX'"),
    ("FindPackagePrefix('no/such')", "'no/such' is not a valid package name"),
    (
        "ExecutableInPackage('rec', 'bare')",
        "package 'bare' found at 'PREFIX', but libexec directory 'PREFIX/lib/bare' does not exist",
    ),
    (
        "ExecutableInPackage('no', 'stub')",
        "executable 'no' not found on the libexec directory 'PREFIX/lib/stub'",
    ),
    (
        "ExecutableInPackage('below', 'stub')",
        "executable 'below' not found on the libexec directory 'PREFIX/lib/stub'",
    ),
    (
        "ExecutableInPackage('plain', 'stub')",
        "executable 'plain' not found on the libexec directory 'PREFIX/lib/stub'",
    ),
    ("FindExecutable(name='no_such')", 'not found on the PATH'),
    ("EnvironmentVariable('NO_SUCH')", "environment variable 'NO_SUCH' does not exist"),
    ("FileContent('no.txt')", 'File not found: no.txt'),
    ("LocalSubstitution('nowhere.reason')", 'nowhere'),
    ("PythonExpression(['bee'])", "name 'bee' is not defined"),
    ("PythonExpression('os.getpid()')", "name 'os' is not defined"),
    ("IfElseSubstitution('perhaps', 'a', 'b')", ''),
    ("IfElseSubstitution('true')", ''),
]


def test_what_fails(launch: Any) -> None:
    """3.5 A substitution that cannot be performed says why."""
    for (_, text), error in zip(FAILURES, launch.errors(*(each for each, _ in FAILURES))):
        assert text in error


def test_environment_variables(launch: Any) -> None:
    """3.5 The environment is read when performed; an empty default is a default."""
    out = launch(
        """
        LogInfo(msg=[EnvironmentVariable('CASE_A'), '|']),
        LogInfo(msg=[EnvironmentVariable('CASE_B', default_value=''), '|']),
        LogInfo(msg=[EnvironmentVariable(name=['CASE', '_B'], default_value=['d', 'ef']), '|']),
        SetEnvironmentVariable('CASE_B', 'now'),
        LogInfo(msg=[EnvironmentVariable('CASE_B', default_value=''), '|']),
        """,
        CASE_A='a',
    )
    assert out.said == ['a|', '|', 'def|', 'now|']


def test_commands(launch: Any) -> None:
    """3.5 A command is split into words, run without a shell, and gives its whole output."""
    out = launch(
        """
        noisy = "sh -c 'echo out; echo err >&2'"
        ---
        LogInfo(msg=['<', Command(['printf ', '"%s|" a "b c" $HOME ', '*']), '>']),
        LogInfo(msg=['<', Command('echo with its end'), '>']),
        LogInfo(msg=['<', Command(noisy, on_stderr='ignore'), '>']),
        LogInfo(msg=['<', Command(noisy, on_stderr='warn'), '>']),
        LogInfo(msg=['<', Command(noisy, on_stderr='capture'), '>']),
        LogInfo(msg=['<', Command('sh -c "cat"', on_stderr='fail'), '>']),
        """
    )
    assert out.status == 0
    screen = '\n'.join(line.removeprefix('[INFO] [launch.user]: ') for line in out.lines)
    assert screen.startswith('<a|b c|$HOME|*|>\n<with its end\n>\n<out\n>\n[WARNING]')
    assert 'err' in screen.partition('[WARNING]')[2].partition('<out')[0]
    assert screen.endswith('<out\n>\n<out\nerr\n>\n<>')


FAILING_COMMANDS = [
    ("Command('false')", 'executed command failed. Command: false'),
    (
        "Command('sh -c \"echo why >&2; exit 2\"', on_stderr='ignore')",
        'executed command failed. Command: sh -c "echo why >&2; exit 2"\n'
        'Captured stderr output: why',
    ),
    (
        'Command(\'sh -c "echo why >&2"\')',
        'executed command showed stderr output. Command: sh -c "echo why >&2"',
    ),
    ("Command('no_such_command')", 'file not found: [Errno 2]'),
    ("Command('true', on_stderr='shout')", 'shout'),
]


def test_commands_that_fail(launch: Any) -> None:
    """3.5 A command fails by its status, by writing to stderr, or if it does not exist."""
    errors = launch.errors(*(each for each, _ in FAILING_COMMANDS))
    for (_, text), error in zip(FAILING_COMMANDS, errors):
        assert text in error


def test_python_expressions(launch: Any) -> None:
    """3.5 The parts make one expression, in which the listed modules can be used."""
    assert _results(
        launch,
        'x = TextSubstitution(text="2")',
        "PythonExpression(['1 + ', x])",
        "PythonExpression(['1.0 * ', x])",
        'PythonExpression(["\'", x, "\' == \'2\'"])',
        "PythonExpression('sqrt(4) + math.pi - pi')",
        "PythonExpression(\"os.path.join('a', 'b')\", ['os'])",
        "PythonExpression(['len(sys.argv) > 0 and ', 'os.sep'], python_modules=['sys', 'os'])",
        "PythonExpression('[i for i in range(2)]')",
        "PythonExpression('None')",
    ) == ['3', '2.0', 'True', '2.0', 'a/b', '/', '[0, 1]', 'None']


def test_places(launch: Any) -> None:
    """3.5 The launch file, its folder and the log folder have substitutions."""
    assert _results(
        launch,
        '',
        'ThisLaunchFileDir()',
        'ThisLaunchFile()',
        "PathJoinSubstitution([ThisLaunchFileDir(), 'x'])",
    ) == ['HERE', 'HERE/it.launch.py', 'HERE/x']
    out = launch('LogInfo(msg=LaunchLogDir()),')
    assert out.said == [out.tidy(str((out.here / 'log/latest').resolve()))]


@pytest.mark.parametrize('substitution', ['ThisLaunchFileDir', 'ThisLaunchFile'])
def test_places_without_a_file(substitution: str, launch: Any) -> None:
    """3.5 A description that comes from no file has no place."""
    out = launch.script(
        f"""
        service = LaunchService()
        service.include_launch_description(LaunchDescription([LogInfo(msg={substitution}())]))
        print('status', service.run())
        """
    )
    assert 'status 1' in out.stdout


def test_locals(launch: Any) -> None:
    """3.5 A local can be an attribute of an event; it must be a text."""
    entities = """
        ExecuteProcess(cmd=['sh', '-c', 'exit 3']),
        RegisterEventHandler(OnProcessExit(on_exit=[
            LogInfo(msg=['name: ', LocalSubstitution('event.process_name', 'its name')]),
            LogInfo(msg=['code: ', {code}])])),
    """
    out = launch(entities.replace('{code}', "LocalSubstitution('event.returncode')"))
    assert (out.status, out.said) == (1, ['name: sh-1'])
    out = launch(entities.replace('{code}', "'three'"))
    assert (out.status, out.said) == (0, ['name: sh-1', 'code: three'])


def test_anonymous_names(launch: Any) -> None:
    """3.5 An anonymous name is the same wherever its name is, and fits for a ROS name."""
    out = launch(
        """
        LogInfo(msg=AnonName('x.y-z')),
        LogInfo(msg=AnonName('x.y-z')),
        LogInfo(msg=AnonName('other')),
        LogInfo(msg=LaunchConfiguration('anonx.y-z')),
        """
    )
    first, second, other, stored = out.said
    assert first == second == stored
    assert re.fullmatch(r'x_y_z_\w+_\d+_\w+', first)
    assert other.startswith('other_')
    assert other != first


def test_content_of_a_file(launch: Any) -> None:
    """3.5 The content of a file is its whole text."""
    assert _results(launch, '', "FileContent(['a', '.txt'])", files={'a.txt': 'one\ntwo\n'}) == [
        'one\ntwo\n'
    ]


def test_logic(launch: Any) -> None:
    """3.5 Operands of logic are read by the rules of YAML, and 1 and 0; results are lowercase."""
    expected = {
        "NotSubstitution('false')": 'true',
        "NotSubstitution('True')": 'false',
        "NotSubstitution('yes')": 'false',
        "NotSubstitution('off')": 'true',
        "NotSubstitution('1')": 'false',
        "NotSubstitution(['0'])": 'true',
        "AndSubstitution('on', '1')": 'true',
        "AndSubstitution('on', 'no')": 'false',
        "OrSubstitution('0', 'YES')": 'true',
        "OrSubstitution('0', 'false')": 'false',
        "AnySubstitution('0', 'false', 'true')": 'true',
        "AnySubstitution('0', 'false')": 'false',
        "AllSubstitution('1', 'true', 'on')": 'true',
        "AllSubstitution('1', 'true', 'off')": 'false',
    }
    assert dict(zip(expected, _results(launch, '', *expected))) == expected


def test_logic_that_fails(launch: Any) -> None:
    """3.5 An operand that is no truth value is an error, wherever it stands."""
    errors = launch.errors(
        "NotSubstitution('perhaps')",
        "NotSubstitution('')",
        "AndSubstitution('false', LaunchConfiguration('no'))",
        "OrSubstitution('true', '2')",
    )
    assert 'accepted' not in errors


def test_comparisons(launch: Any) -> None:
    """3.5 Truth values are compared as such, then numbers by value, then texts."""
    expected = {
        "EqualsSubstitution('1.0', '1')": 'true',
        "EqualsSubstitution('True', '1')": 'true',
        "EqualsSubstitution('true', 'TRUE')": 'true',
        "EqualsSubstitution('false', '0')": 'true',
        "EqualsSubstitution('0.1', '0.10000000000000000001')": 'true',
        "EqualsSubstitution('a', 'A')": 'false',
        "EqualsSubstitution('a', ['a'])": 'true',
        "EqualsSubstitution(None, '')": 'true',
        "EqualsSubstitution(True, 'true')": 'true',
        'EqualsSubstitution(2, 2.0)': 'true',
        "EqualsSubstitution('yes', 'true')": 'false',
        "EqualsSubstitution('1', '2')": 'false',
        "NotEqualsSubstitution('1', '2')": 'true',
        "NotEqualsSubstitution('a', 'a')": 'false',
    }
    assert dict(zip(expected, _results(launch, '', *expected))) == expected


def test_choice_of_two(launch: Any) -> None:
    """3.5 Only the chosen branch of a choice is performed."""
    assert _results(
        launch,
        "no = LaunchConfiguration('no')",
        "IfElseSubstitution('true', 'a', no)",
        "IfElseSubstitution('off', no, ['b', 'c'])",
        "IfElseSubstitution('0', if_value='x')",
        "IfElseSubstitution(condition='1', if_value='x', else_value='y')",
    ) == ['a', 'bc', '', 'x']


def test_parameters_in_scope(launch: Any) -> None:
    """3.5 The text of a parameter that SetParameter has set, else the default."""
    out = launch(
        """
        from launch_ros.substitutions import Parameter as Given
        ---
        SetParameter('a', 1),
        GroupAction([SetParameter('b', 'inner'), LogInfo(msg=Given('b'))]),
        LogInfo(msg=Given('a')),
        LogInfo(msg=Given('b', default='default')),
        LogInfo(msg=Given('c')),
        """
    )
    assert out.said == ['inner', '1', 'default']
    assert out.status == 1
    assert "parameter 'c' not found" in out.error


def test_typed_texts(launch: Any) -> None:
    """3.5 A text becomes a value of the asked type, or an error."""
    out = launch.script(
        """
        from typing import List
        from launch.utilities.type_utils import perform_typed_substitution

        def attempt(text, kind):
            value = TextSubstitution(text=text)
            try:
                print(repr(perform_typed_substitution(LaunchContext(), [value], kind)))
            except (ValueError, TypeError):
                print('refused')

        for text in ['1', '1.5', 'true', 'text', '[1, 2]', '[a, b]', '[1, a]', '{a: 1}']:
            attempt(text, None)
        attempt('7', int)
        attempt('7', float)
        attempt('7.5', int)
        attempt('1', bool)
        attempt('off', bool)
        attempt('maybe', bool)
        attempt('7', str)
        attempt('[1, 2]', List[int])
        attempt('[1, a]', List[int])
        attempt('[a, b]', List[str])
        """
    )
    assert out.stdout.splitlines() == [
        *['1', '1.5', 'True', "'text'", '[1, 2]', "['a', 'b']", 'refused', 'refused'],
        *['7', '7.0', 'refused', 'True', 'False', 'refused', "'7'"],
        *['[1, 2]', 'refused', "['a', 'b']"],
    ]
    assert out.err == ''


def test_descriptions(launch: Any) -> None:
    """3.5 Each substitution has a description."""
    out = launch.script(
        """
        for each in [TextSubstitution(text='a'), LaunchConfiguration('a'),
                     NotSubstitution('a'), FileContent('a'), IfElseSubstitution('a', 'b'),
                     EqualsSubstitution('a', 'b'), LaunchLogDir(), PathSubstitution('a')]:
            assert isinstance(each.describe(), str) and each.describe(), each
        print(TextSubstitution(text='a').describe())
        """
    )
    assert (out.stdout, out.err) == ("'a'\n", '')
