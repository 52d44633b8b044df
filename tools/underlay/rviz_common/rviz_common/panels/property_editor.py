# SPDX-License-Identifier: Apache-2.0
"""Widgets to edit properties."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import ExitStack
import time
from typing import Any

from rviz_common.context import Context
from rviz_common.panels.flags_folder import FlagsFolder
from rviz_common.panels.widgets import add_widget
from rviz_common.properties import Choice, Flag, Flags, Property, Values

__all__ = ['PropertyEditor']

QUIET_S = 0.6
"""Debounce time in s: a typed value takes effect once it has been stable for this long."""


class PropertyEditor:
    """
    Widgets for some properties; those whose paths have several names are in folders.

    Parameters
    ----------
    context
        The page.
    values
        The properties and their values.
    change
        Sets a property: called with its path and the user's value; may raise ValueError.
    without
        Paths of properties that get no widget.

    """

    def __init__(
        self,
        context: Context,
        values: Values,
        change: Callable[[str, Any], None],
        without: Iterable[str] = (),
    ) -> None:
        self._values = values
        self._change = change
        self._context = context
        self._waiting: dict[str, tuple[float, Any]] = {}
        self._folders: dict[str, Any] = {}
        shown = [each for each in values.properties.values() if each.path not in set(without)]
        flags = [each for each in shown if isinstance(each, Flags)]
        shown = [each for each in shown if not isinstance(each, Flags)]
        self._widgets = {each.path: self._add(each) for each in shown}
        self._said = {each.path: values[each.path] for each in shown}
        self._flags = [FlagsFolder(context, each, values, change) for each in flags]

    def update(self) -> None:
        """Apply typed values, and show values changed by a program."""
        now_s = time.monotonic()
        for path, (due_s, value) in list(self._waiting.items()):
            if now_s >= due_s:
                del self._waiting[path]
                self._set(path, value)
        for path, said in self._said.items():
            value = self._values[path]
            if value != said and path not in self._waiting:
                self._said[path] = value
                self._widgets[path].value = value
        for folder in self._flags:
            folder.update()

    def _add(self, of: Property) -> Any:
        with ExitStack() as above:
            names = of.path.split('/')[:-1]
            for depth in range(len(names)):
                above.enter_context(self._folder('/'.join(names[: depth + 1])))
            widget = add_widget(self._context.gui, of, self._values[of.path])
        delay_s = 0.0 if isinstance(of, (Flag, Choice)) else QUIET_S
        self._context.on_input(widget, lambda value: self._take(of.path, value, delay_s))
        return widget

    def _folder(self, path: str) -> Any:
        if path not in self._folders:
            label = path.rpartition('/')[2]
            self._folders[path] = self._context.gui.add_folder(label, expand_by_default=False)
        return self._folders[path]

    def _take(self, path: str, value: Any, delay_s: float) -> None:
        self._waiting[path] = time.monotonic() + delay_s, value

    def _set(self, path: str, value: Any) -> None:
        """Set a property; an invalid value is replaced by the current one."""
        try:
            self._change(path, value)
        except ValueError as error:
            self._context.visualizer.notify('Not changed', f"'{path}' {error}.")
            self._said[path] = value
        else:
            self._said[path] = self._values[path]
