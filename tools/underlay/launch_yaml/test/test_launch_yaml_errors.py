# SPDX-License-Identifier: Apache-2.0
"""The errors of launch files in YAML."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
import io
from typing import Any, List  # noqa: UP035

from launch import LaunchContext
from launch.failures import place_of
from launch.frontend import Entity, InvalidFrontendLaunchFileError
from launch_yaml import Parser
from launch_yaml.entity import Entity as YAMLEntity
from launch_yaml.launch_description_sources import YAMLLaunchDescriptionSource
import pytest

Run = Callable[..., list[str]]


def parse(content: str) -> Any:
    """Parse a launch file."""
    root, parser = Parser.load(io.StringIO(content))
    return parser.parse_description(root)


@pytest.mark.parametrize(
    'content, error, text',
    [
        ('{bogus: x, message: y}', ValueError, "Unexpected key(s) found in `log`: {'bogus'}"),
        ('{mesage: y}', AttributeError, "Attribute 'message' of type '<class 'str'>' not found"),
        ('{message: true}', TypeError, "Put it in quotes: 'true'"),
        ('{message: 5}', TypeError, "got 5 of type int. Put it in quotes: '5'"),
        ('{message: }', TypeError, "Omit it, or write '' for an empty string"),
        ('{message: x, if: true}', TypeError, "The attribute 'if' of `log` cannot be used"),
        ('{message: [x]}', TypeError, "expected str, but got ['x'] of type "),
        ('hello', AttributeError, "Attribute 'message' of type"),
    ],
)
def test_errors(content: str, error: type[Exception], text: str) -> None:
    """An error begins with what is wrong, and knows the line of its element."""
    with pytest.raises(error) as caught:
        parse(f'launch:\n\n- log: {content}\n')
    assert text in str(caught.value).splitlines()[0]
    assert place_of(caught.value).call_site == ('<string>', 3)  # type: ignore[union-attr]


@pytest.mark.parametrize(
    'content, text',
    [
        ('- timer: {period: 1, children: []}', 'Write 1.0 instead'),
        ('- arg: {name: a, default: true}', "Put it in quotes: 'true'"),
        ('- executable: {cmd: x, shell: 1}', "'shell' of `executable` cannot be used"),
        ('- executable: {cmd: x, shell: "$(var s)"}', 'without substitutions'),
        ('- include: {file: x, arg: {name: a, value: b}}', "'arg' of `include` must be a list"),
        ('- log: {message: x}\n  let: {name: a, value: b}', 'must be one key'),
        ('- log', 'must be one key'),
        ('- shutdown: now', "Unexpected value(s) found in `shutdown`: {'now'}"),
        ('- foo: {}', 'Unrecognized entity of the type: foo'),
        ('- group: 5', "'children' of `group` must be a list"),
    ],
)
def test_more_errors(content: str, text: str) -> None:
    """What has the wrong type or form is told."""
    with pytest.raises((RuntimeError, TypeError, ValueError)) as caught:
        parse(f'launch:\n{content}\n')
    assert text in str(caught.value)


@pytest.mark.parametrize(
    'content, text',
    [
        ('launch: [', 'the file is not YAML: '),
        ('- a', "the file must have the key 'launch'"),
        ('<launch/>', "the file must have the key 'launch'"),
        ('{launch: [], more: []}', "the file must have only one key, but it has 'launch', 'more'"),
    ],
)
def test_no_launch_file(content: str, text: str) -> None:
    """What is no YAML, or has another form, is told."""
    with pytest.raises(InvalidFrontendLaunchFileError, match=text):
        parse(content)


def test_wrong_root() -> None:
    """The root must be `launch`."""
    with pytest.raises(RuntimeError, match="^Expected 'launch' as root tag$"):
        parse('lunch: []')


def test_console(run: Run) -> None:
    """The errors of both loaders are listed, with the line."""
    lines = run('launch:\n- log:\n    message: x\n    bogus: y\n')
    assert lines[0].endswith('when trying to load file of format [yaml]:')
    assert lines[1] == " - ValueError: Unexpected key(s) found in `log`: {'bogus'}"
    assert lines[2].startswith(' - SyntaxError: ')
    assert lines[3].endswith("test.launch.yaml', line 2 (log)")


def test_line_of_what_is_no_yaml(run: Run) -> None:
    """A file that is not well-formed is told with the line."""
    lines = run('launch:\n- log: {message: x\n')
    assert lines[-2].endswith("test.launch.yaml', line 3")


def test_line_of_what_fails_at_run_time(run: Run) -> None:
    """What fails when it is executed is told with its line, too."""
    lines = run('launch:\n- group:\n  - log: {message: "$(var a)"}\n')
    assert lines[1].endswith("test.launch.yaml', line 3 (LogInfo)")


def test_source(write: Callable[[str, str], str]) -> None:
    """A source reads YAML only."""
    source = YAMLLaunchDescriptionSource(write('a', 'launch:\n- arg: {name: a}\n'))
    [argument] = source.get_launch_description(LaunchContext()).get_launch_arguments()
    assert argument.name == 'a'
    assert source.method == 'interpreted YAML launch file'


def test_values() -> None:
    """Values have the types of YAML, which must be those that are asked for."""
    entity = YAMLEntity(
        {
            'i': 1,
            'f': 1.5,
            'b': True,
            't': '1',
            'l': [1, 2],
            's': ['a', '$(var x)'],
            'm': [1, 'a'],
        },
        'test',
    )
    assert entity.get_attr('i', data_type=int) == 1
    assert entity.get_attr('f', data_type=float) == 1.5
    assert entity.get_attr('b', data_type=bool) is True
    assert entity.get_attr('t') == '1'
    assert repr(entity.get_attr('t', data_type=float)) == '1.0'
    assert entity.get_attr('t', data_type=None) == '1'
    assert entity.get_attr('l', data_type=List[int]) == [1, 2]  # noqa: UP006
    assert entity.get_attr('s', data_type=List[int]) == ['a', '$(var x)']  # noqa: UP006
    assert entity.get_attr('x', optional=True) is None
    with pytest.raises(ValueError, match='The result is a non-uniform list'):
        entity.get_attr('m', data_type=None)
    entity.assert_entity_completely_parsed()


def test_relations() -> None:
    """An element knows its parent and its children."""
    root = YAMLEntity({'a': [{'x': 1}], 'children': [{'b': None}]}, 'test')
    [child] = root.get_attr('a', data_type=List[Entity])  # noqa: UP006
    assert child.parent is root
    assert [each.type_name for each in root.children] == ['b']
    root.assert_entity_completely_parsed()


def test_path_of_the_source() -> None:
    """The class is also found in the module that ROS 2 Jazzy has for it."""
    module = import_module('launch_yaml.launch_description_sources.yaml_launch_description_source')
    assert module.YAMLLaunchDescriptionSource is YAMLLaunchDescriptionSource
