# SPDX-License-Identifier: Apache-2.0
"""Tests of the tools: what they publish, and what they draw."""

from collections.abc import Iterator
import math
from typing import Any

from geometry_msgs.msg import PointStamped, PoseStamped, PoseWithCovarianceStamped
import numpy as np
import pytest
from rclpy.clock import Clock
from rclpy.logging import get_logger
from rclpy.qos import DurabilityPolicy
from rviz_common.context import Context
from rviz_common.frames import Frames
from rviz_common.inputs import WorkQueue
from rviz_common.page import NO_TOKEN, Page, PageSettings
from rviz_common.plugins import load_plugin, plugin_names, TOOLS
from rviz_default_plugins.tools.measure import Measure
from rviz_default_plugins.tools.publishing import heading, PublishPoint, SetGoal, SetInitialPose
from tf2_ros import Buffer

ROOT = '/world/tools/1'


class Publisher:
    """Remembers what is published."""

    def __init__(self, kind: type, topic: str, qos: Any) -> None:
        self.kind, self.topic_name, self.qos = kind, topic, qos
        self.messages: list[Any] = []
        self.publish = self.messages.append

    def get_subscription_count(self) -> int:
        """Return how many listen: nobody."""
        return 0


class FakeNode:
    """A node that only remembers its publishers."""

    def __init__(self) -> None:
        self.publishers: list[Publisher] = []

    def create_publisher(self, kind: type, topic: str, qos: Any) -> Publisher:
        """Return a publisher, or fail as rclpy does."""
        if ' ' in topic:
            raise ValueError('Invalid topic name')
        self.publishers.append(Publisher(kind, topic, qos))
        return self.publishers[-1]

    def destroy_publisher(self, publisher: Publisher) -> None:
        """Forget a publisher."""
        self.publishers.remove(publisher)

    def get_clock(self) -> Clock:
        """Return a clock."""
        return Clock()

    def get_logger(self) -> Any:
        """Return a logger."""
        return get_logger('test')


@pytest.fixture(scope='module')
def page() -> Iterator[Page]:
    """Serve a page."""
    with Page('test', PageSettings(token=NO_TOKEN)) as page:
        yield page


@pytest.fixture
def context(page: Page) -> Context:
    """Return a context with a node that publishes nothing."""
    node: Any = FakeNode()
    return Context(node, page, Frames(Buffer(), 'odom'), WorkQueue())


def begun(kind: Any, context: Context, given: Any = None) -> tuple[Any, Publisher]:
    """Return a tool, and its publisher."""
    tool = kind(context, ROOT, given)
    tool.begin()
    tool.take_up()
    node: Any = context.node
    return tool, node.publishers[0]


def yaw_of(pose: Any) -> float:
    """Return the angle of a pose about the vertical axis."""
    return 2.0 * math.atan2(pose.orientation.z, pose.orientation.w)


def test_packages_offer_the_tools() -> None:
    """They are found by the names that files have."""
    assert load_plugin(TOOLS, 'rviz_default_plugins/SetGoal') is SetGoal
    assert {kind.CLASS for kind in (Measure, PublishPoint, SetGoal, SetInitialPose)} <= set(
        plugin_names(TOOLS)
    )


def test_a_goal_is_where_the_drag_begins(context: Context) -> None:
    """The drag gives the direction; the message is published once, in the fixed frame."""
    tool, publisher = begun(SetGoal, context)
    assert (publisher.kind, publisher.topic_name) == (PoseStamped, 'goal_pose')
    assert not tool.drag((1.0, 2.0, 0.0), (1.0, 2.5, 0.0), False)
    assert not tool.drag((1.0, 2.0, 0.0), (0.0, 2.0, 0.0), False)
    assert publisher.messages == []
    assert tool.drag((1.0, 2.0, 0.0), (1.0, 1.0, 0.0), True)
    (message,) = publisher.messages
    assert message.header.frame_id == 'odom' and message.header.stamp.sec > 0
    assert (message.pose.position.x, message.pose.position.y) == (1.0, 2.0)
    assert yaw_of(message.pose) == pytest.approx(-math.pi / 2)


def test_the_arrow_follows_the_pointer(context: Context) -> None:
    """It is there from the drag until the tool is laid down."""
    tool, _ = begun(SetGoal, context)
    tool.drag((1.0, 2.0, 0.0), (1.0, 3.0, 0.0), False)
    arrow: Any = context.scene.get_handle_by_name(ROOT)
    assert np.allclose(arrow.points[0, :, :2], [[1, 2], [1, 2.7]]) and arrow.visible
    tool.lay_down()
    assert not arrow.visible


def test_a_click_is_a_pose_along_x(context: Context) -> None:
    """Who does not drag gets the direction that RViz gives."""
    tool, publisher = begun(SetGoal, context)
    assert tool.click((1.0, 2.0, 0.0))
    assert yaw_of(publisher.messages[0].pose) == 0.0


def test_the_topic_and_its_quality_are_from_the_file(context: Context) -> None:
    """As the file says, the messages are kept for those who come later."""
    given = {
        'Class': SetGoal.CLASS,
        'Topic': {'Value': '/robot1/goal', 'Durability Policy': 'Transient Local', 'Depth': 1},
    }
    tool, publisher = begun(SetGoal, context, given)
    assert publisher.topic_name == '/robot1/goal'
    assert publisher.qos.durability is DurabilityPolicy.TRANSIENT_LOCAL
    assert tool.to_file() == given
    node: Any = context.node
    tool.close()
    assert node.publishers == []


def test_an_estimate_says_how_sure_it_is(context: Context) -> None:
    """The variances are those of the file, on the diagonal of the matrix."""
    tool, publisher = begun(SetInitialPose, context, {'Class': 'x', 'Covariance y': 0.5})
    assert (publisher.kind, publisher.topic_name) == (PoseWithCovarianceStamped, 'initialpose')
    tool.drag((1.0, 2.0, 0.0), (2.0, 2.0, 0.0), True)
    covariance = publisher.messages[0].pose.covariance
    expected = np.zeros(36)
    expected[[0, 7, 35]] = 0.25, 0.5, 0.06853891909122467
    assert np.allclose(covariance, expected)


@pytest.mark.parametrize('is_single', [True, False])
def test_a_point_is_published(context: Context, is_single: bool) -> None:
    """The file says if the tool is done after a click."""
    tool, publisher = begun(PublishPoint, context, {'Class': 'x', 'Single click': is_single})
    assert tool.click((1.0, 2.0, 0.0)) is is_single
    assert tool.drag((0.0, 0.0, 0.0), (3.0, 2.0, 0.0), False) is False
    (message,) = publisher.messages
    assert isinstance(message, PointStamped) and publisher.topic_name == 'clicked_point'
    assert (message.point.x, message.point.y, message.header.frame_id) == (1.0, 2.0, 'odom')


def test_an_impossible_topic_is_said(context: Context, capfd: Any) -> None:
    """Nothing else is harmed, and using the tool says so again."""
    tool = SetGoal(context, ROOT, {'Topic': {'Value': 'a b'}})
    tool.begin()
    tool.click((0.0, 0.0, 0.0))
    tool.close()
    said = capfd.readouterr().err
    assert "cannot publish to 'a b': Invalid topic name" in said
    assert 'has no topic to publish to' in said


def test_measuring_takes_two_points(context: Context) -> None:
    """The distance stands in the middle; a third click begins anew."""
    tool = Measure(context, ROOT)
    tool.click((0.0, 0.0, 0.0))
    assert context.scene.get_handle_by_name(f'{ROOT}/text') is None
    tool.click((3.0, 4.0, 0.0))
    label: Any = context.scene.get_handle_by_name(f'{ROOT}/text')
    assert label.text == '5.000 m'
    assert np.allclose(label.position, (1.5, 2.0, 0.02))
    tool.click((1.0, 1.0, 0.0))
    assert context.scene.get_handle_by_name(f'{ROOT}/text') is None
    tool.drag((0.0, 0.0, 0.0), (0.0, 1.0, 0.0), False)
    label = context.scene.get_handle_by_name(f'{ROOT}/text')
    assert label.text == '1.000 m'
    tool.lay_down()
    assert context.scene.get_handle_by_name(f'{ROOT}/line') is None


def test_headings_go_from_x_to_y() -> None:
    """The angle is that of mathematics; of no way at all, it is 0."""
    assert heading((0, 0, 0), (0, 1, 0)) == pytest.approx(math.pi / 2)
    assert heading((1, 1, 0), (1, 1, 0)) == 0.0
