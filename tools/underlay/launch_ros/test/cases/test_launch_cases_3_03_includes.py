# SPDX-License-Identifier: Apache-2.0
"""Cases of section 3.3: including files, and what descriptions come from."""

from __future__ import annotations

from typing import Any

import pytest

SAY = "LogInfo(msg=LaunchConfiguration('a', default='nothing')),"


def test_sources(launch: Any) -> None:
    """3.3 The source is an object, or any text or substitution; parts of a path concatenate."""
    out = launch(
        """
        SetLaunchConfiguration('name', 'child'),
        IncludeLaunchDescription('child.launch.py'),
        IncludeLaunchDescription([LaunchConfiguration('name'), '.launch', '.py']),
        IncludeLaunchDescription(PathJoinSubstitution(['.', 'child.launch.py'])),
        IncludeLaunchDescription(PythonLaunchDescriptionSource('child.launch.py')),
        IncludeLaunchDescription(PythonLaunchDescriptionSource(
            [ThisLaunchFileDir(), '/child', '.launch.py'])),
        IncludeLaunchDescription(AnyLaunchDescriptionSource('child.launch.py')),
        IncludeLaunchDescription(LaunchDescriptionSource(
            LaunchDescription([LogInfo(msg='made here')]))),
        """,
        files={'child.launch.py': SAY},
    )
    assert (out.status, out.said) == (0, [*['nothing'] * 6, 'made here'])


def test_arguments_of_an_include(launch: Any) -> None:
    """3.3 Arguments are any pairs, read at once; names and values may have several parts."""
    out = launch(
        """
        pairs = {'a': '1'}
        first = IncludeLaunchDescription('child.launch.py', launch_arguments=pairs.items())
        second = IncludeLaunchDescription(
            'child.launch.py', launch_arguments=((name, value) for name, value in [('a', '2')]))
        pairs['a'] = 'too late'
        third = IncludeLaunchDescription(
            'child.launch.py', launch_arguments=[(['a'], ['3', TextSubstitution(text='!')])])
        print(first.launch_arguments, second.launch_arguments, flush=True)
        ---
        first, second, third,
        """,
        files={'child.launch.py': SAY},
    )
    assert out.said == ['1', '2', '3!']
    assert "(('a', '1'),) (('a', '2'),)" in out.stdout


def test_values_of_arguments_are_texts(launch: Any) -> None:
    """3.3 A bool as the value of an argument is an error when the include is visited."""
    out = launch(
        "LogInfo(msg='before'), IncludeLaunchDescription('child.launch.py', "
        "launch_arguments={'a': True}.items()),",
        files={'child.launch.py': SAY},
    )
    assert (out.status, out.said) == (1, ['before'])
    assert 'bool' in out.error


def test_order_of_an_include(launch: Any) -> None:
    """3.3 The location is found with the configurations of before, the arguments come later."""
    out = launch(
        """
        SetLaunchConfiguration('which', 'one'),
        IncludeLaunchDescription(
            [LaunchConfiguration('which'), '.launch.py'],
            launch_arguments=[('which', 'two'), ('place', ThisLaunchFileDir())]),
        """,
        files={
            'sub/x': '',
            'one.launch.py': "LogInfo(msg=['one: ', LaunchConfiguration('which')]),",
            'two.launch.py': "LogInfo(msg='two'),",
        },
    )
    assert out.said == ['one: two']


PLACES = """
    LogInfo(msg=ThisLaunchFile()),
    GroupAction([IncludeLaunchDescription('sub/child.launch.py')]),
    LogInfo(msg=ThisLaunchFileDir()),
    LogInfo(msg=LocalSubstitution('current_launch_file_path')),
    LogInfo(msg=LocalSubstitution('current_launch_file_directory')),
"""


def test_location_of_the_file(launch: Any) -> None:
    """3.3 A file knows its absolute path; behind an include, also a scoped one, the child's."""
    files = {'sub/child.launch.py': 'LogInfo(msg=ThisLaunchFileDir()),'}
    out = launch(PLACES, files=files)
    assert out.said == [
        *['HERE/it.launch.py', 'HERE/sub', 'HERE/sub', 'HERE/sub/child.launch.py', 'HERE/sub']
    ]
    (warning,) = (line for line in out.lines if line.startswith('[WARNING]'))
    assert 'ThisLaunchFileDir' in warning


def test_location_of_the_file_in_a_scope(launch: Any) -> None:
    """3.3 With an option the place is restored behind an include (section 6)."""
    files = {'sub/child.launch.py': 'LogInfo(msg=ThisLaunchFileDir()),'}
    launch(PLACES, files=files)
    out = launch.run('launch', '--scoped-location', 'it.launch.py').end()
    assert out.said == [*['HERE/it.launch.py', 'HERE/sub', 'HERE', 'HERE/it.launch.py', 'HERE']]
    assert 'WARNING' not in out.text


REQUIRED = """
    GroupAction([DeclareLaunchArgument('need', description='what it needs')]),
    DeclareLaunchArgument('free', default_value='1'),
    LogInfo(msg=LaunchConfiguration('need')),
"""


def test_required_arguments_must_be_given_to_the_include(launch: Any) -> None:
    """3.3 An argument without a default must be named by this include; being set is no help."""
    out = launch(
        """
        SetLaunchConfiguration('need', 'set'),
        LogInfo(msg='before'),
        IncludeLaunchDescription('child.launch.py', launch_arguments=[('x', '1'), ('y', '2')]),
        """,
        'need:=given',
        files={'child.launch.py': REQUIRED},
    )
    assert (out.status, out.said) == (1, ['before'])
    assert out.error.startswith(
        "Included launch description missing required argument 'need' (description: "
        "'what it needs'), given: [x, y]"
    )


def test_required_arguments_of_nested_files(launch: Any) -> None:
    """3.3 What an include inside the included file gives counts; conditional ones are free."""
    files = {
        'child.launch.py': REQUIRED,
        'gives.launch.py': "IncludeLaunchDescription('child.launch.py', "
        "launch_arguments=[('need', 'inside')]),",
        'passes.launch.py': "IncludeLaunchDescription('child.launch.py'),",
        'free.launch.py': "DeclareLaunchArgument('cond', condition=IfCondition('false')),",
    }
    out = launch(
        """
        IncludeLaunchDescription('gives.launch.py'),
        IncludeLaunchDescription('free.launch.py'),
        """,
        files=files,
    )
    assert (out.status, out.said) == (0, ['inside'])
    out = launch("IncludeLaunchDescription('passes.launch.py'),", files=files)
    assert out.status == 1
    assert "missing required argument 'need'" in out.error
    assert out.said == []


def test_undeclared_arguments_are_accepted(launch: Any) -> None:
    """3.3 An include may be given arguments that its file does not declare."""
    out = launch(
        "IncludeLaunchDescription('c.launch.py', launch_arguments=[('a', 'extra')]),",
        files={'c.launch.py': SAY},
    )
    assert (out.status, out.said) == (0, ['extra'])


ARGUMENTS = """
    DeclareLaunchArgument('speed', default_value='1'),
    LogInfo(msg=LaunchConfiguration('looked_up', default='')),
    ExecuteProcess(cmd=['rec']),
"""


def test_undeclared_arguments_of_the_command_line(launch: Any) -> None:
    """3.3 Undeclared arguments are set; what nobody looks up is told, or refused (issue)."""
    out = launch(ARGUMENTS, 'looked_up:=yes')
    assert (out.status, out.said) == (0, ['yes'])
    assert 'WARN' not in out.text
    out = launch(ARGUMENTS, 'nothing_like_it:=1')
    assert (out.status, len(out.runs)) == (0, 1)
    assert any('nothing_like_it' in line for line in out.lines if line.startswith('[WARNING]'))
    out = launch(ARGUMENTS, 'sped:=1')
    assert (out.status, out.runs) == (1, [])
    assert "'sped'" in out.stdout + out.err and "'speed'" in out.stdout + out.err
    launch.write('it.launch.py', ARGUMENTS)
    out = launch.run('launch', '--allow-unknown-args', 'it.launch.py', 'sped:=1', 'z:=2').end()
    assert (out.status, len(out.runs)) == (0, 1)
    assert 'WARN' not in out.text


def test_a_file_is_executed_once(launch: Any) -> None:
    """3.3 A Python file is executed once for each of its includes (section 6)."""
    out = launch(
        "print('top')\n---\nIncludeLaunchDescription('child.launch.py'),",
        files={'child.launch.py': "print('child')\n---\nLogInfo(msg='x'),"},
    )
    assert sorted(line for line in out.lines if not line.startswith('[')) == ['child', 'top']


def test_what_cannot_be_looked_into_beforehand_is_no_error(launch: Any) -> None:
    """3.3 A file that is only found with the launch's configurations is found in time."""
    out = launch(
        """
        DeclareLaunchArgument('which', default_value='child'),
        IncludeLaunchDescription([LaunchConfiguration('which'), '.launch.py']),
        IncludeLaunchDescription('missing.launch.py', condition=IfCondition('0')),
        IncludeLaunchDescription([FindPackageShare('none'), '/a.py'], condition=IfCondition('0')),
        """,
        files={'child.launch.py': SAY},
    )
    assert (out.status, out.said) == (0, ['nothing'])


def test_source_object(launch: Any) -> None:
    """3.3 A source tells its location and method, and loads with or without a context."""
    launch.write('child.launch.py', SAY)
    out = launch.script(
        """
        source = PythonLaunchDescriptionSource(['child', '.launch.py'])
        print(source.location, '|', source.method)
        context = LaunchContext()
        description = source.get_launch_description(context)
        print(len(description.entities), source.location)
        print(len(source.try_get_launch_description_without_context().entities))
        needs = PythonLaunchDescriptionSource([LaunchConfiguration('x'), '.launch.py'])
        print(needs.try_get_launch_description_without_context())
        """
    )
    lines = out.stdout.splitlines()
    assert lines[1:] == ['1 child.launch.py', '1', 'None']


def test_python_files(launch: Any) -> None:
    """3.3 A Python file is executed from its source, and is in neither sys.modules nor path."""
    out = launch(
        """
        import sys
        import os

        before = list(sys.path)

        def generate_launch_description():
            return LaunchDescription([OpaqueFunction(function=look)])

        def look(context):
            print(__name__, os.path.basename(__file__), flush=True)
            print('python_launch_file' in sys.modules, os.path.dirname(__file__) in sys.path)
            from launch.launch_description_sources import load_python_launch_file_as_module
            print(load_python_launch_file_as_module('other.py').answer(), flush=True)
        """,
        files={'other.py': 'def answer():\n    return 42\n# generate_launch_description\n'},
    )
    printed = [line for line in out.lines if not line.startswith('[')]
    assert printed == ['python_launch_file it.launch.py', 'False False', '42']


def test_python_file_without_the_function(launch: Any) -> None:
    """3.3 A Python file that has no generate_launch_description() says so."""
    out = launch('nothing = 1  # but for generate_launch_description\n')
    assert out.status == 1
    assert (
        "launch file at 'it.launch.py' does not contain the required function "
        "'generate_launch_description()'"
    ) in out.error


FORMATS = {
    'p.launch.py': "LogInfo(msg='py'),",
    'x.launch.xml': '<log message="xml"/>',
    'y.launch.yaml': '- log: {message: yaml}',
    'y.launch.yml': 'launch:\n- log: {message: yml}',
    'x.launch': '<launch><log message="launch"/></launch>',
    'x.xml': '<launch><log message="plain xml"/></launch>',
    'y.yaml': 'launch:\n- log: {message: plain yaml}',
    'y.yml': 'launch:\n- log: {message: plain yml}',
    'none': '<launch><log message="no ending"/></launch>',
    'other.txt': 'launch:\n- log: {message: other ending}',
    'yaml.launch': 'launch:\n- log: {message: yaml behind launch}',
    'python.txt': (
        'from launch import LaunchDescription as D\nfrom launch.actions import LogInfo as L\n'
        "def generate_launch_description():\n    return D([L(msg='Python behind txt')])\n"
    ),
}


def test_any_format(launch: Any) -> None:
    """3.3 The ending of the file says what is tried first; other formats are tried too."""
    out = launch(
        ''.join(f"IncludeLaunchDescription('{name}'),\n" for name in FORMATS),
        files=FORMATS,
    )
    assert (out.status, out.said) == (
        0,
        [
            *['py', 'xml', 'yaml', 'yml', 'launch', 'plain xml', 'plain yaml', 'plain yml'],
            *['no ending', 'other ending', 'yaml behind launch', 'Python behind txt'],
        ],
    )


@pytest.mark.parametrize(
    ('source', 'name', 'said'),
    [
        ('FrontendLaunchDescriptionSource', 'x.launch.xml', 'xml'),
        ('FrontendLaunchDescriptionSource', 'y.launch.yaml', 'yaml'),
        ('XMLLaunchDescriptionSource', 'x.launch.xml', 'xml'),
        ('YAMLLaunchDescriptionSource', 'y.launch.yaml', 'yaml'),
    ],
)
def test_sources_of_one_format(source: str, name: str, said: str, launch: Any) -> None:
    """3.3 There is a source for each format."""
    out = launch(f"IncludeLaunchDescription({source}('{name}')),", files=FORMATS)
    assert (out.status, out.said) == (0, [said])


@pytest.mark.parametrize(
    ('name', 'text', 'errors'),
    [
        (
            'it.launch.py',
            "def generate_launch_description():\n    raise TypeError('no way')\n",
            [
                'Caught multiple exceptions when trying to load file of format [py]:',
                ' - TypeError: no way',
                ' - InvalidFrontendLaunchFileError: The launch file may have a syntax error, or '
                'its format is unknown',
            ],
        ),
        (
            'it.launch.xml',
            '<launch><log></launch>',
            [
                'Caught multiple exceptions when trying to load file of format [xml]:',
                ' - InvalidFrontendLaunchFileError: the file is not XML: ',
                ' - SyntaxError: ',
            ],
        ),
        (
            'it.txt',
            'neither of them',
            ['The launch file may have a syntax error, or its format is unknown'],
        ),
    ],
)
def test_files_that_no_loader_takes(name: str, text: str, errors: list[str], launch: Any) -> None:
    """3.3 If nothing can load a file, the errors of the loaders are told together."""
    out = launch(text, name=name)
    assert out.status == 1
    lines = out.error.splitlines()
    for expected, line in zip(errors, lines):
        assert line.startswith(expected)
