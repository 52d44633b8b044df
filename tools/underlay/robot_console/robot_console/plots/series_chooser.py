# SPDX-License-Identifier: Apache-2.0
"""Widgets to select the plotted series: presets, fields and paths."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from html import escape
from typing import Any, Protocol

from robot_console.plots.fields import completions
from robot_console.plots.series import effort, imu, parse_series, PathError, Series, tracking_error
from robot_console.plots.topic_listener import fields_of, Samples
from rviz_common.context import Context
from rviz_common.inputs import on_choice
from rviz_common.pace import Pace
from rviz_common.topics import is_full_topic_name

__all__ = ['Plot', 'PresetButtons', 'SeriesChooser']

STATES, COMMANDS = 'joint_states', 'joint_commands'
TRACKING, EFFORT, IMU = 'Tracking error', 'Effort', 'IMU'
IMU_TYPE = 'sensor_msgs/msg/Imu'

NOTHING = '(choose)'
LOOK_S = 2.0


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
            self._say(f'No message received on {names}; the preset needs one.')
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
            self._say('There is nothing to plot for this preset: its topics have no publisher.')


def _positions(message: Any) -> dict[str, float]:
    return dict(zip(message.name, message.position))


class SeriesChooser:
    """
    Widgets to select presets and message fields, and to enter paths.

    Parameters
    ----------
    plot
        The plot that receives the series; the widgets are added to the GUI of its context.

    """

    def __init__(self, plot: Plot) -> None:
        self._plot = plot
        self._node = plot.context.node
        self._look = Pace(LOOK_S)
        self._types: dict[str, str] = {}
        self._samples = Samples(self._node, plot.full_name)
        gui, context = plot.context.gui, plot.context
        self._presets = PresetButtons(plot, self._samples, self.say)
        self._said = gui.add_html('')
        with gui.add_folder('Series'):
            self._topic = gui.add_dropdown('Topic', (NOTHING,))
            context.on_input(self._topic, self._choose_topic)
            self._field = gui.add_dropdown('Field', (NOTHING,))
            context.on_input(self._field, self._choose_field)
            self._path: Any = gui.add_text('Path', '', hint='TOPIC.FIELD, or PATH - PATH')
            context.on_click(gui.add_button('Add this path'), self._add_path)
            self._listed = gui.add_dropdown('Remove', (NOTHING,))
            context.on_input(self._listed, self._remove)

    def update(self) -> None:
        """Update the list of available topics."""
        self._samples.update()
        if self._look.is_due():
            self._offer_topics()

    def close(self) -> None:
        """Cancel pending requests for messages."""
        self._samples.close()

    def list_series(self, texts: Sequence[str]) -> None:
        """
        Update the list from which series can be removed.

        Parameters
        ----------
        texts
            The plotted series.

        """
        _offer(self._listed, texts)

    def say(self, sentence: str) -> None:
        """
        Show a warning above the widgets.

        Parameters
        ----------
        sentence
            The warning; '' removes it.

        """
        shown = f'<div class=plot-legend><p>⚠ {escape(sentence)}</p></div>' if sentence else ''
        self._said.content = shown

    def _offer_topics(self) -> None:
        """Offer the topics whose messages have numeric fields."""
        types = {
            self._short(name): kinds[0]
            for name, kinds in self._node.get_topic_names_and_types()
            if is_full_topic_name(name)
        }
        if types != self._types:
            self._types = self._presets.types = types
            _offer(self._topic, sorted(topic for topic in types if self._has_numbers(topic)))

    def _has_numbers(self, topic: str) -> bool:
        return bool(self._completions(topic))

    def _completions(self, topic: str, sample: Any = None) -> list[str]:
        try:
            return completions(self._types[topic], fields_of, sample)
        except (KeyError, PathError):
            return []

    def _short(self, name: str) -> str:
        """Return a topic as named in paths: relative to the namespace of the robot if possible."""
        robot = self._plot.full_name('x')[:-1]
        short = name.removeprefix(robot)
        return short if self._plot.full_name(short) == name else name

    def _choose_topic(self, topic: str) -> None:
        self.say('')
        _offer(self._field, self._completions(topic))
        if topic in self._types:
            self._samples.ask([topic], lambda found: self._offer_fields(topic, found))
        elif topic != NOTHING:
            self.say(f"'{topic}' no longer has a publisher.")

    def _offer_fields(self, topic: str, found: Mapping[str, Any]) -> None:
        if topic in found:
            _offer(self._field, self._completions(topic, found[topic]))

    def _choose_field(self, field: str) -> None:
        if field != NOTHING:
            path = self._path.value = f'{self._topic.value}.{field}'
            self._add(path)

    def _add_path(self) -> None:
        self._add(self._path.value)

    def _add(self, text: str) -> None:
        self.say('')
        try:
            self._plot.add(text)
        except PathError as error:
            self.say(str(error))

    def _remove(self, text: str) -> None:
        if text != NOTHING:
            self._plot.remove(text)


def _offer(dropdown: Any, texts: Sequence[str]) -> None:
    """Set the options of a dropdown; the selected one is kept if it is still available."""
    options = (NOTHING, *texts)
    if dropdown.options != options:
        dropdown.options = options
