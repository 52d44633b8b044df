# SPDX-License-Identifier: Apache-2.0
"""Check which file of named places a launch file chooses."""

from __future__ import annotations

from humanoid_perception.places_choice import places_choice
from launch import LaunchContext
from launch.substitutions import SubstitutionFailure
import pytest


def chosen(given: str, scene: str = '') -> str:
    """Return the file for launch arguments."""
    context = LaunchContext()
    context.launch_configurations.update(places_file=given, scene=scene)
    return places_choice().perform(context)


def test_the_places_of_a_scene() -> None:
    """A scene may have none."""
    assert chosen('', 'apartment').endswith('/config/places_apartment.yaml')
    assert chosen('apartment', 'room') == chosen('', 'apartment')
    assert chosen('', 'moon') == ''


@pytest.mark.parametrize(
    ('given', 'said'),
    [
        ('apartmant', "Did you mean 'apartment'"),
        ('~no_one/places.yaml', "there is no home folder '~no_one'. Give the whole path"),
    ],
)
def test_a_file_that_is_not_there(given: str, said: str) -> None:
    """It is said in a sentence."""
    with pytest.raises(SubstitutionFailure, match=said):
        chosen(given)
