# SPDX-License-Identifier: Apache-2.0
"""What the launch files of navigation would start, as a rehearsal of the launch tells."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription
from launch.dry_run import rehearse
from launch.launch_description_sources import PythonLaunchDescriptionSource
import pytest

FOLDER = Path(__file__).resolve().parents[1] / 'nav2_bringup'
SERVERS = {
    'controller_server',
    'smoother_server',
    'planner_server',
    'behavior_server',
    'velocity_smoother',
    'collision_monitor',
    'bt_navigator',
    'waypoint_follower',
    'docking_server',
    'map_server',
    'amcl',
    'lifecycle_manager_navigation',
    'lifecycle_manager_localization',
}


@pytest.fixture(autouse=True)
def _launch_files_of_this_folder(tmp_path, monkeypatch):
    """Include the launch files beside this test, and not those that are installed."""
    index = tmp_path / 'share' / 'ament_index' / 'resource_index' / 'packages'
    index.mkdir(parents=True)
    (index / 'nav2_bringup').touch()
    (tmp_path / 'share' / 'nav2_bringup').symlink_to(FOLDER)
    before = os.environ.get('AMENT_PREFIX_PATH', '')
    monkeypatch.setenv('AMENT_PREFIX_PATH', f'{tmp_path}{os.pathsep}{before}')


def _facts(name: str = 'bringup_launch.py', **arguments: str) -> list[dict[str, Any]]:
    """Return what each action of a launch file tells."""
    path = str(FOLDER / 'launch' / name)
    given = {'params_file': str(FOLDER / 'params' / 'nav2_params.yaml'), **arguments}
    service = LaunchService(noninteractive=True)
    service.include_launch_description(
        LaunchDescription(
            [
                IncludeLaunchDescription(
                    PythonLaunchDescriptionSource(path), launch_arguments=given.items()
                )
            ]
        )
    )
    root, status = rehearse(service)
    assert status == 0
    found: list[dict[str, Any]] = []

    def walk(node: Any) -> None:
        found.append(node.facts)
        for child in node.children:
            walk(child)

    walk(root)
    return found


def _components(facts: list[dict[str, Any]]) -> dict[str, dict[str, Any]]:
    loaded = [node for each in facts for node in each.get('composable_nodes', ())]
    return {each['node_name']: each for each in loaded}


def test_composition():
    """One container, into which all servers are loaded with their parameters."""
    facts = _facts(map='/m.yaml', use_sim_time='true')
    programs = [each['node_name'] for each in facts if 'node_name' in each]
    assert programs == ['nav2_container']
    components = _components(facts)
    assert set(components) == SERVERS
    assert {each.get('target_container') for each in facts} - {None} == {'/nav2_container'}
    assert components['map_server']['parameters']['yaml_filename'] == '/m.yaml'
    assert all(each['parameters']['use_sim_time'] is True for each in components.values())
    assert components['amcl']['parameters']['base_frame_id']
    managed = components['lifecycle_manager_localization']['parameters']
    assert list(managed['node_names']) == ['map_server', 'amcl']
    assert managed['autostart'] is True


def test_processes():
    """Without composition each server is a program."""
    facts = _facts(use_composition='False', map='/m.yaml')
    programs = {each['node_name']: each for each in facts if 'node_name' in each}
    assert set(programs) == SERVERS and not _components(facts)
    assert programs['amcl']['parameters']['base_frame_id']
    assert programs['map_server']['parameters']['yaml_filename'] == '/m.yaml'


def test_map_of_the_parameter_file(tmp_path):
    """Without the argument, the map is the one of the file; the argument counts more."""
    path = tmp_path / 'p.yaml'
    path.write_text('map_server: {ros__parameters: {yaml_filename: /file.yaml}}\n')
    for composed in ('True', 'False'):
        for given, expected in (('', '/file.yaml'), ('/m.yaml', '/m.yaml')):
            facts = _facts(params_file=str(path), map=given, use_composition=composed)
            programs = {each['node_name']: each for each in facts if 'node_name' in each}
            server = {**programs, **_components(facts)}['map_server']
            assert server['parameters']['yaml_filename'] == expected
            assert 'docking_server' not in {**programs, **_components(facts)}


def test_namespace():
    """Servers and container are below it, and get the parameters of the file all the same."""
    facts = _facts(namespace='left', use_namespace='true', map='/m.yaml')
    assert {each.get('target_container') for each in facts} - {None} <= {
        'left/nav2_container',
        '/left/nav2_container',
    }
    components = _components(facts)
    assert set(components) == SERVERS
    assert components['amcl']['parameters']['base_frame_id']


@pytest.mark.parametrize(('robot', 'scan'), [('tb3', 'base_scan'), ('tb4', 'rplidar_link')])
def test_loopback_simulation(robot, scan):
    """A robot without physics, its map, navigation without AMCL, and RViz if wanted."""
    facts = _facts(f'{robot}_loopback_simulation.launch.py', use_rviz='False')
    programs = {each['node_name']: each for each in facts if 'node_name' in each}
    assert {'loopback_simulator', 'map_server', 'lifecycle_manager_map_server'} <= set(programs)
    assert programs['loopback_simulator']['parameters']['scan_frame_id'] == scan
    assert Path(programs['map_server']['parameters']['yaml_filename']).is_file()
    assert 'rviz2' not in programs
    components = _components(facts)
    assert 'amcl' not in components and 'planner_server' in components
    assert components['planner_server']['parameters']['use_sim_time'] is True
    everything = _facts(f'{robot}_loopback_simulation.launch.py', use_composition='False')
    assert {'rviz2', 'planner_server'} <= {each.get('node_name') for each in everything}


@pytest.mark.parametrize(('slam', 'has_amcl'), [('True', False), ('False', True)])
def test_map_or_slam(slam, has_amcl):
    """With SLAM there is neither AMCL nor a map server."""
    components = _components(_facts(slam=slam, map='/m.yaml'))
    assert ('amcl' in components) is has_amcl
    assert 'planner_server' in components
