# SPDX-License-Identifier: Apache-2.0
"""The panel of navigation, without a browser: what it is told, and what it does."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any
from unittest import mock

from nav2_msgs.msg import MissedWaypoint
from nav2_rviz_plugins.action_watch import ActionWatch
from nav2_rviz_plugins.goal_tool import GoalTool
import pytest
from rclpy.action import ActionClient
from rviz_fakes import navigation_world, NavigationWorld
from visualization_msgs.msg import Marker

TO_POSE, THROUGH, WAYPOINTS = 'navigate_to_pose', 'navigate_through_poses', 'follow_waypoints'


@pytest.fixture
def world() -> Iterator[NavigationWorld]:
    """Return a page and its panel, without servers yet."""
    with navigation_world() as world:
        yield world


def drag(world: NavigationWorld, x: float, y: float) -> bool:
    """Draw a goal at a point that looks along y; return whether the tool is done."""
    tool = GoalTool(world.visualizer.context, '/world/tools/test')
    tool.drag((x, y, 0.0), (x, y + 0.5, 0.0), False)
    return tool.drag((x, y, 0.0), (x, y + 1.0, 0.0), True)


def test_goal_with_feedback_and_result(world: NavigationWorld) -> None:
    """A goal is sent in the fixed frame; feedback and success are told."""
    world.serve(TO_POSE)
    visitor = world.visit()
    visitor.wait_for('no server', lambda state: state['there'])
    assert drag(world, 1.0, 2.0)
    server = world.servers[TO_POSE]
    world.wait_until(lambda: server.goals, 'no goal')
    pose = server.goals[0].request.pose
    assert (pose.header.frame_id, pose.pose.position.x, pose.pose.position.y) == ('map', 1.0, 2.0)
    assert pose.pose.orientation.z == pytest.approx(0.7071, abs=1e-4)
    visitor.wait_for_phase('executing')
    goal = visitor.wait_for_feedback(
        server,
        distance_remaining=3.5,
        estimated_time_remaining=12,
        navigation_time=4,
        number_of_recoveries=1,
    )
    assert goal['numbers'] == {
        'distance_remaining': 3.5,
        'estimated_time_remaining': 12.0,
        'navigation_time': 4.0,
        'number_of_recoveries': 1.0,
    }
    server.end('succeed')
    assert visitor.wait_for_phase('succeeded')['text'] == 'The goal is reached.'


def test_goal_that_is_aborted(world: NavigationWorld) -> None:
    """The reason of the server is told, with its code."""
    world.serve(TO_POSE)
    visitor = world.visit()
    drag(world, 1.0, 2.0)
    visitor.wait_for_phase('executing')
    world.servers[TO_POSE].end('abort', 208, 'There is no way to the goal.')
    goal = visitor.wait_for_phase('aborted')
    assert goal['text'] == 'There is no way to the goal. (error code 208)'


def test_cancel(world: NavigationWorld) -> None:
    """A goal is canceled from the page."""
    world.serve(TO_POSE)
    visitor = world.visit()
    drag(world, 1.0, 2.0)
    visitor.wait_for_phase('executing')
    visitor.ask('cancel')
    visitor.wait_for_phase('canceling')
    world.servers[TO_POSE].end('canceled', 0, 'As you like.')
    assert visitor.wait_for_phase('canceled')['text'] == 'As you like.'
    visitor.ask('cancel')
    visitor.wait_for('not said', lambda state: 'no goal to cancel' in state['note'])


def test_goal_that_is_refused_or_forgotten(world: NavigationWorld) -> None:
    """A goal that the server refuses, or leaves behind when it ends, is said in words."""
    world.serve(TO_POSE)
    world.servers[TO_POSE].accepts = False
    visitor = world.visit()
    drag(world, 1.0, 2.0)
    assert '/navigate_to_pose rejected the goal' in visitor.wait_for_phase('failed')['text']
    world.servers[TO_POSE].accepts = True
    drag(world, 1.0, 2.0)
    visitor.wait_for_phase('executing')
    with mock.patch.object(ActionWatch, 'is_there', False):
        assert 'the goal is no longer executed' in visitor.wait_for_phase('failed')['text']


def test_no_server(world: NavigationWorld) -> None:
    """A goal that nobody could take is no riddle."""
    visitor = world.visit()
    drag(world, 1.0, 2.0)
    goal = visitor.wait_for_phase('failed')
    assert goal['text'] == (
        'The goal has not been sent: there is no server of the action /navigate_to_pose. Is '
        'navigation running?'
    )


def test_goal_of_another_program(world: NavigationWorld) -> None:
    """Goals that the page has not sent are followed, and can be canceled."""
    world.serve(TO_POSE)
    visitor = world.visit()
    server = world.servers[TO_POSE]
    client = ActionClient(world.robot, server.kind, TO_POSE)
    world.wait_until(client.server_is_ready, 'no server')
    client.send_goal_async(server.kind.Goal())
    assert not visitor.wait_for_phase('executing')['own']
    world.wait_until(lambda: server.goals, 'no goal')
    visitor.wait_for_feedback(server, distance_remaining=1.5)
    visitor.ask('cancel')
    visitor.wait_for_phase('canceling')
    server.end('abort', 1, 'Gone.')
    assert visitor.wait_for_phase('aborted')['text'] == 'Gone. (error code 1)'
    client.destroy()


def test_waypoints(world: NavigationWorld) -> None:
    """Waypoints are collected, numbered, removed and followed; those that were missed are told."""
    world.serve(TO_POSE, WAYPOINTS)
    visitor = world.visit()
    visitor.ask('collect', on=True)
    visitor.wait_for('not in use', lambda state: state['tool'] == 'goal' and state['collects'])
    for x in (1.0, 2.0, 3.0, 4.0):
        assert not drag(world, x, 0.0)
    visitor.ask('remove', index=1)
    state = visitor.wait_for('not removed', lambda state: len(state['waypoints']) == 3)
    assert [each['x'] for each in state['waypoints']] == [1.0, 3.0, 4.0]
    assert state['waypoints'][0]['yaw'] == pytest.approx(90.0)
    texts = [each.text for each in markers(world) if each.type == Marker.TEXT_VIEW_FACING]
    assert texts == ['1', '2', '3']
    visitor.ask('follow', loops=2)
    server = world.servers[WAYPOINTS]
    world.wait_until(lambda: server.goals, 'no goal')
    assert server.goals[0].request.number_of_loops == 2
    assert [each.pose.position.x for each in server.goals[0].request.poses] == [1.0, 3.0, 4.0]
    visitor.wait_for_phase('executing')
    visitor.wait_for_feedback(server, current_waypoint=2)
    server.end('succeed', missed_waypoints=[MissedWaypoint(index=1, error_code=5)])
    assert visitor.wait_for_phase('succeeded')['text'] == 'Missed waypoints: 2.'
    visitor.ask('clear')
    visitor.wait_for('not cleared', lambda state: not state['waypoints'])
    world.wait_until(lambda: len(markers(world)) == 0, 'still marked')


def test_parts_of_waypoints(world: NavigationWorld) -> None:
    """What the waypoint follower has done on the way is shown with the waypoints."""
    world.serve(TO_POSE, WAYPOINTS)
    visitor = world.visit()
    visitor.ask('collect', on=True)
    visitor.wait_for('not collecting', lambda state: state['collects'])
    drag(world, 1.0, 0.0)
    visitor.ask('follow', loops=0)
    visitor.wait_for_phase('executing')
    server = world.servers[TO_POSE]
    client = ActionClient(world.robot, server.kind, TO_POSE)
    world.wait_until(client.server_is_ready, 'no server')
    client.send_goal_async(server.kind.Goal())
    world.wait_until(lambda: server.goals, 'no goal')
    goal = visitor.wait_for_feedback(server, distance_remaining=2.5)
    assert goal['action'] == WAYPOINTS
    client.destroy()


def test_way_through_poses(world: NavigationWorld) -> None:
    """The waypoints are also the poses of one way."""
    world.serve(THROUGH)
    visitor = world.visit()
    visitor.ask('through')
    visitor.wait_for('not said', lambda state: 'collect some first' in state['note'])
    visitor.ask('collect', on=True)
    visitor.wait_for('not collecting', lambda state: state['collects'])
    drag(world, 1.0, 0.0)
    drag(world, 2.0, 0.0)
    visitor.ask('through')
    world.wait_until(lambda: world.servers[THROUGH].goals, 'no goal')
    assert len(world.servers[THROUGH].goals[0].request.poses) == 2


def test_lifecycle_managers(world: NavigationWorld) -> None:
    """It is told whether they are active; commands reach those that are there, in order."""
    visitor = world.visit()
    state = visitor.wait_for('no reason', lambda state: state['navigation']['note'])
    assert state['navigation']['state'] == 'unknown'
    assert 'No node offers' in state['navigation']['note']
    visitor.ask('command', command='pause')
    visitor.wait_for('not said', lambda state: 'no lifecycle manager' in state['note'])
    world.manage('localization', 'navigation')
    visitor.wait_for('not active', lambda state: state['navigation']['state'] == 'active')
    visitor.wait_for('not active', lambda state: state['localization']['state'] == 'active')
    visitor.ask('command', command='pause')
    visitor.wait_for('not paused', lambda state: state['note'] == 'Pause is done.')
    visitor.wait_for('still active', lambda state: state['navigation']['state'] == 'inactive')
    visitor.ask('command', command='resume')
    visitor.wait_for('not resumed', lambda state: state['note'] == 'Resume is done.')
    assert world.commands == [
        ('navigation', 1),
        ('localization', 1),
        ('localization', 2),
        ('navigation', 2),
    ]
    visitor.ask('command', command='explode')
    world.wait_until(lambda: visitor.refusals, 'not refused')


def test_panel_appears_with_navigation() -> None:
    """A file that does not list the panel gets it when there is a server, and is saved without."""
    with navigation_world('Panels: []') as world:
        assert world.visualizer.panels.panels == []
        world.serve(TO_POSE)
        world.wait_until(lambda: len(world.visualizer.panels._running) == 1, 'no panel')
        visitor = world.visit()
        assert visitor.state['navigation']
        assert world.visualizer.panels.to_file() == []


def markers(world: NavigationWorld) -> list[Any]:
    """Return the markers that the session has published."""
    panel: Any = world.visualizer.panels._running[0]
    return [each for each in panel._session.markers.markers if each.action == Marker.ADD]
