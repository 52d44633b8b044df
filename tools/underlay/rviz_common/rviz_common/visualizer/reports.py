# SPDX-License-Identifier: Apache-2.0
"""Reports on unknown or invalid content of a file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, TYPE_CHECKING

from rviz_common.config import Configuration, Place
from rviz_common.config.configuration import DISPLAYS
from rviz_common.visualizer.display_entry import DisplayEntry
from rviz_common.visualizer.display_tree import Entry, Group, UnknownEntry
from rviz_common.visualizer.global_options import UNUSED_OPTIONS

if TYPE_CHECKING:
    from rviz_common.visualizer.visualizer import Visualizer

__all__ = ['surprises']


def surprises(shown: Visualizer) -> Iterator[str]:
    """
    Format a warning for each part of a file that is unknown or invalid.

    Parameters
    ----------
    shown
        The visualizer that shows the file.

    Yields
    ------
    str
        A message with the file and, for displays, the line.

    """
    source = shown.configuration.document.source
    view = shown.cameras.view
    yield from _about_displays(shown.configuration, shown.displays.children)
    yield from _about_classes('tools', source, shown.tools.unknown, shown.tools.failures)
    yield from _about_classes('panels', source, shown.panels.unknown, shown.panels.failures)
    yield from _about_classes('views', source, [] if view.is_known else [view.class_name], {})
    for name in shown.options.unknown(UNUSED_OPTIONS):
        yield f"{source}: Unknown global option '{name}'. The file keeps it."
    yield from (f'{source}: In the global options, {each}' for each in shown.options.refusals)
    yield from (f'{source}: In the view, {each}' for each in view.values.refusals)
    for panel in shown.panels.panels:
        about = f"In the panel '{panel.name}' ({panel.CLASS})"
        yield from (f'{source}: {about}, {each}' for each in panel.values.refusals)
    for tool in shown.tools.tools:
        yield from (f'{source}: In {tool.CLASS}, {each}' for each in tool.values.refusals)


def _about_displays(configuration: Configuration, entries: list[Entry]) -> Iterator[str]:
    """Yield a message for each reason to leave displays out, and for each unknown content."""
    left_out: dict[str, list[str]] = {}
    document = configuration.document
    for place, entry in _placed(entries, DISPLAYS):
        if isinstance(entry, UnknownEntry):
            where = document.where(place)
            left_out.setdefault(entry.reason, []).append(f"'{entry.name}' ({where})")
        elif isinstance(entry, DisplayEntry):
            yield from _about_properties(document.where(place), entry)
    for reason, names in left_out.items():
        yield f'{reason.rstrip(".")}: {", ".join(names)} left out. The file keeps them.'


def _about_classes(
    what: str, source: str, classes: Iterable[str], failures: Mapping[str, str]
) -> Iterator[str]:
    """Yield a message for each class of other entries that is unknown or cannot be imported."""
    for name in dict.fromkeys(classes):
        if name in failures:
            reason = f"'{name}' cannot be used: {failures[name].rstrip('.')}"
        else:
            reason = f"No package provides {what} of the class '{name}'"
        yield f'{source}: {reason}. The file keeps it.'


def _about_properties(where: str, entry: DisplayEntry) -> Iterator[str]:
    display: Any = entry.display
    if display.unknown:
        listed = ', '.join(f"'{name}'" for name in display.unknown)
        yield (
            f"{where}: The display '{entry.name}' ({entry.class_name}) does not know {listed}. "
            'The file keeps it.'
        )
    for refusal in display.values.refusals:
        yield f"{where}: In the display '{entry.name}' ({entry.class_name}), {refusal}"


def _placed(entries: list[Entry], above: Place) -> Iterator[tuple[Place, Entry]]:
    """Return all entries with their places in the file."""
    for index, entry in enumerate(entries):
        yield (*above, index), entry
        if isinstance(entry, Group):
            yield from _placed(entry.children, (*above, index, 'Displays'))
