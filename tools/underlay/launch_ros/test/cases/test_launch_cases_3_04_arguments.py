# SPDX-License-Identifier: Apache-2.0
"""Cases of section 3.4: launch arguments and how they are shown."""

from __future__ import annotations

from textwrap import dedent, indent
from typing import Any

import pytest


def test_default_and_given_value(launch: Any) -> None:
    """3.4 A default is performed and stored only if the argument is not set."""
    entities = """
        DeclareLaunchArgument('a', default_value='1'),
        DeclareLaunchArgument('b', default_value=['b', LaunchConfiguration('a')]),
        SetLaunchConfiguration('c', 'set'),
        DeclareLaunchArgument('c', default_value=LaunchConfiguration('never performed')),
        DeclareLaunchArgument(name='d', default_value=''),
        *[LogInfo(msg=[name, '=', LaunchConfiguration(name)]) for name in 'abcd'],
    """
    assert launch(entities).said == ['a=1', 'b=b1', 'c=set', 'd=']
    out = launch(entities, 'a:=2', 'd:=x:=y', 'a:=3')
    assert out.said == ['a=3', 'b=b3', 'c=set', 'd=x:=y']


def test_required_argument(launch: Any) -> None:
    """3.4 An argument without a default that is not set is an error of two lines."""
    out = launch(
        """
        OpaqueFunction(function=lambda context: [
            DeclareLaunchArgument('need', description='for this'), LogInfo(msg='never')]),
        """
    )
    error = 'Required launch argument "need" (description: "for this") was not provided'
    assert (out.status, out.said) == (1, [])
    assert f'[ERROR] [launch.actions.declare_launch_argument]: {error}' in out.lines
    assert out.error.startswith(error)


def test_choices(launch: Any) -> None:
    """3.4 A value among the choices is taken, and compared as a text."""
    entities = """
        DeclareLaunchArgument('b', default_value='bee', choices=['bee', 'cee']),
        DeclareLaunchArgument('t', default_value='1', choices=('1', '2')),
        DeclareLaunchArgument('s', default_value=LaunchConfiguration('b'), choices={'cee'}),
        LogInfo(msg=LaunchConfiguration('b')),
    """
    assert launch(entities, 'b:=cee').said == ['cee']
    out = launch(entities, 'b:=zzz')
    error = 'Argument "b" provided value "zzz" is not valid. Valid options are: [\'bee\', \'cee\']'
    assert (out.status, out.said) == (1, [])
    assert f'[ERROR] [launch.actions.declare_launch_argument]: {error}' in out.lines
    assert out.error.startswith(error)
    out = launch(entities, 't:=3')
    assert "provided value \"3\" is not valid. Valid options are: ('1', '2')" in out.error
    out = launch(entities)
    assert out.error.startswith('Argument "s" provided value "bee" is not valid.')


def test_choices_that_are_no_texts_never_match(launch: Any) -> None:
    """3.4 A choice that is no text matches no value."""
    out = launch("DeclareLaunchArgument('n', choices=[1, 2]),", 'n:=1')
    assert out.status == 1
    assert 'Argument "n" provided value "1" is not valid. Valid options are: [1, 2]' in out.error


@pytest.mark.parametrize(
    ('arguments', 'error'),
    [
        ('choices=[]', 'choices'),
        (
            "default_value='z', choices=['a', 'b']",
            'Provided default_value "z" is not in provided choices "[\'a\', \'b\']".',
        ),
    ],
)
def test_wrong_choices(arguments: str, error: str, launch: Any) -> None:
    """3.4 No choices, or a plain default that is none of them, are errors when it is made."""
    out = launch(f"LogInfo(msg='never'), DeclareLaunchArgument('a', {arguments}),", 'a:=a')
    assert (out.status, out.said) == (1, [])
    logged = [line for line in out.lines if '[launch.actions.declare_launch_argument]' in line]
    assert logged and error in logged[0]
    assert error in out.error


def test_position_matters(launch: Any) -> None:
    """3.4 An argument exists behind its declaration, and inside the scope of it."""
    out = launch(
        "LogInfo(msg=LaunchConfiguration('a')), DeclareLaunchArgument('a', default_value='1'),"
    )
    assert "launch configuration 'a' does not exist" in out.error
    out = launch(
        """
        GroupAction([DeclareLaunchArgument('a', default_value='1')]),
        LogInfo(msg=LaunchConfiguration('a', default='gone')),
        """
    )
    assert out.said == ['gone']


HEADER = "Arguments (pass arguments as '<name>:=<value>'):\n"


def test_show_args(launch: Any) -> None:
    """3.4 The arguments are shown with their descriptions, choices and defaults, to the byte."""
    out = launch.show_args(
        r"""
        DeclareLaunchArgument('need', description='must be given'),
        DeclareLaunchArgument('bare', default_value=''),
        DeclareLaunchArgument('one', choices=['a', 'b']),
        DeclareLaunchArgument('two', choices=('a', 'b'), description='Which'),
        DeclareLaunchArgument('dot', choices=['a'], description='Which.', default_value='a'),
        DeclareLaunchArgument('lines', description='first\n  second'),
        LogInfo(msg='is not visited'),
        ExecuteProcess(cmd=['rec']),
        """
    )
    assert out.stdout == HEADER + indent(
        dedent(
            """
            'need':
                must be given

            'bare':
                no description given
                (default: '')

            'one':
                One of: ['a', 'b']

            'two':
                Which. Valid choices are: ('a', 'b')

            'dot':
                Which. Valid choices are: ['a']
                (default: 'a')

            'lines':
                first
          second
        """
        ),
        '  ',
        str.strip,
    )
    assert (out.status, out.err, out.runs) == (0, '', [])


DEFAULTS = {
    "['a', 'b']": "'a' + 'b'",
    "LaunchConfiguration('x')": "LaunchConfig('x')",
    "EnvironmentVariable('HOME')": "EnvVar('HOME')",
    "PathJoinSubstitution([FindPackageShare('p'), 'x.yaml'])": (
        "PathJoin('FindPackageShare(pkg='p') + 'x.yaml'')"
    ),
    "PythonExpression(['1+', LaunchConfiguration('b')])": (
        "PythonExpr('1+' + LaunchConfig('b'), ['math'])"
    ),
    "Command(['echo ', 'hi'])": "Command('echo ' + 'hi')",
    "FindExecutable(name='xacro')": "FindExec('xacro')",
    "AnonName('x')": "AnonName('x')",
    'ThisLaunchFileDir()': 'ThisLaunchFileDir()',
    "LocalSubstitution('x.y')": "LocalVar('x.y')",
    "['a ', LaunchConfiguration('x')]": "'a ' + LaunchConfig('x')",
}


def test_show_args_describes_defaults(launch: Any) -> None:
    """3.4 A default that is not a text is shown by the description of its parts."""
    out = launch.show_args(
        ''.join(
            f"DeclareLaunchArgument('a{n}', default_value={default}),\n"
            for n, default in enumerate(DEFAULTS)
        )
    )
    prefix = '        (default: '
    shown = [line for line in out.stdout.splitlines() if line.startswith(prefix)]
    assert shown == [f'{prefix}{text})' for text in DEFAULTS.values()]


def test_show_args_without_any(launch: Any) -> None:
    """3.4 If there are none, that is said; still there is a log folder."""
    out = launch.show_args("LogInfo(msg='x'),")
    assert out.stdout == HEADER + '\n  No arguments.\n'
    assert out.status == 0
    assert (out.here / 'log/latest').is_symlink()


def test_show_args_finds_declarations(launch: Any) -> None:
    """3.4 Declarations are found in depth; the first of a name counts; * means conditional."""
    out = launch.show_args(
        """
        if_ = IfCondition(LaunchConfiguration('go', default='0'))
        arg = DeclareLaunchArgument
        ---
        arg('first', default_value='1'),
        GroupAction([arg('first', default_value='2'), arg('grouped', default_value='1')]),
        arg('own', condition=if_),
        GroupAction([arg('in_group'), GroupAction([arg('deeper')])], condition=if_),
        IncludeLaunchDescription('child.launch.py', condition=if_),
        TimerAction(period=1.0, actions=[arg('in_timer')]),
        RegisterEventHandler(OnShutdown(on_shutdown=[arg('in_handler')])),
        OpaqueFunction(function=lambda context: [arg('invisible')]),
        IncludeLaunchDescription('missing.launch.py'),
        GroupAction([arg('isolated')], forwarding=False),
        arg('last'),
        """,
        files={'child.launch.py': "DeclareLaunchArgument('included'),"},
    )
    lines = out.stdout.splitlines()
    assert [line.strip() for line in lines if line.startswith("    '")] == [
        *["'first':", "'grouped':", "'own':*", "'in_group':*", "'deeper':", "'included':"],
        *["'in_timer':*", "'in_handler':*", "'last':"],
    ]
    assert "        (default: '1')" in lines
    assert "        (default: '2')" not in lines
    assert lines[-2:] == ['', '* argument(s) which are only used if specific conditions occur']


def test_false_include_still_needs_its_arguments(launch: Any) -> None:
    """3.4 An include inside the file that will not happen still needs its required arguments."""
    files = {'child.launch.py': "DeclareLaunchArgument('need'),"}
    entities = """
        IncludeLaunchDescription('child.launch.py', condition=IfCondition('false'){given}),
        LogInfo(msg='done'),
    """
    out = launch(entities.replace('{given}', ''), files=files)
    assert out.status == 1
    assert "missing required argument 'need'" in out.error
    given = ", launch_arguments=[('need', '1')]"
    out = launch(entities.replace('{given}', given), files=files)
    assert (out.status, out.said) == (0, ['done'])


def test_show_args_of_a_broken_file(launch: Any) -> None:
    """3.4 A file that cannot be loaded is an error with status 1."""
    out = launch.show_args("raise RuntimeError('broken')  # generate_launch_description\n")
    assert out.status == 1
    assert 'broken' in out.err
