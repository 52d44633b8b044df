# SPDX-License-Identifier: Apache-2.0
"""The widget that draws a plot."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TYPE_CHECKING

import msgspec
import numpy as np
from robot_console.plots.plot_legend import COLORS
from robot_console.plots.plotted import Plotted
from robot_console.plots.thinning import slice_times
from robot_console.plots.value_trace import Numbers
from viser import uplot

if TYPE_CHECKING:
    from viser import GuiApi

__all__ = ['PlotChart']

HEIGHT = 240
FREE = {'x': uplot.Scale(time=False)}
AROUND_ZERO = {**FREE, 'y': uplot.Scale(range=(-0.1, 0.1))}
"""Without it, uPlot shows curves that are all zero on a scale to 100."""
X_AXIS = uplot.Series(label='s')


class PlotChart:
    """Curves over the last seconds."""

    def __init__(self, gui: GuiApi) -> None:
        """Add the widget, without curves."""
        nothing = np.array([-1.0, 0.0])
        self._chart = gui.add_uplot(
            (nothing, np.zeros(2)),
            (X_AXIS, uplot.Series(label='', show=False)),
            scales=FREE,
            legend=uplot.Legend(show=True),
            height=HEIGHT,
            padding=(10, 16, 0, 0),
        )
        self._is_zero = False

    def set_series(self, plotted: Sequence[Plotted]) -> None:
        """Draw other series from now on; `draw` is to be called next."""
        colors = COLORS[: len(plotted)]
        curves = [
            uplot.Series(label=f'{number}', stroke=color, width=1.5, spanGaps=False)
            for number, color in enumerate(colors, 1)
        ]
        self._chart.series = (X_AXIS, *(curves or [uplot.Series(label='', show=False)]))

    def draw(self, window_s: float, curves: Sequence[Numbers]) -> None:
        """Draw the curves; where they are not a number, they have a gap."""
        times = slice_times(window_s)
        is_zero = not any(np.nan_to_num(curve).any() for curve in curves)
        if is_zero != self._is_zero:
            self._is_zero = is_zero
            self._chart.scales = AROUND_ZERO if is_zero else FREE
        shown = curves or [np.zeros(len(times))]
        # The arrays of viser know numbers only, but uPlot takes nothing but null for a gap.
        self._chart._queue_update('data', tuple(map(_encoded, (times, *shown))))


def _encoded(numbers: Numbers) -> Any:
    """Return a list with None for what is no number, as it goes over the wire."""
    values = [value if value == value else None for value in numbers.tolist()]
    return msgspec.Raw(msgspec.msgpack.encode(values))
