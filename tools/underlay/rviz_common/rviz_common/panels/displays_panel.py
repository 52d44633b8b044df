# SPDX-License-Identifier: Apache-2.0
"""The panel with the displays: which are shown, their status and properties, and new ones."""

from __future__ import annotations

from typing import Any

from rviz_common.context import Context
from rviz_common.pace import Pace
from rviz_common.panel import Panel
from rviz_common.panels.display_switches import DisplaySwitches
from rviz_common.panels.property_editor import PropertyEditor
from rviz_common.plugins import DISPLAYS, load_plugin, plugin_names
from rviz_common.properties import Text, Topic, topic_path, Values
from rviz_common.status import Level, MARKS, status_text
from rviz_common.visualizer.display_entry import DisplayEntry
from rviz_common.visualizer.display_tree import Entry, Group
from rviz_common.visualizer.global_options import FIXED_FRAME

__all__ = ['DisplaysPanel', 'EntryFolder']

NAME = Text('Name', '', 'Its name here and in the file.')

NO_TOPIC = '(none)'


class DisplaysPanel(Panel):
    """What is shown, the tree of displays with their properties, and the global options."""

    CLASS = 'rviz_common/Displays'
    UNUSED = ('Help Height', 'Property Tree Widget', 'Splitter Ratio', 'Tree Height')

    def start(self) -> None:
        """Add the widgets."""
        self._visualizer = self.context.visualizer
        self._pace = Pace()
        gui = self.context.gui
        with gui.add_folder('Global Options', expand_by_default=False):
            self._frames: Any = gui.add_dropdown('Known frames', [self._fixed_frame()])
            self.context.on_input(self._frames, self._choose_frame)
            self._options = PropertyEditor(
                self.context, self._visualizer.options, self._visualizer.set_option
            )
        with gui.add_folder('Shown'):
            self._switches = DisplaySwitches(self.context, self._visualizer.displays)
        self._add = _AddDisplay(self.context)
        self._tree = gui.add_folder(None)
        self._folders: dict[Entry, EntryFolder] = {}
        self._revision = -1

    def update(self) -> None:
        """Update the widgets."""
        if self._revision != self._visualizer.revision:
            self._revision = self._visualizer.revision
            self._follow_tree()
        self._options.update()
        for folder in self._folders.values():
            folder.update()
        if self._pace.is_due():
            self._say()

    def _say(self) -> None:
        frames = tuple(sorted({self._fixed_frame(), *self._visualizer.watch.names()}))
        if frames != self._frames.options:
            self._frames.options = frames
        if self._frames.value != self._fixed_frame():
            self._frames.value = self._fixed_frame()
        self._add.update()
        self._switches.say()
        for folder in self._folders.values():
            folder.say()

    def _follow_tree(self) -> None:
        """Add folders for new displays, and remove those of deleted displays."""
        entries = self._visualizer.displays.children
        for entry in [each for each in self._folders if each not in entries]:
            self._folders.pop(entry).folder.remove()
        with self._tree:
            for entry in entries:
                if entry not in self._folders:
                    self._folders[entry] = EntryFolder(self.context, entry)
        for folder in self._folders.values():
            folder.follow()
        self._switches.follow()

    def _fixed_frame(self) -> str:
        return str(self._visualizer.options[FIXED_FRAME])

    def _choose_frame(self, frame: str) -> None:
        self._visualizer.set_option(FIXED_FRAME, frame)


class EntryFolder:
    """
    A folder with the status and the properties of a display.

    Parameters
    ----------
    context
        The page, and the visualizer from which the entry can be removed.
    entry
        A display or a group; the folder of a group contains those of its displays.

    Attributes
    ----------
    folder
        The handle that viser has for the folder.

    """

    def __init__(self, context: Context, entry: Entry) -> None:
        self._context = context
        self._entry = entry
        self._label = self._wanted_label()
        self.folder = context.gui.add_folder(
            self._label, expand_by_default=isinstance(entry, Group)
        )
        with self.folder:
            self._add()

    def update(self) -> None:
        """Update the widgets."""
        for editor in self._editors:
            editor.update()
        for below in self._below.values():
            below.update()

    def say(self) -> None:
        """Update the status that is shown."""
        label, text = self._wanted_label(), status_text(self._entry.status)
        if label != self._label:
            self._label = self.folder.label = label
        if text != self._text.content:
            self._text.content = text
            self._text.visible = bool(text)
        for below in self._below.values():
            below.say()

    def follow(self) -> None:
        """Add folders for new displays of a group, and remove those of deleted displays."""
        children = self._entry.children if isinstance(self._entry, Group) else []
        for entry in [each for each in self._below if each not in children]:
            self._below.pop(entry).folder.remove()
        for entry in children:
            if entry in self._below:
                self._below[entry].follow()
                continue
            with self._tree:
                self._below[entry] = EntryFolder(self._context, entry)

    def _add(self) -> None:
        gui, entry = self._context.gui, self._entry
        text = status_text(entry.status)
        self._text = gui.add_markdown(text, visible=bool(text))
        self._editors = []
        if isinstance(entry, DisplayEntry):
            values = entry.display.values
            self._editors.append(
                PropertyEditor(self._context, values, entry.change, without=['Enabled'])
            )
        self._tree = gui.add_folder(None)
        self._below: dict[Entry, EntryFolder] = {}
        self.follow()
        with gui.add_folder('Name, Remove', expand_by_default=False):
            name = Values([NAME], {'Name': entry.name})
            self._editors.append(PropertyEditor(self._context, name, self._rename_in(name)))
            button = gui.add_button('Remove', color='red', hint=f'Remove {entry.name}')
        self._context.on_click(button, lambda: self._context.visualizer.remove(entry))

    def _rename_in(self, values: Values) -> Any:
        def rename(path: str, value: Any) -> None:
            values[path] = value
            self._entry.name = values[path].strip() or self._entry.class_name

        return rename

    def _wanted_label(self) -> str:
        entry = self._entry
        level = entry.level if entry.is_enabled else Level.OK
        mark = f'{MARKS[level]} ' if level else ''
        return f'{mark}{entry.name}' if entry.is_enabled else f'{entry.name} (off)'


class _AddDisplay:
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
                gui.add_markdown('No installed package provides displays.')
                return
            self._class = gui.add_dropdown('Display', names, hint='The type of the display.')
            self._topic = gui.add_dropdown('Topic', [NO_TOPIC], hint='Topics of a matching type.')
            button = gui.add_button('Add')
        context.on_input(self._class, lambda value: self.update())
        context.on_click(button, self._add)

    def update(self) -> None:
        """Update the list of topics."""
        if not hasattr(self, '_class'):
            return
        options = (NO_TOPIC, *_topics_for(self._context, self._class.value))
        if options != self._topic.options:
            self._topic.options = options

    def _add(self) -> None:
        topic = self._topic.value
        if topic not in _topics_for(self._context, self._class.value):
            topic = ''
        try:
            entry = self._context.visualizer.add(self._class.value, topic)
        except Exception as error:  # a class of another package
            self._context.visualizer.notify('Not added', f'{type(error).__name__}: {error}')
            return
        if topic:
            entry.name = f'{entry.name} {topic}'


def _topics_for(context: Context, class_name: str) -> list[str]:
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
