# SPDX-License-Identifier: Apache-2.0
"""Look at plots in a browser."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from rclpy.node import Node
from robot_console.panels.plots_panel import PlotsPanel
from robot_console.plots.series import parse_all
from rviz_common.page import Page
from sensor_msgs.msg import JointState

JOINTS = tuple('abcd')
EFFORT = '; '.join(f'joint_states.effort[{joint}]' for joint in JOINTS)
STILL = '; '.join(f'joint_states.velocity[{joint}]' for joint in JOINTS[:2])
POSITION = 'joint_states.position[a]'
CHARTS = 'Object.values((window.__viserTestpoints || {}).uplots || {}).map(each => each.chart)'
CURVES = f'{CHARTS}.map(chart => chart.data.slice(1).filter(curve => curve.some(Number.isFinite)))'
DRAWN = f'{CURVES}.map(curves => curves.length)'
LABELS = f'{CHARTS}.map(chart => chart.axes.map(axis => axis.label ?? null))'
TICKS = f'{CHARTS}.map(chart => chart.axes.map(axis => (axis._splits || []).length))'


@pytest.fixture
def tab(open_tab: Any) -> Any:
    """Open a tab."""
    return open_tab(1000, 500)


@pytest.fixture
def move(robot_node: Node) -> Callable[[], None]:
    """Return what has a robot move."""
    states = robot_node.create_publisher(JointState, 'joint_states', 10)
    moved = JointState(
        name=JOINTS, position=[1.0, 2.0, 3.0, 4.0], velocity=[0.0] * 4, effort=[5.0, 6.0, 7.0, 8.0]
    )
    return lambda: states.publish(moved)


def test_other_series(
    watched_page: Page, show_panel: Any, work_until: Any, move: Callable[[], None], tab: Any
) -> None:
    """A tab that was hidden shows a plot with its axes; so does it after each change of series."""
    tabs = watched_page.viser.gui.add_tab_group()
    with tabs.add_tab('Other'):
        watched_page.viser.gui.add_html('nothing')
    with tabs.add_tab('Plots'):
        panel = show_panel(PlotsPanel, Series=POSITION)

    def is_drawn(count: int) -> bool:
        ticks = tab.evaluate(TICKS)
        return tab.evaluate(DRAWN) == [count] and len(ticks) == 1 and min(ticks[0]) > 2

    tab.goto(f'{watched_page.url}?fixedDpr=0.5')
    work_until(panel, lambda: tab.get_by_role('tab', name='Plots').count(), move)
    tab.get_by_role('tab', name='Plots').click()
    work_until(panel, lambda: is_drawn(1), move)
    for text in (EFFORT, STILL, POSITION) * 7:
        series = parse_all(text)
        panel.show(series)
        work_until(panel, lambda count=len(series): is_drawn(count), move)
    assert tab.evaluate(LABELS) == [['s', 'rad or m']]
