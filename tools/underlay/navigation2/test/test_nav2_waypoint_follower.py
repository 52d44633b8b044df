# SPDX-License-Identifier: Apache-2.0
"""The follower of waypoints with a navigator that does what a test says."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
import sys
from typing import Any

from action_msgs.msg import GoalStatus
import cv2
from nav2_msgs.action import FollowGPSWaypoints, FollowWaypoints, NavigateToPose
from nav2_util import ActionAborted, ActionServer, sleep
from nav2_waypoint_follower import WaypointFollower
import pytest
from sensor_msgs.msg import Image
from std_msgs.msg import Empty

sys.path.insert(0, str(Path(__file__).parent))
from navigation_servers import Client, pose  # noqa: E402, I100

SUCCEEDED = GoalStatus.STATUS_SUCCEEDED
ABORTED = GoalStatus.STATUS_ABORTED
CANCELED = GoalStatus.STATUS_CANCELED


class Stack:
    """A follower, a navigator that cannot reach negative x and stays at x > 10, and a client."""

    def __init__(self, ros: Any, parameters: dict[str, Any]) -> None:
        self.ros, self.node = ros, ros.node('navigator')
        self.visited: list[float] = []
        self.canceled: list[float] = []
        self.navigator = ActionServer(self.node, NavigateToPose, 'navigate_to_pose', self._go)
        self.navigator.activate()
        self.follower = ros.make(WaypointFollower, parameters)
        self.follower.trigger_configure()
        self.follower.trigger_activate()
        self.client = Client(ros, ros.node('client'), FollowWaypoints, 'follow_waypoints')

    async def _go(self, goal: Any) -> None:
        x = goal.pose.pose.position.x
        self.visited.append(x)
        if x < 0.0:
            raise ActionAborted(206, 'A wall is there.')
        try:
            while x > 10.0:
                self.navigator.check()
                await sleep(self.node, 0.01)
        except Exception:
            self.canceled.append(x)
            raise

    def close(self) -> None:
        self.client.close()
        self.navigator.destroy()


@pytest.fixture
def make_stack(ros: Any) -> Iterator[Any]:
    """Return a function that makes a stack with parameters."""
    made: list[Stack] = []

    def make(**parameters: Any) -> Stack:
        made.append(Stack(ros, parameters))
        return made[-1]

    yield make
    for each in made:
        each.close()


def test_all_waypoints_are_visited_as_often_as_wanted(make_stack: Any) -> None:
    """From the first index on, and from the beginning in further loops."""
    stack = make_stack()
    handle = stack.client.send(
        poses=[pose(1.0), pose(2.0), pose(3.0)], number_of_loops=1, goal_index=1
    )
    status, result = stack.client.wait(handle)
    assert (status, result.error_code, result.error_msg) == (SUCCEEDED, 0, '')
    assert stack.visited == [2.0, 3.0, 1.0, 2.0, 3.0]
    assert result.missed_waypoints == []
    assert {each.current_waypoint for each in stack.client.feedback} == {0, 1, 2}


def test_a_missed_waypoint_is_told(make_stack: Any) -> None:
    """With its index and the error code of the navigator; the others are visited."""
    stack = make_stack(stop_on_failure=False)
    status, result = stack.client.wait(stack.client.send(poses=[pose(1.0), pose(-2.0), pose(3.0)]))
    assert status == SUCCEEDED and stack.visited == [1.0, -2.0, 3.0]
    missed = [(each.index, each.error_code) for each in result.missed_waypoints]
    assert missed == [(1, 206)]
    assert result.missed_waypoints[0].goal.pose.position.x == -2.0
    assert result.error_msg == 'Waypoint 1 was missed. A wall is there.'


def test_a_missed_waypoint_ends_the_goal_if_wanted(make_stack: Any) -> None:
    """With a sentence."""
    stack = make_stack()
    status, result = stack.client.wait(stack.client.send(poses=[pose(1.0), pose(-2.0), pose(3.0)]))
    assert (status, result.error_code) == (ABORTED, 600)
    assert 'Waypoint 1 was missed. A wall is there.' in result.error_msg
    assert stack.visited == [1.0, -2.0]


def test_canceling_cancels_the_navigation(make_stack: Any) -> None:
    """At once."""
    stack = make_stack()
    handle = stack.client.send(poses=[pose(11.0)])
    stack.ros.wait_until(lambda: stack.visited)
    stack.ros.spin(0.1)
    handle.cancel_goal_async()
    assert stack.client.wait(handle)[0] == CANCELED
    stack.ros.wait_until(lambda: stack.canceled == [11.0])


def test_a_newer_list_takes_over(make_stack: Any) -> None:
    """Its first waypoint takes the place of the one that the robot goes to."""
    stack = make_stack()
    first = stack.client.send(poses=[pose(11.0), pose(1.0)])
    stack.ros.wait_until(lambda: stack.visited)
    second = stack.client.send(poses=[pose(2.0)])
    status, result = stack.client.wait(first)
    assert status == ABORTED and 'newer goal' in result.error_msg
    assert stack.client.wait(second)[0] == SUCCEEDED
    assert stack.visited == [11.0, 2.0]


def test_goals_that_make_no_sense_are_aborted(make_stack: Any) -> None:
    """With a sentence each."""
    stack = make_stack()
    status, result = stack.client.wait(stack.client.send(poses=[]))
    assert status == ABORTED and 'no waypoints' in result.error_msg
    status, result = stack.client.wait(stack.client.send(poses=[pose(1.0)], goal_index=1))
    assert status == ABORTED and 'goal_index is 1' in result.error_msg


def test_a_missing_navigator_is_told(ros: Any) -> None:
    """The first waypoint is missed."""
    follower = ros.make(WaypointFollower)
    follower.trigger_configure()
    follower.trigger_activate()
    client = Client(ros, ros.node('client'), FollowWaypoints, 'follow_waypoints')
    status, result = client.wait(client.send(poses=[pose(1.0)]))
    assert status == ABORTED and "'navigate_to_pose'" in result.error_msg
    client.close()


def test_places_on_the_earth_need_a_converter(make_stack: Any) -> None:
    """Without it, goals are rejected."""
    stack = make_stack()
    client = Client(stack.ros, stack.node, FollowGPSWaypoints, 'follow_gps_waypoints')
    assert not client.send().accepted
    client.close()


def test_it_waits_at_waypoints(make_stack: Any) -> None:
    """For as long as the parameter says; canceling ends that."""
    stack = make_stack(**{'wait_at_waypoint.waypoint_pause_duration': 20000})
    handle = stack.client.send(poses=[pose(1.0)])
    stack.ros.wait_until(lambda: stack.visited)
    stack.ros.spin(0.2)
    assert not handle.end.done()
    handle.cancel_goal_async()
    assert stack.client.wait(handle, 2.0)[0] == CANCELED


def test_it_takes_photos_at_waypoints(make_stack: Any, tmp_path: Path) -> None:
    """As files that have the colours of the image; without an image the task fails."""
    stack = make_stack(
        **{
            'waypoint_task_executor_plugin': 'photo',
            'photo.plugin': 'nav2_waypoint_follower::PhotoAtWaypoint',
            'photo.image_topic': 'image',
            'photo.save_dir': str(tmp_path / 'photos'),
        }
    )
    status, result = stack.client.wait(stack.client.send(poses=[pose(1.0)]))
    assert (status, result.error_code) == (ABORTED, 601) and 'no image' in result.error_msg
    publisher = stack.node.create_publisher(Image, 'image', 1)
    stack.ros.wait_until(publisher.get_subscription_count)
    image = Image(height=2, width=3, step=9, encoding='rgb8', data=[255, 0, 0] * 6)
    image.header.stamp.sec = 7
    publisher.publish(image)
    stack.ros.wait_until(lambda: stack.follower._task._image is not None)
    assert stack.client.wait(stack.client.send(poses=[pose(1.0)]))[0] == SUCCEEDED
    pixels = cv2.imread(str(tmp_path / 'photos' / '0_7.png'))
    assert pixels.shape == (2, 3, 3) and tuple(pixels[0, 0]) == (0, 0, 255)


def test_it_waits_for_a_word_at_waypoints(make_stack: Any) -> None:
    """And fails if none comes in time."""
    stack = make_stack(
        **{
            'waypoint_task_executor_plugin': 'word',
            'word.plugin': 'nav2_waypoint_follower::InputAtWaypoint',
            'word.timeout': 1.0,
        }
    )
    publisher = stack.node.create_publisher(Empty, 'input_at_waypoint/input', 1)
    stack.ros.wait_until(publisher.get_subscription_count)
    handle = stack.client.send(poses=[pose(1.0)])
    stack.ros.wait_until(lambda: stack.visited)
    stack.ros.spin(0.3)
    publisher.publish(Empty())
    assert stack.client.wait(handle)[0] == SUCCEEDED
    status, result = stack.client.wait(stack.client.send(poses=[pose(1.0)]))
    assert (status, result.error_code) == (ABORTED, 601)
    assert 'within 1 s' in result.error_msg
