# SPDX-License-Identifier: Apache-2.0
"""Tests of what a command line can go on to, without a shell."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable
from importlib import import_module
import os
from pathlib import Path
import subprocess
import sys
import time

import pytest
from ros2cli.completion import graph
from ros2cli.completion.answering import find_completer, Finder, OF_ARGUMENT, OF_COMMAND

LONG_S = 20.0
# Whatever the machine has to do besides: people get no words after a few seconds.
PATIENT = """
from runpy import run_module
from ros2cli.completion import answering
answering.DEADLINE_S = 100.0
run_module('ros2cli', run_name='__main__', alter_sys=True)
"""
BASH_WORDBREAKS = ' \t\n"\'><=;|&(:'
LAUNCH_FILE = """\
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument

print('loaded')


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('rate_hz', default_value='50'),
        DeclareLaunchArgument('robot', default_value='nao', choices=['nao', 'wolfgang']),
        DeclareLaunchArgument('use_rviz', default_value='false'),
    ])
"""

Complete = Callable[..., list[str]]


@pytest.fixture
def prefix(tmp_path: Path) -> Path:
    """Make a folder of installed packages with one that has a launch file and a program."""
    for folder in ('share/ament_index/resource_index/packages', 'share/demo_pkg/launch'):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / 'share/ament_index/resource_index/packages/demo_pkg').touch()
    (tmp_path / 'share/demo_pkg/launch/demo.launch.py').write_text(LAUNCH_FILE)
    program = tmp_path / 'lib/demo_pkg/talk'
    program.parent.mkdir(parents=True)
    program.write_text('#!/bin/sh\n')
    program.chmod(0o755)
    return tmp_path


@pytest.fixture
def complete(prefix: Path, tmp_path: Path, ros_environment_variables: dict[str, str]) -> Complete:
    """Return a function that asks for the words after a line, as the shell function does."""

    def ask(line: str, point: int | None = None, *, is_patient: bool = True) -> list[str]:
        program = ['-c', PATIENT] if is_patient else ['-m', 'ros2cli']
        path = os.pathsep.join([str(prefix), os.environ.get('AMENT_PREFIX_PATH', '')])
        result = subprocess.run(
            ['bash', '-c', '"$@" 8>&1 >/dev/null', 'bash', sys.executable, *program],
            env={
                **ros_environment_variables,
                'AMENT_PREFIX_PATH': path,
                'COMP_LINE': line,
                'COMP_POINT': str(len(line) if point is None else point),
                'ROS_HOME': str(tmp_path),
                '_ARGCOMPLETE': '1',
                '_ARGCOMPLETE_COMP_WORDBREAKS': BASH_WORDBREAKS,
                '_ARGCOMPLETE_IFS': '\n',
                '_ARGCOMPLETE_SHELL': 'bash',
                '_ARGCOMPLETE_SUPPRESS_SPACE': '0',
            },
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            timeout=120,
        )
        return result.stdout.split('\n')

    return ask


@pytest.mark.parametrize('target', sorted({*OF_COMMAND.values(), *OF_ARGUMENT.values()}))
def test_table_names_functions(target: str) -> None:
    """Each row of the table names a function that exists."""
    module, _, name = target.partition(':')
    assert callable(getattr(import_module(f'ros2cli.completion.{module}'), name))


def test_command_is_more_precise_than_argument() -> None:
    """A command's own row goes before that of the argument; names that are new have none."""
    assert find_completer('ros2 run', 'package_name') is not None
    assert find_completer('ros2 run', 'package_name') != find_completer(
        'ros2 pkg xml', 'package_name'
    )
    assert find_completer('ros2 pkg create', 'package_name') is None
    assert find_completer('ros2 topic pub', 'rate') is None


@pytest.mark.parametrize(
    'line, words',
    [
        ('ros2 lau', ['launch ']),
        ('ros2 topic pu', ['pub ']),
        ('ros2 topic echo --qos-rel', ['--qos-reliability ']),
        ('ros2 topic echo --qos-durability tr', ['transient_local ']),
        ('ros2 run demo_p', ['demo_pkg ']),
        ('ros2 run demo_pkg ', ['talk ']),
        ('ros2 launch demo_p', ['demo_pkg ']),
        ('ros2 launch demo_pkg d', ['demo.launch.py ']),
        ('ros2 launch demo_pkg demo.launch.py ', ['rate_hz:=', 'robot:=', 'use_rviz:=']),
        ('ros2 launch demo_pkg demo.launch.py robot:=nao r', ['rate_hz:=']),
        ('ros2 launch demo_pkg demo.launch.py robot:=w', ['wolfgang ']),
        ('ros2 launch demo_pkg demo.launch.py use_rviz:=', ['true', 'false']),
        ('ros2 pkg prefix demo_p', ['demo_pkg ']),
        ('ros2 topic find sensor_msgs/msg/JointS', ['sensor_msgs/msg/JointState ']),
        ('ros2 topic find sensor_m', None),
        ('ros2 pkg create --license Ap', ['Apache-2.0 ']),
        ('ros2 topic pub /x std_msgs/msg/String ', ['"{data: \'\'}"']),
        ('ros2 topic pub /x std_msgs/msg/String "', ["{data: ''}"]),
        ('ros2 service call /x std_srvs/srv/SetBool ', ['"{data: false}"']),
        ('ros2 topic pub /x std_msgs/msg/Nope ', ['']),
        ('ros2 nope ', ['']),
        ('ros2 run nope ', ['']),
        ('ros2 launch demo_pkg nope.launch.py ', ['']),
    ],
)
def test_words(complete: Complete, line: str, words: list[str] | None) -> None:
    """The words after a line are those that fit there; after a mistake there are none."""
    found = complete(line)
    if words is None:
        assert all(word.startswith('sensor_msgs/msg/') for word in found)
        assert len(found) > 1
    else:
        assert found == words


def test_file_instead_of_package(complete: Complete, prefix: Path) -> None:
    """The path of a launch file is completed, and so are its arguments."""
    path = prefix / 'share/demo_pkg/launch/demo.launch.py'
    assert complete(f'ros2 launch {str(path)[:-8]}') == [f'{path} ']
    assert complete(f'ros2 launch {path} us') == ['use_rviz:=']


def test_cursor_inside_the_line(complete: Complete) -> None:
    """Only what is before the cursor counts."""
    assert complete('ros2 launch demo_p -n', len('ros2 launch demo_p')) == ['demo_pkg ']


def test_launch_file_that_takes_its_time(complete: Complete, prefix: Path) -> None:
    """The shell does not wait for a launch file that does not come to an end."""
    path = prefix / 'slow.launch.py'
    path.write_text(f"import os\nos.system('sleep {LONG_S}')\n")
    begin = time.monotonic()
    assert complete(f'ros2 launch {path} ', is_patient=False) == ['']
    assert time.monotonic() - begin < LONG_S


@pytest.mark.parametrize('written', ['{}', '"{}', "'{}"])
def test_path_that_needs_quotes(complete: Complete, prefix: Path, written: str) -> None:
    """Spaces and apostrophes in a path are quoted in the manner of the line."""
    path = prefix / "robin's files"
    path.mkdir()
    (path / 'demo.launch.py').touch()
    begin = str(path).replace("'", "'\\''" if written.startswith("'") else "'")
    if written == '{}':
        begin = begin.replace("'", "\\'").replace(' ', '\\ ')
    end = ' ' if written == '{}' else ''
    assert complete(f'ros2 launch {written.format(begin)}/d') == [f'{begin}/demo.launch.py{end}']


def test_variable_in_path(complete: Complete, prefix: Path) -> None:
    """A path that begins with a variable keeps it."""
    (prefix / 'bag').mkdir()
    (prefix / 'bag.mcap').touch()
    (prefix / 'bag.txt').touch()
    assert complete('ros2 bag play $ROS_HOME/ba') == ['$ROS_HOME/bag.mcap', '$ROS_HOME/bag/']


def test_zsh_quotes_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    """For zsh only what separates a word from its description is escaped."""
    monkeypatch.setenv('_ARGCOMPLETE_SHELL', 'zsh')
    assert Finder().quote_completions(["world:=it's here"], '"', None) == ["world\\:=it's here"]


def test_nodes_by_what_they_offer(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where only nodes with a life cycle, or containers, make sense no others are offered."""
    services = {
        '/box/_container/load_node': ['composition_interfaces/srv/LoadNode'],
        '/lamp/get_state': ['lifecycle_msgs/srv/GetState'],
        '/arm/get_state': ['demo_msgs/srv/Pose'],
    }
    found = graph.Names({}, services, ['/arm', '/box', '/lamp'])
    monkeypatch.setattr(graph, 'graph_names', lambda: found)
    assert graph.lifecycle_nodes('', Namespace()) == ['/lamp']
    assert graph.containers('', Namespace()) == ['/box']


@pytest.mark.usefixtures('talker')
def test_names_of_the_graph(complete: Complete) -> None:
    """Topics, nodes and the types of topics come from the graph; later from memory."""
    for _ in range(20):
        if complete('ros2 topic echo /jo') == ['/joint_commands ']:
            break
    assert complete('ros2 topic echo /jo') == ['/joint_commands ']
    assert complete('ros2 topic echo /robot1/_') == ['/robot1/_secret ']
    assert complete('ros2 node info /ta') == ['/talker ']
    for name in ('/joint_commands', 'joint_commands'):
        assert complete(f'ros2 topic pub {name} ') == ['sensor_msgs/msg/JointState ']


def test_memory_is_short(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is remembered is forgotten with time, and when processes come or go."""
    neighbours = 1
    monkeypatch.setenv('ROS_HOME', str(tmp_path))
    monkeypatch.setattr(graph, 'participant_ports', lambda domain: neighbours)
    assert graph.recall('/a/b') is None
    graph.remember('/a/b', ['rate_hz'])
    assert graph.recall('/a/b') == ['rate_hz']
    assert graph.recall('/a_b') is None
    neighbours = 2
    assert graph.recall('/a/b') is None
    neighbours = 1
    monkeypatch.setattr(graph, 'REMEMBERED_S', -1.0)
    assert graph.recall('/a/b') is None


def test_home_that_cannot_be_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where nothing can be written nothing is remembered, and that is all."""
    (tmp_path / 'file').touch()
    monkeypatch.setenv('ROS_HOME', str(tmp_path / 'file'))
    graph.remember('graph', [])
    assert graph.recall('graph') is None
