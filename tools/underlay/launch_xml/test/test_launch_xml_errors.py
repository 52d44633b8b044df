# SPDX-License-Identifier: Apache-2.0
"""The errors of launch files in XML."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
import io
from typing import List  # noqa: UP035

from launch import LaunchContext
from launch.failures import place_of
from launch.frontend import Entity, InvalidFrontendLaunchFileError, Parser
from launch_xml import Parser as XMLParser
from launch_xml.launch_description_sources import XMLLaunchDescriptionSource
import pytest

Run = Callable[..., list[str]]


def parse(content: str) -> None:
    """Parse a launch file."""
    root, parser = XMLParser.load(io.StringIO(content))
    parser.parse_description(root)


def element(content: str) -> Entity:
    """Return an element."""
    root, _ = XMLParser.load(io.StringIO(content))
    return root


@pytest.mark.parametrize(
    'content, error, text',
    [
        ('<log mesage="x"/>', AttributeError, "Attribute 'message' of type '<class 'str'>' not "),
        ('<log message="x" a="1"/>', ValueError, "attribute(s) found in `log`: {'a'}"),
        ('<log message="x" b="" a=""/>', ValueError, "attribute(s) found in `log`: {'a', 'b'}"),
        ('<log message="x"><a/></log>', ValueError, "nested tag(s) found in `log`: {'a'}"),
        ('<foo/>', RuntimeError, 'Unrecognized entity of the type: foo'),
        ('<let name="x"/>', AttributeError, "Attribute 'value' of type"),
        ('<arg name="x" value="1"/>', ValueError, "attribute(s) found in `arg`: {'value'}"),
        ('<group ns="x"/>', ValueError, "attribute(s) found in `group`: {'ns'}"),
        ('<include file="x"><arg name="a" value="b" if="true"/></include>', ValueError, "{'if'}"),
        ('<timer period="soon"/>', TypeError, "The attribute 'period' of `timer` cannot be used"),
        ('<executable cmd="x" shell="$(var s)"/>', TypeError, 'without substitutions'),
        ('<executable cmd="x" on_exit="stop"/>', ValueError, "must be 'shutdown'"),
        ('<executable/>', AttributeError, "Attribute 'cmd' of type"),
        ('<arg name="x" default="$(bogus)"/>', RuntimeError, 'Unknown substitution: bogus'),
        ('<rosparam file="x"/>', RuntimeError, 'Unrecognized entity of the type: rosparam'),
        ('<test/>', RuntimeError, 'Unrecognized entity of the type: test'),
        ('<machine/>', RuntimeError, 'Unrecognized entity of the type: machine'),
    ],
)
def test_errors(content: str, error: type[Exception], text: str) -> None:
    """An error begins with what is wrong, and knows the line of its element."""
    with pytest.raises(error) as caught:
        parse(f'<launch>\n\n{content}</launch>')
    assert text in str(caught.value).splitlines()[0]
    assert place_of(caught.value).call_site == ('<string>', 3)  # type: ignore[union-attr]


@pytest.mark.parametrize(
    'content, advice',
    [
        ('<lgo message="x"/>', "Did you mean 'log'?"),
        ('<log mesage="x"/>', "There is 'mesage' instead: was 'message' meant?"),
        ('<let name="a" value="b" uless="true"/>', "Did you mean 'unless'?"),
        ('<arg name="x" value="1"/>', '<let name="..." value="..."/>'),
        ('<group ns="x"/>', '<push_ros_namespace namespace="..."/>'),
        ('<rosparam/>', '<param from="FILE"/>'),
        ('<env name="a" value="b"/>', '<set_env name="..." value="..."/>'),
    ],
)
def test_advice(content: str, advice: str) -> None:
    """Further lines say what is probably meant."""
    with pytest.raises((AttributeError, RuntimeError, ValueError)) as caught:
        parse(f'<launch>{content}</launch>')
    assert advice in '\n'.join(str(caught.value).splitlines()[1:])


def test_wrong_root() -> None:
    """The root must be `launch`; its attributes are not checked."""
    with pytest.raises(RuntimeError, match="^Expected 'launch' as root tag$"):
        parse('<lunch/>')
    parse('<launch version="1.0"/>')


def test_line_of_what_fails_at_run_time(run: Run) -> None:
    """What fails when it is executed is told with its line, too."""
    lines = run('<launch>\n  <let name="a" value="1"/>\n\n  <log message="$(var b)"/>\n</launch>')
    assert "launch configuration 'b' does not exist" in lines[0]
    assert lines[1].endswith("test.launch.xml', line 4 (LogInfo)")


def test_console(run: Run) -> None:
    """The errors of both loaders are listed, with the line."""
    lines = run('<launch>\n  <lgo message="x"/>\n</launch>')
    assert lines[0].endswith('when trying to load file of format [xml]:')
    assert lines[1] == ' - RuntimeError: Unrecognized entity of the type: lgo'
    assert lines[2] == "   Did you mean 'log'?"
    assert lines[3].startswith(' - SyntaxError: ')
    assert lines[4].endswith("test.launch.xml', line 2 (lgo)")


def test_no_xml(run: Run) -> None:
    """A file that is not well-formed is told with the line."""
    lines = run('<launch>\n  <log message="x">\n</launch>')
    assert lines[1] == (
        ' - InvalidFrontendLaunchFileError: the file is not XML: mismatched tag: line 3, column 2'
    )
    assert lines[3].endswith("test.launch.xml', line 3")


def test_name_of_several_formats(run: Run) -> None:
    """If the name allows several formats, what each parser found is told."""
    lines = run('<launch', name='a.launch')
    assert lines[1].startswith(' - InvalidFrontendLaunchFileError: the file is not XML: unclosed')
    assert lines[2] == "   the file must have the key 'launch', with a list of actions below it"


def test_deprecated(run: Run) -> None:
    """A launch file may say that it should not be used."""
    lines = run('<launch deprecated="use another"/>')
    assert lines[0].endswith('test.launch.xml] is deprecated: use another')


@pytest.mark.parametrize('name', ['a.xml', 'a.launch', 'a', 'a.txt', 'a.launch.xml'])
def test_names_of_files(name: str, run: Run) -> None:
    """A file is read as XML whatever its name."""
    assert run('<launch><log message="x"/></launch>', name) == ['[INFO] [launch.user]: x']


def test_source(write: Callable[[str, str], str]) -> None:
    """A source reads XML only, and tells what is not."""
    path = write('a.launch.xml', '<launch><arg name="a"/></launch>')
    source = XMLLaunchDescriptionSource(path)
    [argument] = source.get_launch_description(LaunchContext()).get_launch_arguments()
    assert argument.name == 'a'
    assert source.method == 'interpreted XML launch file'
    other = XMLLaunchDescriptionSource(write('b', 'launch: []'))
    with pytest.raises(InvalidFrontendLaunchFileError, match='the file is not XML: syntax error'):
        other.get_launch_description(LaunchContext())


def test_typed_attributes() -> None:
    """Attributes get the types that are asked for."""
    entity = element('<a i="1" f="1" b="yes" t="1" l="[1, 2]" s="a,b" s-sep="," v="$(var x)"/>')
    assert entity.get_attr('i', data_type=int) == 1
    assert repr(entity.get_attr('f', data_type=float)) == '1.0'
    assert entity.get_attr('b', data_type=bool) is True
    assert entity.get_attr('t') == '1'
    assert entity.get_attr('t', data_type=None) == 1
    assert entity.get_attr('l', data_type=List[int]) == [1, 2]  # noqa: UP006
    assert entity.get_attr('s', data_type=list[str]) == ['a', 'b']
    assert entity.get_attr('v', data_type=int) == '$(var x)'
    entity.assert_entity_completely_parsed()
    with pytest.raises(TypeError, match='must be of type int, without substitutions'):
        entity.get_attr('v', data_type=int, can_be_str=False)


def test_relations() -> None:
    """An element knows its parent and its children."""
    root = element('<a><b/><c/><b/></a>')
    assert [child.type_name for child in root.children] == ['b', 'c', 'b']
    assert len(root.get_attr('b', data_type=List[Entity])) == 2  # noqa: UP006
    assert root.children[0].parent is root
    assert root.parent is None
    assert root.get_attr('d', data_type=List[Entity], optional=True) is None  # noqa: UP006
    with pytest.raises(AttributeError, match="'d' of type"):
        root.get_attr('d', data_type=List[Entity])  # noqa: UP006


def test_public_extensions() -> None:
    """The ends of the names of files are known."""
    assert XMLParser.get_file_extensions() == {'launch', 'launch.xml', 'xml'}
    assert {'xml', 'yaml'} <= set(Parser.get_available_extensions())
    assert Parser.is_extension_valid('.launch.xml')


def test_path_of_the_source() -> None:
    """The class is also found in the module that ROS 2 Jazzy has for it."""
    module = import_module('launch_xml.launch_description_sources.xml_launch_description_source')
    assert module.XMLLaunchDescriptionSource is XMLLaunchDescriptionSource
