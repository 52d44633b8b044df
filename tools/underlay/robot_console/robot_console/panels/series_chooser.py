# SPDX-License-Identifier: Apache-2.0
"""Widgets to select the plotted series."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

from robot_console.message_types import fields_of
from robot_console.panels.plot_protocol import Plot
from robot_console.panels.preset_buttons import PresetButtons
from robot_console.plots.completion import completions
from robot_console.plots.field_path import PathError
from robot_console.samples import Samples
from rviz_common.pace import Pace
from rviz_common.topic_names import is_full_topic_name

__all__ = ['SeriesChooser']

NOTHING = '(choose)'
LOOK_S = 2.0


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
            self.say(f"Nobody publishes '{topic}' any longer.")

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
