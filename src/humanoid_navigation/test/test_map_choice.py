# SPDX-License-Identifier: Apache-2.0
"""Check which map a launch file chooses."""

from __future__ import annotations

from pathlib import Path

from humanoid_navigation.map_choice import map_choice
from launch import LaunchContext
from launch.substitutions import SubstitutionFailure
import pytest


def chosen(given: str, scene: str = '') -> str:
    """Return the map for launch arguments."""
    context = LaunchContext()
    context.launch_configurations.update(map=given, scene=scene)
    return map_choice().perform(context)


def test_a_map_by_path_name_and_scene(tmp_path: Path) -> None:
    """The given one comes first; it is a file, or one of the package."""
    own = tmp_path / 'own.yaml'
    own.touch()
    assert chosen(str(own), 'apartment') == str(own)
    assert chosen('', 'apartment').endswith('/maps/apartment.yaml')
    assert chosen('apartment', 'other') == chosen('', 'apartment')


@pytest.mark.parametrize(
    ('given', 'scene', 'said'),
    [
        ('/nowhere.yaml', '', "There is no map '/nowhere.yaml'. Give the path .*apartment"),
        ('', 'moon', "There is no map of the scene 'moon'"),
        ('~no_one/room.yaml', '', "there is no home folder '~no_one'. Give the whole path"),
    ],
)
def test_a_map_that_is_not_there(given: str, scene: str, said: str) -> None:
    """It is said in a sentence."""
    with pytest.raises(SubstitutionFailure, match=said):
        chosen(given, scene)
