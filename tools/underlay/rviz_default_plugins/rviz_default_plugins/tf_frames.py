# SPDX-License-Identifier: Apache-2.0
"""Which frames of tf are shown, and where: their poses, their age, and a filter by name."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
import re

from tf2_py.poses import chain, IDENTITY, inverse, Pose
from tf2_py.samples import Sample

__all__ = ['Age', 'Ageing', 'FrameFilter', 'placed']

MAX_LINKS = 1000


def _roots(samples: Mapping[str, Sample]) -> dict[str, tuple[str, Pose]]:
    """
    Find the root of each frame, and the pose of the frame in it.

    Parameters
    ----------
    samples
        The newest sample of each frame that has a parent, by the name of the frame.

    Returns
    -------
    dict[str, tuple[str, Pose]]
        The root and the pose, also for the roots themselves; none for frames in loops.

    """
    found: dict[str, tuple[str, Pose]] = {}
    for frame in samples:
        _climb(frame, samples, found)
    return found


def placed(
    samples: Mapping[str, Sample], fixed: str
) -> tuple[dict[str, Pose], dict[str, list[str]]]:
    """
    Compute the poses of all frames in a fixed frame.

    Parameters
    ----------
    samples
        As for `_roots`.
    fixed
        The name of the fixed frame.

    Returns
    -------
    tuple[dict[str, Pose], dict[str, list[str]]]
        The poses of the frames that are connected to the fixed one; and, by their root, the names
        of those that are not.

    """
    found = _roots(samples)
    root, fixed_pose = found.get(fixed, (fixed, IDENTITY))
    to_fixed = inverse(fixed_pose)
    poses: dict[str, Pose] = {}
    others: dict[str, list[str]] = {}
    for frame, (top, pose) in found.items():
        if top == root:
            poses[frame] = chain(to_fixed, pose)
        else:
            others.setdefault(top, []).append(frame)
    return poses, others


def _climb(frame: str, samples: Mapping[str, Sample], found: dict[str, tuple[str, Pose]]) -> None:
    """Find the root of a frame, and of all frames on the way to it."""
    way: list[str] = []
    top = frame
    while top not in found:
        sample = samples.get(top)
        if sample is None:
            found[top] = top, IDENTITY
            break
        if len(way) > MAX_LINKS:
            return
        way.append(top)
        top = sample.parent
    for each in reversed(way):
        sample = samples[each]
        root, above = found[sample.parent]
        found[each] = root, chain(above, sample.pose)


class Age(Enum):
    """The freshness of a frame: shown, shown grey, or not shown."""

    FRESH = 'fresh'
    OLD = 'old'
    GONE = 'gone'


class Ageing:
    """
    Tracks the last update of each frame; static frames never become old.

    A frame is old after a third of the time-out. A sample with an unchanged stamp is no update.
    """

    def __init__(self) -> None:
        self._heard: dict[str, tuple[int, float]] = {}

    def hear(self, samples: Mapping[str, Sample], now_s: float) -> None:
        """
        Record the frames that were updated since the last call.

        Parameters
        ----------
        samples
            The newest sample of each frame that has a parent, by the name of the frame.
        now_s
            The time in s, of the clock that `age` uses.

        """
        before = self._heard
        self._heard = heard = {}
        for frame, sample in samples.items():
            known = before.get(frame)
            is_same = known is not None and known[0] == sample.stamp_ns
            heard[frame] = known if known and is_same else (sample.stamp_ns, now_s)

    def age(self, frame: str, now_s: float, timeout_s: float) -> Age:
        """
        Compute the freshness of a frame; one that is only known as a parent is fresh.

        Parameters
        ----------
        frame
            The name of the frame.
        now_s
            The time in s, of the clock that `hear` uses.
        timeout_s
            The time without updates after which the frame is gone; it is old after a third of it.

        """
        stamp_ns, heard_s = self._heard.get(frame, (0, now_s))
        age_s = now_s - heard_s
        if not stamp_ns or age_s <= timeout_s / 3.0:
            return Age.FRESH
        return Age.OLD if age_s <= timeout_s else Age.GONE


class FrameFilter:
    """
    Filter of frames by two regular expressions, matched anywhere in their names.

    Parameters
    ----------
    shown
        Must match the names of frames that are shown; '' for any name.
    hidden
        Must not match them; '' to hide none.

    Raises
    ------
    ValueError
        One of them is not a valid regular expression.

    """

    def __init__(self, shown: str = '', hidden: str = '') -> None:
        self._shown, self._hidden = _compiled(shown), _compiled(hidden)
        self._decided: dict[str, bool] = {}

    def shows(self, frame: str) -> bool:
        """
        Whether a frame passes the filter.

        Parameters
        ----------
        frame
            The name of the frame.

        """
        if frame not in self._decided:
            self._decided[frame] = self._decide(frame)
        return self._decided[frame]

    def _decide(self, frame: str) -> bool:
        if self._shown is not None and not self._shown.search(frame):
            return False
        return self._hidden is None or not self._hidden.search(frame)


def _compiled(expression: str) -> re.Pattern[str] | None:
    try:
        return re.compile(expression) if expression else None
    except re.error as error:
        raise ValueError(f"'{expression}' is not a valid regular expression: {error}.") from None
