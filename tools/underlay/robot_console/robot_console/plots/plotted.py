# SPDX-License-Identifier: Apache-2.0
"""A plotted series with its recent values."""

from __future__ import annotations

from typing import Any

from robot_console.plots.field_path import PathError
from robot_console.plots.field_reader import FieldReader
from robot_console.plots.field_types import Schema
from robot_console.plots.series import Series
from robot_console.plots.value_trace import Trace

__all__ = ['Plotted']

TOGETHER_S = 1.0


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
