# SPDX-License-Identifier: Apache-2.0
"""The report of a sweep: one HTML page without other files, failures first."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape
import math
from typing import Any

from humanoid_simulation.sweep.plots import falls_by, survival_over
from humanoid_simulation.sweep.results import (
    bins_of,
    Crash,
    ending_text,
    FAILED,
    FELL,
    FinishedRun,
    number_text,
    STOOD,
    Summary,
    wilson_interval,
)

NAME = 'report.html'
MOST_ROWS = 1000
"""Maximum length of each table; the Parquet table has all runs."""


@dataclass(frozen=True)
class Report:
    """What the report of an experiment is about."""

    experiment: str
    version: str
    planned: int
    varied: tuple[str, ...]
    """Names of the conditions that have several values."""
    finished: Sequence[FinishedRun]
    """Runs that this version of the code has finished."""
    crashes: Sequence[Crash] = ()
    """Crashes of runs that are not finished."""
    others: int = 0
    """Number of runs in the table that belong to other versions or experiments."""
    replay: str = ''
    """The command that shows a run, without its key."""

    def html(self) -> str:
        """Return the page."""
        ranked = sorted(self.finished, key=lambda run: run.badness)
        bad = [run for run in ranked if run.result.outcome != STOOD]
        good = [run for run in ranked if run.result.outcome == STOOD]
        return ''.join(
            (
                f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">'
                f'<meta name="viewport" content="width=device-width, initial-scale=1">'
                f'<title>{escape(self.experiment)}: sweep</title><style>{_STYLE}</style></head>'
                f'<body><h1>{escape(self.experiment)}</h1>',
                self._summary(Summary.of(self.finished)),
                self._failures(bad),
                self._crashes(),
                self._plots(),
                self._others(good),
                '</body></html>\n',
            )
        )

    def _summary(self, summary: Summary) -> str:
        """Return the numbers at the top."""
        low, high = wilson_interval(summary.not_stood, summary.finished)
        share = summary.not_stood / summary.finished if summary.finished else 0.0
        numbers = (
            (f'{summary.finished} of {self.planned}', 'runs are finished'),
            (f'{summary.stood}', 'stood'),
            (f'{summary.fell}', 'fell'),
            *([(f'{summary.failed}', 'could not be simulated')] if summary.failed else []),
            *([(f'{len({each.key for each in self.crashes})}', 'crashed')] * bool(self.crashes)),
            (f'{share:.1%}', f'do not stand; with 95 % confidence {low:.1%} to {high:.1%}'),
            (f'{summary.simulated_s:.0f} s', f'of walking, in {summary.cpu_s:.0f} s of CPU'),
            (f'{summary.distance_m:.0f} m', 'walked'),
        )
        cells = ''.join(f'<div><b>{value}</b> {escape(text)}</div>' for value, text in numbers)
        others = (
            f' {self.others} runs of other versions or other conditions are only in the table.'
            if self.others
            else ''
        )
        return (
            f'<div class="numbers">{cells}</div>'
            f'<p>Version of the code: <code>{escape(self.version)}</code>.{others}</p>'
        )

    def _failures(self, bad: Sequence[FinishedRun]) -> str:
        """Return the table of the runs that did not stand, the worst first."""
        if not bad:
            return '<h2>Failures</h2><p>None: every finished run stood.</p>'
        return (
            f'<h2>Failures</h2><p>Watch one on a page: '
            f'<code>{escape(self.replay)} KEY</code></p>{self._table(bad)}'
        )

    def _others(self, good: Sequence[FinishedRun]) -> str:
        """Return the table of the runs that stood, the one that swayed most first."""
        if not good:
            return ''
        return (
            f'<h2>Runs that stood</h2><details><summary>Show {min(len(good), MOST_ROWS)}, '
            f'largest tilt first</summary>{self._table(good)}</details>'
        )

    def _crashes(self) -> str:
        """Return the list of processes that crashed, for runs that are not finished."""
        if not self.crashes:
            return ''
        rows = ''.join(
            f'<tr><td><code>{escape(each.key)}</code></td><td>{each.attempt}</td>'
            f'<td><pre>{escape(each.reason)}</pre></td></tr>'
            for each in self.crashes
        )
        return (
            '<h2>Crashes</h2><p>These runs are not finished; the same command tries them again.'
            '</p><div class="wide"><table><tr><th>key</th><th>attempt</th><th>reason</th></tr>'
            f'{rows}</table></div>'
        )

    def _plots(self) -> str:
        """Return two plots for each condition that varies."""
        if not self.finished:
            return ''
        plots = []
        for name in self.varied:
            plots.append(falls_by(name, bins_of(self.finished, name)))
            with_it = [run for run in self.finished if _is_number(run.conditions.get(name))]
            if with_it:
                plots.append(survival_over(name, with_it))
        if not plots:
            return ''
        figures = ''.join(f'<figure>{plot}</figure>' for plot in plots)
        return (
            '<h2>Conditions</h2><p>Bars are the share of runs that did not stand, with intervals '
            'of 95 %. Each condition is shown for all values of the others.</p>'
            f'<div class="plots">{figures}</div>'
        )

    def _table(self, runs: Sequence[FinishedRun]) -> str:
        """Return a table of runs."""
        names = ('key', 'result', 'seed', *self.varied)
        units = ('last command (m/s, m/s, rad/s)', 'last push', 'walked', 'tilt')
        head = ''.join(f'<th>{escape(name)}</th>' for name in (*names, *units))
        rows = ''.join(f'<tr>{_cells(run, self.varied)}</tr>' for run in runs[:MOST_ROWS])
        rest = len(runs) - MOST_ROWS
        more = f'<p>{rest} more are in the table runs.parquet.</p>' if rest > 0 else ''
        return f'<div class="wide"><table><tr>{head}</tr>{rows}</table></div>{more}'


def _cells(run: FinishedRun, varied: Iterable[str]) -> str:
    """Return the cells of a row."""
    result = run.result
    command = f'{result.forward_m_s:.2f} {result.left_m_s:.2f} {result.turn_rad_s:.2f}'
    push_ns = math.hypot(result.push_x_ns, result.push_y_ns)
    push = ''
    if push_ns:
        degrees = math.degrees(math.atan2(result.push_y_ns, result.push_x_ns))
        push = f'{push_ns:.0f} N s, {degrees:.0f}°, at {result.push_s:.1f} s'
    texts = [
        run.conditions.get('seed', ''),
        *(run.conditions.get(name, 'default') for name in varied),
        command,
        push,
        f'{result.distance_m:.1f} m',
        f'{math.degrees(result.largest_tilt_rad):.0f}°',
    ]
    kind = 'bad' if result.outcome in (FELL, FAILED) else 'good'
    cells = ''.join(f'<td>{escape(number_text(text))}</td>' for text in texts)
    return (
        f'<td><code>{run.key}</code></td><td class="{kind}">{escape(ending_text(run))}</td>{cells}'
    )


def _is_number(value: Any) -> bool:
    """Check whether a value can be an axis; true and false are not numbers here."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


_STYLE = """
:root{color-scheme:light dark;--text:#1b1f24;--back:#fff;--soft:#59636e;--line:#d8dee4;
--bad:#c93a2b;--good:#2c7fb8}
@media(prefers-color-scheme:dark){:root{--text:#e6edf3;--back:#14181d;--soft:#9aa6b2;
--line:#343b43;--bad:#ff7b6b;--good:#6cb6ff}}
body{font:15px/1.5 system-ui,sans-serif;color:var(--text);background:var(--back);
max-width:1080px;margin:2rem auto;padding:0 1rem}
h2{margin-top:2rem}code,pre{font:13px ui-monospace,monospace}pre{margin:0;white-space:pre-wrap}
.numbers{display:flex;flex-wrap:wrap;gap:1rem 2rem}.numbers b{font-size:1.6rem;display:block}
.wide{overflow-x:auto}table{border-collapse:collapse;font-size:13px}
th,td{padding:.25rem .7rem .25rem 0;border-bottom:1px solid var(--line);text-align:left;
vertical-align:top}td{font-variant-numeric:tabular-nums}th{white-space:nowrap}
.bad{color:var(--bad)}.good{color:var(--good)}summary{cursor:pointer}
.plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(420px,100%),1fr));gap:1rem}
figure{margin:0}svg{width:100%;height:auto}svg text{font:11px system-ui,sans-serif;
fill:var(--soft);text-anchor:middle}svg .title{font-size:13px;fill:var(--text);
text-anchor:start}svg .axis{text-anchor:end}svg .name{fill:var(--text)}svg .small{font-size:9px}
svg .count{font-size:10px}svg .line{stroke:var(--line)}svg .interval{stroke:var(--text);
stroke-width:1.5}svg rect.fell{fill:var(--bad);opacity:.75}svg circle.fell{fill:var(--bad)}
svg circle.stood{fill:var(--good);opacity:.6}
"""
