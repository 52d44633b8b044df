# SPDX-License-Identifier: Apache-2.0
"""Tests of the widgets of the page."""

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest
from rviz_common.context import Context
from rviz_common.frames import Frames
from rviz_common.inputs import WorkQueue
from rviz_common.page import Page
from rviz_common.panel import Panel
from rviz_common.panels import panel_tabs
from rviz_common.panels.display_switches import DisplaySwitches
from rviz_common.panels.displays_panel import EntryFolder
from rviz_common.panels.panel_tabs import PanelTabs
from rviz_common.panels.property_editor import PropertyEditor
from rviz_common.properties import (
    Choice,
    ColorOf,
    Flag,
    Frame,
    Number,
    Topic,
    Values,
    Vector,
    Whole,
)
from rviz_common.status import escaped, Level, status_text, Statuses
from rviz_common.visualizer import Visualizer
from tf2_ros import Buffer
from viser._messages import GuiSetPanelPositionMessage

ALL = (
    Flag('Flag', True),
    Number('Number', 0.5, '', 0.0, 1.0),
    Whole('Whole', 3, '', 0, 9),
    Choice('Choice', 'a', '', ('a', 'b')),
    ColorOf('Color', (1, 2, 3)),
    Vector('Vector', (1.0, 2.0, 3.0)),
    Frame('Frame', 'map'),
    Topic('Topic/Value', '/a', '', 'std_msgs/msg/String'),
)
GROUP = """
Visualization Manager:
  Displays:
    - Class: rviz_common/Group
      Name: Group
      Displays:
        - Class: a/B
          Name: Inner
    - Class: c/D
      Name: Outer
"""
Show = Callable[..., Visualizer]


class Notices:
    """A visualizer that only takes messages."""

    def __init__(self) -> None:
        self.texts: list[str] = []

    def notify(self, title: str, text: str) -> None:
        """Take a message."""
        self.texts.append(text)


@pytest.fixture
def context(page: Page) -> Context:
    """Return a context without a node."""
    node: Any = None
    return Context(node, page, Frames(Buffer()), WorkQueue(), Notices())


def test_there_is_a_widget_for_each_kind_of_property(context: Context) -> None:
    """A widget begins with the value; what a program changes, the widget shows."""
    values = Values(ALL)
    editor = PropertyEditor(context, values, values.__setitem__)
    assert {path: tuple_of(widget.value) for path, widget in editor._widgets.items()} == {
        each.path: each.default for each in ALL
    }
    values['Whole'] = 7
    editor.update()
    assert editor._widgets['Whole'].value == 7


def test_typing_takes_effect_when_it_rests(
    context: Context, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a name that is typed letter by letter, only the whole is used; flags are at once."""
    now_s = 100.0
    monkeypatch.setattr('time.monotonic', lambda: now_s)
    values = Values(ALL)
    changes: list[tuple[str, Any]] = []
    editor = PropertyEditor(context, values, lambda path, value: changes.append((path, value)))
    for text in ('/s', '/sc', '/scan'):
        editor._take('Topic/Value', text, 0.6)
        now_s += 0.3
        editor.update()
    assert changes == []
    now_s += 0.5
    editor._take('Flag', False, 0.0)
    editor.update()
    assert changes == [('Topic/Value', '/scan'), ('Flag', False)]


def test_what_cannot_be_used_is_refused_with_a_sentence(context: Context) -> None:
    """The widget shows again what holds."""
    values = Values(ALL)
    editor = PropertyEditor(context, values, values.__setitem__)
    editor._widgets['Number'].value = 5.0
    editor._take('Number', 5.0, 0.0)
    editor.update()
    assert context.visualizer.texts == ["'Number' must be from 0 to 1, not 5.0."]
    assert editor._widgets['Number'].value == 0.5


def test_the_tree_follows_the_displays(show: Show) -> None:
    """Folders come and go with displays; their labels say what is wrong."""
    shown = show(GROUP)
    shown.frame()
    (panel,) = (each for each in shown.panels.panels if each.CLASS == 'rviz_common/Displays')
    folders: list[EntryFolder] = list(panel._folders.values())  # type: ignore[attr-defined]
    assert [each.folder.label for each in folders] == ['⚠ Group', '⚠ Outer']
    inner = shown.displays.children[0].children[0]  # type: ignore[attr-defined]
    shown.remove(inner)
    shown.frame()
    for folder in folders:
        folder.say()
    assert [each.folder.label for each in folders] == ['Group', '⚠ Outer']
    shown.displays.children[1].enable(False)
    folders[1].say()
    assert folders[1].folder.label == 'Outer (off)'


def test_one_click_switches_a_display(show: Show) -> None:
    """Checkboxes outside of the folders follow the displays, and enable and disable them."""
    shown = show('Panels:\n  - Class: rviz_common/Displays\n' + GROUP)
    (panel,) = shown.panels.panels
    switches: DisplaySwitches = panel._switches  # type: ignore[attr-defined]
    group, outer = (switches.switches[each] for each in shown.displays.children)
    assert outer.box.label == 'Outer' and outer.below is None and group.below is not None
    (inner,) = group.below.switches.values()
    for entry, switch in switches.switches.items():
        click(switch.box, False)
        shown.context.queue.run()
        assert not entry.is_enabled
    assert inner.box.label == 'Inner' and inner.box.value
    shown.displays.children[1].name = 'Other'
    shown.displays.children[1].enable(True)
    switches.say()
    assert (outer.box.label, outer.box.value) == ('Other', True)
    shown.remove(shown.displays.children[0].children[0])  # type: ignore[attr-defined]
    shown.remove(shown.displays.children[1])
    shown.frame()
    assert list(switches.switches.values()) == [group] and not group.below.switches


def test_the_head_names_the_worst_first(show: Show) -> None:
    """The top of the page has the fixed frame, and the displays with something to say."""
    shown = show(GROUP)
    assert shown.head._summary().splitlines()[::2] == [
        '⚠ **Fixed Frame**: No publisher on /tf or /tf\\_static: only data in '
        "'map' itself can be shown. Start robot\\_state\\_publisher, or another publisher of "
        'the robot pose.',
        '⚠ Inner, Outer: see Displays',
    ]


def test_texts_are_not_assigned_when_nothing_is_new(
    show: Show, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A frame in which nothing happens sends nothing to browsers."""
    shown = show('Panels:\n  - Class: rviz_common/Displays\n' + GROUP)
    for _ in range(2):
        shown.frame()
        shown.panels.panels[0]._pace.hurry()  # type: ignore[attr-defined]
        shown.head._pace.hurry()
    sent: list[Any] = []
    interface = shown.context.gui._websock_interface
    monkeypatch.setattr(interface, 'queue_message', sent.append)
    shown.frame()
    assert sent == []


def test_a_panel_that_fails_harms_no_other(context: Context, show: Show, capfd: Any) -> None:
    """It is stopped with a line of the log; unknown ones are kept for the file."""
    shown = show('Panels:\n  - Class: rviz_common/Time\n  - Class: a/B\n    X: 1\n')
    (time_panel,) = shown.panels.panels

    def fail() -> None:
        raise RuntimeError('no time')

    time_panel.update = fail  # type: ignore[method-assign]
    shown.frame()
    shown.frame()
    assert capfd.readouterr().err.count('no time') == 1
    assert isinstance(shown.panels, PanelTabs)
    assert shown.panels.unknown == ['a/B']
    assert shown.panels.to_file() == [{'Class': 'rviz_common/Time'}, {'Class': 'a/B', 'X': 1}]


class Awaited(Panel):
    """A panel on demand, which is wanted from the start."""

    CLASS = 'a/Awaited'
    FOLLOWS = 'rviz_common/Views'

    @classmethod
    def is_wanted(cls, node: Any) -> bool:
        """Want it."""
        return True

    def start(self) -> None:
        """Add nothing."""


@pytest.mark.parametrize(
    ('followed', 'tabs'),
    [('rviz_common/Views', 'Views Awaited Time'), ('b/Missing', 'Views Time Awaited')],
)
def test_a_panel_on_demand_appears_where_it_belongs(
    show: Show, monkeypatch: pytest.MonkeyPatch, followed: str, tabs: str
) -> None:
    """Its tab is next to that of the panel that it follows, or else the last one."""
    load = panel_tabs.load_plugin
    plugins = {Awaited.CLASS: Awaited}
    monkeypatch.setattr(Awaited, 'FOLLOWS', followed)
    monkeypatch.setattr(panel_tabs, 'plugin_names', lambda group: list(plugins))
    monkeypatch.setattr(
        panel_tabs, 'load_plugin', lambda group, name: plugins.get(name) or load(group, name)
    )
    shown = show('Panels:\n  - Class: rviz_common/Views\n  - Class: rviz_common/Time\n')
    assert in_row(shown) == ['Views', 'Time']
    shown.frame()
    assert in_row(shown) == tabs.split()
    assert [each['Class'] for each in shown.panels.to_file()] == [
        'rviz_common/Views', 'rviz_common/Time',
    ]  # fmt: skip


def test_panels_can_be_docked_beside_the_tabs(show: Show, tmp_path: Any) -> None:
    """Those docked are below each other; the file remembers them; back, they have their places."""
    shown = show(
        'Panels:\n  - {Class: rviz_common/Views}\n  - {Class: rviz_common/Time, Docked: true}\n'
        '  - {Class: rviz_common/Tool Properties}\n'
    )
    assert (in_row(shown), on_left(shown)) == (['Views', 'Tool Properties'], ['Time'])
    views, time, _ = shown.panels.panels
    press_dock_button(shown, views)
    assert (in_row(shown), on_left(shown)) == (['Tool Properties'], ['Time', 'Views'])
    above, below = (each.panel for each in shown.panels.dock._docked)
    positions = sent_positions(shown)
    assert positions[above._impl.uuid][0] == 'edge'
    assert positions[below._impl.uuid] == ('split', above._impl.uuid)
    press_dock_button(shown, time)
    assert (in_row(shown), on_left(shown)) == (['Time', 'Tool Properties'], ['Views'])
    assert sent_positions(shown)[below._impl.uuid][0] == 'edge'
    shown.save(str(tmp_path / 'a.rviz'))
    again = show((tmp_path / 'a.rviz').read_text())
    assert on_left(again) == ['Views']
    assert [each.unknown for each in again.panels.panels] == [[], [], []]
    assert len(shown.panels._tabs[time]._children) > 1, 'what was in it has moved along'


def in_row(shown: Visualizer) -> list[str]:
    """Return the names of the tabs that browsers show in the row."""
    return list(shown.panels.dock._group._tab_labels)


def on_left(shown: Visualizer) -> list[str]:
    """Return the names of the tabs on the left, from top to bottom."""
    return [each.name for each in shown.panels.dock._docked]


def press_dock_button(shown: Visualizer, panel: Panel) -> None:
    """Press the button that moves a panel."""
    button = next(iter(shown.panels._tabs[panel]._children.values()))
    for callback in button._impl.update_cb:  # type: ignore[attr-defined]
        callback(SimpleNamespace(client=object(), target=button))
    shown.context.queue.run()


def sent_positions(shown: Visualizer) -> dict[str, tuple[str, str]]:
    """Return where browsers that connect now are told to place each panel."""
    buffer = shown.context.gui._websock_interface._broadcast_buffer
    return {
        each.uuid: (each.position['kind'], each.position.get('anchor_uuid', ''))
        for each in buffer.message_from_id.values()
        if isinstance(each, GuiSetPanelPositionMessage)
    }


def test_a_panel_with_a_value_that_cannot_be_used(show: Show, capfd: Any) -> None:
    """It has its default instead, which the log says."""
    show("Panels:\n  - Class: rviz_common/Time\n    Sync Source: ''\n")
    show("Panels:\n  - {Class: robot_console/Log, Name: What nodes say, Namespace: '1x'}\n")
    said = capfd.readouterr().err
    assert said.count('In the panel') == 1
    assert "'What nodes say' (robot_console/Log), 'Namespace' must be like 'robot1'" in said


def test_another_topic_of_a_tool_is_used_at_once(show: Show, node: Any) -> None:
    """Who changes the topic of a tool need not start anew."""
    tools = 'Visualization Manager:\n  Tools:\n    - Class: rviz_default_plugins/SetGoal\n'
    shown = show('Panels:\n  - Class: rviz_common/Tool Properties\n' + tools)
    (panel,) = shown.panels.panels
    (editor,) = panel._editors  # type: ignore[attr-defined]
    editor._take('Topic/Value', '/other_goal', 0.0)
    shown.frame()
    topics = [name for name, _ in node.get_publisher_names_and_types_by_node('rviz2', '/')]
    assert '/other_goal' in topics and '/goal_pose' not in topics
    assert shown.tools.to_file()[0]['Topic'] == {'Value': '/other_goal'}


def test_a_file_that_is_uploaded_replaces_what_is_shown(show: Show, tmp_path: Any) -> None:
    """It is saved under its own name, beside the last one; a broken one changes nothing."""
    shown = show(GROUP, str(tmp_path / 'first.rviz'))
    shown._files._load('b.rviz', b'Panels: 3')
    shown._files._load('c.rviz', b'\xff\xff')
    assert [each.name for each in shown.displays.children] == ['Group', 'Outer']
    shown._files._load('../../b.rviz', b'Panels: ~')
    assert shown.displays.children == []
    assert shown.path == str(tmp_path / 'b.rviz')
    shown._files._save()
    assert (tmp_path / 'b.rviz').read_text() == 'Panels: ~\n'


def test_views_can_be_changed(show: Show, tmp_path: Any) -> None:
    """Another kind of view, and saved ones, get into the file."""
    shown = show('Panels:\n  - Class: rviz_common/Views\n')
    (panel,) = shown.panels.panels
    panel._choose_kind('FPS')  # type: ignore[attr-defined]
    panel._change('Yaw', 1.5)  # type: ignore[attr-defined]
    panel._save(None)  # type: ignore[attr-defined]
    shown.frame()
    shown.save(str(tmp_path / 'a.rviz'))
    again = show((tmp_path / 'a.rviz').read_text())
    assert again.cameras.view.class_name == 'rviz_default_plugins/FPS'
    assert again.cameras.view.values['Yaw'] == 1.5
    assert [view.name for view in again.saved_views] == ['View']


def test_texts_of_others_mean_nothing_to_markdown() -> None:
    """A name with stars or brackets is shown as it is, and a long one is cut."""
    assert escaped('a*b_[c](d)\n<e>') == 'a\\*b\\_\\[c\\](d) \\<e\\>'
    assert len(escaped('x' * 10000)) < 600
    status = Statuses()
    status.say('A', Level.ERROR, 'b')
    status.say('C', Level.OK, 'd')
    assert status_text(status) == '✖ **A**: b\n\n✔ **C**: d'


def click(box: Any, is_on: bool) -> None:
    """Do with a checkbox what a browser does."""
    box.value = is_on
    for callback in box._impl.update_cb:
        callback(SimpleNamespace(client=object(), target=box))


def tuple_of(value: Any) -> Any:
    """Return a value as properties have it."""
    return tuple(value) if isinstance(value, (tuple, list)) else value
