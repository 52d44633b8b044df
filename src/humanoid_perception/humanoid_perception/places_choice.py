# SPDX-License-Identifier: Apache-2.0
"""Launch substitution for the file of named places of a scene."""

from __future__ import annotations

from typing import Any

from humanoid_common.errors import UserError
from humanoid_perception.places_file import places_path
from launch import LaunchContext, Substitution
from launch.substitutions import LaunchConfiguration, SubstitutionFailure
from launch.utilities import perform_substitutions


class PlacesChoice(Substitution):
    """
    Substitution for the path of a file of named places: the given one, or else that of the scene.

    Parameters
    ----------
    given
        A path, the name of a file of this package, or empty.
    scene
        The name of the simulated scene, or empty. A scene without named places is allowed.

    """

    def __init__(self, given: LaunchConfiguration, scene: LaunchConfiguration) -> None:
        super().__init__()
        self._given, self._scene = given, scene

    def describe(self) -> str:
        """Return a description of this substitution as a string."""
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
            The path; empty if none is given and the scene has none.

        Raises
        ------
        SubstitutionFailure
            The given file does not exist; the message lists those of this package.

        """
        given = perform_substitutions(context, [self._given])
        if given:
            try:
                return str(places_path(given))
            except UserError as error:
                raise SubstitutionFailure(str(error)) from None
        scene = perform_substitutions(context, [self._scene])
        try:
            return str(places_path(scene) or '') if scene.isidentifier() else ''
        except UserError:
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
