# SPDX-License-Identifier: Apache-2.0
"""The base class of displays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from rviz_common.context import Context
from rviz_common.plugins import name_of
from rviz_common.properties import Flag, Property, Values
from rviz_common.selection import Hit, Ray
from rviz_common.status import Level, Statuses

__all__ = ['Display']

COMMON = ('Class', 'Name', 'Value')


class Display:
    """
    An entry of the list of displays.

    A display draws below `root`, a path of the scene that no other display uses. It is started
    when it is enabled, and stopped when it is disabled; `update` is called for each frame in
    between. Nothing is drawn before `start`.

    Parameters
    ----------
    context
        The node, the page and the transforms.
    root
        The path of the scene below which it draws.
    given
        Its entry in the .rviz file, None for a new display. Invalid values are reported as a
        warning in the status, and the defaults are used instead.

    Attributes
    ----------
    name
        The name shown to the user, which can be changed.
    values
        The properties, with `Enabled` as the first.
    status
        The status that the display reports.

    """

    CLASS: ClassVar[str]
    """The class name in the file, such as `rviz_default_plugins/Grid`."""
    PROPERTIES: ClassVar[tuple[Property, ...]] = ()
    UNUSED: ClassVar[tuple[str, ...]] = ()
    """Properties of RViz, by top-level name, that do not apply in a browser."""

    def __init__(
        self, context: Context, root: str, given: Mapping[str, Any] | None = None
    ) -> None:
        self.context = context
        self.root = root
        self.name = self._first_name = name_of(given, self.CLASS)
        enabled = Flag('Enabled', True, 'Whether to show the display.')
        self.values = Values((enabled, *self.PROPERTIES), given)
        self.status = Statuses()
        for refusal in self.values.refusals:
            self.status.say('File', Level.WARN, refusal)

    @property
    def unknown(self) -> list[str]:
        """The properties in the file that are unknown."""
        return self.values.unknown((*COMMON, *self.UNUSED))

    def to_file(self) -> dict[str, Any]:
        """Return the entry for the .rviz file."""
        written = self.values.to_file()
        if 'Class' not in written or self.name != self._first_name:
            written.update({'Class': self.CLASS, 'Name': self.name})
        if 'Enabled' in written:
            written['Value'] = self.values['Enabled']
        return written

    def start(self) -> None:
        """Start showing the display."""

    def stop(self) -> None:
        """Stop showing the display."""

    def update(self) -> None:
        """Draw the next frame."""

    def pick(self, ray: Ray) -> Hit | None:
        """
        Find the first object of the display on a ray; by default the user can select none.

        Parameters
        ----------
        ray
            The ray, in the fixed frame.

        """
        return None

    def on_change(self, path: str) -> None:
        """
        Apply a property that was changed while the display is running; by default restart it.

        Parameters
        ----------
        path
            The path of the property, such as `Shape/Color`.

        """
        self.stop()
        self.start()
