# SPDX-License-Identifier: Apache-2.0
"""The arguments of the launch files, and the view."""

from __future__ import annotations

from pathlib import Path

from launch import LaunchContext
from launch.actions import DeclareLaunchArgument
from launch.launch_description_sources import AnyLaunchDescriptionSource
import pytest
import yaml

PACKAGE = Path(__file__).parents[1]


@pytest.mark.parametrize(
    ('name', 'arguments'),
    [
        ('description', {'urdf_package', 'urdf_package_path'}),
        ('display', {'jsp_gui', 'rviz_config'}),
    ],
)
def test_arguments(name: str, arguments: set[str]) -> None:
    """They have the names of ROS 2 Jazzy; only the file of the robot has no default."""
    path = str(PACKAGE / 'launch' / f'{name}.launch.py')
    description = AnyLaunchDescriptionSource(path).get_launch_description(LaunchContext())
    declared = [each for each in description.entities if isinstance(each, DeclareLaunchArgument)]
    assert {each.name for each in declared} == arguments
    assert all(bool(each.default_value) == (name == 'display') for each in declared)


def test_the_view_shows_any_robot() -> None:
    """It takes the robot from the topic of the robot state publisher."""
    view = yaml.safe_load((PACKAGE / 'config' / 'urdf.rviz').read_text())
    displays = {each['Name']: each for each in view['Visualization Manager']['Displays']}
    assert displays['RobotModel']['Description Topic']['Value'] == '/robot_description'
