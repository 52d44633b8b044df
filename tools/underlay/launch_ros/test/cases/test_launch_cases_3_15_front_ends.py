# SPDX-License-Identifier: Apache-2.0
"""Cases of section 3.15: launch files in XML and YAML."""

from __future__ import annotations

import json
import os
from typing import Any

XML, YAML = {'name': 'it.launch.xml'}, {'name': 'it.launch.yaml'}


def test_xml_actions(launch: Any) -> None:
    """3.15 The tags for arguments, variables, includes, groups, logs and environments."""
    out = launch(
        """
        <launch version="0.1.0">
        <arg name="a" default="1" description="d"/>
        <arg name="c" default="x"><choice value="x"/><choice value="y"/></arg>
        <let name="b" value="$(var a)2"/>
        <log message="a=$(var a) b=$(var b)"/>
        <include file="$(dirname)/child.launch.xml">
          <arg name="given" value="arg"/>
          <let name="more" value="let"/>
        </include>
        <log message="$(var given) stays"/>
        <group><let name="b" value="inner"/><log message="b=$(var b)"/></group>
        <log message="b=$(var b)"/>
        <group scoped="false"><let name="b" value="kept"/></group>
        <log message="b=$(var b)"/>
        <group forwarding="false"><keep name="k" value="$(var b)"/>
          <log message="$(var k) $(var b gone)"/></group>
        <let name="flag" value="true"/>
        <group scoped="$(var flag)"><let name="b" value="scoped"/></group>
        <log message="b=$(var b)"/>
        <set_env name="CASE_A" value="1"/>
        <append_env name="CASE_A" value="2"/>
        <append_env name="CASE_A" value="0" prepend="true" separator=","/>
        <set_env name="CASE_B" value="1"/>
        <unset_env name="CASE_B"/>
        <log message="$(env CASE_A) $(env CASE_B none)"/>
        <group><reset_env/><log message="$(env CASE_A reset)"/></group>
        <group scoped="true"><reset><keep name="b" value="$(var b)"/></reset>
          <log message="$(var a gone) $(var b)"/></group>
        <timer period="0.1"><log message="timer"/><shutdown reason="because"/></timer>
        <log message="if" if="$(var flag)"/>
        <log message="unless" unless="$(var flag)"/>
        </launch>
        """,
        **XML,
        files={'child.launch.xml': '<log message="$(var given) $(var more)"/>'},
    )
    assert out.status == 0
    assert out.said == [
        *['a=1 b=12', 'arg let', 'arg stays', 'b=inner', 'b=12', 'b=kept', 'kept gone'],
        # Section 6: scoped is substituted.
        *['b=kept', '0,1:2 none', 'reset', 'gone kept', 'if', 'timer'],
    ]


def test_xml_executable(launch: Any) -> None:
    """3.15 An executable has the attributes of a process."""
    out = launch(
        """
        <let name="x" value="a b"/>
        <executable cmd="rec one 'two words' $(var x)" cwd="sub" name="n" output="screen"
                    launch-prefix="env CASE_P=1">
          <env name="CASE_E" value="$(var x)"/>
        </executable>
        <executable cmd="echo shell; exit 3" shell="true" output="both"/>
        <executable cmd="true" respawn="true" respawn_delay="0.05" respawn_max_retries="1"/>
        <executable cmd="true" on_exit="shutdown" sigterm_timeout="1" sigkill_timeout="1"
                    emulate_tty="true" if="0"/>
        """,
        **XML,
        files={'sub/x': ''},
    )
    assert out.status == 0
    assert out.run.args == ['one', 'two words', 'a b']
    assert out.run.cwd == str(out.here / 'sub')
    assert (out.run.env['CASE_P'], out.run.env['CASE_E']) == ('1', 'a b')
    assert '[echo-2] shell' in out.lines
    assert len([line for line in out.lines if 'true-3]: process started' in line]) == 2


def test_on_exit(launch: Any) -> None:
    """3.15 on_exit="shutdown" ends the launch with a process."""
    out = launch('<executable cmd="true" on_exit="shutdown"/><executable cmd="sleep 60"/>', **XML)
    assert out.status == 0
    assert any('[true-1] was required' in line for line in out.lines)


def test_xml_node(launch: Any) -> None:
    """3.15 A node with all its attributes and children, below what is set for all nodes."""
    out = launch(
        """
        <set_parameter name="all" value="1"/>
        <set_parameters_from_file filename="all.yaml"/>
        <set_remap from="x" to="y"/>
        <set_use_sim_time value="false"/>
        <group><push_ros_namespace namespace="p"/><push-ros-namespace namespace="q"/>
          <node pkg="stub" exec="rec" name="n" namespace="own" exec_name="label" args="-a b"
                ros_args="--log-level info" output="screen" respawn="false">
            <param name="int" value="1"/>
            <param name="nest"><param name="deep" value="x"/></param>
            <param from="own.yaml"/>
            <remap from="i" to="o"/>
            <env name="CASE_E" value="1"/>
          </node>
        </group>
        """,
        **XML,
        files={'all.yaml': '{}', 'own.yaml': '{}'},
    )
    assert out.status == 0, out.text
    args = out.args[0]
    assert args[:10] == [
        *['-a', 'b', '--ros-args', '--log-level', 'info', '--ros-args'],
        *['-r', '__node:=n', '-r', '__ns:=/p/q/own'],
    ]
    assert args[10:14] == ['-p', 'all:=1', '--params-file', 'HERE/all.yaml']
    assert args[14:20] == [*['--params-file', 'PARAMS'] * 2, '--params-file', 'own.yaml']
    assert args[20:] == ['-r', 'x:=y', '-r', 'i:=o']
    values = [each['/p/q/own/n']['ros__parameters'] for each in out.run.params if each]
    assert values == [{'int': 1}, {'nest.deep': 'x'}]
    assert '[INFO] [label-1]: process started with pid [N]' in out.lines


def test_parameter_types(launch: Any) -> None:
    """3.15 The value of a parameter is typed by YAML, or by its type; value-sep makes lists."""
    params = {
        ('int', 'value="1"'): 1,
        ('float', 'value="1.5"'): 1.5,
        ('bool', 'value="true"'): True,
        ('text', 'value="hello"'): 'hello',
        ('quoted', 'value="\'1\'"'): '1',
        ('list', 'value="[1, 2]"'): [1, 2],
        ('forced', 'value="1" type="str"'): '1',
        ('tofloat', 'value="1" type="float"'): 1.0,
        ('ints', 'value="1,2" value-sep=","'): [1, 2],
        ('texts', 'value="1;2" value-sep=";" type="list_of_str"'): ['1', '2'],
        ('var', 'value="$(var x)"'): 7,
        ('vartext', 'value="$(var x)" type="str"'): '7',
    }
    inside = ''.join(f'<param name="{name}" {value}/>' for name, value in params)
    out = launch(f'<let name="x" value="7"/><node pkg="stub" exec="rec">{inside}</node>', **XML)
    assert out.status == 0
    found: dict[str, Any] = {}
    for each in out.run.params:
        found.update(each['/**']['ros__parameters'])
    assert found == {name: value for (name, _), value in params.items()}


def test_splitting(launch: Any) -> None:
    """3.15 Only literal text of a command is split; what a substitution gives is one word."""
    out = launch(
        """
        <let name="ex" value="p q"/><let name="none" value=""/>
        <node pkg="stub" exec="rec" args="-a $(var ex) b$(var ex)c 'in quotes' $(var none) end"/>
        """,
        **XML,
    )
    assert out.run.args == ['-a', 'p q', 'bp qc', 'in quotes', '', 'end', '--ros-args']


STRICT = [
    (
        '<node pkg="stub" exec="rec" type="x"/>',
        "Unexpected attribute(s) found in `node`: {'type'}",
    ),
    ('<node pkg="stub" exec="rec"><foo/></node>', 'Unexpected nested tag(s) found in `node`: '),
    ('<node pkg="stub"/>', "Attribute 'exec' of type '<class 'str'>' not found in Entity 'node'"),
    ('<foo/>', 'Unrecognized entity of the type: foo'),
    ('<group ns="a"/>', 'Unexpected attribute(s) found in `group`'),
    ('<arg name="a" value="1"/>', 'Unexpected attribute(s) found in `arg`'),
    ('<node pkg="stub" exec="rec" required="true"/>', 'Unexpected attribute(s) found in `node`'),
    ('<node pkg="stub" exec="rec" node-name="n"/>', 'Unexpected attribute(s) found in `node`'),
    (
        '<log message="a" if="1" unless="0"/>',
        "if and unless conditions can't be used simultaneously",
    ),
    ('<log message="$(bogus)"/>', 'Unknown substitution: bogus'),
    ('<log message="$(optenv HOME)"/>', 'Unknown substitution: optenv'),
    ('<log message="$(find stub)"/>', 'Unknown substitution: find'),
    ('<log message="$(arg a)"/>', 'Unknown substitution: arg'),
    ('<rosparam/>', 'Unrecognized entity of the type: rosparam'),
    ('<executable cmd="true" on_exit="restart"/>', ''),
    ('<log message="$(var  a)"/>', ''),
    ('<log message="$(var a"/>', ''),
    ('<include file="child.launch.xml"><arg name="a" value="1" if="1"/></include>', ''),
]


def _check_strictness(launch: Any, ending: str, cases: list[tuple[str, str]]) -> None:
    files = {f'{n}.launch.{ending}': text for n, (text, _) in enumerate(cases)}
    includes = [f"IncludeLaunchDescription('{name}')" for name in files]
    errors = launch.errors(*includes, files={**files, 'child.launch.xml': ''})
    for (_, text), error in zip(cases, errors):
        assert error != 'accepted'
        assert text in error


def test_strictness_of_xml(launch: Any) -> None:
    """3.15 What is unknown or missing in a file is an error."""
    _check_strictness(launch, 'xml', STRICT)


def test_root(launch: Any) -> None:
    """3.15 The root may have any attribute, but another name is wrong; deprecated is told."""
    out = launch('<launch a="b" deprecated="old"><log message="x"/></launch>', **XML)
    assert (out.status, out.said) == (0, ['x'])
    assert '[WARNING] [root]: launch file [HERE/it.launch.xml] is deprecated: old' in out.lines
    launch.write('it.launch.xml', '<robot/>', wrap=False)
    out = launch.run('launch', 'it.launch.xml').end()
    assert out.status == 1
    assert "Expected 'launch' as root tag" in out.error


def test_yaml_actions(launch: Any) -> None:
    """3.15 YAML has the same entities, with lists for children."""
    out = launch(
        """
        launch:
        - arg: {name: a, default: '1'}
        - let: {name: b, value: $(var a)2}
        - log: {message: a=$(var a) b=$(var b)}
        - include:
            file: $(dirname)/child.launch.yaml
            arg:
            - {name: given, value: arg}
            let:
            - {name: more, value: let}
        - group:
          - let: {name: b, value: inner}
          - log: {message: $(var b)}
        - group:
            scoped: false
            children:
            - let: {name: b, value: kept}
        - log: {message: $(var b), if: 'true'}
        - timer:
            period: 0.1
            children:
            - log: {message: timer}
        - executable: {cmd: rec executable, env: [{name: CASE_E, value: '1'}]}
        - node:
            pkg: stub
            exec: rec
            name: n
            namespace: ''
            args: a $(var b)
            param:
            - {name: int, value: 1}
            - {name: text, value: '1'}
            - {name: list, value: [1, 2]}
            - name: nest
              param:
              - {name: deep, value: true}
            - {from: own.yaml}
            remap:
            - {from: i, to: o}
        """,
        **YAML,
        files={
            'child.launch.yaml': '- log: {message: $(var given) $(var more)}',
            'own.yaml': '{}',
        },
    )
    assert out.status == 0
    assert out.said == ['a=1 b=12', 'arg let', 'inner', 'kept', 'timer']
    runs = {run.args[0]: run for run in out.runs}
    assert runs['executable'].env['CASE_E'] == '1'
    assert runs['a'].args[1] == 'kept'
    found: dict[str, Any] = {}
    for each in runs['a'].params:
        found.update(each.get('/n', {}).get('ros__parameters', {}))
    assert found == {'int': 1, 'text': '1', 'list': [1, 2], 'nest.deep': True}
    assert [out.tidy(word) for word in runs['a'].args][-2:] == ['-r', 'i:=o']


STRICT_YAML = [
    (
        '- node: {pkg: stub, exec: rec, bogus: 1}',
        "Unexpected key(s) found in `node`: {'bogus'}",
    ),
    ('- arg: {name: a, default: true}', 'TypeError'),
    ('- timer: {period: 1, children: []}', 'TypeError'),
    ('- foo: {}', 'Unrecognized entity of the type: foo'),
    (
        '- node: {pkg: stub, exec: rec, param: [{name: a, value: [1, b]}]}',
        'The result is a non-uniform list',
    ),
    ('- log: {message: a, if: "1", unless: "0"}', "can't be used simultaneously"),
]


def test_strictness_of_yaml(launch: Any) -> None:
    """3.15 In YAML unknown keys and values of a wrong type are errors."""
    _check_strictness(launch, 'yaml', STRICT_YAML)


def test_quoted_numbers_in_yaml(launch: Any) -> None:
    """3.15 Texts that look like numbers are fine where they are quoted."""
    out = launch(
        '- timer: {period: "0.1", children: [{log: {message: a}}]}\n'
        '- timer: {period: 0.2, children: [{log: {message: b}}]}',
        **YAML,
    )
    assert (out.status, out.said) == (0, ['a', 'b'])


GRAMMAR = [
    ('plain', 'plain'),
    ('$(var a)', 'A'),
    ('x$(var a)y$(var a)', 'xAyA'),
    ('$(var $(var name))', 'A'),
    ('$(var none default)', 'default'),
    ("$(var none 'two words')", 'two words'),
    ("$(var none 'nested $(var a)')", 'nested A'),
    ("$(var none '')", ''),
    ('$(var none x$(var a)y)', 'xAy'),
    ('costs $5 or $', 'costs $5 or $'),
    (r'\$(var a)', '$(var a)'),
    (r'a\\b \b', r'a\b b'),
    ('$(find-pkg-share $(var pkg))/x', 'PREFIX/share/stub/x'),
    ('$(find-pkg-prefix stub)', 'PREFIX'),
    ('$(exec-in-pkg rec stub)', 'PREFIX/lib/stub/rec'),
    ('$(find-exec rec)', 'PREFIX/lib/stub/rec'),
    ('$(env CASE_NONE default)', 'default'),
    ('$(env CASE_E)', 'e'),
    ("$(eval '1 + 1')", '2'),
    ("$(eval '\\'$(var a)\\' == \\'A\\'')", 'True'),
    ("$(eval 'os.sep' os)", '/'),
    ("$(command 'echo out')", 'out\n'),
    ('$(not true)', 'false'),
    ('$(and true 0)', 'false'),
    ('$(or true 0)', 'true'),
    # Section 6: these two work.
    ('$(any false true)', 'true'),
    ('$(all false true)', 'false'),
    ('$(equals 1 1.0)', 'true'),
    ('$(not-equals a b)', 'true'),
    ('$(if true yes no)', 'yes'),
    ('$(dirname)', 'HERE'),
    ('$(filename)', 'HERE/it.launch.yaml'),
    ('$(file-content text)', 'content\n'),
    ('$(var nested)', '$(var a)'),
    ('', ''),
]


def test_grammar(launch: Any) -> None:
    """3.15 Substitutions may stand in texts, and in each other; results are not read again."""
    logs = ''.join(f'- log: {{message: {json.dumps(f"<{text}>")}}}\n' for text, _ in GRAMMAR)
    out = launch(
        'launch:\n- let: {name: a, value: A}\n- let: {name: name, value: a}\n'
        "- let: {name: pkg, value: stub}\n- let: {name: nested, value: '\\$(var a)'}\n" + logs,
        **YAML,
        files={'text': 'content'},
        CASE_E='e',
    )
    assert out.status == 0
    said = out.text.replace('[INFO] [launch.user]: ', '').split('>\n')
    said[-1] = said[-1].removesuffix('>')
    found = dict(zip((text for text, _ in GRAMMAR), said))
    assert found == {text: f'<{result}' for text, result in GRAMMAR}


def test_more_substitutions(launch: Any) -> None:
    """3.15 Anonymous names, the log folder, commands with a mode, and parameters in XML."""
    out = launch(
        """
        <set_parameter name="p" value="1"/>
        <log message="$(anon a)"/>
        <log message="$(anon a)"/>
        <log message="$(log_dir)"/>
        <log message="$(launch_log_dir)"/>
        <log message="$(param p) $(param none default)"/>
        <log message="&lt;$(command 'sh -c &quot;echo $(var none mode) >&amp;2&quot;' ignore)>"/>
        """,
        **XML,
    )
    assert out.status == 0
    assert out.said[0] == out.said[1] and out.said[0].startswith('a_')
    assert out.said[2] == out.said[3] != ''
    assert out.said[4:] == ['1 default', '<>']


EXTENSION = """
from launch.actions import LogInfo
from launch.frontend import expose_action, expose_substitution
from launch.substitutions import TextSubstitution


@expose_action('greet')
class Greet(LogInfo):
    @classmethod
    def parse(cls, entity, parser):
        return cls, {'msg': 'hello ' + entity.get_attr('whom')}


@expose_substitution('shout')
def shout(data):
    return TextSubstitution, {'text': '!'}
"""


def test_extensions(launch: Any) -> None:
    """3.15 A package can add tags and substitutions; one that is broken is a warning."""
    folder = 'site/case_frontend-1.0.dist-info'
    launch.write('site/case_frontend.py', EXTENSION, wrap=False)
    launch.write(f'{folder}/METADATA', 'Name: case_frontend\nVersion: 1.0\n')
    launch.write(
        f'{folder}/entry_points.txt',
        '[launch.frontend.launch_extension]\ncase = case_frontend\nbad = no_such_module\n',
    )
    path = f'{launch.here / "site"}:{os.environ.get("PYTHONPATH", "")}'
    out = launch('<greet whom="you"/><log message="a$(shout)"/>', **XML, PYTHONPATH=path)
    assert (out.status, out.said) == (0, ['hello you', 'a!'])
    assert 'no_such_module' in out.stdout + out.err


def test_composition_tags(launch: Any) -> None:
    """3.15 Containers, composable and lifecycle nodes, and timers on ROS time have tags."""
    out = launch.show_args(
        """
        <arg name="a" default="1"/>
        <node_container pkg="stub" exec="rec" name="c" namespace="" output="screen" args="x">
          <composable_node pkg="p" plugin="P" name="n" namespace="ns" if="true">
            <param name="a" value="1"/><remap from="i" to="o"/>
            <extra_arg name="use_intra_process_comms" value="true"/>
          </composable_node>
        </node_container>
        <load_composable_node target="/c">
          <composable_node pkg="p" plugin="P" name="n"/>
        </load_composable_node>
        <lifecycle_node pkg="stub" exec="rec" name="l" namespace=""/>
        <ros_timer period="1.0"><log message="x"/></ros_timer>
        <set_ros_log_dir new_log_dir="x"/>
        """,
        name='it.launch.xml',
    )
    assert (out.status, out.err) == (0, '')
    assert "'a':" in out.stdout
