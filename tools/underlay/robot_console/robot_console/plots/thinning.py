# SPDX-License-Identifier: Apache-2.0
"""
Decimation of values to the resolution of a plot.

Time is divided into slices, and the minimum and maximum of each slice are kept, so that no peak is
lost. The slices are the same for all series of a plot and start at multiples of their length;
otherwise, scrolling curves would jitter.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from robot_console.plots.value_trace import Numbers

__all__ = ['SLICES', 'slice_times', 'thinned']

SLICES = 400
PAUSE_S = 1.0
PAUSE_PERIODS = 4.0


def slice_times(window_s: float) -> Numbers:
    """
    Compute the times of the drawn points, two per slice.

    Parameters
    ----------
    window_s
        The length of the time window, in s.

    Returns
    -------
    Numbers
        Times (800,) in s relative to now, from `-window_s` to 0.

    """
    return np.linspace(-window_s, 0.0, 2 * SLICES, dtype=np.float64)


def thinned(times: Numbers, values: Numbers, now_s: float, window_s: float) -> Numbers:
    """
    Resample a trace to the times of the slices, keeping the extremes of each slice.

    The curve has a gap at non-finite values, and where no value was received for a second and for
    much longer than the mean period. Other values are interpolated linearly.

    Parameters
    ----------
    times, values
        The trace (n,), its times ascending, in s.
    now_s
        The time at the right end of the plot, of the same clock.
    window_s
        The length of the time window, in s.

    Returns
    -------
    Numbers
        Values (800,) for the times of `slice_times`; NaN where the curve has a gap.

    """
    finite = np.flatnonzero(np.isfinite(values))
    if len(finite) == 0:
        return np.full(2 * SLICES, np.nan)
    slice_s = window_s / SLICES
    first = math.floor(now_s / slice_s) - SLICES + 1
    at_s = (first + (np.arange(2 * SLICES) + 0.5) / 2.0) * slice_s
    known_s, known = times[finite], values[finite]
    drawn: Numbers = np.interp(at_s, known_s, known, left=np.nan, right=np.nan)
    is_gap = (np.diff(finite) > 1) | (np.diff(known_s) > _longest_s(times))
    after = np.searchsorted(known_s, at_s)
    drawn[np.concatenate(([False], is_gap, [False]))[after]] = np.nan
    _fill(drawn, np.floor(known_s / slice_s).astype(np.int64) - first, known)
    return drawn


def _longest_s(times: Numbers) -> float:
    """Compute the longest interval between values that is not a gap."""
    if len(times) < 2:
        return PAUSE_S
    return max(PAUSE_S, PAUSE_PERIODS * float(times[-1] - times[0]) / (len(times) - 1))


def _fill(drawn: Numbers, places: npt.NDArray[np.int64], values: Numbers) -> None:
    """Set the minimum and maximum of each slice that contains values."""
    inside = (places >= 0) & (places < SLICES)
    places, values = places[inside], values[inside]
    if len(places) == 0:
        return
    starts = np.flatnonzero(np.diff(places, prepend=-1))
    low, high = np.minimum.reduceat(values, starts), np.maximum.reduceat(values, starts)
    ends = np.append(starts[1:], len(values)) - 1
    rises = values[ends] >= values[starts]
    at = 2 * places[starts]
    drawn[at] = np.where(rises, low, high)
    drawn[at + 1] = np.where(rises, high, low)
