# SPDX-License-Identifier: Apache-2.0
"""Say in one line how far a sweep is: falls, time left, best and worst run."""

from __future__ import annotations

from collections.abc import Callable
import os
import time
from typing import IO

from humanoid_simulation.sweep.results import ending_text, Summary, time_left_s

_TERMINAL_PERIOD_S, _LOG_PERIOD_S = 0.2, 10.0


def progress_line(summary: Summary, planned: int, done: int, left: int, elapsed_s: float) -> str:
    """
    Compose the line about the progress.

    Parameters
    ----------
    summary
        Summary of the finished runs.
    planned
        Number of runs of the experiment.
    done, left
        Number of runs that were done since the start, and of those that are left.
    elapsed_s
        Time since the start.

    """
    parts = [f'{summary.finished} of {planned}', falls_text(summary)]
    left_s = time_left_s(done, left, elapsed_s)
    if left and left_s is not None:
        parts.append(f'{duration_text(left_s)} left')
    for name, run in (('best', summary.best), ('worst', summary.worst)):
        if run is not None:
            parts.append(f'{name} {run.key[:8]} {ending_text(run)}')
    return ' | '.join(parts)


def falls_text(summary: Summary) -> str:
    """
    Describe how many runs fell, and how many could not be simulated.

    Parameters
    ----------
    summary
        Summary of the runs.

    """
    failed = f', {summary.failed} could not be simulated' if summary.failed else ''
    return f'{summary.fell} fell{failed}'


def duration_text(duration_s: float) -> str:
    """
    Format a duration, with a precision that an estimate has.

    Parameters
    ----------
    duration_s
        The duration in s.

    """
    if duration_s < 90.0:
        return f'{duration_s:.0f} s'
    if duration_s < 5400.0:
        return f'{duration_s / 60.0:.0f} min'
    return f'{duration_s / 3600.0:.1f} h'


def print_progress(stream: IO[str]) -> Callable[[str, bool], None]:
    """
    Make a function that prints progress: one changing line in a terminal, else some lines.

    Parameters
    ----------
    stream
        Where to print.

    Returns
    -------
    Callable
        Takes a line, and whether it is to stay.

    """
    is_terminal = stream.isatty()
    period_s = _TERMINAL_PERIOD_S if is_terminal else _LOG_PERIOD_S
    next_s = 0.0

    def say(line: str, stays: bool) -> None:
        nonlocal next_s
        now_s = time.monotonic()
        if not stays and now_s < next_s:
            return
        next_s = now_s + period_s
        if is_terminal:
            width = os.get_terminal_size(stream.fileno()).columns - 1
            line = f'\r\x1b[K{line if stays else line[:width]}'
        stream.write(line if is_terminal and not stays else f'{line}\n')
        stream.flush()

    return say
