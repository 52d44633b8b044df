# SPDX-License-Identifier: Apache-2.0
"""Which checkboxes switch displays on and off, without opening their folders."""

from __future__ import annotations

from typing import Any

from rviz_common.context import Context
from rviz_common.visualizer.display_tree import Entry, Group

__all__ = ['DisplaySwitches', 'Switch']

WHOLE_GROUP = 'Whole group'


class DisplaySwitches:
    """
    A checkbox for each display of a group; those of a group in it are in a folder of their own.

    Parameters
    ----------
    context
        The page.
    group
        The displays and groups.

    Attributes
    ----------
    switches
        The checkboxes, by display or group.

    """

    def __init__(self, context: Context, group: Group) -> None:
        self._context = context
        self._group = group
        self._place = context.gui.add_folder(None)
        self.switches: dict[Entry, Switch] = {}
        self.follow()

    def follow(self) -> None:
        """Add checkboxes for new displays, and remove those of deleted displays."""
        children = self._group.children
        for entry in [each for each in self.switches if each not in children]:
            self.switches.pop(entry).remove()
        with self._place:
            for entry in children:
                if entry in self.switches:
                    self.switches[entry].follow()
                else:
                    self.switches[entry] = Switch(self._context, entry)

    def say(self) -> None:
        """Show the current names, and which displays are enabled."""
        for switch in self.switches.values():
            switch.say()


class Switch:
    """
    A checkbox to enable a display, or to enable a group above the checkboxes of its displays.

    Parameters
    ----------
    context
        The page.
    entry
        The display or the group.

    Attributes
    ----------
    box
        The handle that viser has for the checkbox.
    below
        The checkboxes of a group; None for a display.

    """

    def __init__(self, context: Context, entry: Entry) -> None:
        self._entry = entry
        self._place = context.gui.add_folder(entry.name if isinstance(entry, Group) else None)
        self.below: DisplaySwitches | None = None
        with self._place:
            label = WHOLE_GROUP if isinstance(entry, Group) else entry.name
            self.box: Any = context.gui.add_checkbox(
                label, entry.is_enabled, hint=entry.class_name
            )
            if isinstance(entry, Group):
                self.below = DisplaySwitches(context, entry)
        self._named: Any = self._place if self.below else self.box
        context.on_input(self.box, entry.enable)

    def follow(self) -> None:
        """Add and remove the checkboxes of a group as its displays come and go."""
        if self.below is not None:
            self.below.follow()

    def say(self) -> None:
        """Show the current name, and whether the entry is enabled."""
        if self._named.label != self._entry.name:
            self._named.label = self._entry.name
        if self.box.value != self._entry.is_enabled:
            self.box.value = self._entry.is_enabled
        if self.below is not None:
            self.below.say()

    def remove(self) -> None:
        """Remove the checkbox, and all below it."""
        self._place.remove()
