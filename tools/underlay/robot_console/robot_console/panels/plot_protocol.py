# SPDX-License-Identifier: Apache-2.0
"""What widgets choose series for."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol

from robot_console.plots.series import Series
from rviz_common.context import Context

__all__ = ['Plot']


class Plot(Protocol):
    """What series are chosen for."""

    context: Context

    def full_name(self, topic: str) -> str:
        """Return the full name of a topic of the robot, or raise ValueError if it is no name."""

    def show(self, series: Iterable[Series]) -> None:
        """Plot these series only."""

    def add(self, text: str) -> None:
        """Plot one more series, or raise PathError."""

    def remove(self, text: str) -> None:
        """Plot a series no longer."""
