# SPDX-License-Identifier: Apache-2.0
"""What a rehearsal tells about nodes."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Optional

from launch import LaunchDescription, LaunchService
from launch.actions import LogInfo
from launch.dry_run import rehearse
from launch.dry_run_record import tree_lines
from launch_ros.actions import (
    LifecycleNode,
    LoadComposableNodes,
    Node,
    PushRosNamespace,
    ROSTimer,
    SetParameter,
)
from launch_ros.descriptions import ComposableNode
from launch_ros.ros_adapters import find_ros_adapter
from launch_ros.utilities.effective_parameters import effective_parameters
import pytest

OWN = '/n:\n  ros__parameters:\n    a: 1\n    b: {c: [1, 2]}\n'
ALL = '/**:\n  ros__parameters:\n    a: 2\n'


@pytest.mark.parametrize(
    'words, expected',
    [
        (['--params-file', 'OWN', '--params-file', 'ALL'], {'a': 2, 'b.c': [1, 2]}),
        (['--params-file', 'ALL', '--params-file', 'OWN'], {'a': 1, 'b.c': [1, 2]}),
        (['--params-file', 'OWN', '-p', 'a:=3'], {'a': 3, 'b.c': [1, 2]}),
        # The single parameter joins those of `/**`, which come before those of the node.
        (['--params-file', 'ALL', '--params-file', 'OWN', '-p', 'a:=3'], {'a': 1, 'b.c': [1, 2]}),
        (['-p', 'n:a:=7', '-p', 'm:a:=8'], {'a': 7}),
        (['--params-file', '/no/such.yaml'], {}),
    ],
)
def test_effective_parameters(tmp_path: Path, words: list[str], expected: dict[str, Any]) -> None:
    """The last of the keys that match wins, where a key counts from its first place on."""
    for name, text in (('OWN', OWN), ('ALL', ALL)):
        (tmp_path / name).write_text(text)
    words = [str(tmp_path / word) if word in ('OWN', 'ALL') else word for word in words]
    assert effective_parameters(words, 'n', '/') == expected


@pytest.mark.parametrize('name, expected', [(None, {'a': 2}), ('n', {'a': 1, 'b.c': [1, 2]})])
def test_node_without_a_name(
    tmp_path: Path, name: Optional[str], expected: dict[str, Any]
) -> None:
    """Of a node whose name is not known only wildcards are certain."""
    path = tmp_path / 'p.yaml'
    path.write_text(ALL + OWN)
    assert effective_parameters(['--params-file', str(path)], name, None) == expected


def test_facts_of_a_node(tmp_path: Path) -> None:
    """Names, files, parameters from everywhere and remappings are told."""
    path = tmp_path / 'p.yaml'
    path.write_text(ALL)
    node = Node(
        executable='/bin/true',
        name='n',
        parameters=[{'rate': 5, 'deep': {'text': 'true'}}, str(path)],
        remappings=[('a', 'b')],
    )
    service = LaunchService(noninteractive=True)
    service.include_launch_description(
        LaunchDescription([PushRosNamespace('arm'), SetParameter('use_sim_time', True), node])
    )
    root, status = rehearse(service)
    facts = root.children[-1].facts
    assert status == 0
    assert (facts['node_name'], facts['node_namespace']) == ('n', '/arm')
    assert facts['parameter_files'] == [str(path)]
    assert facts['parameters'] == {'a': 2, 'deep.text': 'true', 'rate': 5, 'use_sim_time': True}
    assert facts['remappings'] == {'a': 'b'}


def test_actions_that_need_a_ros_node() -> None:
    """What they would do is told, and the launch's own node is not made for it."""
    nodes = [ComposableNode(package='p', plugin='P', name='n', parameters=[{'rate': 5}])]
    service = LaunchService(noninteractive=True)
    service.include_launch_description(
        LaunchDescription(
            [
                LifecycleNode(executable='/bin/true', name='l', namespace=''),
                LoadComposableNodes(composable_node_descriptions=nodes, target_container='/c'),
                ROSTimer(period=2.0, actions=[LogInfo(msg='late')]),
            ]
        )
    )
    root, status = rehearse(service)
    assert status == 0 and find_ros_adapter(service.context) is None
    node, loading, timer = root.children
    assert node.facts['node_name'] == 'l'
    assert loading.facts['target_container'] == '/c'
    assert loading.facts['composable_nodes'][0]['parameters'] == {'rate': 5}
    assert timer.waiting[0][0] == '2.0 s to pass'
    text = '\n'.join(tree_lines(root))
    assert '  composable node:\n    package: p\n    plugin: P\n    node name: n\n' in text
