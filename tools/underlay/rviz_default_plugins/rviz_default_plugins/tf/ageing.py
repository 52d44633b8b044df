# SPDX-License-Identifier: Apache-2.0
"""How long nothing has been heard of frames."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

from tf2_py._link import Sample

__all__ = ['Age', 'Ageing']


class Age(Enum):
    """How fresh a frame is: shown, shown grey, or not shown."""

    FRESH = 'fresh'
    OLD = 'old'
    GONE = 'gone'


class Ageing:
    """
    Watches when frames are heard of; those that do not move never grow old.

    A frame is old after a third of the time-out. What has the same stamp as before is not new.
    """

    def __init__(self) -> None:
        self._heard: dict[str, tuple[int, float]] = {}

    def hear(self, samples: Mapping[str, Sample], now_s: float) -> None:
        """
        Note which frames have been heard of since the last call.

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
        Compute how fresh a frame is; one that is only known as a parent is fresh.

        Parameters
        ----------
        frame
            The name of the frame.
        now_s
            The time in s, of the clock that `hear` uses.
        timeout_s
            After how long without news the frame is gone; it is old after a third of it.

        """
        stamp_ns, heard_s = self._heard.get(frame, (0, now_s))
        age_s = now_s - heard_s
        if not stamp_ns or age_s <= timeout_s / 3.0:
            return Age.FRESH
        return Age.OLD if age_s <= timeout_s else Age.GONE
