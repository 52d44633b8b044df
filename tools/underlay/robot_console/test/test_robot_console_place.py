# SPDX-License-Identifier: Apache-2.0
"""Where the panels of the console are in the page."""

from __future__ import annotations

from collections.abc import Iterator
import os
from typing import Any
from unittest import mock

from domain_coordinator import domain_id
import pytest
import rclpy
from rclpy.context import Context as RosContext
from rclpy.node import Node
from rviz_common.context import Context
from rviz_common.inputs import WorkQueue
from rviz_common.page import NO_TOKEN, Page, PageSettings
from rviz_common.panels.panel_tabs import PanelTabs
from rviz_common.widget_order import ALWAYS_ORDER

FILE = [
    {'Class': 'robot_console/Safety', 'Name': 'Stop', 'Robot': 'real'},
    {'Class': 'robot_console/Drive', 'Max Sideways Speed': 0, 'Namespace': 'robot1'},
]


@pytest.fixture
def context() -> Iterator[Context]:
    """Return a page and a node in a domain of their own."""
    quiet = {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'}
    with (
        domain_id() as domain,
        mock.patch.dict(os.environ, quiet),
        Page('test', PageSettings(token=NO_TOKEN)) as page,
    ):
        ros = RosContext()
        rclpy.init(context=ros, domain_id=domain)
        node = Node('console', context=ros)
        nothing: Any = None
        yield Context(node, page, nothing, WorkQueue())
        node.destroy_node()
        ros.try_shutdown()


def test_stop_button_is_outside_of_the_tabs(context: Context) -> None:
    """The stop button is above all, and in no tab; other panels are in one."""
    with (
        mock.patch.object(context.gui, 'add_markdown', wraps=context.gui.add_markdown) as pages,
        mock.patch.object(context.gui, 'add_tab_group', wraps=context.gui.add_tab_group) as tabs,
    ):
        panels = PanelTabs(context, FILE)
        assert [call.kwargs['order'] for call in pages.call_args_list] == [ALWAYS_ORDER, None]
        assert tabs.call_count == 1
        panels.close()
        PanelTabs(context, FILE[:1]).close()
        assert tabs.call_count == 1, 'a button alone makes no tabs'


def test_file(context: Context) -> None:
    """What the file says is written back; nothing of it is unknown."""
    panels = PanelTabs(context, FILE)
    assert panels.unknown == [] and [each.unknown for each in panels.panels] == [[], []]
    safety, drive = panels.to_file()
    assert (safety['Name'], safety['Robot']) == ('Stop', 'real')
    assert drive['Max Sideways Speed'] == 0 and drive['Namespace'] == 'robot1'
    assert context.page.routes.find('/drive/robot1') and context.page.routes.find('/safety')
    panels.close()
    assert not context.page.routes.find('/drive/robot1')


def test_same_panel_twice(context: Context) -> None:
    """A second panel for the same robot is left out; the first one works."""
    panels = PanelTabs(context, [FILE[0], FILE[0]])
    panels.update()
    panels.close()
    assert not context.page.routes.find('/safety')


@pytest.mark.parametrize('panel', ['Diagnostics', 'Drive', 'Log'])
def test_topic_that_is_no_name(context: Context, panel: str) -> None:
    """A file that gives a panel a topic which is none has a sentence in its tab."""
    with mock.patch.object(context.gui, 'add_markdown', wraps=context.gui.add_markdown) as said:
        panels = PanelTabs(context, [{'Class': f'robot_console/{panel}', 'Topic': '32FC1'}])
        panels.update()
        panels.close()
    [sentence] = [call.args[0] for call in said.call_args_list]
    assert sentence.startswith("✖ '32FC1' is not a valid topic name")
    assert not context.page.routes.find(f'/{panel.lower()}')


def test_panel_that_fails_later(context: Context) -> None:
    """A panel that is stopped while it is shown says so in its tab."""
    with mock.patch.object(context.gui, 'add_markdown', wraps=context.gui.add_markdown) as said:
        panels = PanelTabs(context, FILE[1:])
        said.reset_mock()
        with mock.patch.object(panels.panels[0], 'update', side_effect=RuntimeError('broken')):
            panels.update()
        panels.update()
    assert [call.args[0] for call in said.call_args_list] == [
        '✖ It has been stopped by an error: see the log.'
    ]
    panels.close()
