# SPDX-License-Identifier: Apache-2.0
"""The panel of joints hears a robot, and says what is missing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from robot_console.panels.joints_panel import JointsPanel
from sensor_msgs.msg import JointState
from std_msgs.msg import String

URDF = """<robot name="r"><link name="base"/><link name="thigh"/>
<joint name="left_hip" type="revolute"><parent link="base"/><child link="thigh"/>
<limit lower="-1" upper="1" velocity="10" effort="60"/></joint></robot>"""
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def rows(panel: Any) -> str:
    """Return the table."""
    html: str = panel._rows.content
    return html


def notes(panel: Any) -> str:
    """Return what is said above the table."""
    html: str = panel._notes.content
    return html


def test_joints(robot_node: Node, show_panel: Any, work_until: Callable[..., None]) -> None:
    """Positions, errors, loads and limits come from the topics of the robot."""
    panel = show_panel(JointsPanel, Namespace='robot1')
    states = robot_node.create_publisher(JointState, '/robot1/joint_states', 10)
    commands = robot_node.create_publisher(JointState, '/robot1/joint_commands', 10)
    described = robot_node.create_publisher(String, '/robot1/robot_description', LATCHED)
    described.publish(String(data=URDF))

    def move() -> None:
        states.publish(
            JointState(name=['left_hip'], position=[0.96], velocity=[-5.0], effort=[61.0])
        )
        commands.publish(JointState(name=['left_hip'], position=[0.5]))

    work_until(panel, lambda: 'Left leg' in rows(panel) and '--t:' in rows(panel), move)
    assert '<td class="p w" style="--p:98%;--t:75%">0.960<i>55.0°</i>' in rows(panel)
    assert '<td class=w>-0.460' in rows(panel)
    assert '<td class="b" style="--p:50%">-5.00' in rows(panel)
    assert '<td class="b e" style="--p:100%">61.0' in rows(panel)
    assert '/robot1/joint_states: 1 joints' in notes(panel)


def test_nobody_publishes(show_panel: Any, work_until: Callable[..., None]) -> None:
    """What is missing is said, with who is."""
    panel = show_panel(JointsPanel)
    work_until(panel, lambda: notes(panel))
    assert '/joint_states: Nothing received yet; it has no publisher.' in notes(panel)
    assert 'No limits: no description on /robot_description yet.' in notes(panel)
    assert 'in its name' not in notes(panel)
    panel._search.value = 'knee'
    work_until(panel, lambda: 'No joint has &#x27;knee&#x27; in its name.' in notes(panel))


def test_broken_description(
    robot_node: Node, show_panel: Any, work_until: Callable[..., None]
) -> None:
    """A description that cannot be read is explained; the joints are shown without limits."""
    panel = show_panel(JointsPanel)
    robot_node.create_publisher(String, 'robot_description', LATCHED).publish(String(data='<x/>'))
    work_until(panel, lambda: 'A URDF starts with &lt;robot&gt;' in notes(panel))


def test_bad_topic(show_panel: Any, work_until: Callable[..., None]) -> None:
    """A name that cannot be that of a topic is said in the page."""
    panel = show_panel(JointsPanel, **{'Joint States Topic': 'a b'})
    work_until(panel, lambda: 'A topic of the panel cannot be subscribed' in notes(panel))


def test_nobody_looks(show_panel: Any) -> None:
    """Nothing is written while nobody looks."""
    panel = show_panel(JointsPanel)
    server = panel.context.server
    clients, server.get_clients = server.get_clients, dict
    try:
        panel.update()
        assert rows(panel) == ''
    finally:
        server.get_clients = clients
