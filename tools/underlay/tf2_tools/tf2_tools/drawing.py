# SPDX-License-Identifier: Apache-2.0
"""How the frame tree is drawn: as a PDF with Graphviz, or else as an SVG for any browser."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from html import escape
import os
import shutil
import subprocess
import time
from typing import Any

_TIMEOUT_S = 60.0
_LOOK_S = 0.1

_MARGIN = 20
_ROW = 34
_INDENT = 36
_BOX_HEIGHT = 24
_LETTER = 8.5
_DETAIL_LETTER = 6.5

Frames = Mapping[str, Mapping[str, Any]]


def write_graph(path: str, graph: str) -> str:
    """
    Write the frame graph as PATH.gv; create its directory if needed.

    Parameters
    ----------
    path
        The path without extension.
    graph
        The graph in the DOT language of Graphviz.

    Returns
    -------
    str
        The path of the file.

    Raises
    ------
    OSError
        The file cannot be written.

    """
    os.makedirs(os.path.dirname(path) or '.', exist_ok=True)
    with open(f'{path}.gv', 'w', encoding='utf-8') as file:
        file.write(graph)
    return f'{path}.gv'


def has_graphviz() -> bool:
    """Whether the program `dot` of Graphviz is installed."""
    return shutil.which('dot') is not None


def write_tree(path: str, frames: Frames) -> str:
    """
    Draw the frame tree as PATH.svg.

    Parameters
    ----------
    path
        The path without extension.
    frames
        The parsed output of `Buffer.all_frames_as_yaml`: the entry of each frame with a parent.

    Returns
    -------
    str
        The path of the file.

    Raises
    ------
    OSError
        The file cannot be written.

    """
    with open(f'{path}.svg', 'w', encoding='utf-8') as file:
        file.write(tree_svg(frames))
    return f'{path}.svg'


def draw(source: str, target: str, is_stopped: Callable[[], bool]) -> str:
    """
    Render a graph as a PDF with Graphviz.

    Parameters
    ----------
    source
        The path of the graph.
    target
        The path of the PDF.
    is_stopped
        Polled every 0.1 s while Graphviz runs; Graphviz is killed when this returns True, or
        after 60 s.

    Returns
    -------
    str
        The reason why the file was not rendered; '' on success.

    """
    command = ['dot', '-Tpdf', source, '-o', target]
    try:
        process = subprocess.Popen(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        )
    except OSError as error:
        return f'dot cannot be started: {error.strerror}'
    return _problem(process, source, is_stopped)


def _problem(process: subprocess.Popen[str], source: str, is_stopped: Callable[[], bool]) -> str:
    """Wait for Graphviz with a timeout; return the error message, or '' on success."""
    end_s = time.monotonic() + _TIMEOUT_S
    while True:
        try:
            _, errors = process.communicate(timeout=_LOOK_S)
            return f'dot could not draw {source}: {errors.strip()}' if process.returncode else ''
        except subprocess.TimeoutExpired:
            if is_stopped() or time.monotonic() > end_s:
                break
    process.kill()
    process.communicate()
    return f'dot did not finish drawing {source} in time, and was stopped'


@dataclass(frozen=True)
class _Row:
    """Row of a frame in the drawing, below its parent and indented."""

    frame: str
    depth: int
    parent_row: int
    """The row index of the parent, -1 for a root."""
    detail: str

    @property
    def x(self) -> int:
        """Return the left edge of the box, in pixels."""
        return _MARGIN + self.depth * _INDENT

    @property
    def width(self) -> float:
        """Return the width of the box, in pixels."""
        return len(self.frame) * _LETTER + 20


def tree_svg(frames: Frames) -> str:
    """
    Draw the frame trees as an SVG, one frame per row.

    Parameters
    ----------
    frames
        The parsed output of `Buffer.all_frames_as_yaml`: the entry of each frame with a parent.

    Returns
    -------
    str
        The SVG document.

    """
    rows = list(_rows(frames)) or [_Row('no tf data', 0, -1, '')]
    width = max(row.x + row.width + len(row.detail) * _DETAIL_LETTER for row in rows) + 3 * _MARGIN
    height = 2 * _MARGIN + len(rows) * _ROW
    return '\n'.join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height}" '
            'font-family="monospace" font-size="14">',
            '<rect width="100%" height="100%" fill="white"/>',
            *(_line(rows, number) for number, row in enumerate(rows) if row.parent_row >= 0),
            *(_box(row, number) for number, row in enumerate(rows)),
            '</svg>\n',
        ]
    )


def _rows(frames: Frames) -> Iterator[_Row]:
    """Yield the rows depth-first; loops of frames start at an arbitrary frame."""
    children: dict[str, list[str]] = {}
    for frame in sorted(frames):
        children.setdefault(str(frames[frame]['parent']), []).append(frame)
    seen: set[str] = set()
    count = 0
    for root in [*(name for name in sorted(children) if name not in frames), *sorted(frames)]:
        waiting = [] if root in seen else [(root, 0, -1)]
        while waiting:
            frame, depth, parent_row = waiting.pop()
            if frame in seen:
                continue
            seen.add(frame)
            yield _Row(frame, depth, parent_row, _detail(frames.get(frame)))
            waiting += [(each, depth + 1, count) for each in reversed(children.get(frame, []))]
            count += 1


def _detail(facts: Mapping[str, Any] | None) -> str:
    """Format the broadcaster, rate and times of the transform to the parent."""
    if facts is None:
        return ''
    if not facts['buffer_length']:
        return f'{facts["broadcaster"]}, one transform'
    return (
        f'{facts["broadcaster"]}, {facts["rate"]:.1f} Hz, the last {facts["buffer_length"]:.1f} s '
        f'until {facts["most_recent_transform"]:.3f}'
    )


def _middle(number: int) -> float:
    return _MARGIN + number * _ROW + _BOX_HEIGHT / 2


def _line(rows: list[_Row], number: int) -> str:
    row, parent = rows[number], rows[rows[number].parent_row]
    start = _middle(row.parent_row) + _BOX_HEIGHT / 2
    return (
        f'<path d="M{parent.x + _INDENT / 2:.0f} {start:.0f}V{_middle(number):.0f}H{row.x}" '
        'fill="none" stroke="#888"/>'
    )


def _box(row: _Row, number: int) -> str:
    top, base = _MARGIN + number * _ROW, _middle(number) + 5
    end = row.x + row.width + 10
    return (
        f'<rect x="{row.x}" y="{top}" width="{row.width:.0f}" height="{_BOX_HEIGHT}" rx="6" '
        'fill="#eef3fb" stroke="#456"/>'
        f'<text x="{row.x + 10}" y="{base:.0f}">{escape(row.frame)}</text>'
        f'<text x="{end:.0f}" y="{base:.0f}" font-size="11" fill="#666">'
        f'{escape(row.detail)}</text>'
    )
