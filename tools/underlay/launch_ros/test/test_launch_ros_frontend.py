# SPDX-License-Identifier: Apache-2.0
"""The tags and substitutions of launch_ros in XML and YAML."""

from __future__ import annotations

from collections.abc import Callable
import io
import os
from pathlib import Path
from typing import Any

from launch import LaunchContext
from launch.failures import place_of
from launch.frontend import Entity, expose, expose_action, Parser
from launch.frontend.expose import known_actions, known_substitutions, load
from launch.frontend.parse_substitution import parse_substitution
from launch.utilities import perform_substitutions, visit_all_entities_and_collect_futures
from launch_ros.actions import Node
import pytest
import yaml

Parse = Callable[..., Any]


def parse(content: str) -> list[Any]:
    """Return the actions in the text of a launch file."""
    root, parser = Parser.load(io.StringIO(content))
    return list(parser.parse_description(root).entities)


@pytest.fixture
def words(context: LaunchContext) -> Callable[[str], list[str]]:
    """Return a function that gives the words of the last node's command line."""
    context.launch_configurations.update(x='p q', five='5')

    def of_last(content: str) -> list[str]:
        *before, node = parse(content)
        for entity in before:
            visit_all_entities_and_collect_futures(entity, context)
        node.prepare(context)
        return list(node.cmd)

    return of_last


@pytest.fixture
def parameters(words: Callable[[str], list[str]]) -> Callable[[str], dict[str, Any]]:
    """Return a function that gives the parameters that a node's children make."""

    def read(content: str) -> dict[str, Any]:
        merged: dict[str, Any] = {}
        if content.startswith('<'):
            content = f'<launch><node exec="/bin/true">{content}</node></launch>'
        else:
            content = f'launch:\n- node:\n    exec: /bin/true\n    param:\n{content}\n'
        found = words(content)
        for option, value in zip(found, found[1:]):
            if option == '--params-file':
                merged.update(yaml.safe_load(Path(value).read_text())['/**']['ros__parameters'])
        return merged

    return read


def test_node(words: Callable[[str], list[str]], prefix: Callable[..., Path]) -> None:
    """A node has its names, arguments and remappings."""
    root = prefix('pkg', 'exe')
    assert words(
        '<launch><node pkg="pkg" exec="exe" name="n" namespace="ns" exec_name="label" '
        'args="-x $(var x) \'a b\'" ros_args="--log-level debug" output="screen">'
        '<remap from="a" to="/$(var five)/b"/><remap from="c" to="d"/></node></launch>'
    ) == [
        str(root / 'lib/pkg/exe'),
        *('-x', 'p q', 'a b', '--ros-args', '--log-level', 'debug'),
        *('--ros-args', '-r', '__node:=n', '-r', '__ns:=/ns', '-r', 'a:=/5/b', '-r', 'c:=d'),
    ]


def test_process_of_a_node() -> None:
    """A node is a process, with its options, too."""
    [node] = parse(
        '<launch><node exec="/x" respawn="true" respawn_delay="1" cwd="/" launch-prefix="nice" '
        'emulate_tty="true" on_exit="shutdown" if="true" exec_name="label">'
        '<env name="A" value="b"/></node></launch>'
    )
    assert isinstance(node, Node)
    assert node.emulate_tty is True
    node.prepare(LaunchContext())
    assert node.cmd[0] == 'nice'
    assert node.name.startswith('label-')
    assert node.env['A'] == 'b'


def test_scope_actions(words: Callable[[str], list[str]]) -> None:
    """Actions set what the nodes after them have in common."""
    found = words(
        '<launch><push_ros_namespace namespace="a"/><push-ros-namespace namespace="$(var five)x" '
        'if="false"/><set_remap from="c" to="d"/><set_parameter name="p" value="true"/>'
        '<set_parameter name="q" value="$(var five)"/><set_use_sim_time value="true"/>'
        '<node exec="/x" name="n"/></launch>'
    )
    assert found[1:] == ('--ros-args -r __node:=n -r __ns:=/a -p p:=True -p q:=5 -r c:=d'.split())


def test_scope_actions_in_yaml(words: Callable[[str], list[str]]) -> None:
    """The same in YAML, where values have types of their own."""
    found = words(
        'launch:\n- push-ros-namespace: {namespace: a}\n- set_remap: {from: c, to: d}\n'
        '- set_parameter: {name: p, value: true}\n- set_use_sim_time: {value: false}\n'
        '- node:\n    exec: /x\n    name: n\n    remap:\n    - {from: e, to: f}\n'
    )
    assert found[1:] == ('--ros-args -r __node:=n -r __ns:=/a -p p:=True -r c:=d -r e:=f'.split())


def test_files_for_all(words: Callable[[str], list[str]], tmp_path: Path) -> None:
    """A parameter file and a log folder are set for the nodes that follow."""
    path = tmp_path / 'p.yaml'
    path.write_text('{}')
    found = words(
        f'<launch><set_parameters_from_file filename="{path}"/><set_ros_log_dir dir="sub"/>'
        '<node exec="/x"/></launch>'
    )
    assert found[1:] == ['--ros-args', '--params-file', str(path)]
    assert os.environ['ROS_LOG_DIR'].endswith('/sub')


@pytest.mark.parametrize(
    'attributes, value',
    [
        ('value="1"', 1),
        ('value="1.5"', 1.5),
        ('value="1e-3"', 0.001),
        ('value="true"', True),
        ('value="\'1\'"', '1'),
        ('value="hello"', 'hello'),
        ('value=""', ''),
        ('value="[1, 2]"', [1, 2]),
        ('value="[a, b]"', ['a', 'b']),
        ('value="a, b" value-sep=", "', ['a', 'b']),
        ('value="1, 2" value-sep=", "', [1, 2]),
        ('value="\'1\', \'2\'" value-sep=", "', ['1', '2']),
        ('value="1" type="str"', '1'),
        ('value="1" type="float"', 1.0),
        ('value="1" type="int"', 1),
        ('value="1" type="bool"', True),
        ('value="1" type="yaml"', 1),
        ('value="[1, 2]" type="list_of_floats"', [1.0, 2.0]),
        ('value="1,2" value-sep="," type="list_of_strs"', ['1', '2']),
        ('value="$(var five)"', 5),
        ('value="$(var five)" type="str"', '5'),
        ('value="$(var five).5"', 5.5),
        ('value="[$(var five), 6]"', [5, 6]),
        ('value="$(var five),6" value-sep=","', [5, 6]),
        ('value="$(var five),6" value-sep="," type="list_of_str"', ['5', '6']),
        ('value="$(var x)"', 'p q'),
        (r'value="a\$b"', 'a$b'),
    ],
)
def test_parameters_in_xml(
    attributes: str, value: Any, parameters: Callable[[str], dict[str, Any]]
) -> None:
    """A text gets its type by YAML rules, or as is said."""
    found = parameters(f'<param name="p" {attributes}/>')
    assert repr(found) == repr({'p': value})


@pytest.mark.parametrize(
    'content, value',
    [
        ('value: 1', 1),
        ('value: 1.5', 1.5),
        ('value: false', False),
        ('value: "1"', '1'),
        ('value: hello', 'hello'),
        ('value: [1, 2]', [1, 2]),
        ('value: ["1", "2"]', ['1', '2']),
        ('value: "$(var five)"', 5),
        ('value: ["$(var five)", "6"]', [5, 6]),
        ('value: ["$(var five)", "6"], type: list_of_strs', ['5', '6']),
        ('value: "$(var five)", type: str', '5'),
        ('value: 2.5, type: float', 2.5),
    ],
)
def test_parameters_in_yaml(
    content: str, value: Any, parameters: Callable[[str], dict[str, Any]]
) -> None:
    """A value keeps the type that it has in YAML; substitutions get theirs when performed."""
    found = parameters(f'    - {{name: p, {content}}}')
    assert repr(found) == repr({'p': value})


def test_nested_parameters(parameters: Callable[[str], dict[str, Any]]) -> None:
    """The names of nested parameters are joined by dots."""
    assert parameters(
        '<param name="a"><param name="b" value="1"/>'
        '<param name="c"><param name="$(var five)" value="x"/></param></param>'
    ) == {'a.b': 1, 'a.c.5': 'x'}


def test_files_of_parameters(parameters: Callable[..., dict[str, Any]], tmp_path: Path) -> None:
    """A file may have substitutions in it, if that is allowed."""
    path = tmp_path / 'p.yaml'
    path.write_text('/**:\n  ros__parameters:\n    a: $(var five)\n')
    assert parameters(f'<param from="{path}" allow_substs="true"/>') == {'a': 5}
    assert parameters(f'<param from="{path}"/>') == {'a': '$(var five)'}
    assert parameters(f'    - {{from: {path}, allow_substs: true}}') == {'a': 5}


@pytest.mark.parametrize(
    'content, text',
    [
        ('<node exec="x" type="y"/>', "Unexpected attribute(s) found in `node`: {'type'}"),
        ('<node type="y"/>', "Attribute 'exec' of type '<class 'str'>' not found in Entity 'node"),
        ('<node exec="x" required="true"/>', "found in `node`: {'required'}"),
        ('<node exec="x"><foo/></node>', "Unexpected nested tag(s) found in `node`: {'foo'}"),
        ('<node exec="x"><param name="a"/></node>', "'a' must have either a 'value' or nested"),
        ('<node exec="x"><param name="a" value="[1, a]"/></node>', 'The result is a non-uniform'),
        ('<node exec="x"><param name="a" value="a: b"/></node>', 'Give it the type str if it'),
        ('<node exec="x"><param name="a" value="1" type="text"/></node>', "unknown type 'text'"),
        ('<node exec="x"><param name="a" value="1" typ="int"/></node>', "`param`: {'typ'}"),
        ('<node exec="x"><param from="a" allow_substs="$(var x)"/></node>', 'without substitutio'),
        ('<node exec="x"><remap from="a"/></node>', "Attribute 'to' of type"),
        ('<nod exec="x"/>', 'Unrecognized entity of the type: nod'),
        ('<set_parameter name="a"/>', "Attribute 'value' of type"),
    ],
)
def test_errors(content: str, text: str) -> None:
    """An error says what is wrong, and where."""
    with pytest.raises((AttributeError, RuntimeError, TypeError, ValueError)) as caught:
        parse(f'<launch>\n{content}</launch>')
    assert text in str(caught.value).splitlines()[0]
    assert place_of(caught.value).call_site == ('<string>', 2)  # type: ignore[union-attr]


@pytest.mark.parametrize(
    'content, advice',
    [
        (
            '<node exec="x"><remap from="a" too="b"/></node>',
            "There is 'too' instead: was 'to' meant?",
        ),
        ('<node package="a" executable="b"/>', "XML and YAML write 'exec'"),
        ('<node package="a" exec="b"/>', "XML and YAML write 'pkg'"),
    ],
)
def test_advice(content: str, advice: str) -> None:
    """Further lines name what was given, and what to write instead."""
    with pytest.raises((AttributeError, ValueError)) as caught:
        parse(f'<launch>{content}</launch>')
    assert advice in '\n'.join(str(caught.value).splitlines()[1:])


def test_node_of_another_package(context: LaunchContext) -> None:
    """A package derives an action from Node and extends its parse()."""
    before = dict(expose.action_parse_methods)

    class Bridge(Node):
        def __init__(self, topic: Any, **kwargs: Any) -> None:
            super().__init__(executable='/bridge', arguments=[topic], **kwargs)

        @classmethod
        def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
            _, kwargs = super().parse(entity, parser)
            del kwargs['executable']
            kwargs['topic'] = parser.parse_substitution(entity.get_attr('topic'))
            return cls, kwargs

    expose_action('test_bridge')(Bridge)
    [node] = parse('<launch><test_bridge exec="x" topic="t" name="b"/></launch>')
    node.prepare(context)
    assert node.cmd == ['/bridge', 't', '--ros-args', '-r', '__node:=b']
    expose.action_parse_methods.clear()
    expose.action_parse_methods.update(before)


def test_substitutions(context: LaunchContext, prefix: Callable[..., Path]) -> None:
    """Packages, executables and parameters can be referred to."""
    root = prefix('pkg', 'exe')
    context.launch_configurations.update(name='pkg', global_params=[('p', 'value')])
    for text, result in {
        '$(find-pkg-share $(var name))/x': f'{root}/share/pkg/x',
        '$(find-pkg-prefix pkg)': str(root),
        '$(exec-in-pkg exe pkg)': f'{root}/lib/pkg/exe',
        '$(param p)': 'value',
        '$(param q default)': 'default',
    }.items():
        assert perform_substitutions(context, parse_substitution(text)) == result


def test_everything_known_can_be_loaded() -> None:
    """Each place in the tables has a class with parse()."""
    for place in [*known_actions().values(), *known_substitutions().values()]:
        assert callable(load(place).parse)
