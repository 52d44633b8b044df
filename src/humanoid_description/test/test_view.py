# SPDX-License-Identifier: Apache-2.0
"""Check how the humanoid is shown."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from ament_index_python.packages import get_package_share_directory
from humanoid_common.testing.launching import (
    argument_defaults,
    load_launch_file,
    undescribed_arguments,
)
import pytest
import yaml

SHARE = Path(get_package_share_directory('humanoid_description'))


@pytest.fixture(name='view', scope='module')
def _view() -> dict[str, Any]:
    """Return the installed configuration of RViz."""
    view: dict[str, Any] = yaml.safe_load((SHARE / 'config' / 'robot_view.rviz').read_text())
    return view['Visualization Manager']


def test_displays(view: dict[str, Any]) -> None:
    """The view shows a ground, the robot and its frames, from plugins that come with RViz."""
    classes = [display['Class'].split('/') for display in view['Displays']]
    assert {library for library, _ in classes} == {'rviz_default_plugins'}
    assert [name for _, name in classes] == ['Grid', 'RobotModel', 'TF']
    assert all(display['Enabled'] for display in view['Displays'])


def test_description_topic(view: dict[str, Any]) -> None:
    """The view takes the model from the latched topic, also if it comes late."""
    topic = view['Displays'][1]['Description Topic']
    assert topic['Value'] == '/robot_description'
    assert topic['Durability Policy'] == 'Transient Local'


def test_fixed_frame(view: dict[str, Any], robot: ElementTree.Element) -> None:
    """The fixed frame is the root of the model."""
    assert view['Global Options']['Fixed Frame'] == robot.findall('link')[0].attrib['name']


MODEL = {
    'scale': '1.0', 'prefix': '', 'upper_body_only': 'false', 'hands': 'false',
    'colours': 'light', 'use_sim_time': 'false',
}  # fmt: skip


@pytest.mark.parametrize(
    ('name', 'defaults'), [('view', {'gui': 'true', **MODEL}), ('description', MODEL)]
)
def test_launch_arguments(name: str, defaults: dict[str, str]) -> None:
    """The launch files have the arguments of the model, with its defaults."""
    description = load_launch_file(SHARE / 'launch' / f'{name}.launch.py')
    assert argument_defaults(description) == defaults
    assert undescribed_arguments(description) == []
