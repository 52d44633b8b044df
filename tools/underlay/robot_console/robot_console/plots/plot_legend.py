# SPDX-License-Identifier: Apache-2.0
"""Legend of a plot: the series with their colours, latest values and errors."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from math import isfinite

from robot_console.plots.plotted import Plotted

__all__ = ['COLORS', 'STYLE', 'legend_html']

COLORS = (
    '#4dabf7',
    '#ffa94d',
    '#69db7c',
    '#ff8787',
    '#b197fc',
    '#ffe066',
    '#66d9e8',
    '#faa2c1',
)
STYLE = """<style>
.plot-legend{margin:0 12px 8px;font-size:11px;line-height:1.45}
.plot-legend div{display:flex;gap:6px;align-items:baseline}
.plot-legend b{flex:none;width:9px;height:9px;border-radius:2px}
.plot-legend span{flex:1;overflow-wrap:anywhere}
.plot-legend i{flex:none;font-style:normal;font-variant-numeric:tabular-nums}
.plot-legend p{margin:0 0 0 15px;color:#fab005}
</style>"""
EMPTY = (
    '<div class=plot-legend>Nothing is plotted yet. Choose a preset or a field, or write a path '
    'such as joint_states.position[left_knee].</div>'
)


def legend_html(plotted: Iterable[Plotted]) -> str:
    """
    Render the legend as HTML: colour, text, latest value and error of each series.

    Parameters
    ----------
    plotted
        The series in the order of their colours, at most 8.

    """
    lines = ''.join(_line(each, COLORS[index]) for index, each in enumerate(plotted))
    return f'<div class=plot-legend>{lines}</div>' if lines else EMPTY


def _line(each: Plotted, color: str) -> str:
    newest = each.trace.newest
    value = '' if newest is None else f'{newest:.4g}' if isfinite(newest) else 'no number'
    trouble = f'<p>⚠ {escape(each.trouble)}</p>' if each.trouble else ''
    return (
        f'<div><b style="background:{color}"></b><span>{escape(str(each.series))}</span>'
        f'<i>{value}</i></div>{trouble}'
    )
