# SPDX-License-Identifier: Apache-2.0
"""Tests of the environment that the set-up files give."""

from __future__ import annotations

from pathlib import Path
import subprocess

import pytest

CLEAN = {'PATH': '/usr/local/bin:/usr/bin:/bin', 'TERM': 'dumb'}


def sourced(root: Path, file: str, script: str, **variables: str) -> str:
    """Return what a script prints in a bash that has sourced only one file."""
    done = subprocess.run(
        ['bash', '--norc', '-c', f'source "$0"; {script}', str(root / file)],
        env={**CLEAN, 'HOME': str(root / 'nowhere'), **variables},
        cwd='/',
        capture_output=True,
        encoding='utf-8',
        check=False,
    )
    assert done.stderr == ''
    return done.stdout


@pytest.mark.parametrize('file', ['.venv/setup.bash', 'install/setup.bash'])
def test_one_file_gives_all(root: Path, file: str) -> None:
    """Python, colcon and ros2 of the environment, rclpy and the distribution are there."""
    modules = 'rclpy, tf2_msgs.msg, composition_interfaces.srv, launch_ros.actions'
    script = f'python3 -c "import {modules}"; which ros2 colcon; echo $ROS_DISTRO'
    lines = sourced(root, file, script).splitlines()
    environment = root / '.venv' / 'bin'
    assert lines == [str(environment / 'ros2'), str(environment / 'colcon'), 'jazzy']


def test_no_search_path_has_an_empty_part(root: Path) -> None:
    """An empty part would mean the current folder."""
    names = 'PATH LD_LIBRARY_PATH PYTHONPATH AMENT_PREFIX_PATH CMAKE_PREFIX_PATH'
    script = f'for name in {names}; do echo "${{!name}}"; done'
    for value in sourced(root, 'install/setup.bash', script).splitlines():
        assert value
        assert '' not in value.split(':')


def test_a_middleware_that_is_not_here_is_not_used(root: Path) -> None:
    """The choice of another installation does not stop every node."""
    script = 'echo $RMW_IMPLEMENTATION'
    variables = {'RMW_IMPLEMENTATION': 'rmw_cyclonedds_cpp'}
    assert sourced(root, 'install/setup.bash', script, **variables) == 'rmw_fastrtps_cpp\n'


def test_the_user_s_choices_stay(root: Path) -> None:
    """A discovery range and a DDS profile that are set already are kept."""
    script = 'echo $ROS_AUTOMATIC_DISCOVERY_RANGE; echo $FASTRTPS_DEFAULT_PROFILES_FILE'
    assert sourced(root, '.venv/setup.bash', script).splitlines() == [
        'LOCALHOST',
        str(root / '.venv/share/ros_environment/config/fastdds.xml'),
    ]
    own = {
        'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET',
        'FASTRTPS_DEFAULT_PROFILES_FILE': '/my/own.xml',
    }
    assert sourced(root, '.venv/setup.bash', script, **own).splitlines() == list(own.values())


def test_in_environment_ignores_another_installation(root: Path) -> None:
    """What another ROS installation set up does not leak in."""
    variables = {'PYTHONPATH': '/opt/ros/humble/lib', 'AMENT_PREFIX_PATH': '/opt/ros/humble'}
    output = subprocess.check_output(
        [root / 'tools' / 'in_environment', 'env'],
        env={**CLEAN, **variables},
        encoding='utf-8',
    )
    assert 'humble' not in output


def test_xacro_runs_as_a_package(root: Path, tmp_path: Path) -> None:
    """`ros2 run xacro xacro` expands a file."""
    model = tmp_path / 'a b.xacro'
    model.write_text(
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">'
        '<xacro:arg name="x" default="1"/><link name="l$(arg x)"/></robot>'
    )
    command = [root / 'tools' / 'ros2', 'run', 'xacro', 'xacro', model, 'x:=7']
    assert '<link name="l7"/>' in subprocess.check_output(command, encoding='utf-8')
