# SPDX-License-Identifier: Apache-2.0
"""Loading nodes into containers, with a container that prints what it is asked for."""

from __future__ import annotations

from collections.abc import Callable
import json
from pathlib import Path
import signal
import sys
import threading
from typing import Any

from launch.actions import EmitEvent, RegisterEventHandler, Shutdown, TimerAction
from launch.conditions import IfCondition
from launch.event_handlers import OnExecutionComplete, OnProcessIO
from launch.events import matches_action
from launch.events.process import SignalProcess
from launch.substitutions import TextSubstitution
from launch_ros.actions import (
    ComposableNodeContainer,
    LoadComposableNodes,
    PushRosNamespace,
    SetParameter,
    SetRemap,
)
from launch_ros.descriptions import ComposableNode, ParameterFile
import pytest

pytest.importorskip('rclpy')
pytest.importorskip('composition_interfaces')
pytestmark = pytest.mark.usefixtures('own_domain')

Run = Callable[..., Any]
FAKE = str(Path(__file__).with_name('fake_container.py'))


def _container(*nodes: ComposableNode, name: str = 'c', **kwargs: Any) -> ComposableNodeContainer:
    return ComposableNodeContainer(
        executable=sys.executable,
        arguments=[FAKE],
        name=name,
        namespace='box',
        composable_node_descriptions=list(nodes),
        output='screen',
        output_format='{line}',
        **kwargs,
    )


def _node(name: Any = None, plugin: str = 'Good', **kwargs: Any) -> ComposableNode:
    return ComposableNode(package='pkg', plugin=plugin, name=name, **kwargs)


def _asked(out: str) -> list[dict[str, Any]]:
    return [json.loads(line) for line in out.splitlines() if line.startswith('{')]


def _load_then_end(run: Run, *before: Any, nodes: Any, target: Any) -> Any:
    """Load nodes, end the launch when that is done, and return the status and the text."""
    load = LoadComposableNodes(composable_node_descriptions=nodes, target_container=target)
    return run(
        RegisterEventHandler(OnExecutionComplete(target_action=load, on_completion=Shutdown())),
        *before,
        load,
    )


def _ends(out: str) -> None:
    assert 'Traceback' not in out
    assert 'launch_ros' not in [thread.name for thread in threading.enumerate()]


@pytest.mark.parametrize('of_container', [True, False])
def test_missing_parameter_file(run: Run, of_container: bool) -> None:
    """It keeps the launch from starting anything; the place is a line of the launch file."""
    node = _node('talker', parameters=['/no.yaml'])
    load = LoadComposableNodes(composable_node_descriptions=[node], target_container='/box/c')
    entity = _container(node) if of_container else load
    status, out = run(entity)
    assert status == 1 and 'process started' not in out
    assert "the parameter file '/no.yaml' does not exist" in out
    created = entity.call_site
    assert created is not None and created.file_name == __file__
    assert f'It comes from {created} (LoadComposableNodes)' in out


def test_what_a_container_is_asked_for(run: Run, tmp_path: Path) -> None:
    """Names, remappings and typed parameters arrive, with those of all nodes before."""
    path = tmp_path / 'p.yaml'
    path.write_text('/**:\n  ros__parameters: {any: 1e-3}\n/other:\n  ros__parameters: {no: 1}\n')
    container = _container()
    node = _node(
        ['tal', TextSubstitution(text='ker')],
        namespace='left',
        remappings=[('in', 'out')],
        parameters=[
            ParameterFile(str(path)),
            {'flag': True, 'number': 5, 'text': 'true', 'sub': TextSubstitution(text='[1, 2]')},
            {'nested': {'ratio': 0.5}, 'texts': ['a', '1'], 'raw': b'\x01\x02'},
        ],
        extra_arguments=[{'use_intra_process_comms': True}],
    )
    status, out = _load_then_end(
        run,
        container,
        PushRosNamespace('robot'),
        SetParameter('all', 2.5),
        SetRemap('x', 'y'),
        nodes=[node],
        target=container,
    )
    assert status == 0
    assert _asked(out) == [
        {
            'container': '/box/c',
            'package': 'pkg',
            'plugin': 'Good',
            'name': 'talker',
            'namespace': '/robot/left',
            'remaps': ['x:=y', 'in:=out'],
            'parameters': [
                ['all', 2.5],
                ['any', 0.001],
                ['flag', True],
                ['number', 5],
                ['text', 'true'],
                ['sub', [1, 2]],
                ['nested.ratio', 0.5],
                ['texts', ['a', '1']],
                ['raw', ['\x01', '\x02']],
            ],
            'extra': [['use_intra_process_comms', True]],
        }
    ]
    assert (
        '[INFO] [launch_ros.actions.load_composable_nodes]: '
        "Loaded node '/robot/left/talker' in container '/box/c'\n"
    ) in out
    _ends(out)


def test_container_loads_its_nodes(run: Run) -> None:
    """They are loaded in order, without the container's namespace, but for false conditions."""
    nodes = [
        _node('b'),
        _node('left_out', condition=IfCondition('false')),
        _node(),
        _node('a', condition=IfCondition('true')),
        _node('end', plugin='Die'),
    ]
    status, out = run(_container(*nodes))
    assert status == 0
    asked = [(each['name'], each['namespace']) for each in _asked(out)]
    assert asked == [('b', ''), ('', ''), ('a', ''), ('end', '')]
    assert "Loaded node '/inborn' in container '/box/c'" in out


def test_node_that_cannot_be_loaded(run: Run) -> None:
    """The failure is reported; the other nodes are loaded, and the launch is no failure."""
    nodes = [_node('bad', plugin='Bad'), _node('good')]
    container = _container()
    status, out = _load_then_end(run, container, nodes=nodes, target='/box/c')
    assert status == 0
    assert (
        '[ERROR] [launch_ros.actions.load_composable_nodes]: '
        "Failed to load node 'bad' of type 'Bad' in container '/box/c': no such class\n"
    ) in out
    assert "Loaded node '/good' in container '/box/c'" in out


def test_two_actions_load_at_once(run: Run, tmp_path: Path) -> None:
    """Each of two containers answers only when the other is asked as well."""
    ends: list[str] = []
    containers, handlers, loads = [], [], []

    def end(event: Any, context: Any) -> Any:
        ends.append('one')
        return Shutdown() if len(ends) == 2 else None

    for name in ('first', 'second'):
        containers.append(_container(name=name))
        node = ComposableNode(package=str(tmp_path / 'meet'), plugin='Meet', name=name)
        load = LoadComposableNodes(
            composable_node_descriptions=[node], target_container=['/box/', name]
        )
        loads.append(load)
        handlers.append(
            RegisterEventHandler(OnExecutionComplete(target_action=load, on_completion=end))
        )
    (tmp_path / 'meet').mkdir()
    status, out = run(*handlers, *containers, *loads)
    assert status == 0
    assert "Loaded node '/first' in container '/box/first'" in out
    assert "Loaded node '/second' in container '/box/second'" in out


def test_two_nodes_of_one_name(run: Run) -> None:
    """The second node of a full name is reported in the name of the container."""
    nodes = [_node('n'), _node('n'), _node(), _node()]
    status, out = run(
        _container(*nodes, name='idle'), TimerAction(period=0.1, actions=[Shutdown()])
    )
    assert status == 0 and out.count('there are now at least') == 1
    assert '[WARNING] [/box/idle]: there are now at least 2 nodes with the name /n created' in out


def test_shutdown_while_waiting(run: Run) -> None:
    """A container that is not there does not delay the end."""
    status, out = run(
        LoadComposableNodes(composable_node_descriptions=[_node('n')], target_container='/gone'),
        TimerAction(period=0.5, actions=[Shutdown()]),
    )
    assert status == 0
    assert (
        '[WARNING] [launch_ros.actions.load_composable_nodes]: '
        "Abandoning wait for the '/gone/_container/load_node' service, due to shutdown.\n"
    ) in out
    _ends(out)


def test_container_that_dies(run: Run) -> None:
    """Nodes that nobody will load any more are reported one by one."""
    status, out = run(_container(_node('first', plugin='Die'), _node('second')))
    assert status == 0
    reason = "the process that offers '/box/c/_container/load_node' has ended"
    for name, plugin in (('first', 'Die'), ('second', 'Good')):
        text = f"Failed to load node '{name}' of type '{plugin}' in container '/box/c': {reason}"
        assert text in out
    _ends(out)


def test_nothing_to_load_needs_no_node(run: Run) -> None:
    """Without nodes to load the launch makes no node of its own."""
    status, out = run(
        ComposableNodeContainer(executable='true', name='c', namespace=''),
        LoadComposableNodes(
            composable_node_descriptions=[_node('n', condition=IfCondition('false'))],
            target_container='/c',
        ),
    )
    assert status == 0 and 'launch_ros' not in out


def test_container_that_is_not_installed(run: Run, prefix: Callable[..., Any]) -> None:
    """The error names the package; nothing is started."""
    prefix('pkg')
    other = ComposableNodeContainer(executable='true', name='other', namespace='')
    status, out = run(
        other,
        ComposableNodeContainer(
            package='my_containers',
            executable='component_container',
            name='c',
            namespace='',
            composable_node_descriptions=[_node('n')],
        ),
    )
    assert status == 1 and 'process started' not in out
    assert "package 'my_containers' not found, searching: [" in out


@pytest.mark.parametrize('target', [1, None])
def test_wrong_target(target: Any) -> None:
    """The target is a container or its name."""
    with pytest.raises(TypeError, match='target_container'):
        LoadComposableNodes(composable_node_descriptions=[], target_container=target)


@pytest.mark.parametrize('killed_at', ['second', 'third'])
@pytest.mark.parametrize('is_named', [True, False])
def test_container_that_is_started_anew(run: Run, killed_at: str, is_named: bool) -> None:
    """All nodes are loaded again into a container that respawns, also if it died meanwhile."""
    container = _container(respawn=True, respawn_delay=0.1)
    asked: list[str] = []

    def note(event: Any) -> Any:
        asked.extend(each['name'] for each in _asked(event.text.decode()))
        if asked[-1:] == ['third'] and (killed_at != 'third' or asked.count('third') == 2):
            return TimerAction(period=0.3, actions=[Shutdown()])
        if asked[-1:] == [killed_at] and asked.count(killed_at) == 1:
            return EmitEvent(
                event=SignalProcess(
                    signal_number=signal.SIGKILL, process_matcher=matches_action(container)
                )
            )
        return None

    load = LoadComposableNodes(
        composable_node_descriptions=[_node(name) for name in ('first', 'second', 'third')],
        target_container='/box/c' if is_named else container,
    )
    status, out = run(
        RegisterEventHandler(OnProcessIO(target_action=container, on_stdout=note)),
        TimerAction(period=30.0, actions=[Shutdown()]),
        container,
        load,
    )
    assert status == 0
    assert asked[-3:] == ['first', 'second', 'third']
    for name in ('first', 'second', 'third'):
        assert f"Loaded node '/{name}' in container '/box/c'" in out
    _ends(out)
