# SPDX-License-Identifier: Apache-2.0
"""Plots of a sweep as SVG, which a page contains without other files or programs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from humanoid_simulation.sweep.results import Bin, FinishedRun, number_text, STOOD

MOST_POINTS = 1500
"""Maximum number of points of a plot; of more runs, evenly chosen ones are shown."""
_WIDTH, _HEIGHT = 460, 250
_LEFT, _RIGHT, _TOP, _BOTTOM = 46, 12, 26, 48
_INNER_WIDTH, _INNER_HEIGHT = _WIDTH - _LEFT - _RIGHT, _HEIGHT - _TOP - _BOTTOM


def falls_by(name: str, bins: Sequence[Bin]) -> str:
    """
    Draw the share of runs that fall over a condition, as bars with intervals of 95 %.

    Parameters
    ----------
    name
        The condition.
    bins
        Runs by its values, from left to right.

    """
    width = _INNER_WIDTH / max(len(bins), 1)
    parts = [_share_axis()]
    for number, each in enumerate(bins):
        middle, share = _LEFT + (number + 0.5) * width, each.fell / each.runs if each.runs else 0.0
        if each.runs:
            low, high = each.interval
            parts.append(
                f'<rect class="fell" x="{middle - 0.35 * width:.1f}" y="{_y(share):.1f}" '
                f'width="{0.7 * width:.1f}" height="{_y(0.0) - _y(share):.1f}">'
                f'<title>{each.fell} of {each.runs} fell</title></rect>'
                f'<path class="interval" d="M{middle:.1f} {_y(low):.1f}V{_y(high):.1f}"/>'
            )
        parts.append(_label(middle, _HEIGHT - 32, each.label, len(bins) > 3))
        parts.append(_text(middle, _HEIGHT - 18, f'{each.fell}/{each.runs}', 'count'))
    parts.append(_text(_LEFT + _INNER_WIDTH / 2, _HEIGHT - 4, name, 'name'))
    return _svg(f'Share of falls over {name}', parts)


def survival_over(name: str, runs: Sequence[FinishedRun]) -> str:
    """
    Draw the time on its feet over a numeric condition, a point for each run or some of them.

    Parameters
    ----------
    name
        The condition.
    runs
        The runs, whose values of the condition are numbers.

    """
    ranked = sorted(runs, key=lambda run: (run.result.outcome != STOOD, run.result.survived_s))
    runs = ranked[:: -(-len(ranked) // MOST_POINTS)]
    values = [float(run.conditions[name]) for run in runs]
    low, high = min(values), max(values)
    longest_s = max([run.result.survived_s for run in runs] + [1e-9])
    parts = [_axis([(share, f'{share * longest_s:.3g}') for share in (0.0, 0.5, 1.0)])]
    for value, run in zip(values, runs):
        x = _LEFT + 6 + (value - low) / ((high - low) or 1.0) * (_INNER_WIDTH - 12)
        y = _y(run.result.survived_s / longest_s)
        kind = 'stood' if run.result.outcome == STOOD else 'fell'
        parts.append(
            f'<circle class="{kind}" cx="{x:.1f}" cy="{y:.1f}" r="3">'
            f'<title>{run.key}: {run.result.outcome}, {run.result.survived_s:.1f} s, '
            f'{escape(name)} {value:.4g}</title></circle>'
        )
    for share in (0.0, 0.5, 1.0):
        x = _LEFT + 6 + share * (_INNER_WIDTH - 12)
        parts.append(_text(x, _HEIGHT - 28, number_text(low + share * (high - low)), ''))
    parts.append(_text(_LEFT + _INNER_WIDTH / 2, _HEIGHT - 8, name, 'name'))
    return _svg(f'Time on its feet (s) over {name}', parts)


def _share_axis() -> str:
    """Draw the vertical axis of shares, from 0 to 100 %."""
    return _axis([(share, f'{share:.0%}') for share in (0.0, 0.25, 0.5, 0.75, 1.0)])


def _axis(labels: Iterable[tuple[float, str]]) -> str:
    """Draw horizontal lines at shares of the height, with labels."""
    return ''.join(
        f'<path class="line" d="M{_LEFT} {_y(share):.1f}H{_WIDTH - _RIGHT}"/>'
        f'<text class="axis" x="{_LEFT - 6}" y="{_y(share) + 4:.1f}">{text}</text>'
        for share, text in labels
    )


def _y(share: float) -> float:
    """Convert a share of the height to a coordinate."""
    return _TOP + (1.0 - share) * _INNER_HEIGHT


def _label(x: float, y: float, text: str, is_narrow: bool) -> str:
    """Draw the label of a bar, in two lines if there is little room."""
    first, separator, second = text.partition(' to ')
    if not separator or not is_narrow:
        return _text(x, y, text, '')
    return _text(x, y - 9, f'{first}…', 'small') + _text(x, y, second, 'small')


def _text(x: float, y: float, text: str, kind: str) -> str:
    """Draw centred text."""
    return f'<text class="{kind}" x="{x:.1f}" y="{y:.1f}">{escape(text)}</text>'


def _svg(title: str, parts: Sequence[str]) -> str:
    """Compose a plot."""
    heading = f'<text class="title" x="{_LEFT}" y="14">{escape(title)}</text>'
    return (
        f'<svg viewBox="0 0 {_WIDTH} {_HEIGHT}" role="img" aria-label="{escape(title)}">'
        f'{heading}{"".join(parts)}</svg>'
    )
