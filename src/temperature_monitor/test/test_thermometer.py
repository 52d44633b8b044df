# SPDX-License-Identifier: Apache-2.0
"""Check the readings that are made up."""

from __future__ import annotations

from statistics import pvariance

import pytest
from temperature_monitor.thermometer import generator_of, Thermometer

THERMOMETER = Thermometer(20.0, 30.0)


def read(seed: int, count: int) -> list[float]:
    """Return the first readings that belong to a seed."""
    generator = generator_of(seed)
    return [THERMOMETER.read(generator) for _ in range(count)]


def test_range_and_variance() -> None:
    """Readings lie in the range, and vary as much as is stated."""
    readings = read(1, 20000)
    assert min(readings) >= 20.0 and max(readings) <= 30.0
    assert THERMOMETER.variance_celsius2 == pytest.approx(100.0 / 12.0)
    assert pvariance(readings) == pytest.approx(THERMOMETER.variance_celsius2, rel=0.05)


def test_seed_repeats_the_readings() -> None:
    """The same seed gives the same readings, another one does not."""
    assert read(7, 5) == read(7, 5) != read(8, 5)


def test_no_seed() -> None:
    """Without a seed the readings differ every time."""
    assert read(-1, 5) != read(-1, 5)
