# SPDX-License-Identifier: Apache-2.0
"""What is measured in a run, how it ended, and how runs are counted, ranked and compared."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
import math
from typing import Any

STOOD, FELL, FAILED = 'stood', 'fell', 'failed'
_NORMAL_95 = 1.959964
"""Quantile of the normal distribution for an interval of 95 %."""
_MOST_BINS = 8


@dataclass(frozen=True)
class RunResult:
    """The end of a run, and sums over it; positions are those of the base in the world frame."""

    outcome: str
    """stood, fell, or failed: it could not be simulated."""
    survived_s: float
    """Simulated time on its feet."""
    distance_m: float = 0.0
    """Path length of the base, measured every half second."""
    largest_tilt_rad: float = 0.0
    """Largest angle between the vertical and the z axis of the base."""
    end_x_m: float = 0.0
    end_y_m: float = 0.0
    end_yaw_rad: float = 0.0
    blocked: int = 0
    """How often the walk took its way for blocked."""
    phase: str = ''
    """Phase of the walk at the end, or before it noticed that it fell."""
    forward_m_s: float = 0.0
    left_m_s: float = 0.0
    turn_rad_s: float = 0.0
    """The last command."""
    push_x_ns: float = 0.0
    push_y_ns: float = 0.0
    """The last push, in the world frame; zero without."""
    push_s: float = 0.0
    """When the last push began; 0 without."""
    cpu_s: float = 0.0
    """CPU time of the run."""
    problem: str = ''
    """Why it could not be simulated."""


@dataclass(frozen=True)
class FinishedRun:
    """A finished run: version of the code, key and values of its conditions, and its result."""

    version: str
    key: str
    conditions: Mapping[str, Any]
    result: RunResult
    finished_at: str = ''
    """Date and time, UTC, ISO 8601."""

    @property
    def badness(self) -> tuple[bool, float, float]:
        """Return what runs are sorted by: the worst one is the least."""
        result = self.result
        return result.outcome == STOOD, result.survived_s, -result.largest_tilt_rad


def ending_text(run: FinishedRun) -> str:
    """
    Describe how a run ended, in a few words.

    Parameters
    ----------
    run
        The run.

    """
    result = run.result
    if result.outcome == STOOD:
        return f'stood, largest tilt {math.degrees(result.largest_tilt_rad):.0f}°'
    if result.outcome == FAILED:
        return f'could not be simulated: {result.problem}'
    phase = f' ({result.phase})' if result.phase else ''
    return f'fell at {result.survived_s:.1f} s{phase}'


@dataclass(frozen=True)
class Crash:
    """A run whose process crashed: version of the code, key, attempt and reason."""

    version: str
    key: str
    conditions: Mapping[str, Any]
    attempt: int
    reason: str


@dataclass(frozen=True)
class Summary:
    """Counts and sums over finished runs."""

    finished: int = 0
    stood: int = 0
    fell: int = 0
    failed: int = 0
    simulated_s: float = 0.0
    distance_m: float = 0.0
    cpu_s: float = 0.0
    best: FinishedRun | None = None
    worst: FinishedRun | None = None

    @classmethod
    def of(cls, runs: Iterable[FinishedRun]) -> Summary:
        """
        Summarize finished runs.

        Parameters
        ----------
        runs
            The runs, in any order.

        """
        return reduce(cls.including, runs, cls())

    def including(self, run: FinishedRun) -> Summary:
        """
        Return the summary of one more run.

        Parameters
        ----------
        run
            The run.

        """
        result = run.result
        return Summary(
            self.finished + 1,
            self.stood + (result.outcome == STOOD),
            self.fell + (result.outcome == FELL),
            self.failed + (result.outcome == FAILED),
            self.simulated_s + result.survived_s,
            self.distance_m + result.distance_m,
            self.cpu_s + result.cpu_s,
            max(self.best or run, run, key=lambda each: each.badness),
            min(self.worst or run, run, key=lambda each: each.badness),
        )

    @property
    def not_stood(self) -> int:
        """Return the number of runs that fell or failed."""
        return self.fell + self.failed


def wilson_interval(hits: int, trials: int) -> tuple[float, float]:
    """
    Compute the 95 % confidence interval of a probability from counts.

    Wilson, "Probable Inference, the Law of Succession, and Statistical Inference", 1927.

    Parameters
    ----------
    hits, trials
        How often it happened, of how many times.

    Returns
    -------
    float, float
        Lower and upper bound; 0 and 1 without trials.

    """
    if trials == 0:
        return 0.0, 1.0
    share, square = hits / trials, _NORMAL_95**2
    middle = (share + square / (2 * trials)) / (1 + square / trials)
    half = (
        _NORMAL_95
        / (1 + square / trials)
        * math.sqrt(share * (1 - share) / trials + square / (4 * trials**2))
    )
    return max(middle - half, 0.0), min(middle + half, 1.0)


@dataclass(frozen=True)
class Bin:
    """Runs with similar values of a condition."""

    label: str
    runs: int
    fell: int
    """How many of them fell or failed."""

    @property
    def interval(self) -> tuple[float, float]:
        """Return the 95 % confidence interval of the share that falls."""
        return wilson_interval(self.fell, self.runs)


def bins_of(runs: Sequence[FinishedRun], name: str) -> list[Bin]:
    """
    Group runs by the values of a condition.

    Parameters
    ----------
    runs
        The runs; those without the condition are left out.
    name
        The condition.

    Returns
    -------
    list of Bin
        One for each value; numbers with more than 8 values are grouped into equal ranges.

    """
    those = [(run.conditions[name], run) for run in runs if name in run.conditions]
    values = {_hashable(value) for value, _ in those}
    if len(values) > _MOST_BINS and all(isinstance(value, (int, float)) for value in values):
        return _ranges(those, min(values), max(values))
    groups: dict[Any, list[FinishedRun]] = {}
    for value, run in sorted(those, key=lambda each: _order(each[0])):
        groups.setdefault(_hashable(value), []).append(run)
    return [_bin(number_text(value), group) for value, group in groups.items()]


def number_text(value: Any) -> str:
    """
    Format a value of a condition, numbers with up to four digits.

    Parameters
    ----------
    value
        The value.

    """
    return f'{value:.4g}' if isinstance(value, float) else str(value)


def time_left_s(finished: int, left: int, elapsed_s: float) -> float | None:
    """
    Estimate the time until a sweep is done from the speed so far.

    Parameters
    ----------
    finished, left
        Number of runs that were finished since the start, and of those that are left.
    elapsed_s
        Time since the start.

    Returns
    -------
    float or None
        In s; None before the first run is finished.

    """
    return left * elapsed_s / finished if finished else None


def _ranges(those: list[tuple[Any, FinishedRun]], low: float, high: float) -> list[Bin]:
    """Group runs into equal ranges of a number; the last one includes its end."""
    count = min(_MOST_BINS, max(2, len(those) // 5))
    width = (high - low) / count
    groups: list[list[FinishedRun]] = [[] for _ in range(count)]
    for value, run in those:
        groups[min(int((value - low) / width), count - 1)].append(run)
    return [
        _bin(f'{low + number * width:.3g} to {low + (number + 1) * width:.3g}', group)
        for number, group in enumerate(groups)
    ]


def _bin(label: str, group: list[FinishedRun]) -> Bin:
    """Count the runs of a group."""
    return Bin(label, len(group), sum(run.result.outcome != STOOD for run in group))


def _hashable(value: Any) -> Any:
    """Make a list usable as a key."""
    return tuple(value) if isinstance(value, list) else value


def _order(value: Any) -> tuple[bool, Any]:
    """Sort numbers by value, and everything else by its text."""
    is_number = isinstance(value, (int, float))
    return not is_number, value if is_number else str(value)
