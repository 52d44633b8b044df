# SPDX-License-Identifier: Apache-2.0
"""Which widgets edit properties, and when a value that was entered takes effect."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import ExitStack
from itertools import islice
import math
import time
from typing import Any

from rviz_common.context import Context
from rviz_common.properties import (
    Choice,
    ColorOf,
    Flag,
    Flags,
    Number,
    Property,
    Values,
    Vector,
    Whole,
)
from viser import GuiApi

__all__ = ['FlagsFolder', 'PropertyEditor']

QUIET_S = 0.6
"""Debounce time in s: a typed value takes effect once it has been stable for this long."""

MOST = 200
"""The maximum number of names with a checkbox."""


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
            widget = _add_widget(self._context.gui, of, self._values[of.path])
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


class FlagsFolder:
    """
    A folder with a checkbox for each name of a property.

    Parameters
    ----------
    context
        The page.
    of
        The property.
    values
        Holds its value.
    change
        Called with the path of the property and the new flags by name when a user clicks one.

    """

    def __init__(
        self, context: Context, of: Flags, values: Values, change: Callable[[str, Any], None]
    ) -> None:
        self._context = context
        self._path = of.path
        self._values = values
        self._change = change
        label = of.path.rpartition('/')[2]
        self._folder = context.gui.add_folder(label, expand_by_default=False)
        self._boxes: dict[str, Any] = {}
        self.update()

    def update(self) -> None:
        """Add checkboxes for new names, and show values changed by a program."""
        for name, is_on in islice(self._values[self._path].items(), MOST):
            box = self._boxes.get(name)
            if box is None:
                self._add(name, is_on)
            elif box.value != is_on:
                box.value = is_on

    def _add(self, name: str, is_on: bool) -> None:
        with self._folder:
            box = self._context.gui.add_checkbox(name or '(no name)', is_on)
        self._boxes[name] = box
        self._context.on_input(box, lambda value: self._set(name, value))

    def _set(self, name: str, is_on: bool) -> None:
        self._change(self._path, {**self._values[self._path], name: is_on})


def _add_widget(gui: GuiApi, of: Property, value: Any) -> Any:
    """
    Add the widget for a kind of property.

    Parameters
    ----------
    gui
        Where to add it.
    of
        The property, whose type determines the kind of widget.
    value
        Its value.

    Returns
    -------
    Any
        The handle that viser has for the widget.

    """
    label, hint = of.path.rpartition('/')[2], of.description or None
    if isinstance(of, Flag):
        return gui.add_checkbox(label, value, hint=hint)
    if isinstance(of, Choice):
        return gui.add_dropdown(label, of.choices, initial_value=value, hint=hint)
    if isinstance(of, ColorOf):
        return gui.add_rgb(label, value, hint=hint)
    if isinstance(of, Vector):
        return gui.add_vector3(label, value, step=0.01, hint=hint)
    if isinstance(of, Number):
        return _add_number(gui, of, value, label, hint)
    return gui.add_text(label, str(value), hint=hint)


def _add_number(gui: GuiApi, of: Number, value: float, label: str, hint: str | None) -> Any:
    return gui.add_number(
        label,
        value,
        min=_limit(of.minimum),
        max=_limit(of.maximum),
        step=1 if isinstance(of, Whole) else 0.01,
        hint=hint,
    )


def _limit(limit: float) -> float | None:
    return limit if math.isfinite(limit) else None
