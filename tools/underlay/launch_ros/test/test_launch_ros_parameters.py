# SPDX-License-Identifier: Apache-2.0
"""The parameters of nodes."""

from __future__ import annotations

from collections.abc import Callable
import math
from pathlib import Path
from typing import Any

from launch import LaunchContext
from launch.actions import SetLaunchConfiguration
from launch.failures import place_of
from launch.substitutions import LaunchConfiguration, TextSubstitution
from launch_ros.actions import PushRosNamespace
from launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue
from launch_ros.utilities import evaluate_parameters, normalize_parameters
from launch_ros.utilities.parameter_files import flow_text
import pytest
import yaml

Words = Callable[..., list[str]]


def _sub(text: str) -> TextSubstitution:
    return TextSubstitution(text=text)


def _evaluated(context: LaunchContext, value: Any) -> Any:
    """Return what a parameter of this value is for a node."""
    found = evaluate_parameters(context, normalize_parameters([{'p': value}]))[0]
    assert isinstance(found, dict)
    return found['p']


def _file(words: list[str]) -> dict[str, Any]:
    """Return the content of the only parameter file on a command line."""
    path = words[words.index('--params-file') + 1]
    content: dict[str, Any] = yaml.safe_load(Path(path).read_text(encoding='utf-8'))
    return content


@pytest.mark.parametrize(
    'value, expected',
    [
        (True, True),
        (5, 5),
        (1.5, 1.5),
        ('true', 'true'),
        ('1.0', '1.0'),
        ('', ''),
        ([1, 2], [1, 2]),
        ((1, 2.5), [1.0, 2.5]),
        ([True], [True]),
        (['a', '1'], ['a', '1']),
        (Path('/a'), '/a'),
        (_sub('5'), 5),
        (_sub('yes'), True),
        (_sub('1.5'), 1.5),
        (_sub('1e-3'), 0.001),
        (_sub('word'), 'word'),
        (_sub(''), ''),
        (_sub('[1, 2.5]'), [1.0, 2.5]),
        ([_sub('1'), '2'], 12),
        ([[_sub('a'), 'b'], ['c']], ['ab', 'c']),
        ([[_sub('1')], ['2']], [1, 2]),
        (ParameterValue(_sub('5'), value_type=str), '5'),
        (ParameterValue('5'), 5),
        (ParameterValue(_sub('5'), value_type=float), 5.0),
        (ParameterValue(3), 3),
        (ParameterValue(_sub('[1]'), value_type=list[float]), [1.0]),
    ],
)
def test_types(context: LaunchContext, value: Any, expected: Any) -> None:
    """A text stays a text; a substitution gets its type by YAML rules; others stay."""
    assert repr(_evaluated(context, value)) == repr(expected)


@pytest.mark.parametrize(
    'value, text',
    [
        (None, "Unexpected type for parameter value None of the parameter 'p'"),
        ([], 'non-empty sequence'),
        ([1, 'a'], 'Got inconsistent input for "p"'),
        ([1, True], 'inconsistent'),
        (_sub('{a: 1}'), """Got <class 'dict'> for "p". If the param"""),
        (_sub('null'), "Got <class 'NoneType'>"),
        (_sub('[1, a]'), 'inconsistent'),
        (_sub('a: b: c'), 'Unable to parse the value of parameter p as yaml. If the parameter is'),
        ([['a'], [_sub('1')]], 'inconsistent'),
    ],
)
def test_wrong_values(context: LaunchContext, value: Any, text: str) -> None:
    """The error of a value that is not allowed names the parameter."""
    with pytest.raises(TypeError) as error:
        _evaluated(context, value)
    assert text in str(error.value)


def test_value_of_another_type(context: LaunchContext) -> None:
    """A value must have the type that it is given."""
    with pytest.raises(ValueError):
        _evaluated(context, ParameterValue(_sub('x'), value_type=int))
    with pytest.raises(TypeError, match="not of type 'int'"):
        ParameterValue(1.5, value_type=int)


@pytest.mark.parametrize(
    'kwargs, key',
    [
        ({}, '/**'),
        ({'name': 'n'}, '/**'),
        ({'namespace': 'a'}, '/**'),
        ({'name': 'n', 'namespace': 'a'}, '/a/n'),
        ({'name': 'n', 'namespace': ''}, '/n'),
    ],
)
def test_file_of_a_dictionary(words: Words, kwargs: Any, key: str) -> None:
    """A dictionary becomes a file for the node, or for any if its full name is not known."""
    found = _file(words(parameters=[{'b': {'c': 1, 'd': {'e': "it's"}}, 'a': True}], **kwargs))
    assert found == {key: {'ros__parameters': {'a': True, 'b.c': 1, 'b.d.e': "it's"}}}


def test_pushed_namespace_counts_as_known(words: Words) -> None:
    """A file is for the full name below the namespace that was pushed."""
    found = _file(words(PushRosNamespace('a'), parameters=[{'p': 1}], name='n'))
    assert list(found) == ['/a/n']


def test_names_may_be_substitutions(words: Words) -> None:
    """The name of a parameter may have parts that are known later."""
    found = _file(
        words(SetLaunchConfiguration('x', 'y'), parameters=[{(LaunchConfiguration('x'), '.z'): 1}])
    )
    assert found['/**']['ros__parameters'] == {'y.z': 1}


def test_files_keep_their_place(words: Words, tmp_path: Path) -> None:
    """Elements keep their order; a file that is missing is left out with a warning."""
    first, second = tmp_path / 'first.yaml', tmp_path / 'second.yaml'
    first.touch()
    second.touch()
    found = words(
        parameters=[
            str(first),
            {'a': 1},
            '/no.yaml',
            ParameterFile([_sub(str(tmp_path)), '/second.yaml']),
            Parameter('p', 'true'),
            Parameter('q', _sub('[1, 2]')),
        ]
    )
    files = [found[i + 1] for i, word in enumerate(found) if word == '--params-file']
    assert [files[0], files[2]] == [str(first), str(second)] and len(files) == 3
    assert found[-4:] == ['-p', 'p:=true', '-p', 'q:=[1, 2]']


def test_missing_file_is_reported(
    words: Words,
    tmp_path: Path,
    capfd: pytest.CaptureFixture[str],
) -> None:
    """The warning names the file."""
    words(parameters=[tmp_path / 'no.yaml'])
    assert f'Parameter file path is not a file: {tmp_path}/no.yaml' in capfd.readouterr().out


def test_file_with_substitutions(context: LaunchContext, tmp_path: Path) -> None:
    """A copy of the file has what the substitutions in it have become."""
    path = tmp_path / 'x.yaml'
    path.write_text('/**:\n  ros__parameters:\n    robot: $(var robot)\n    plain: $x\n')
    context.launch_configurations['robot'] = 'r1'
    copy = Path(ParameterFile(path, allow_substs=True).evaluate(context))
    assert copy != path
    assert copy.read_text() == '/**:\n  ros__parameters:\n    robot: r1\n    plain: $x\n'


@pytest.mark.parametrize(
    'line, error',
    [
        ('$(bogus)', 'Unknown substitution: bogus'),
        ('$(var robto)', "launch configuration 'robto' does not exist. Did you mean 'robot'"),
        ('$(find p)', r"Unknown substitution: find\nROS 2 has '\$\(find-pkg-share PACKAGE\)'"),
    ],
)
def test_wrong_substitution_in_a_file(
    line: str,
    error: str,
    context: LaunchContext,
    tmp_path: Path,
) -> None:
    """The error of a substitution names the file and the line."""
    path = tmp_path / 'x.yaml'
    path.write_text(f'/**:\n  ros__parameters:\n    robot: {line}\n')
    context.launch_configurations['robot'] = 'r1'
    with pytest.raises(RuntimeError, match=error) as caught:
        ParameterFile(path, allow_substs=True).evaluate(context)
    assert place_of(caught.value).call_site == (str(path), 3)  # type: ignore[union-attr]


def test_substituted_file_that_is_no_yaml(context: LaunchContext, tmp_path: Path) -> None:
    """What the substitutions have become must still be YAML."""
    path = tmp_path / 'x.yaml'
    path.write_text('a: $(var text)\n')
    context.launch_configurations['text'] = '[1'
    with pytest.raises(ValueError, match='substituted parameter file is not a valid yaml file'):
        ParameterFile(path, allow_substs=True).evaluate(context)


def test_flag_of_a_file() -> None:
    """The flag must be a truth value."""
    with pytest.raises(TypeError, match='allow_substs'):
        ParameterFile('/x.yaml', allow_substs='true')  # type: ignore[arg-type]


def test_rule_before_evaluation() -> None:
    """A single parameter has no rule before its value is known."""
    with pytest.raises(RuntimeError, match='before it is evaluated'):
        Parameter('a', 1).get_parameter_rule()


@pytest.mark.parametrize(
    'value',
    [
        True,
        0,
        -5,
        1.0,
        1e-07,
        1.5e300,
        -0.0,
        math.inf,
        -math.inf,
        '',
        'a',
        "it's",
        'true',
        '1e3',
        '0x10',
        'a: b',
        '# x',
        'a\nb',
        '\t',
        '\x7f\x85\u2028',
        '\u00e9\U0001f600',
        '"',
        '\\n',
        '~',
        [1, 2],
        ['a', 'b, c'],
        [1.5],
        b'\x00\xff',
    ],
)
def test_written_values(value: Any) -> None:
    """What is written is read again as the same value of the same type."""
    assert repr(yaml.safe_load(flow_text(value))) == repr(value)


def test_written_nan() -> None:
    """Not a number is written as YAML has it."""
    assert math.isnan(yaml.safe_load(flow_text(math.nan)))
