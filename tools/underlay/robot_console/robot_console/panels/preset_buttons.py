# SPDX-License-Identifier: Apache-2.0
"""Presets of series that are often plotted together."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from robot_console.panels.plot_protocol import Plot
from robot_console.plots.presets import effort, imu, tracking_error
from robot_console.plots.series import parse_series
from robot_console.samples import Samples
from rviz_common.inputs import on_choice

__all__ = ['PresetButtons']

STATES, COMMANDS = 'joint_states', 'joint_commands'
TRACKING, EFFORT, IMU = 'Tracking error', 'Effort', 'IMU'
IMU_TYPE = 'sensor_msgs/msg/Imu'


class PresetButtons:
    """
    Buttons that plot preset series, selected from the data that the robot publishes now.

    Parameters
    ----------
    plot
        The plot whose series are replaced.
    samples
        Receives the messages from which joints are selected; its `update` is called by its owner.
    say
        Shows a message to the user; '' removes it.

    Attributes
    ----------
    types
        The types of the available topics, by topic name; set by the owner.

    """

    def __init__(self, plot: Plot, samples: Samples, say: Callable[[str], None]) -> None:
        self._plot, self._samples, self._say = plot, samples, say
        self.types: Mapping[str, str] = {}
        buttons = plot.context.gui.add_button_group('Preset', (TRACKING, EFFORT, IMU))
        on_choice(plot.context.queue.post, buttons, self.choose)

    def choose(self, preset: str) -> None:
        """
        Plot the series of a preset, if necessary once messages have arrived.

        Parameters
        ----------
        preset
            The label of the button.

        """
        self._say('')
        if preset == IMU:
            self._show(self._imu())
        else:
            topics = [STATES, COMMANDS] if preset == TRACKING else [STATES]
            self._samples.ask(topics, lambda found: self._show_joints(topics, found))

    def _show_joints(self, topics: Sequence[str], found: Mapping[str, Any]) -> None:
        """Plot the joints of the received messages, or report missing messages."""
        silent = [topic for topic in topics if topic not in found]
        if silent:
            names = ' and '.join(map(self._plot.full_name, silent))
            self._say(f'No message has come on {names}; the preset needs one.')
        elif COMMANDS in found:
            commanded, measured = (_positions(found[topic]) for topic in (COMMANDS, STATES))
            self._show(tracking_error(COMMANDS, STATES, commanded, measured))
        else:
            state = found[STATES]
            self._show(effort(STATES, dict(zip(state.name, state.effort))))

    def _imu(self) -> list[str]:
        """Return the series of the first IMU."""
        imus = sorted(topic for topic, kind in self.types.items() if kind == IMU_TYPE)
        return imu(imus[0]) if imus else []

    def _show(self, texts: Sequence[str]) -> None:
        if texts:
            self._plot.show(map(parse_series, texts))
        else:
            self._say('There is nothing to plot for this preset: nobody publishes such values.')


def _positions(message: Any) -> dict[str, float]:
    return dict(zip(message.name, message.position))
