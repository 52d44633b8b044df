# SPDX-License-Identifier: Apache-2.0
"""Write the finished runs of a sweep as a Parquet table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, fields
import io
from pathlib import Path
from typing import Any

from humanoid_common.parameters import values_of
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.files import replace_file
from humanoid_simulation.sweep.conditions import Conditions, WALK
from humanoid_simulation.sweep.results import FinishedRun, RunResult

NAME = 'runs.parquet'


class NoParquetError(SimulationError):
    """The library that writes Parquet is not installed."""


def write_table(path: Path, runs: Sequence[FinishedRun]) -> None:
    """
    Write a table with one row for each run; it appears complete or not at all.

    Parameters
    ----------
    path
        The file; an existing one is replaced.
    runs
        The runs, in the order of the rows.

    Raises
    ------
    NoParquetError
        The library pyarrow cannot be imported.
    SimulationError
        The file cannot be written; an existing one is left unchanged.

    """
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError as error:
        raise NoParquetError(
            f'There is no table {path} yet: it needs the Python package pyarrow ({error}). '
            'Install pyarrow and give the same command again: it writes the table, and repeats '
            'no run.'
        ) from error
    stream = io.BytesIO()
    parquet.write_table(pyarrow.table(columns_of(runs)), stream)
    replace_file(path, stream.getvalue())


def columns_of(runs: Sequence[FinishedRun]) -> dict[str, list[Any]]:
    """
    Arrange runs in columns.

    Parameters
    ----------
    runs
        The runs.

    Returns
    -------
    dict
        Columns by name: `version` and `key`, which together are unique; all conditions, but
        parameters of the walk only if a run changes them; the result; `finished_at`.

    """
    columns: dict[str, list[Any]] = {
        'version': [run.version for run in runs],
        'key': [run.key for run in runs],
    }
    for name, default in values_of(Conditions()).items():
        if not name.startswith(WALK) or any(name in run.conditions for run in runs):
            columns[name] = [run.conditions.get(name, default) for run in runs]
    results = [asdict(run.result) for run in runs]
    for each in fields(RunResult):
        name = f'commanded_{each.name}' if each.name in columns else each.name
        columns[name] = [result[each.name] for result in results]
    columns['finished_at'] = [run.finished_at for run in runs]
    return columns
