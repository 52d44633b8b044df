# SPDX-License-Identifier: Apache-2.0
"""The ghost in the scene, in a page that nobody looks at, with a node that takes notes."""

from __future__ import annotations

import math
from typing import Any

from console_stage import Stage
import pytest
from robot_console.commanded_robot import CommandedRobot
from rviz_common.status import Level
from sensor_msgs.msg import JointState
from std_msgs.msg import String

URDF = """<robot name="r"><link name="base">
<visual><geometry><box size="1 1 1"/></geometry></visual></link>
<link name="arm"><visual><geometry><sphere radius="0.5"/></geometry></visual></link>
<joint name="shoulder" type="continuous"><parent link="base"/><child link="arm"/>
<axis xyz="0 0 1"/></joint></robot>"""


@pytest.fixture
def ghost(stage: Stage) -> Any:
    """Show the ghost of a robot that is at its place."""
    display = stage.show(CommandedRobot)
    stage.node.say('robot_description', String(data=URDF))
    stage.move('map', 'base', x=2.0)
    stage.move('base', 'arm')
    return display


def command(stage: Stage, *positions: float, topic: str = 'joint_commands') -> None:
    """Tell the joint where to be."""
    stage.node.say(topic, JointState(name=['shoulder'], position=positions))


def said(ghost: Any) -> str:
    """Return all that the ghost says."""
    return ' '.join(sentence for _, _, sentence in ghost.status.items())


def test_follows_commands(stage: Stage, ghost: Any) -> None:
    """The ghost is where the robot is, turned as it was told, blue and a little larger."""
    ghost.update()
    command(stage, 0.5)
    ghost.update()
    base, arm = stage.node_at('/display_0/base'), stage.node_at('/display_0/base/arm')
    assert base.visible and base.position.tolist() == [2.0, 0.0, 0.0]
    assert arm.wxyz.tolist() == pytest.approx([math.cos(0.25), 0.0, 0.0, math.sin(0.25)])
    box = stage.node_at('/display_0/base/visual_0')
    assert (box.color, box.opacity) == ((77, 171, 247), 0.3)
    assert 1.0 < box.dimensions[0] < 1.01


def test_only_links_that_lag_behind_are_shown(stage: Stage, ghost: Any) -> None:
    """A link that is where it was told to be is hidden, until it is not, or always shown."""
    ghost.update()
    command(stage, 0.5)
    ghost.update()
    body, ball = (stage.node_at(f'/display_0/{each}/visual_0') for each in ('base', 'base/arm'))
    assert (body.visible, ball.visible) == (False, True)
    ghost.on_change('Update Interval')  # also explains at once what is shown
    ghost.update()
    assert 'The ghost shows the links that lag behind their commands.' in said(ghost)
    stage.move('base', 'arm', wxyz=(math.cos(0.25), 0.0, 0.0, math.sin(0.25)))
    ghost.on_change('Update Interval')
    ghost.update()
    assert (body.visible, ball.visible) == (False, False)
    assert 'All links follow their commands, so the ghost is hidden.' in said(ghost)
    ghost.values['Position Tolerance'] = 0.0
    ghost.update()
    assert (body.visible, ball.visible) == (True, True)


def test_hidden_links_stay_hidden_when_redrawn(stage: Stage, ghost: Any) -> None:
    """A new look does not show the links that follow."""
    command(stage, 0.0)
    ghost.update()
    ghost.values['Alpha'] = 0.6
    ghost.on_change('Alpha')
    ghost.update()
    ball = stage.node_at('/display_0/base/arm/visual_0')
    assert (ball.opacity, ball.visible) == (0.6, False)


def test_hidden_without_commands(
    stage: Stage, ghost: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The ghost is hidden before the first command and a second after the last, and says why."""
    ghost.update()
    base = stage.node_at('/display_0/base')
    assert not base.visible
    assert 'No publisher on /joint_commands. The ghost is hidden.' in said(ghost)
    command(stage, 0.5)
    ghost.update()
    assert base.visible
    now_s = stage.later(monkeypatch, 1.5)
    stage.node.publishers = 1
    ghost.update()
    assert now_s and not base.visible
    assert 'No positions received on /joint_commands for a second.' in said(ghost)


def test_malformed_commands(stage: Stage, ghost: Any) -> None:
    """A command that cannot be shown is named, and does no harm."""
    ghost.update()
    command(stage)
    ghost.update()
    assert 'A command was ignored: it has 1 names but 0 positions.' in said(ghost)
    command(stage, math.nan)
    ghost.update()
    assert not stage.node_at('/display_0/base').visible
    stage.node.say('joint_commands', JointState(name=['tail'], position=[1.0]))
    command(stage, 1.0)
    ghost.update()
    assert stage.node_at('/display_0/base').visible


def test_colours_of_the_description(stage: Stage, ghost: Any) -> None:
    """The ghost can have the colours of the robot."""
    ghost.update()
    ghost.values['Use Color'] = False
    ghost.on_change('Use Color')
    assert stage.node_at('/display_0/base/visual_0').color != (77, 171, 247)


def test_namespace(stage: Stage) -> None:
    """The topics are those of the robot that the namespace says."""
    ghost = stage.show(CommandedRobot)
    ghost.values['Namespace'] = 'robot1'
    ghost.on_change('Namespace')
    assert {topic for topic, _, _ in stage.node.subscriptions} == {
        '/robot1/robot_description',
        '/robot1/joint_commands',
    }


def test_bad_topic(stage: Stage) -> None:
    """A topic that cannot be subscribed is named, also when there is a robot to show."""
    ghost = stage.show(CommandedRobot, {'Command Topic': {'Value': 'a b'}})
    assert "'a b' cannot be subscribed: no topic has a space in its name" in said(ghost)
    stage.node.say('robot_description', String(data=URDF))
    ghost.update()
    assert "'a b' cannot be subscribed: no topic has a space in its name" in said(ghost)
    assert ghost.status.level == Level.ERROR
