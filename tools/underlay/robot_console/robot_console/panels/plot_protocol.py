# SPDX-License-Identifier: Apache-2.0
"""Interface of a plot to the widgets that select its series."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol

from robot_console.plots.series import Series
from rviz_common.context import Context

__all__ = ['Plot']


class Plot(Protocol):
    """A plot whose series can be selected."""

    context: Context

    def full_name(self, topic: str) -> str:
        """
        Resolve the topic name of a robot to a fully qualified name.

        Parameters
        ----------
        topic
            The name; a relative name is placed in the namespace of the robot.

        Raises
        ------
        ValueError
            The name is not a valid topic name; the message is a full sentence.

        """

    def show(self, series: Iterable[Series]) -> None:
        """
        Replace the plotted series.

        Parameters
        ----------
        series
            The series, in the order of their colours; those that are already plotted keep their
            values.

        Raises
        ------
        PathError
            There are too many series.

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
            The text is not a valid series, or there are too many series already.

        """

    def remove(self, text: str) -> None:
        """
        Remove a series from the plot.

        Parameters
        ----------
        text
            The series as listed; an unknown series is ignored.

        """
