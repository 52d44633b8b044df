# SPDX-License-Identifier: Apache-2.0
"""How a display is made from a file, and run so that its failures stop nothing else."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
import itertools
from typing import Any

from rviz_common.context import Context
from rviz_common.display import Display
from rviz_common.plugins import DISPLAYS, load_plugin
from rviz_common.selection import Hit, Ray
from rviz_common.status import described_error, Level, Statuses
from rviz_common.visualizer.display_tree import Entry, Group, UnknownEntry

__all__ = ['DisplayEntry', 'Maker']


class DisplayEntry(Entry):
    """
    A display that is started and stopped as it is enabled; one that fails is stopped.

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
        """The name given by the user."""
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
        """Whether it is enabled."""
        return bool(self.display.values['Enabled'])

    @property
    def is_running(self) -> bool:
        """Whether the display is running."""
        return self._is_running

    @property
    def status(self) -> Statuses:
        """The status of the display."""
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
            The value is invalid; the message is that of `Property.read`.

        """
        before = self.display.values[path]
        self.display.values[path] = value
        if self._is_running and self.display.values[path] != before:
            self._guarded(lambda: self.display.on_change(path))

    def update(self) -> None:
        """Draw the next frame."""
        if self._is_running:
            self._guarded(self.display.update)

    def pick(self, ray: Ray) -> Hit | None:
        """
        Find the first object of the display on a ray, if it runs.

        Parameters
        ----------
        ray
            As for `Entry.pick`.

        """
        found: list[Hit | None] = [None]
        if self._is_running:
            self._guarded(lambda: found.append(self.display.pick(ray)))
        return found[-1]

    def to_file(self) -> dict[str, Any]:
        """Return the entry for the .rviz file."""
        return self.display.to_file()

    def _guarded(self, work: Callable[[], None]) -> None:
        """Run a callable of the display; stop the display if it fails."""
        try:
            work()
        except Exception as error:  # a failing display must not stop the others
            self._fail(error)

    def _fail(self, error: Exception) -> None:
        self._is_running = False
        with suppress(Exception):  # a failed display may fail to stop, too
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


class Maker:
    """
    Factory of entries; each display gets its own path of the scene.

    Parameters
    ----------
    context
        The context of the displays.
    root
        The path of the scene below which they draw.

    """

    def __init__(self, context: Context, root: str) -> None:
        self._context = context
        self._root = root
        self._numbers = itertools.count(1)

    def entry(self, given: Mapping[str, Any]) -> Entry:
        """
        Make an entry with all its children from a .rviz file; it is not shown yet.

        Parameters
        ----------
        given
            The entry of the file, with its `Class`.

        Returns
        -------
        Entry
            A display or a group; an `UnknownEntry` if the display cannot be created.

        """
        if given['Class'] == Group.CLASS:
            below = given.get('Displays') or []
            return Group(given, [self.entry(each) for each in below])
        try:
            kind = load_plugin(DISPLAYS, given['Class'])
        except LookupError:
            return UnknownEntry(
                given, f"No package provides displays of the class '{given['Class']}'."
            )
        except ImportError as error:
            return UnknownEntry(given, f"'{given['Class']}' cannot be used: {error}")
        try:
            return DisplayEntry(kind(self._context, self._path(), given))
        except Exception as error:  # a failing display must not stop the others
            return UnknownEntry(
                given, f"'{given['Class']}' cannot be created: {type(error).__name__}: {error}"
            )

    def new(self, class_name: str) -> DisplayEntry:
        """
        Make a display of a class with its defaults.

        Parameters
        ----------
        class_name
            The class, such as `rviz_default_plugins/Grid`.

        Raises
        ------
        LookupError
            No installed package offers it.
        ImportError
            The module of the class cannot be imported.

        """
        return DisplayEntry(load_plugin(DISPLAYS, class_name)(self._context, self._path()))

    def _path(self) -> str:
        return f'{self._root}/{next(self._numbers)}'
