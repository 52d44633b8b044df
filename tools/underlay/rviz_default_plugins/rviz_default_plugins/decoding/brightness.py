# SPDX-License-Identifier: Apache-2.0
"""Normalisation of depth and other single-channel images to greys."""

from __future__ import annotations

from collections import deque
from statistics import median
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ['Brightness']


class Brightness:
    """
    Maps values to greys between limits, which may be determined from the last images.

    Parameters
    ----------
    limits
        The values mapped to black and white; None to determine them from the images.
    window
        The number of images over whose minima and maxima the medians are taken as limits.

    """

    def __init__(self, limits: tuple[float, float] | None = None, window: int = 5) -> None:
        self._limits = limits
        self._seen: deque[tuple[float, float]] = deque(maxlen=max(1, window))

    def apply(self, values: NDArray[Any]) -> NDArray[np.uint8]:
        """
        Map the values of an image to greys.

        Parameters
        ----------
        values
            An array of any shape. Without fixed limits, its minimum and maximum enter the medians.

        Returns
        -------
        NDArray[np.uint8]
            Greys of the same shape. Non-finite values are black, and all values are if the limits
            are equal.

        """
        numbers = values.astype(np.float32)
        finite = np.isfinite(numbers)
        low, high = self._limits or self._found(numbers[finite])
        span = high - low
        if span == 0.0 or not np.isfinite(span):
            return np.zeros(values.shape, dtype=np.uint8)
        parts = np.where(finite, (np.where(finite, numbers, low) - low) / span, 0.0)
        return (np.clip(parts, 0.0, 1.0) * 255.0).astype(np.uint8)

    def _found(self, numbers: NDArray[np.float32]) -> tuple[float, float]:
        if numbers.size:
            self._seen.append((float(numbers.min()), float(numbers.max())))
        if not self._seen:
            return 0.0, 0.0
        return median(low for low, _ in self._seen), median(high for _, high in self._seen)
