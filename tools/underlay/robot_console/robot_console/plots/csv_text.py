# SPDX-License-Identifier: Apache-2.0
"""What a plot shows as a table for other programs."""

from __future__ import annotations

from collections.abc import Mapping
import csv
import io

from robot_console.plots.value_trace import Numbers

__all__ = ['csv_text']

Columns = Mapping[str, tuple[Numbers, Numbers]]


def csv_text(columns: Columns) -> str:
    """Return a line for each time at which there is a value, with a column for each series."""
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
