# SPDX-License-Identifier: Apache-2.0
"""The settings of single links of a robot, or of single frames of tf, in a file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rviz_common.properties import Flag, Number, Property

__all__ = ['Parts']

SHOWN = Flag('Value', True)
ALPHA = Number('Alpha', 1.0, '', 0.0, 1.0)
AXES = Flag('Show Axes', False)


class Parts:
    """
    Settings of named parts, such as the links of a robot, in one section of a file.

    A part that the file does not name is shown if `all_shown` is set.

    Parameters
    ----------
    given
        The section of the file, by the name of the part; invalid values are ignored.

    Attributes
    ----------
    all_shown
        Whether parts that the file does not name are shown.

    """

    def __init__(self, given: Mapping[str, Any] | None) -> None:
        self._given: dict[str, Any] = dict(given) if isinstance(given, Mapping) else {}
        self.all_shown = True

    def show_all(self, are_shown: bool) -> None:
        """
        Show all parts, or none of them, overriding their individual settings.

        Parameters
        ----------
        are_shown
            Whether all are shown.

        """
        self.all_shown = are_shown
        for settings in self._given.values():
            if isinstance(settings, dict):
                settings['Value'] = are_shown

    def is_shown(self, name: str) -> bool:
        """
        Whether a part is to be shown.

        Parameters
        ----------
        name
            The name of the part.

        """
        return bool(self._setting(name, SHOWN, self.all_shown))

    def alpha(self, name: str) -> float:
        """
        Return the opacity of a part, from 0 to 1.

        Parameters
        ----------
        name
            The name of the part.

        """
        return float(self._setting(name, ALPHA, ALPHA.default))

    def has_axes(self, name: str) -> bool:
        """
        Whether a part is to be shown with its axes.

        Parameters
        ----------
        name
            The name of the part.

        """
        return bool(self._setting(name, AXES, AXES.default))

    def put_into(self, written: dict[str, Any], name: str) -> dict[str, Any]:
        """
        Merge the settings of the parts into the entry for the file.

        Parameters
        ----------
        written
            The entry of the file.
        name
            The section of the parts, such as `Links`; without it the entry is left unchanged.

        Returns
        -------
        dict[str, Any]
            The entry with the settings.

        """
        parts = {part: each for part, each in self._given.items() if isinstance(each, dict)}
        section = written.get(name)
        return {**written, name: {**section, **parts}} if isinstance(section, dict) else written

    def _setting(self, name: str, setting: Property, default: Any) -> Any:
        settings = self._given.get(name)
        if not isinstance(settings, Mapping) or setting.path not in settings:
            return default
        try:
            return setting.read(settings[setting.path])
        except ValueError:
            return default
