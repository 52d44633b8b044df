# SPDX-License-Identifier: Apache-2.0
"""The map that belongs to a scene, for launch files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ament_index_python.packages import get_package_share_directory
from humanoid_common.errors import UserError
from humanoid_common.paths import expanded_path
from launch import LaunchContext, Substitution
from launch.substitutions import LaunchConfiguration, SubstitutionFailure
from launch.utilities import perform_substitutions


class MapChoice(Substitution):
    """
    Substitution for the path of a map: the requested one, or else that of the scene.

    Parameters
    ----------
    given
        The requested map: a path, the name of a map of this package, or empty.
    scene
        The name of the simulated scene, or empty.

    """

    def __init__(self, given: LaunchConfiguration, scene: LaunchConfiguration) -> None:
        super().__init__()
        self._given, self._scene = given, scene

    def describe(self) -> str:
        """Return a human-readable description."""
        return f'MapChoice({self._given.describe()}, {self._scene.describe()})'

    def perform(self, context: LaunchContext) -> str:
        """
        Resolve the path of the map's YAML file.

        Parameters
        ----------
        context
            The launch context, with the values of the two launch configurations.

        Returns
        -------
        str
            The absolute path.

        Raises
        ------
        SubstitutionFailure
            There is no such map, whose message lists those of this package, or no such home
            folder.

        """
        folder = Path(get_package_share_directory('humanoid_navigation')) / 'maps'
        given = perform_substitutions(context, [self._given])
        name = given or perform_substitutions(context, [self._scene])
        try:
            candidates = (expanded_path(given), folder / f'{name}.yaml')
        except UserError as error:
            raise SubstitutionFailure(str(error)) from None
        for path in candidates:
            if name and path.is_file():
                return str(path.absolute())
        stems = sorted(path.stem for path in folder.glob('*.yaml'))
        known = ', '.join(stem for stem in stems if not stem.endswith('_mask'))
        what = f"There is no map '{given}'" if given else f"There is no map of the scene '{name}'"
        raise SubstitutionFailure(
            f'{what}. Give the path of a map, as map:=/path/to/map.yaml, or the name of one of '
            f'this package ({known}), or make one with slam:=True.'
        )


def map_choice(**_: Any) -> MapChoice:
    """
    Choose the map by the launch arguments `map` and `scene`.

    Parameters
    ----------
    **_
        Ignored.

    Returns
    -------
    MapChoice
        A substitution for the path of the map; `scene` need not be declared.

    """
    return MapChoice(LaunchConfiguration('map'), LaunchConfiguration('scene', default=''))
