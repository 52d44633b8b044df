# SPDX-License-Identifier: Apache-2.0
"""A thermometer that makes its readings up."""

from __future__ import annotations

from dataclasses import dataclass
import random

COLDEST_CELSIUS = -273.15
"""Absolute zero, below which there is no reading."""


@dataclass(frozen=True)
class Thermometer:
    """Draws each reading from the range, all values being equally likely."""

    low_celsius: float
    high_celsius: float

    @property
    def variance_celsius2(self) -> float:
        """Return the variance of the readings, that of a uniform distribution."""
        return (self.high_celsius - self.low_celsius) ** 2 / 12.0

    def read(self, generator: random.Random) -> float:
        """
        Draw the next reading in degrees Celsius.

        Parameters
        ----------
        generator
            The source of random numbers.

        """
        return generator.uniform(self.low_celsius, self.high_celsius)


def generator_of(seed: int) -> random.Random:
    """
    Create a random number generator.

    Parameters
    ----------
    seed
        The same seed repeats the same numbers; a negative one gives new numbers each time.

    """
    return random.Random(seed) if seed >= 0 else random.Random()
