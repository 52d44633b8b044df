# SPDX-License-Identifier: Apache-2.0
"""The parameters of both nodes."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_common.parameters import parameter, ParameterError
from temperature_monitor.thermometer import Thermometer

_COLDEST = -273.15


@dataclass(frozen=True)
class PublisherParameters:
    """How often to publish, and what."""

    rate_hz: float = parameter(
        1.0, 'Number of readings published per second.', at_least=0.01, at_most=1000.0
    )
    min_celsius: float = parameter(20.0, 'The lowest reading.', at_least=_COLDEST, at_most=10000.0)
    max_celsius: float = parameter(
        30.0, 'The highest reading.', at_least=_COLDEST, at_most=10000.0
    )
    frame_id: str = parameter('thermometer', 'Frame of the thermometer.')
    seed: int = parameter(
        -1,
        'Seed of the random readings; -1 gives different readings on every run.',
        at_least=-1,
        at_most=2**31 - 1,
        read_only=True,
    )

    def __post_init__(self) -> None:
        """Check that there is a range to draw from."""
        if self.min_celsius >= self.max_celsius:
            raise ParameterError(
                f"Parameter 'min_celsius' is {self.min_celsius}, but must be below "
                f"'max_celsius', which is {self.max_celsius}.",
                'min_celsius',
                'max_celsius',
            )

    @property
    def thermometer(self) -> Thermometer:
        """Return the thermometer that the parameters describe."""
        return Thermometer(self.min_celsius, self.max_celsius)


@dataclass(frozen=True)
class AnalyzerParameters:
    """When it is hot."""

    threshold_celsius: float = parameter(
        25.0, 'Warn about readings above this.', at_least=_COLDEST, at_most=10000.0
    )
