# SPDX-License-Identifier: Apache-2.0
"""How a plot is drawn in the page: the curves and their legend."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from math import isfinite
from typing import Any, TYPE_CHECKING

import msgspec
import numpy as np
from robot_console.plots.plot_board import Plotted
from robot_console.plots.traces import Numbers, slice_times
from robot_console.plots.units import shared_unit
from viser import uplot

if TYPE_CHECKING:
    from viser import GuiApi, ViserServer

__all__ = ['STYLE', 'PlotChart', 'legend_html']

COLORS = (
    '#228be6',
    '#e8590c',
    '#2f9e44',
    '#e64980',
    '#845ef7',
    '#a98300',
    '#0c8fa5',
    '#e03131',
)
"""They can be told from a white and from a dark background."""
STYLE = """<style>
.plot-legend{margin:0 12px 8px;font-size:11px;line-height:1.45}
.plot-legend div{display:flex;gap:6px;align-items:baseline}
.plot-legend b{flex:none;width:9px;height:9px;border-radius:2px}
.plot-legend span{flex:1;overflow-wrap:anywhere}
.plot-legend i{flex:none;font-style:normal;font-variant-numeric:tabular-nums}
.plot-legend p{margin:0 0 0 15px;color:light-dark(#8a5300,#fab005)}
</style>"""
EMPTY = (
    '<div class=plot-legend>Nothing is plotted yet. Choose a preset or a field, or write a path '
    'such as joint_states.position[left_knee].</div>'
)

HEIGHT = 240
FREE = {'x': uplot.Scale(time=False)}
AROUND_ZERO = {**FREE, 'y': uplot.Scale(range=(-0.1, 0.1))}
"""Otherwise, uPlot shows curves that are all zero on a scale up to 100."""
X_AXIS = uplot.Series(label='s')
WIDER = 1.0 + 1e-9
"""uPlot lays out an axis only when its scale changes; one created hidden would stay empty."""
NO_CURVE = uplot.Series(label='', show=False)
LABEL_SIZE = 18
"""Height of the label of the x axis and width of that of the y axis, in pixels."""


def legend_html(plotted: Sequence[Plotted]) -> str:
    """
    Render the legend as HTML: colour, text, latest value and error of each series.

    Units are shown with the values, unless all series have the same: then the axis shows it.

    Parameters
    ----------
    plotted
        The series in the order of their colours, at most 8.

    """
    units = [each.unit for each in plotted]
    shown = [''] * len(units) if shared_unit(units) else units
    lines = ''.join(map(_line, plotted, shown, COLORS))
    return f'<div class=plot-legend>{lines}</div>' if lines else EMPTY


def _line(each: Plotted, unit: str, color: str) -> str:
    trouble = f'<p>⚠ {escape(each.trouble)}</p>' if each.trouble else ''
    return (
        f'<div><b style="background:{color}"></b><span>{escape(str(each.series))}</span>'
        f'<i>{_value(each.trace.newest, unit)}</i></div>{trouble}'
    )


def _value(newest: float | None, unit: str) -> str:
    if newest is None:
        return ''
    return f'{newest:.4g} {unit}'.rstrip() if isfinite(newest) else 'no number'


class PlotChart:
    """
    The viser widget that draws curves over a time window.

    The widget is replaced whenever the number of curves, the scale or the unit changes: a browser
    receives the curves and the options of a widget one after the other, and uPlot fails if they do
    not match.

    Parameters
    ----------
    server
        The server of the page; the widget is added at the current position of its GUI.

    """

    def __init__(self, server: ViserServer) -> None:
        self._server = server
        self._place = server.gui.add_folder(None)
        self._count, self._is_zero, self._unit = 0, True, ''
        self._is_wider = False
        self._chart = self._new_chart(np.array([-1.0, 0.0]))

    def draw(self, window_s: float, curves: Sequence[Numbers], unit: str) -> None:
        """
        Draw curves over a time window.

        Parameters
        ----------
        window_s
            The length of the window, in s; it ends at the current time.
        curves
            The values of each curve (800,), at the times of `slice_times`; NaN creates a gap.
        unit
            The unit of all values, which is shown at the axis; '' if they have none in common.

        """
        self._is_wider = not self._is_wider
        times = slice_times(window_s) * (WIDER if self._is_wider else 1.0)
        is_zero = not any(np.nan_to_num(curve).any() for curve in curves)
        kind = len(curves), is_zero, unit
        with self._server.atomic():
            if kind != (self._count, self._is_zero, self._unit):
                self._count, self._is_zero, self._unit = kind
                self._chart.remove()
                self._chart = self._new_chart(times)
            shown = curves or [np.zeros(len(times))]
            # Arrays of viser contain numbers only, but uPlot requires null for a gap.
            self._chart._queue_update('data', tuple(map(_encoded, (times, *shown))))

    def _new_chart(self, times: Numbers) -> Any:
        """Add a widget for the current number of curves, scale and unit."""
        gui: GuiApi = self._server.gui
        series = [
            uplot.Series(label=f'{number}', stroke=color, width=1.5, spanGaps=False)
            for number, color in enumerate(COLORS[: self._count], 1)
        ] or [NO_CURVE]
        with self._place:
            return gui.add_uplot(
                (times, *(np.zeros(len(times)) for _ in series)),
                (X_AXIS, *series),
                scales=AROUND_ZERO if self._is_zero else FREE,
                axes=(_axis('s'), _axis(self._unit)),
                legend=uplot.Legend(show=False),
                height=HEIGHT,
                padding=(10, 16, 0, 0),
            )


def _axis(unit: str) -> uplot.Axis:
    """Return an axis with a unit; without one, nothing is left free for it."""
    if not unit:
        return uplot.Axis()
    return uplot.Axis(label=unit, labelSize=LABEL_SIZE, labelGap=0, labelFont='11px sans-serif')


def _encoded(numbers: Numbers) -> Any:
    """Encode numbers as a MessagePack list, with NaN as null."""
    values = [value if value == value else None for value in numbers.tolist()]
    return msgspec.Raw(msgspec.msgpack.encode(values))
