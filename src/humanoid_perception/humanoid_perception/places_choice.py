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
        """
        Resolve the path of the file of named places.

        Parameters
        ----------
        context
            The launch context, with the values of the two launch configurations.

        Returns
        -------
        str
            The path; empty if none was asked for and the scene has none.

        Raises
        ------
        SubstitutionFailure
            There is no file as was asked for; the message lists those of this package.

        """
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
    """
    Choose the file of named places by the launch arguments `places_file` and `scene`.

    Parameters
    ----------
    **_
        Ignored.

    Returns
    -------
    PlacesChoice
        A substitution for the path of the file; `scene` need not be declared.

    """
    return PlacesChoice(
        LaunchConfiguration('places_file'), LaunchConfiguration('scene', default='')
    )
