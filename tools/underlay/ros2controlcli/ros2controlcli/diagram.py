# SPDX-License-Identifier: Apache-2.0
"""
Draw which controllers command and read which: for Graphviz, or as an SVG for any browser.

Each controller and each hardware component is a box. An arrow points from who commands to who is
commanded, and, in blue, from who measures to who reads. It is dashed while it is not in use.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

_SHOWN = 4
_LETTER, _LINE = 8, 18
_MARGIN, _GAP = 20, 150
_FILLS = {'active': '#d9f2d9', 'inactive': '#eeeeee'}
_COMMANDS, _READS = '#333333', '#3366cc'


@dataclass(frozen=True)
class Box:
    """A controller or hardware component: its name, and the lines below it."""

    name: str
    lines: tuple[str, ...]
    state: str

    @property
    def text(self) -> tuple[str, ...]:
        """Return all lines."""
        return (self.name, *self.lines)


@dataclass(frozen=True)
class Arrow:
    """The interfaces over which one box commands another one, or reads from it."""

    source: str
    target: str
    interfaces: tuple[str, ...]
    is_used: bool
    is_command: bool

    @property
    def label(self) -> tuple[str, ...]:
        """Return the interfaces, abbreviated if there are many."""
        rest = len(self.interfaces) - _SHOWN
        return (*self.interfaces[:_SHOWN], *([f'and {rest} more'] if rest > 0 else []))


@dataclass(frozen=True)
class Diagram:
    """The boxes of a controller manager, and the arrows between them."""

    boxes: tuple[Box, ...]
    arrows: tuple[Arrow, ...]


def diagram_of(controllers: Sequence[Any], components: Sequence[Any]) -> Diagram:
    """
    Find who commands and reads what.

    Parameters
    ----------
    controllers
        Messages `controller_manager_msgs/ControllerState`.
    components
        Messages `controller_manager_msgs/HardwareComponentState`.

    """
    boxes = [Box(each.name, (each.type, each.state), each.state) for each in controllers]
    boxes += [
        Box(each.name, (each.plugin_name or each.class_type, each.state.label), each.state.label)
        for each in components
    ]
    return Diagram(tuple(boxes), tuple(_arrows(controllers, components)))


def _arrows(controllers: Sequence[Any], components: Sequence[Any]) -> Iterator[Arrow]:
    taken = {i.name: c.name for c in components for i in c.command_interfaces}
    given = {i.name: c.name for c in components for i in c.state_interfaces}
    for each in controllers:
        taken |= dict.fromkeys(_full(each.name, each.reference_interfaces), each.name)
        given |= dict.fromkeys(_full(each.name, each.exported_state_interfaces), each.name)
    loaded = {each.name for each in controllers}
    for each in controllers:
        chained = [
            name
            for chain in each.chain_connections
            if chain.name in loaded
            for name in _full(chain.name, chain.reference_interfaces)
        ]
        commanded = dict.fromkeys([*each.required_command_interfaces, *chained])
        taken |= {name: name.partition('/')[0] for name in chained}
        used = {*each.claimed_interfaces, *(chained if each.state == 'active' else [])}
        for owner, names in _by_owner(commanded, taken):
            yield Arrow(each.name, owner, names, not used.isdisjoint(names), True)
        for owner, names in _by_owner(dict.fromkeys(each.required_state_interfaces), given):
            yield Arrow(owner, each.name, names, each.state == 'active', False)


def _full(owner: str, interfaces: Sequence[str]) -> list[str]:
    """Return interfaces of a controller with its name before them."""
    return [name if name.startswith(f'{owner}/') else f'{owner}/{name}' for name in interfaces]


def _by_owner(
    names: dict[str, None], owners: dict[str, str]
) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield the interfaces of each owner; those of nobody are left out."""
    known = [name for name in names if name in owners]
    for owner in dict.fromkeys(owners[name] for name in known):
        yield owner, tuple(name for name in known if owners[name] == owner)


def as_dot(diagram: Diagram) -> str:
    """
    Write a diagram in the DOT language of Graphviz.

    Parameters
    ----------
    diagram
        The diagram.

    """
    lines = ['digraph controllers {', 'rankdir=LR;', 'node [shape=box style="rounded,filled"];']
    lines += [
        f'{_quoted(box.name)} [label={_quoted(*box.text)} fillcolor="{_fill(box)}"];'
        for box in diagram.boxes
    ]
    lines += [
        f'{_quoted(each.source)} -> {_quoted(each.target)} [label={_quoted(*each.label)} '
        f'style={"solid" if each.is_used else "dashed"} color="{_colour(each)}"];'
        for each in diagram.arrows
    ]
    return '\n'.join([*lines, '}\n'])


def _quoted(*lines: str) -> str:
    escaped = [line.replace('\\', '\\\\').replace('"', '\\"') for line in lines]
    return '"' + '\\n'.join(escaped) + '"'


def _fill(box: Box) -> str:
    return _FILLS.get(box.state, '#fbe9d0')


def _colour(arrow: Arrow) -> str:
    return _COMMANDS if arrow.is_command else _READS


def as_svg(diagram: Diagram) -> str:
    """
    Draw a diagram as an SVG document, with those who command at the left of those they command.

    Parameters
    ----------
    diagram
        The diagram.

    """
    places = _places(diagram)
    labels = sum(len(each.label) for each in diagram.arrows)
    width = max((x + w for x, _, w, _ in places.values()), default=0) + _MARGIN
    bottom = max((y + h for _, y, _, h in places.values()), default=0) + 2 * _MARGIN
    height = bottom + labels * _LINE + len(diagram.arrows) * 6
    return '\n'.join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{max(width, 600)}" '
            f'height="{height}" font-family="monospace" font-size="13">',
            '<rect width="100%" height="100%" fill="white"/>',
            *_drawn_arrows(diagram, places),
            *(_drawn_box(box, places[box.name]) for box in diagram.boxes),
            *_legend(diagram, bottom),
            '</svg>\n',
        ]
    )


_Places = dict[str, tuple[int, int, int, int]]


def _places(diagram: Diagram) -> _Places:
    """Return x, y, width and height of each box: a column for each step of the chain."""
    depth = {box.name: 0 for box in diagram.boxes}
    for _ in diagram.boxes:  # a loop of controllers ends after as many steps as there are boxes
        for each in diagram.arrows:
            if each.is_command and each.source != each.target and each.target in depth:
                deeper = max(depth[each.target], depth[each.source] + 1)
                depth[each.target] = min(deeper, len(depth))
    places: _Places = {}
    x = _MARGIN
    for column in sorted(set(depth.values())):
        y, widest = _MARGIN, 0
        for box in (box for box in diagram.boxes if depth[box.name] == column):
            width = max(map(len, box.text)) * _LETTER + _MARGIN
            height = len(box.text) * _LINE + 12
            places[box.name] = x, y, width, height
            y, widest = y + height + _MARGIN, max(widest, width)
        x += widest + _GAP
    return places


def _drawn_box(box: Box, place: tuple[int, int, int, int]) -> str:
    x, y, width, height = place
    texts = ''.join(
        f'<text x="{x + 10}" y="{y + _LINE * (row + 1)}"'
        f'{" font-weight=" + chr(34) + "bold" + chr(34) if row == 0 else ""}>{escape(line)}</text>'
        for row, line in enumerate(box.text)
    )
    return (
        f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="6" fill="{_fill(box)}" '
        f'stroke="#666"/>{texts}'
    )


def _drawn_arrows(diagram: Diagram, places: _Places) -> Iterator[str]:
    """Yield the arrows with their numbers; the legend below has their interfaces."""
    for number, each in enumerate(diagram.arrows, start=1):
        x1, y1, w1, h1 = places[each.source]
        x2, y2, w2, h2 = places[each.target]
        start_x, end_x = (x1 + w1, x2) if x1 <= x2 else (x1, x2 + w2)
        offset = 6 if each.is_command else -6
        start_y, end_y = y1 + h1 // 2 + offset, y2 + h2 // 2 + offset
        dashes = '' if each.is_used else ' stroke-dasharray="6 4"'
        yield (
            f'<path d="M{start_x} {start_y}L{end_x} {end_y}" stroke="{_colour(each)}"{dashes}/>'
            f'<circle cx="{end_x}" cy="{end_y}" r="4" fill="{_colour(each)}"/>'
            f'<text x="{(start_x + end_x) // 2}" y="{(start_y + end_y) // 2 - 3}" '
            f'fill="{_colour(each)}">{number}</text>'
        )


def _legend(diagram: Diagram, top: int) -> Iterator[str]:
    y = top
    for number, each in enumerate(diagram.arrows, start=1):
        verb = 'commands' if each.is_command else 'is read by'
        lines = [f'{number}: {each.source} {verb} {each.target}: {each.label[0]}']
        lines += [f'      {name}' for name in each.label[1:]]
        for line in lines:
            yield (
                f'<text x="{_MARGIN}" y="{y}" xml:space="preserve" fill="{_colour(each)}">'
                f'{escape(line)}</text>'
            )
            y += _LINE
        y += 6
