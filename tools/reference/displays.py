# SPDX-License-Identifier: Apache-2.0
"""Describe what .rviz files may list, as the code has it: displays, panels, tools, views."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
import inspect
import math
from typing import Any

from rviz_common.panel import DOCKED
from rviz_common.panels import panel_tabs
from rviz_common.plugins import DISPLAYS, load_plugin, PANELS, plugin_names, TOOLS
from rviz_common.properties import (
    Choice,
    ColorOf,
    Flag,
    Flags,
    Frame,
    Number,
    Property,
    Topic,
    topic_properties,
    Vector,
    Whole,
)
from rviz_common.view import KINDS
from rviz_common.visualizer import tool_box
from rviz_common.visualizer.global_options import OPTIONS, UNUSED_OPTIONS

OWN = (
    'nav2_rviz_plugins',
    'robot_console',
    'rviz_common',
    'rviz_default_plugins',
    'rviz_imu_plugin',
    'vision_msgs_rviz_plugins',
)
"""The packages of this project, and not those that somebody adds."""
OF_RVIZ = tuple(
    f'rviz_default_plugins/{name}'
    for name in (
        'AccelStamped Axes Camera DepthCloud Effort FluidPressure Grid GridCells Illuminance '
        'Image InteractiveMarkers LaserScan Map Marker MarkerArray Odometry Path PointCloud '
        'PointCloud2 PointStamped Polygon Pose PoseArray PoseWithCovariance Range '
        'RelativeHumidity RobotModel TF Temperature TwistStamped Wrench'
    ).split()
)
"""The displays that come with RViz2 of Jazzy."""
KIND_NAMES = {
    Flag: 'true or false',
    Flags: 'true or false for each',
    ColorOf: 'red; green; blue',
    Vector: 'X, Y and Z',
    Frame: 'frame',
    Whole: 'whole number',
    Number: 'number',
}
QUALITY = ('Depth', 'Durability Policy', 'History Policy', 'Reliability Policy')

INTRODUCTION = """\
# What .rviz files may list

What `rviz2` in the browser knows. A `/` in the name of a property leads below another one:
`Topic/Depth` is the `Depth` below `Topic`. A file may leave out each of them. What is not listed
here is named once in the log, and kept when the file is saved. How to use it:
[how-to/browser.md](../how-to/browser.md).
"""
OF_TOPICS = """\
The tables below have the properties of a topic in one row: its name, and in what else it
differs from these.
"""
OF_DISPLAYS = """\
All have a `Name` and `Enabled`. `rviz_common/Group` has `Displays`, and no properties of its own.
"""
OF_PANELS = """\
All have a `Name`, which is the title of their tab. Those in tabs have:
"""


def lines() -> Iterator[str]:
    """Yield the lines of the page."""
    yield INTRODUCTION
    yield '## Topics\n'
    yield OF_TOPICS
    yield from _table(topic_properties(''), single=True)
    yield '## Global Options\n'
    yield from _table(OPTIONS)
    yield from _without_meaning(UNUSED_OPTIONS)
    yield '## Displays\n'
    yield OF_DISPLAYS
    yield from _plugins(DISPLAYS)
    yield from _missing_displays()
    yield '## Panels\n'
    yield OF_PANELS
    yield from _table([DOCKED])
    yield from _plugins(PANELS)
    yield from _without_meaning(panel_tabs.BUILT_IN)
    yield '## Tools\n'
    yield from _plugins(TOOLS)
    yield from _without_meaning(tool_box.BUILT_IN)
    yield '## Views\n'
    for name in sorted(KINDS):
        yield from _described(name, KINDS[name], ())


def _plugins(group: str) -> Iterator[str]:
    for name in plugin_names(group):
        if name.partition('/')[0] in OWN:
            kind = load_plugin(group, name)
            yield from _described(name, kind, kind.UNUSED)


def _described(name: str, kind: Any, unused: tuple[str, ...]) -> Iterator[str]:
    summary = (inspect.getdoc(kind) or '').partition('\n')[0]
    yield f'### {name}\n\n{summary}\n'
    yield from _table(kind.PROPERTIES)
    yield from _without_meaning(unused)


def _table(properties: Iterable[Property], single: bool = False) -> Iterator[str]:
    """Yield a table of properties; those of a topic are one row, or single ones."""
    shown = list(properties)
    if not shown:
        return
    yield '| property | type | default | |'
    yield '|---|---|---|---|'
    by_path = {each.path: each for each in shown}
    topics = [] if single else [each.path for each in shown if isinstance(each, Topic)]
    hidden = {quality for topic in topics for quality in _qualities(topic)}
    for each in shown:
        if each.path not in hidden:
            special = _quality(each.path, by_path) if each.path in topics else ''
            yield _row(each, special)
    yield ''


def _row(of: Property, special: str) -> str:
    default = ', '.join(each for each in (_default(of), special) if each)
    cells = [f'`{of.path}`', _kind(of), default, of.description]
    return f'| {" | ".join(cell.replace("|", "&#124;") for cell in cells)} |'


def _default(of: Property) -> str:
    value = of.write(of.default)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return ', '.join(str(part) for part in value.values())
    return f'`{value}`' if isinstance(value, str) and value else str(value)


def _kind(of: Property) -> str:
    """Say what a property may be."""
    if isinstance(of, Choice):
        return ', '.join(f'`{each}`' if each else 'nothing' for each in of.choices)
    if isinstance(of, Topic):
        return f'topic of `{of.type_name}`' if of.type_name else 'topic'
    name = next((name for kind, name in KIND_NAMES.items() if isinstance(of, kind)), 'text')
    return f'{name}{_limits(of)}' if isinstance(of, Number) else name


def _limits(of: Number) -> str:
    low, high = of.minimum, of.maximum
    if math.isinf(low) and math.isinf(high):
        return ''
    if math.isinf(low):
        return f', up to {high:g}'
    return f', from {low:g}' + ('' if math.isinf(high) else f' to {high:g}')


def _qualities(topic: str) -> list[str]:
    """Return the paths of the quality of service of a topic, which stands beside them."""
    above, _, last = topic.rpartition('/')
    return [f'{above}/{name}' for name in QUALITY] if last == 'Value' else []


def _quality(topic: str, by_path: dict[str, Property]) -> str:
    """Say in what a topic differs from others, if its quality of service can be set."""
    usual = {each.path: each.default for each in topic_properties('')}
    found = []
    for name, path in zip(QUALITY, _qualities(topic)):
        of = by_path.get(path)
        if of is not None and of.default != usual[f'Topic/{name}']:
            found.append(f'{name} {of.default}')
    return ', '.join(found)


def _missing_displays() -> Iterator[str]:
    """Say which displays of RViz2 there are not."""
    missing = sorted(set(OF_RVIZ) - set(plugin_names(DISPLAYS)))
    names = ', '.join(f'`{name.partition("/")[2]}`' for name in missing)
    yield f'### What RViz2 has besides\n\nThere is nothing here for {names}.\n'


def _without_meaning(names: tuple[str, ...]) -> Iterator[str]:
    """Say what of RViz2 is read and kept, but does nothing."""
    if names:
        listed = ', '.join(f'`{name}`' for name in names)
        yield f'Kept in files, but without meaning here: {listed}.\n'
