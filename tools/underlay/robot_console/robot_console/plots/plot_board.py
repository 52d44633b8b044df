# SPDX-License-Identifier: Apache-2.0
"""The series of a plot."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from robot_console.plots.field_path import PathError
from robot_console.plots.field_types import Schema
from robot_console.plots.plotted import Plotted
from robot_console.plots.series import MAX_SERIES, parse_series, Series
from robot_console.plots.thinning import thinned
from robot_console.plots.value_trace import Numbers

__all__ = ['MAX_WINDOW_S', 'PlotBoard']

MAX_WINDOW_S = 120.0
EMPTY: Numbers = np.empty(0)
Columns = dict[str, tuple[Numbers, Numbers]]


class PlotBoard:
    """Series by what is written for them, which go on while what is seen of them may rest."""

    def __init__(self, window_s: float) -> None:
        """Take how many seconds are seen."""
        self.window_s = window_s
        self._plotted: dict[str, Plotted] = {}
        self._types: dict[str, tuple[str, Schema]] = {}
        self._rest: tuple[float, Columns] | None = None

    @property
    def plotted(self) -> list[Plotted]:
        """Return the series in their order."""
        return list(self._plotted.values())

    @property
    def topics(self) -> set[str]:
        """Return the topics that the series are about."""
        return {path.topic for each in self.plotted for path in each.series.paths}

    @property
    def is_resting(self) -> bool:
        """Tell if what is seen rests."""
        return self._rest is not None

    def add(self, text: str) -> None:
        """Add a series, or raise PathError."""
        self.put(parse_series(text))

    def put(self, series: Series) -> None:
        """Add a series that is not there yet, or raise PathError."""
        if str(series) in self._plotted:
            return
        if len(self._plotted) >= MAX_SERIES:
            raise PathError(
                f'There are {MAX_SERIES} series, which is as many as can be told apart. Remove '
                'one, or list a second panel of plots in the file.'
            )
        plotted = self._plotted[str(series)] = Plotted(series, MAX_WINDOW_S)
        for topic, (type_name, schema) in self._types.items():
            plotted.find_type(topic, type_name, schema)

    def remove(self, text: str) -> None:
        """Remove a series."""
        self._plotted.pop(text, None)

    def replace(self, series: Iterable[Series]) -> None:
        """Have these series only; those that are there already go on."""
        before, self._plotted = self._plotted, {}
        for each in series:
            self.put(each)
            self._plotted[str(each)] = before.get(str(each), self._plotted[str(each)])

    def find_type(self, topic: str, type_name: str, schema: Schema) -> None:
        """Take the type of a topic."""
        self._types[topic] = type_name, schema
        for each in self.plotted:
            each.find_type(topic, type_name, schema)

    def take(self, topic: str, message: Any, time_s: float) -> None:
        """Take a message of a topic."""
        for each in self.plotted:
            each.take(topic, message, time_s)

    def clear(self) -> None:
        """Forget what has been; the series stay."""
        self._rest = None
        for each in self.plotted:
            each.trace.clear()

    def rest(self, now_s: float) -> None:
        """Have what is seen rest; what comes meanwhile is not lost."""
        kept = {
            text: (times.copy(), values.copy())
            for text, (times, values) in self._since(now_s - MAX_WINDOW_S).items()
        }
        self._rest = now_s, kept

    def go_on(self) -> None:
        """Have what is seen go on."""
        self._rest = None

    def drawn(self, now_s: float) -> list[Numbers]:
        """Return what is to be drawn of each series."""
        at_s, columns = self._seen(now_s)
        return [thinned(*each, at_s, self.window_s) for each in columns.values()]

    def columns(self, now_s: float) -> Columns:
        """Return times and values of what is seen."""
        at_s, columns = self._seen(now_s)
        seen = {}
        for text, (times, values) in columns.items():
            inside = (times >= at_s - self.window_s) & (times <= at_s)
            seen[text] = times[inside], values[inside]
        return seen

    def _seen(self, now_s: float) -> tuple[float, Columns]:
        if self._rest is None:
            return now_s, self._since(now_s - self.window_s)
        at_s, kept = self._rest
        return at_s, {text: kept.get(text, (EMPTY, EMPTY)) for text in self._plotted}

    def _since(self, first_s: float) -> Columns:
        return {text: each.trace.since(first_s) for text, each in self._plotted.items()}
