# SPDX-License-Identifier: Apache-2.0
"""The nodes and launch files of the tf2 tutorials."""

from __future__ import annotations

from collections.abc import Callable
import math
from pathlib import Path
from typing import Any

from geometry_msgs.msg import PointStamped, TransformStamped
from programs import Program
from publisher_probe import Probe
import pytest
from rclpy.time import Time
from tf2_ros import Buffer, TransformListener
from turtle_tf2_py.static_turtle_tf2_broadcaster import transform_from_words
from turtle_tf2_py.turtle_frames import planar_transform
from turtlesim.msg import Pose
import yaml

Start = Callable[..., Program]


@pytest.fixture(scope='module')
def buffer(probe: Probe) -> Buffer:
    """Return a buffer that listens to all transforms of the domain."""
    buffer = Buffer()
    buffer.listener = TransformListener(buffer, probe.node)
    return buffer


def found(probe: Probe, buffer: Buffer, parent: str, child: str) -> TransformStamped:
    """Wait for a transform."""
    probe.until(
        lambda: buffer.can_transform(parent, child, Time()), f'no transform {parent} -> {child}'
    )
    return buffer.lookup_transform(parent, child, Time())


def test_poses_in_the_plane() -> None:
    """They are transforms about the z axis."""
    transform = planar_transform('a', 'b', Time(seconds=3).to_msg(), 1, 2, math.pi / 2.0)
    header, rotation = transform.header, transform.transform.rotation
    assert (header.frame_id, transform.child_frame_id, header.stamp.sec) == ('a', 'b', 3)
    assert transform.transform.translation.x == 1.0 and rotation.x == 0.0
    assert (rotation.z, rotation.w) == pytest.approx((math.sqrt(0.5), math.sqrt(0.5)))


@pytest.mark.parametrize(
    ('words', 'reason'),
    [
        (['a', '1', '2'], 'There are 3 arguments instead of 7'),
        (['', *'012345'], 'The name of the frame is empty'),
        (['world', *'012345'], "The frame cannot be 'world'"),
        (['a', 'x', *'12345'], "'x' is not a number"),
        (['a', 'nan', *'12345'], "'nan' is not a number"),
    ],
)
def test_static_frames_with_mistakes(words: list[str], reason: str) -> None:
    """A sentence says which one, and how the command is used."""
    with pytest.raises(ValueError, match=f'{reason}.*\\n.*Usage: ros2 run turtle_tf2_py'):
        transform_from_words(words)


def test_static_frame(probe: Probe, buffer: Buffer, start: Start) -> None:
    """It is where the command line says."""
    start(
        'run', 'turtle_tf2_py', 'static_turtle_tf2_broadcaster', 'table', *'123', '0', '0', '1.0'
    )
    transform = found(probe, buffer, 'world', 'table').transform
    position = transform.translation
    assert (position.x, position.y, position.z) == (1.0, 2.0, 3.0)
    assert transform.rotation.z == pytest.approx(math.sin(0.5))


def test_one_turtle_follows_the_other(probe: Probe, buffer: Buffer, start: Start) -> None:
    """The second one comes to the first one, whose pose is its frame."""
    first: list[Pose] = probe.listen(Pose, '/turtle1/pose')
    second: list[Pose] = probe.listen(Pose, '/turtle2/pose')
    start('launch', 'turtle_tf2_py', 'turtle_tf2_demo.launch.py')
    probe.until(lambda: first and second, 'no turtles')

    def distance() -> float:
        return math.dist((first[-1].x, first[-1].y), (second[-1].x, second[-1].y))

    assert distance() > 2.0
    probe.until(lambda: distance() < 0.5, 'the turtle does not follow')
    frame = found(probe, buffer, 'world', 'turtle1').transform.translation
    assert (frame.x, frame.y) == pytest.approx((first[-1].x, first[-1].y))


def test_a_carrot_beside_the_turtle(probe: Probe, buffer: Buffer, start: Start) -> None:
    """The second turtle comes to the frame, two metres to the left of the first turtle."""
    second: list[Pose] = probe.listen(Pose, '/turtle2/pose')
    start('launch', 'turtle_tf2_py', 'turtle_tf2_fixed_frame_demo.launch.py')
    position = found(probe, buffer, 'turtle1', 'carrot1').transform.translation
    assert (position.x, position.y, position.z) == (0.0, 2.0, 0.0)

    def is_there() -> bool:
        if not buffer.can_transform('turtle2', 'carrot1', Time()):
            return False
        target = buffer.lookup_transform('turtle2', 'carrot1', Time()).transform.translation
        return math.hypot(target.x, target.y) < 0.5

    probe.until(lambda: second and is_there(), 'the turtle does not come to the carrot')


def test_a_carrot_that_moves(probe: Probe, start: Start) -> None:
    """It goes around the turtle."""
    places: list[tuple[float, float]] = []

    class Ear(Buffer):
        def set_transform(self, transform: TransformStamped, *rest: Any) -> None:
            position = transform.transform.translation
            if transform.child_frame_id == 'carrot1':
                places.append((position.x, position.y))
            super().set_transform(transform, *rest)

    buffer = Ear()
    listener = TransformListener(buffer, probe.node)
    start('run', 'turtle_tf2_py', 'dynamic_frame_tf2_broadcaster')
    probe.until(lambda: len({*places}) > 5, 'no carrot that moves')
    assert [math.hypot(*place) for place in places] == pytest.approx([10.0] * len(places))
    listener.unregister()


def test_points_with_a_stamp(probe: Probe, start: Start) -> None:
    """The third turtle tells where it is, in the frame of the world."""
    points: list[PointStamped] = probe.listen(PointStamped, '/turtle3/turtle_point_stamped')
    start('launch', 'turtle_tf2_py', 'turtle_tf2_sensor_message.launch.py')
    probe.until(lambda: len({each.point.x for each in points}) > 3, 'no turtle that moves')
    assert {each.header.frame_id for each in points} == {'world'}


def test_the_view_is_read() -> None:
    """It shows the frames, in the world of the turtles."""
    path = Path(__file__).parents[1] / 'rviz' / 'turtle_rviz.rviz'
    view = yaml.safe_load(path.read_text())['Visualization Manager']
    assert view['Global Options']['Fixed Frame'] == 'world'
    assert 'rviz_default_plugins/TF' in [each['Class'] for each in view['Displays']]
