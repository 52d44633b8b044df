# SPDX-License-Identifier: Apache-2.0
"""Widgets to add a display."""

from __future__ import annotations

from rviz_common.context import Context
from rviz_common.plugins import DISPLAYS, load_plugin, plugin_names
from rviz_common.properties import Topic, topic_path

__all__ = ['AddDisplay']

NO_TOPIC = '(none)'


class AddDisplay:
    """
    Widgets to add a display of a class, with a topic that fits it.

    Parameters
    ----------
    context
        The page, and the visualizer to which displays are added.

    """

    def __init__(self, context: Context) -> None:
        self._context = context
        names = plugin_names(DISPLAYS)
        gui = context.gui
        with gui.add_folder('Add a display', expand_by_default=False):
            if not names:
                gui.add_markdown('No installed package offers displays.')
                return
            self._class = gui.add_dropdown('Display', names, hint='What is to be shown.')
            self._topic = gui.add_dropdown('Topic', [NO_TOPIC], hint='Those of a fitting type.')
            button = gui.add_button('Add')
        context.on_input(self._class, lambda value: self.update())
        context.on_click(button, self._add)

    def update(self) -> None:
        """Update the list of topics."""
        if not hasattr(self, '_class'):
            return
        options = (NO_TOPIC, *topics_for(self._context, self._class.value))
        if options != self._topic.options:
            self._topic.options = options

    def _add(self) -> None:
        topic = self._topic.value
        if topic not in topics_for(self._context, self._class.value):
            topic = ''
        try:
            entry = self._context.visualizer.add(self._class.value, topic)
        except Exception as error:  # a class of another package
            self._context.visualizer.notify('Not added', f'{type(error).__name__}: {error}')
            return
        if topic:
            entry.name = f'{entry.name} {topic}'


def topics_for(context: Context, class_name: str) -> list[str]:
    """
    List the topics that a display of a class can show, sorted.

    Parameters
    ----------
    context
        The context, whose node lists the topics.
    class_name
        The class of the display, such as `rviz_default_plugins/Path`.

    Returns
    -------
    list[str]
        The topics of a matching message type; none for an unknown class.

    """
    try:
        properties = load_plugin(DISPLAYS, class_name).PROPERTIES
    except (LookupError, ImportError):
        return []
    path = topic_path(properties)
    types = {
        each.type_name for each in properties if isinstance(each, Topic) and each.path == path
    }
    return sorted(
        topic for topic, names in context.node.get_topic_names_and_types() if types & set(names)
    )
