# SPDX-License-Identifier: Apache-2.0
"""The file of named places that belongs to a scene, for launch files."""

from __future__ import annotations

from typing import Any

from humanoid_perception.places import places_path, PlacesError
from launch import LaunchContext, Substitution
from launch.substitutions import LaunchConfiguration, SubstitutionFailure
from launch.utilities import perform_substitutions


class PlacesChoice(Substitution):
    """
    Stands for the path of a file of named places: the one asked for, or else that of the scene.

    Parameters
    ----------
    given
        What was asked for: a path, the name of one of this package, or nothing.
    scene
        The name of the simulated scene, or nothing. One without named places is fine.

    """

    def __init__(self, given: LaunchConfiguration, scene: LaunchConfiguration) -> None:
        super().__init__()
        self._given, self._scene = given, scene

    def describe(self) -> str:
        """Return a short description for people."""
        return f'PlacesChoice({self._given.describe()}, {self._scene.describe()})'

    def perform(self, context: LaunchContext) -> str:
        """Return the path, or nothing; SubstitutionFailure says which files there are."""
        given = perform_substitutions(context, [self._given])
        if given:
            try:
                return str(places_path(given))
            except PlacesError as error:
                raise SubstitutionFailure(str(error)) from None
        scene = perform_substitutions(context, [self._scene])
        try:
            return str(places_path(scene) or '') if scene.isidentifier() else ''
        except PlacesError:
            return ''


def places_choice(**_: Any) -> PlacesChoice:
    """Return the file for the arguments `places_file` and `scene` of a launch."""
    return PlacesChoice(
        LaunchConfiguration('places_file'), LaunchConfiguration('scene', default='')
    )
