# SPDX-License-Identifier: Apache-2.0
"""The series of a plot with their recent values, and what of them is in view."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from robot_console.plots.field_reader import FieldReader
from robot_console.plots.fields import Schema
from robot_console.plots.series import MAX_SERIES, parse_series, PathError, Series
from robot_console.plots.traces import Numbers, thinned, Trace
from robot_console.plots.units import shared_unit

__all__ = ['MAX_WINDOW_S', 'PlotBoard', 'Plotted']

TOGETHER_S = 1.0

MAX_WINDOW_S = 120.0
EMPTY: Numbers = np.empty(0)
Columns = dict[str, tuple[Numbers, Numbers]]


class Plotted:
    """
    A series with its recent values, and the reason if new values are missing.

    Parameters
    ----------
    series
        The series; its message types are set later with `find_type`.
    keep_s
        The duration for which values are kept, in s.

    Attributes
    ----------
    trace
        The values with their times.
    trouble
        A message that explains why there are no new values; '' if there are.

    """

    def __init__(self, series: Series, keep_s: float) -> None:
        self.series = series
        self.trace = Trace(keep_s)
        self.trouble = ''
        self._readers: list[FieldReader | None] = [None] * len(series.paths)
        self._newest: list[tuple[float, float] | None] = [None] * len(series.paths)

    @property
    def unit(self) -> str:
        """The unit of the values; '' while it is unknown, or if there is none."""
        return shared_unit('' if each is None else each.unit for each in self._readers)

    def find_type(self, topic: str, type_name: str, schema: Schema) -> None:
        """
        Set the message type of a topic; if it lacks the plotted field, `trouble` reports that.

        Parameters
        ----------
        topic
            The topic, as named in paths; topics that the series does not use are ignored.
        type_name
            Its message type.
        schema
            Returns the fields of a message type.

        """
        for index, path in enumerate(self.series.paths):
            if path.topic == topic:
                try:
                    self._readers[index] = FieldReader(path, type_name, schema)
                except PathError as error:
                    self.trouble = str(error)

    def take(self, topic: str, message: Any, time_s: float) -> None:
        """
        Add a value of the series if a message completes it.

        The two numbers of a difference must be received less than 1 s apart.

        Parameters
        ----------
        topic
            The topic, as named in paths; topics that the series does not use are ignored.
        message
            The message.
        time_s
            The time of reception, from `time.time`.

        """
        has_news = False
        for index, reader in enumerate(self._readers):
            if reader is not None and reader.path.topic == topic:
                try:
                    self._newest[index] = time_s, reader.read(message)
                except PathError as error:
                    self.trouble = f'{reader.path}: {error}'
                else:
                    has_news = True
        if has_news:
            self._add(time_s)

    def _add(self, time_s: float) -> None:
        """Add a value if all of its operands are known and recent."""
        together = [
            each[1] for each in self._newest if each and abs(time_s - each[0]) < TOGETHER_S
        ]
        if len(together) == len(self._newest):
            self.trouble = ''
            self.trace.add(time_s, self.series.value(together))


class PlotBoard:
    """
    The series of a plot with their values, which are still recorded while the view is frozen.

    Parameters
    ----------
    window_s
        The length of the time window, in s. It may be changed; 120 s are kept in any case.

    """

    def __init__(self, window_s: float) -> None:
        self.window_s = window_s
        self._plotted: dict[str, Plotted] = {}
        self._types: dict[str, tuple[str, Schema]] = {}
        self._rest: tuple[float, Columns] | None = None

    @property
    def plotted(self) -> list[Plotted]:
        """Return the series in order."""
        return list(self._plotted.values())

    @property
    def topics(self) -> set[str]:
        """Return the topics that the series use."""
        return {path.topic for each in self.plotted for path in each.series.paths}

    @property
    def is_resting(self) -> bool:
        """Whether the view is frozen."""
        return self._rest is not None

    def add(self, text: str) -> None:
        """
        Add a series given as text.

        Parameters
        ----------
        text
            As for `parse_series`.

        Raises
        ------
        PathError
            The text is not a valid series, or there are 8 already.

        """
        self.put(parse_series(text))

    def put(self, series: Series) -> None:
        """
        Add a series unless it is already present.

        Parameters
        ----------
        series
            The series.

        Raises
        ------
        PathError
            There are 8 series already.

        """
        if str(series) in self._plotted:
            return
        if len(self._plotted) >= MAX_SERIES:
            raise PathError(
                f'There are already {MAX_SERIES} series, the maximum of a plot. Remove '
                'one, or add a second Plots panel to the file.'
            )
        plotted = self._plotted[str(series)] = Plotted(series, MAX_WINDOW_S)
        for topic, (type_name, schema) in self._types.items():
            plotted.find_type(topic, type_name, schema)

    def remove(self, text: str) -> None:
        """
        Remove a series and its values.

        Parameters
        ----------
        text
            The text of the series; an unknown series is ignored.

        """
        self._plotted.pop(text, None)

    def replace(self, series: Iterable[Series]) -> None:
        """
        Replace all series; those already present keep their values.

        Parameters
        ----------
        series
            The series, in the new order.

        Raises
        ------
        PathError
            There are more than 8 series; the first 8 are kept.

        """
        before, self._plotted = self._plotted, {}
        for each in series:
            self.put(each)
            self._plotted[str(each)] = before.get(str(each), self._plotted[str(each)])

    def find_type(self, topic: str, type_name: str, schema: Schema) -> None:
        """
        Set the message type of a topic, also for series that are added later.

        Parameters
        ----------
        topic
            The topic, as named in paths.
        type_name
            Its message type.
        schema
            Returns the fields of a message type.

        """
        self._types[topic] = type_name, schema
        for each in self.plotted:
            each.find_type(topic, type_name, schema)

    def take(self, topic: str, message: Any, time_s: float) -> None:
        """
        Add the values of a message to the series.

        Parameters
        ----------
        topic
            The topic, as named in paths.
        message
            The message.
        time_s
            The time of reception, from `time.time`.

        """
        for each in self.plotted:
            each.take(topic, message, time_s)

    def clear(self) -> None:
        """Clear all values; the series remain."""
        self._rest = None
        for each in self.plotted:
            each.trace.clear()

    def rest(self, now_s: float) -> None:
        """
        Freeze the view at a time; new values are still stored.

        Parameters
        ----------
        now_s
            The current time, from `time.time`.

        """
        kept = {
            text: (times.copy(), values.copy())
            for text, (times, values) in self._since(now_s - MAX_WINDOW_S).items()
        }
        self._rest = now_s, kept

    def go_on(self) -> None:
        """Unfreeze the view."""
        self._rest = None

    def drawn(self, now_s: float) -> list[Numbers]:
        """
        Resample the series to the drawn points.

        Parameters
        ----------
        now_s
            The current time, from `time.time`; the right end of the plot unless it is frozen.

        Returns
        -------
        list of Numbers
            The values of each series (800,), as returned by `thinned`.

        """
        at_s, columns = self._seen(now_s)
        return [thinned(*each, at_s, self.window_s) for each in columns.values()]

    def columns(self, now_s: float) -> Columns:
        """
        Return the values in the displayed time window, for export.

        Parameters
        ----------
        now_s
            The current time, from `time.time`; the end of the window unless the plot is frozen.

        Returns
        -------
        dict
            Times (n,) in s, from `time.time`, and values (n,), by the text of the series.

        """
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
