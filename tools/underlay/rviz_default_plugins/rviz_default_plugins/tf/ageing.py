# SPDX-License-Identifier: Apache-2.0
"""The age of frames: the time since their last update."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

from tf2_py._link import Sample

__all__ = ['Age', 'Ageing']


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
