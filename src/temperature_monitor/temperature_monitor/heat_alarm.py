# SPDX-License-Identifier: Apache-2.0
"""Tell when it is too hot, and when it is not any more."""

from __future__ import annotations

from dataclasses import dataclass
import math


@dataclass(frozen=True)
class Notice:
    """A sentence about a reading."""

    text: str
    is_warning: bool


class HeatAlarm:
    """
    Threshold alarm: warns of every reading above it, and tells once when it is back to normal.

    Parameters
    ----------
    threshold_celsius
        The highest reading that is not too hot, in °C; it can be changed at any time.

    """

    def __init__(self, threshold_celsius: float) -> None:
        self.threshold_celsius = threshold_celsius
        self._is_hot = False

    def judge(self, celsius: float) -> Notice | None:
        """
        Compare a reading with the threshold.

        Parameters
        ----------
        celsius
            The reading.

        Returns
        -------
        Notice or None
            A warning for each reading above the threshold or not finite, a notice for the first
            one back to normal, and None for others.

        """
        if not math.isfinite(celsius):
            return Notice(f'The thermometer reads {celsius}: is it broken?', is_warning=True)
        was_hot, self._is_hot = self._is_hot, celsius > self.threshold_celsius
        if self._is_hot:
            return Notice(self._compare(celsius, 'above'), is_warning=True)
        if was_hot:
            return Notice(
                'Back to normal: ' + self._compare(celsius, 'not above'), is_warning=False
            )
        return None

    def _compare(self, celsius: float, relation: str) -> str:
        """Say how a reading relates to the threshold."""
        return f'{celsius:.1f} °C is {relation} {self.threshold_celsius:.1f} °C'
