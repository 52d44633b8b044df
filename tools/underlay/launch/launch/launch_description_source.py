# SPDX-License-Identifier: Apache-2.0
"""Sources of launch descriptions."""

from __future__ import annotations

import os
from typing import Optional, TYPE_CHECKING

from launch.launch_description import LaunchDescription
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class LaunchDescriptionSource:
    """
    Source of a launch description: the description itself, or what it is loaded from when needed.

    Parameters
    ----------
    launch_description
        The description; None if a subclass loads it from `location`.
    location
        The path of the launch file, or a name for the source.
    method
        A human-readable name of the loading method.

    """

    _loads_file = False

    def __init__(
        self,
        launch_description: Optional[LaunchDescription] = None,
        location: SomeSubstitutionsType = '<string>',
        method: str = 'unspecified mechanism from a script',
    ) -> None:
        self.__launch_description = launch_description
        self.__location = normalize_to_list_of_substitutions(location)
        self.__expanded_location: Optional[str] = None
        self.__method = method
        self.__preview: Optional[tuple[str, dict[str, str], LaunchDescription]] = None

    @property
    def location(self) -> str:
        """Return the location; until it is known, the description of its substitutions."""
        if self.__expanded_location is None:
            return ' + '.join(sub.describe() for sub in self.__location)
        return self.__expanded_location

    @property
    def method(self) -> str:
        """Return a human-readable name of the loading method."""
        return self.__method

    def get_launch_description(self, context: LaunchContext) -> LaunchDescription:
        """
        Return the launch description, which is loaded once.

        Parameters
        ----------
        context
            The launch context, in which the location is performed.

        Raises
        ------
        FileNotFoundError
            The description is to be loaded from a file that does not exist.

        """
        location = self.expand_location(context)
        if self.__launch_description is None:
            self._require_file(location, context)
            self.__launch_description = self._from_preview(
                location
            ) or self._get_launch_description(location)
        return self.__launch_description

    def _require_file(self, location: str, context: LaunchContext) -> None:
        """Raise an error if the location must be a file, but is not."""
        if self._loads_file and not os.path.isfile(location):
            from launch._include_stack import missing_launch_file

            raise missing_launch_file(context, location)

    def expand_location(self, context: LaunchContext) -> str:
        """
        Return the location, which is performed once and then cached.

        Parameters
        ----------
        context
            The launch context, in which the location is performed.

        """
        if self.__expanded_location is None:
            self.__expanded_location = perform_substitutions(context, self.__location)
        return self.__expanded_location

    @property
    def location_parts(self) -> list[Substitution]:
        """Return the location as a list of substitutions."""
        return self.__location

    def location_in_advance(self) -> Optional[str]:
        """Return the location if it is known before the launch runs, else None."""
        from launch.launch_context import LaunchContext

        try:
            return perform_substitutions(LaunchContext(), self.__location)
        except Exception:
            return None

    def try_get_launch_description_without_context(self) -> Optional[LaunchDescription]:
        """Return the description if it is available before the launch runs, else None."""
        if self.__launch_description is not None:
            return self.__launch_description
        from launch.launch_context import LaunchContext

        try:
            location = perform_substitutions(LaunchContext(), self.__location)
            return self._from_preview(location) or self._load_preview(location)
        except Exception as error:
            from launch.logging import get_logger

            get_logger('launch.launch_description_source').debug(
                "the launch description at '%s' is not known yet: %s", self.location, error
            )
            return None

    def _load_preview(self, location: str) -> LaunchDescription:
        environment = dict(os.environ)
        description = self._get_launch_description(location)
        self.__preview = (location, environment, description)
        return description

    def _from_preview(self, location: str) -> Optional[LaunchDescription]:
        """Return the preview if neither the location nor the environment has changed."""
        if self.__preview is None:
            return None
        known_location, environment, description = self.__preview
        return (
            description if (location, dict(os.environ)) == (known_location, environment) else None
        )

    def _get_launch_description(self, location: str) -> LaunchDescription:
        """Load the description; subclasses override this."""
        raise NotImplementedError(
            f"the source class '{type(self).__name__}' does not say how to load '{location}'"
        )
