# SPDX-License-Identifier: Apache-2.0
"""A display that can be shown, and whose failures harm nothing else."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any

from rviz_common.described_error import described_error
from rviz_common.display import Display
from rviz_common.status import Level, Statuses
from rviz_common.visualizer.entry import Entry

__all__ = ['DisplayEntry']


class DisplayEntry(Entry):
    """
    A display, which is started and stopped as it is enabled; one that fails is stopped.

    Parameters
    ----------
    display
        A display that has not been started.

    """

    def __init__(self, display: Display) -> None:
        self.display = display
        self.class_name = display.CLASS
        self._is_running = False
        self._is_shown_above = False

    @property
    def name(self) -> str:
        """Return the name that a person has given."""
        return self.display.name

    @name.setter
    def name(self, name: str) -> None:
        """
        Rename the display.

        Parameters
        ----------
        name
            The name for the user and the file.

        """
        self.display.name = name

    @property
    def is_enabled(self) -> bool:
        """Tell if it is to be shown."""
        return bool(self.display.values['Enabled'])

    @property
    def is_running(self) -> bool:
        """Tell if it is shown."""
        return self._is_running

    @property
    def status(self) -> Statuses:
        """Return what the display has to say."""
        return self.display.status

    def enable(self, is_enabled: bool) -> None:
        """
        Enable or disable the display; one that has failed is started again.

        Parameters
        ----------
        is_enabled
            As for `Entry.enable`.

        """
        self.display.values['Enabled'] = is_enabled
        self.appear(self._is_shown_above)

    def appear(self, is_shown_above: bool) -> None:
        """
        Start or stop the display, as it is enabled and shown above.

        Parameters
        ----------
        is_shown_above
            As for `Entry.appear`.

        """
        self._is_shown_above = is_shown_above
        is_wanted = is_shown_above and self.is_enabled
        if is_wanted and not self._is_running:
            self.status.forget('Display')
            self._is_running = True
            self._guarded(self.display.start)
        elif not is_wanted and self._is_running:
            self._guarded(self.display.stop)
            self._is_running = False

    def change(self, path: str, value: Any) -> None:
        """
        Set a property, and apply it if the display runs.

        Parameters
        ----------
        path, value
            The path of the property, such as `Shape/Color`, and its new value.

        Raises
        ------
        ValueError
            The value cannot be used; the message is that of `Property.read`.

        """
        before = self.display.values[path]
        self.display.values[path] = value
        if self._is_running and self.display.values[path] != before:
            self._guarded(lambda: self.display.on_change(path))

    def update(self) -> None:
        """Draw the next frame."""
        if self._is_running:
            self._guarded(self.display.update)

    def to_file(self) -> dict[str, Any]:
        """Return what the file is to have."""
        return self.display.to_file()

    def _guarded(self, work: Callable[[], None]) -> None:
        """Have the display do something; stop it if it fails."""
        try:
            work()
        except Exception as error:  # whatever a display does, the others go on
            self._fail(error)

    def _fail(self, error: Exception) -> None:
        self._is_running = False
        with suppress(Exception):  # what has failed may not be able to stop either
            self.display.stop()
        self.display.context.scene.remove_by_name(self.display.root)
        reason = f'{type(error).__name__}: {error}'
        self.status.say(
            'Display',
            Level.ERROR,
            f'It has been stopped by an error ({reason}). Disable and enable it to try again.',
        )
        self.display.context.node.get_logger().error(
            f"Display '{self.name}' ({self.class_name}) has been stopped: {described_error(error)}"
        )
