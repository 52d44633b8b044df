# SPDX-License-Identifier: Apache-2.0
"""The substitutions."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from launch import LaunchContext
from launch.substitutions import (
    AllSubstitution,
    AndSubstitution,
    AnonName,
    AnySubstitution,
    Command,
    EnvironmentVariable,
    EqualsSubstitution,
    FileContent,
    FindExecutable,
    IfElseSubstitution,
    LaunchConfiguration,
    LaunchLogDir,
    LocalSubstitution,
    NotEqualsSubstitution,
    NotSubstitution,
    OrSubstitution,
    PathJoinSubstitution,
    PathSubstitution,
    PythonExpression,
    SubstitutionFailure,
    TextSubstitution,
    ThisLaunchFile,
    ThisLaunchFileDir,
)
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
import pytest


def test_texts_are_put_together(context: LaunchContext) -> None:
    """Texts, paths and substitutions concatenate without a separator."""
    context.launch_configurations['x'] = 'X'
    parts = normalize_to_list_of_substitutions(['a', Path('/b'), LaunchConfiguration('x')])
    assert perform_substitutions(context, parts) == 'a/bX'


def test_lists_do_not_nest() -> None:
    """A list in a list is an error that names its type."""
    with pytest.raises(TypeError, match="type '<class 'list'>'"):
        normalize_to_list_of_substitutions(['a', ['b']])  # type: ignore[list-item]


def test_text_must_be_a_text() -> None:
    """A number is not a text."""
    with pytest.raises(TypeError, match="type 'int'"):
        TextSubstitution(text=1)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    'default, text',
    [(False, 'False'), (1.5, '1.5'), ('x', 'x'), (['a', 1], 'a1'), (Path('/p'), '/p')],
)
def test_default_of_a_launch_configuration(
    context: LaunchContext,
    default: Any,
    text: str,
) -> None:
    """The default may be anything that has a text."""
    assert LaunchConfiguration('x', default=default).perform(context) == text


def test_missing_launch_configuration(context: LaunchContext) -> None:
    """The failure names the closest launch configuration."""
    context.launch_configurations['use_sim_time'] = 'true'
    with pytest.raises(
        SubstitutionFailure,
        match=("launch configuration 'use_simtime' does not exist. Did you mean 'use_sim_time'"),
    ):
        LaunchConfiguration(['use_', 'simtime']).perform(context)


@pytest.mark.parametrize(
    'expression, error', [('r2d2 == 1', NameError), ('my robot == 1', SyntaxError)]
)
def test_expression_without_quotes(
    context: LaunchContext, expression: str, error: type[Exception]
) -> None:
    """An expression that lacks quotes is shown, with the advice to write them."""
    with pytest.raises(error) as caught:
        PythonExpression(expression).perform(context)
    lines = str(caught.value).splitlines()
    assert lines[1] == f'The expression is: {expression}'
    assert lines[2].startswith('A string in it needs quotes of its own')


def test_no_sums() -> None:
    """A substitution is not added to a text; the error shows the list to be written."""
    for make in (lambda x: '/ns/' + x, lambda x: x + '/topic', lambda x: ['a'] + x):
        with pytest.raises(TypeError, match='write a list, such as .*, LaunchConfiguration'):
            make(LaunchConfiguration('x'))


def test_readable_values() -> None:
    """Substitutions in what is logged can be read."""
    parts = [TextSubstitution(text='a'), LaunchConfiguration(['b', LaunchConfiguration('c')])]
    assert repr(parts) == "[TextSubstitution('a'), LaunchConfiguration('b' + LaunchConfig('c'))]"


def test_path_join(context: LaunchContext) -> None:
    """A part may be a list; an absolute part drops what stands before it."""
    assert PathJoinSubstitution(['a', ['b', '.txt']]).perform(context) == 'a/b.txt'
    assert PathJoinSubstitution(['a', Path('/b'), 'c']).perform(context) == '/b/c'


def test_path_operator(context: LaunchContext) -> None:
    """Substitutions that stand for paths are joined with a slash."""
    path = PathSubstitution(TextSubstitution(text='/a')) / 'b' / TextSubstitution(text='c')
    assert path.perform(context) == '/a/b/c'
    context.extend_locals({'current_launch_file_directory': '/d'})
    assert (ThisLaunchFileDir() / ['e', 'f']).perform(context) == '/d/ef'


def test_environment_variable(context: LaunchContext, monkeypatch: pytest.MonkeyPatch) -> None:
    """The environment of now counts; an empty default is one."""
    variable = EnvironmentVariable('LAUNCH_TEST', default_value='')
    assert variable.perform(context) == ''
    monkeypatch.setenv('LAUNCH_TEST', 'x')
    assert variable.perform(context) == 'x'
    with pytest.raises(SubstitutionFailure, match="'LAUNCH_NONE' does not exist"):
        EnvironmentVariable('LAUNCH_NONE').perform(context)


def test_find_executable(context: LaunchContext) -> None:
    """The failure names the program."""
    assert FindExecutable(name='sh').perform(context).endswith('/sh')
    with pytest.raises(SubstitutionFailure, match="'no_such_program' not found on the PATH"):
        FindExecutable(name=['no_such_', 'program']).perform(context)


def test_command_keeps_the_line_break(context: LaunchContext) -> None:
    """The output is not stripped, and no shell reads the command."""
    assert Command(['echo ', "'a  b' $HOME"]).perform(context) == 'a  b $HOME\n'


@pytest.mark.parametrize(
    'mode, result', [('ignore', 'out\n'), ('warn', 'out\n'), ('capture', 'err\nout\n')]
)
def test_command_with_errors_allowed(context: LaunchContext, mode: str, result: str) -> None:
    """What a command writes to its standard error may be dropped or taken in."""
    command = Command("sh -c 'echo err >&2; echo out'", on_stderr=mode)
    assert command.perform(context) == result


@pytest.mark.parametrize(
    'command, mode, text',
    [
        ("sh -c 'echo err >&2'", 'fail', 'showed stderr output. Command: sh .*\n.*err'),
        (
            "sh -c 'echo why >&2; exit 3'",
            'ignore',
            'executed command failed. Command: sh .*\n.*why',
        ),
        ('no_such_program x', 'fail', 'file not found: .*no_such_program'),
        ('echo', 'nonsense', "invalid on_stderr 'nonsense'"),
        ("echo 'x", 'fail', 'cannot be run: No closing quotation'),
    ],
)
def test_command_failures(context: LaunchContext, command: str, mode: str, text: str) -> None:
    """A failure tells the command and what it said."""
    with pytest.raises(SubstitutionFailure, match=text):
        Command(command, on_stderr=mode).perform(context)


@pytest.mark.parametrize('mode', ['fail', 'warn', 'capture'])
def test_hints_of_a_command(
    context: LaunchContext, mode: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """A line `PROGRAM: hint: ...` is a warning, and neither a failure nor a result."""
    command = Command("sh -c 'echo sh: hint: look >&2; echo out'", on_stderr=mode)
    assert command.perform(context) == 'out\n'
    out = capsys.readouterr().out
    assert out == '[WARNING] [launch.substitutions.command]: sh: hint: look\n'


def test_missing_file_is_told_once(context: LaunchContext) -> None:
    """What the command itself says of a missing file is not said again."""
    text = "the file '/nowhere' does not exist"
    for said in (text, 'no'):
        command = ['sh -c "echo \\"', said, '\\" >&2; exit 1" /nowhere']
        with pytest.raises(SubstitutionFailure) as caught:
            Command(command).perform(context)
        lines = str(caught.value).splitlines()[1:]
        assert sum(text in line for line in lines) == 1


def test_path_that_became_several_words(context: LaunchContext, tmp_path: Path) -> None:
    """A path with a space that nobody quoted is named, and how to quote it."""
    path = tmp_path / 'my ws' / 'arm.xacro'
    path.parent.mkdir()
    path.touch()
    context.launch_configurations['path'] = str(path)
    with pytest.raises(SubstitutionFailure) as caught:
        Command(['cat ', LaunchConfiguration('path')]).perform(context)
    assert str(caught.value).splitlines()[-1] == (
        f"The path '{path}' contains a space, and was split into several words. "
        """Quote it: Command(['cat "', path, '"'])"""
    )
    assert Command(['cat "', LaunchConfiguration('path'), '"']).perform(context) == ''


@pytest.mark.parametrize(
    'parts, question',
    [
        (['cat', 'arm.urdf'], "Is a space missing after 'cat'?"),
        (['no_such_program', 'arm.urdf'], ''),
        (['no_such_program ', 'arm.urdf'], ''),
    ],
)
def test_missing_blank(context: LaunchContext, parts: list[str], question: str) -> None:
    """A program that runs into its first argument is asked about."""
    with pytest.raises(SubstitutionFailure) as caught:
        Command(parts).perform(context)
    first, *more = str(caught.value).splitlines()
    assert first.startswith('file not found: ')
    assert [line.split('? ')[0] + '?' for line in more] == [question] * bool(question)


def test_python_expression(context: LaunchContext) -> None:
    """The members of math are known by name, other modules only when they are listed."""
    context.launch_configurations['n'] = '4'
    assert PythonExpression(['sqrt(', LaunchConfiguration('n'), ')']).perform(context) == '2.0'
    assert PythonExpression('1 == 1').perform(context) == 'True'
    assert PythonExpression('os.sep', ['os']).perform(context) == '/'
    with pytest.raises(NameError, match="'os' is not defined"):
        PythonExpression('os.sep').perform(context)


def test_launch_file_outside_of_one(context: LaunchContext) -> None:
    """There must be a launch file to have its path."""
    for substitution in (ThisLaunchFile(), ThisLaunchFileDir()):
        with pytest.raises(SubstitutionFailure, match='no launch file is being read'):
            substitution.perform(context)


def test_log_dir(context: LaunchContext, tmp_path: Path) -> None:
    """The folder is that of the run."""
    assert LaunchLogDir().perform(context).startswith(str(tmp_path / 'log'))


def test_local_substitution(context: LaunchContext) -> None:
    """An expression on the locals must be a text."""
    context.extend_locals({'event': Path('/a/b')})
    assert LocalSubstitution('event.name').perform(context) == 'b'
    with pytest.raises(SubstitutionFailure, match="of type 'PosixPath'"):
        LocalSubstitution('event.parent').perform(context)


def test_anonymous_name(context: LaunchContext) -> None:
    """A name stays the same within a launch, and is allowed as the name of a node."""
    name = AnonName('camera-1').perform(context)
    assert name == AnonName(['camera', '-1']).perform(context)
    assert name.startswith('camera_1_') and not set(name) & set('.-:')
    assert AnonName('camera-1').perform(LaunchContext()) != name


def test_file_content(context: LaunchContext, tmp_path: Path) -> None:
    """The whole text is taken."""
    (tmp_path / 'f').write_text('a\nb\n')
    assert FileContent(tmp_path / 'f').perform(context) == 'a\nb\n'
    with pytest.raises(SubstitutionFailure, match='File not found: /nope'):
        FileContent('/nope').perform(context)


@pytest.mark.parametrize(
    'substitution, text',
    [
        (NotSubstitution('yes'), 'false'),
        (NotSubstitution('0'), 'true'),
        (AndSubstitution('on', '1'), 'true'),
        (AndSubstitution('true', 'False'), 'false'),
        (OrSubstitution('off', 'no'), 'false'),
        (OrSubstitution('off', 'TRUE'), 'true'),
        (AnySubstitution('0', '0', '1'), 'true'),
        (AnySubstitution(), 'false'),
        (AllSubstitution('1', '1', '0'), 'false'),
        (AllSubstitution(), 'true'),
    ],
)
def test_logic(context: LaunchContext, substitution: Any, text: str) -> None:
    """Truth values are read by YAML rules and written in lower case."""
    assert substitution.perform(context) == text


def test_logic_on_something_else(context: LaunchContext) -> None:
    """A text that is no truth value is a failure that tells it."""
    with pytest.raises(SubstitutionFailure, match="cannot read 'perhaps' as a boolean"):
        NotSubstitution('perhaps').perform(context)


@pytest.mark.parametrize(
    'left, right, equal',
    [
        ('1.0', '1', True),
        (True, '1', True),
        (None, '', True),
        (0.1 + 0.2, 0.3, True),
        ('True', 'true', True),
        ('a', 'A', False),
        ('1', '2', False),
        (False, 'x', False),
    ],
)
def test_comparison(context: LaunchContext, left: Any, right: Any, equal: bool) -> None:
    """Values are compared as truth values, as numbers, or else as texts."""
    assert EqualsSubstitution(left, right).perform(context) == str(equal).lower()
    assert NotEqualsSubstitution(left, right).perform(context) == str(not equal).lower()


def test_if_else(context: LaunchContext) -> None:
    """Only the text that is chosen is performed."""
    missing = LaunchConfiguration('missing')
    assert IfElseSubstitution('yes', 'a', missing).perform(context) == 'a'
    assert IfElseSubstitution('no', missing, 'b').perform(context) == 'b'
    with pytest.raises(RuntimeError, match='both are empty'):
        IfElseSubstitution('yes')


@pytest.mark.parametrize(
    'substitution, text',
    [
        (TextSubstitution(text='a'), "'a'"),
        (LaunchConfiguration('x'), "LaunchConfig('x')"),
        (EnvironmentVariable('HOME'), "EnvVar('HOME')"),
        (
            PathJoinSubstitution([LaunchConfiguration('p'), 'x']),
            "PathJoin('LaunchConfig('p') + 'x'')",
        ),
        (
            PythonExpression(['1+', LaunchConfiguration('b')]),
            "PythonExpr('1+' + LaunchConfig('b'), ['math'])",
        ),
        (Command(['echo ', 'hi']), "Command('echo ' + 'hi')"),
        (FindExecutable(name='xacro'), "FindExec('xacro')"),
        (AnonName('x'), "AnonName('x')"),
        (ThisLaunchFileDir(), 'ThisLaunchFileDir()'),
        (LocalSubstitution('event.pid', 'pid'), "LocalVar('pid')"),
    ],
)
def test_descriptions(substitution: Any, text: str) -> None:
    """The descriptions are what `--show-args` shows as defaults."""
    assert substitution.describe() == text
