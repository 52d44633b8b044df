# SPDX-License-Identifier: Apache-2.0
"""Export of plotted values as CSV."""

from __future__ import annotations

from collections.abc import Mapping
import csv
import io

from robot_console.plots.value_trace import Numbers

__all__ = ['csv_text']

Columns = Mapping[str, tuple[Numbers, Numbers]]


def csv_text(columns: Columns) -> str:
    """
    Format the curves of a plot as CSV.

    Parameters
    ----------
    columns
        Times (n,) in s and values (n,), by series name.

    Returns
    -------
    str
        A header, and a row for each time at which a series has a value; other cells are empty.

    """
    rows: dict[float, dict[str, float]] = {}
    for name, (times, values) in columns.items():
        for time_s, value in zip(times.tolist(), values.tolist()):
            rows.setdefault(time_s, {})[name] = value
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator='\n')
    writer.writerow(['time_s', *columns])
    for time_s in sorted(rows):
        row = rows[time_s]
        writer.writerow([f'{time_s:.6f}', *(row.get(name, '') for name in columns)])
    return stream.getvalue()
