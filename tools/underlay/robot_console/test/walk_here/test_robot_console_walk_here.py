# SPDX-License-Identifier: Apache-2.0
"""The tool sends a robot without dynamics to clicked places."""

from __future__ import annotations

from collections.abc import Iterator
import json
import math
from typing import Any

from control_msgs.action import FollowJointTrajectory
from geometry_msgs.msg import Twist
from live_world import live_world, LiveWorld
from nav_msgs.msg import Odometry
from obstacles import obstacles
import pytest
from rclpy.action import ActionServer
from robot_console.walk_here import walk_here, walk_session
from robot_console.walk_here.walk_here import WalkHere
from rviz_common.context import Context
from rviz_common.frames import Frames
from tf2_ros import Buffer
from websockets.sync.client import connect

HIDE = """
Object.defineProperty(document, 'hidden', { value: true });
document.dispatchEvent(new Event('visibilitychange'));
"""
TICK_S, PERIOD_S = 0.1, 0.02
"""The robot's time goes faster than that of the test."""


class Walker:
    """A robot that follows its velocity at once, and publishes its odometry."""

    def __init__(self, node: Any) -> None:
        """Stand at the origin."""
        self.x_m = self.y_m = self.yaw_rad = self.time_s = 0.0
        self.commands: list[Twist] = []
        node.create_subscription(Twist, 'cmd_vel', self.commands.append, 10)
        self._publisher = node.create_publisher(Odometry, 'odom', 5)
        node.create_timer(PERIOD_S, self._tick)

    def _tick(self) -> None:
        if self.commands:
            command = self.commands[-1]
            self.yaw_rad += TICK_S * command.angular.z
            self.x_m += TICK_S * command.linear.x * math.cos(self.yaw_rad)
            self.y_m += TICK_S * command.linear.x * math.sin(self.yaw_rad)
        self.time_s += TICK_S
        message = Odometry()
        message.header.frame_id = 'odom'
        message.header.stamp.sec = int(self.time_s)
        message.header.stamp.nanosec = int(self.time_s % 1.0 * 1e9)
        message.pose.pose.position.x, message.pose.pose.position.y = self.x_m, self.y_m
        turn = message.pose.pose.orientation
        turn.z, turn.w = math.sin(self.yaw_rad / 2.0), math.cos(self.yaw_rad / 2.0)
        self._publisher.publish(message)


@pytest.fixture
def world() -> Iterator[LiveWorld]:
    """Return a page and a robot."""
    with live_world() as world:
        yield world


@pytest.fixture
def tool(patience: None, world: LiveWorld, monkeypatch: pytest.MonkeyPatch) -> Iterator[WalkHere]:
    """Return the tool, activated; it is patient with a machine that is busy."""
    for module, name in (
        (walk_session, 'STALE_S'),
        (walk_here, 'STALE_S'),
        (walk_session, 'TAKE_S'),
    ):
        monkeypatch.setattr(module, name, 100.0)
    frames = Frames(Buffer(), 'odom')
    context = Context(world.node, world.page, frames, world.context.queue)
    tool = WalkHere(context, '/world/tools/0', {'Namespace': 'robot1'})
    tool.begin()
    tool.take_up()
    yield tool
    tool.close()
    assert list(world.node.subscriptions) == _of_link(world)


def _of_link(world: LiveWorld) -> list[Any]:
    """Return the subscriptions of the link to the robot, which stay."""
    names = ('/robot1/emergency_stop', '/robot1/stop_state')
    return [each for each in world.node.subscriptions if each.topic_name in names]


class Page:
    """The page of a person."""

    def __init__(self, world: LiveWorld, key: str) -> None:
        """Connect."""
        self._connection = connect(f'ws://127.0.0.1:{world.page.port}/walk_here/robot1?me={key}')

    def ask(self, **message: Any) -> dict[str, Any]:
        """Ask for something, and return the state."""
        self._connection.send(json.dumps(message))
        state: dict[str, Any] = json.loads(self._connection.recv(60.0))
        return state


def test_it_walks_there(world: LiveWorld, tool: WalkHere) -> None:
    """A click and a drag end where they are, with the heading of the drag."""
    walker, page = Walker(world.robot), Page(world, 'ann')
    for x_m, y_m, end in ((1.0, 0.5, None), (0.5, 1.0, (0.5, 2.0, 0.0))):
        tool.take_up()
        world.wait_until(lambda: tool._now is not None, 'no odometry')
        place = (x_m, y_m, 0.0)
        assert tool.click(place) if end is None else tool.drag(place, end, True)
        tool.lay_down()
        state = page.ask(do='beat')
        goal = state['goal']
        assert state['waiting'] == goal['number'] and not goal['text']

        def has_ended(number: int = goal['number']) -> bool:
            return bool(page.ask(do='walk', number=number)['goal']['text'])

        world.wait_until(has_ended, 'it does not arrive')
        assert page.ask(do='beat')['goal']['text'] == 'Arrived.'
        assert math.hypot(walker.x_m - x_m, walker.y_m - y_m) < 0.15
        world.wait_until(lambda: walker.commands[-1] == Twist(), 'no zero')
        world.wait_until(lambda: tool._now is None, 'it still listens')
    assert abs(math.remainder(walker.yaw_rad - math.pi / 2.0, math.tau)) < 0.2


def test_nobody_takes_the_click(
    world: LiveWorld, tool: WalkHere, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Then the odometry is not subscribed any more, though no page is open."""
    Walker(world.robot)
    world.wait_until(lambda: tool._now is not None, 'no odometry')
    tool.click((1.0, 0.0, 0.0))
    tool.lay_down()
    assert tool._odometry is not None
    monkeypatch.setattr(walk_session, 'TAKE_S', -1.0)
    world.wait_until(lambda: tool._odometry is None, 'it still listens')


def test_it_refuses(world: LiveWorld, tool: WalkHere) -> None:
    """Without odometry nobody knows where the robot is; with navigation, that knows the way."""
    page = Page(world, 'ann')
    tool.click((1.0, 0.0, 0.0))
    assert page.ask(do='beat')['goal']['text'] == (
        "There is no odometry on '/robot1/odom', so nobody knows where the robot is."
    )
    ActionServer(world.robot, FollowJointTrajectory, 'navigate_to_pose', lambda handle: None)
    Walker(world.robot)
    name = '/robot1/navigate_to_pose/_action/send_goal'
    world.wait_until(lambda: world.node.count_services(name) > 0, 'no navigation')
    tool.click((1.0, 0.0, 0.0))
    assert 'Use the tool 2D Goal Pose' in page.ask(do='beat')['goal']['text']


def test_it_stays_active_when_a_property_changes(world: LiveWorld, tool: WalkHere) -> None:
    """It has the new topic, and finds out where the robot is."""
    tool.values['Odometry Topic'] = '/robot1/odom'
    tool.on_change('Odometry Topic')
    Walker(world.robot)
    world.wait_until(lambda: tool._now is not None, 'no odometry')
    tool.lay_down()
    tool.on_change('Odometry Topic')
    assert tool._odometry is None, 'nobody wants to walk'


def test_a_robot_has_one_such_tool(world: LiveWorld, tool: WalkHere, capfd: Any) -> None:
    """A second one says so, and has nothing that would be left behind."""
    before = [*world.node.subscriptions], [*world.node.publishers]
    other = WalkHere(tool.context, '/world/tools/1', {'Namespace': 'robot1'})
    other.begin()
    assert ([*world.node.subscriptions], [*world.node.publishers]) == before
    assert "This robot already has the page '/walk_here/robot1'." in capfd.readouterr().err
    other.close()
    other.take_up()
    other.lay_down()
    assert [*world.node.subscriptions] == before[0]


def test_in_a_browser(patience: None, world: LiveWorld, tool: WalkHere, open_tab: Any) -> None:
    """The page in which somebody clicks walks, elsewhere too, until it is stopped or hidden."""
    walker, other, tab = Walker(world.robot), open_tab(360, 100), open_tab(360, 100)
    for browser, each in enumerate((other, tab)):
        each.add_init_script(f'window.rvizViewer = {browser}')
        each.goto(f'http://127.0.0.1:{world.page.port}/walk_here/robot1')
        assert each.locator('#row').is_hidden()
    tool.browser = 1
    world.wait_until(lambda: tool._now is not None, 'no odometry')
    tool.click((100.0, 0.0, 0.0))

    def is_walking() -> bool:
        return 'm to go' in tab.locator('#what').text_content()

    other.mouse.click(5, 90)
    world.wait_until(is_walking, 'no walk')
    world.wait_until(lambda: '(' in other.locator('#what').text_content(), 'not told elsewhere')
    world.wait_until(lambda: walker.x_m > 0.1, 'it does not walk')
    tool.click((0.0, 1000.0, 0.0))
    world.wait_until(lambda: walker.y_m > 0.5, 'it does not walk to the other place')
    tab.get_by_role('button', name='Stop walking').click()
    world.wait_until(lambda: tab.locator('#what').text_content() == 'Stopped.', 'no stop')
    world.wait_until(lambda: walker.commands[-1] == Twist(), 'no zero')
    tab.get_by_role('button', name='Close').click()
    world.wait_until(lambda: tab.locator('#row').is_hidden(), 'still shown')
    tool.click((100.0, 0.0, 0.0))
    world.wait_until(is_walking, 'no second walk')
    tab.evaluate(HIDE)
    world.wait_until(lambda: tab.locator('#what').text_content() == 'Stopped.', 'it walks on')
    world.wait_until(lambda: walker.commands[-1] == Twist(), 'no second zero')
    assert obstacles(tab) == []
