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
        """
        Resolve the topic name of a robot to a fully qualified one.

        Parameters
        ----------
        topic
            The name; a relative one is put into the namespace of the robot.

        Raises
        ------
        ValueError
            It is no valid topic name; the text is a sentence.

        """

    def show(self, series: Iterable[Series]) -> None:
        """
        Replace the plotted series.

        Parameters
        ----------
        series
            The series, in the order of their colours; those that are plotted already keep their
            values.

        Raises
        ------
        PathError
            They are too many.

        """

    def add(self, text: str) -> None:
        """
        Add a series to the plot.

        Parameters
        ----------
        text
            A path such as `joint_states.position[left_knee]`, or the difference `PATH - PATH`.

        Raises
        ------
        PathError
            The text is no series, or there are too many already.

        """

    def remove(self, text: str) -> None:
        """
        Remove a series from the plot.

        Parameters
        ----------
        text
            The series as it is listed; an unknown one is ignored.

        """
