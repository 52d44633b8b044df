# SPDX-License-Identifier: Apache-2.0
"""Check what the cameras publish."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
import math
import time
from typing import Any

from humanoid_common.parameters import build, ParameterError
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_simulation.camera.topics import CameraTopics
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.simulator_parameters import CameraParameters
from humanoid_simulation.testing.camera_studio import ball_address, world
import numpy as np
import pytest
from sensor_msgs.msg import CameraInfo, Image, PointCloud2

SMALL = {'camera_width_px': 64, 'camera_height_px': 49, 'camera_renderer': 'rays'}


class Set:
    """The cameras of a node, and a clock that ticks when the test wants."""

    def __init__(
        self,
        ros: RosSandbox,
        cameras: Mapping[str, str],
        prefix: str = '',
        **parameters: Any,
    ) -> None:
        """Begin at time 0."""
        self._ros = ros
        self._model, self._data = world()
        self.node = ros.observer()
        given = build(CameraParameters, {**SMALL, **parameters})
        self.topics = CameraTopics(self.node, cameras, self._model, given, prefix)
        self._ticks = 0

    def collect(self, kind: Any, topic: str) -> list[Any]:
        """Collect the messages of a topic."""
        messages: list[Any] = []
        self.node.create_subscription(kind, topic, messages.append, 10)
        return messages

    def tick_until(self, predicate: Callable[[], bool], what: str) -> None:
        """Tick until the predicate holds."""

        def is_so() -> bool:
            self.tick()
            return predicate()

        self._ros.wait_until(is_so, 60.0, what)

    def wait_until(self, predicate: Callable[[], bool], what: str) -> None:
        """Wait, in a pause, until the predicate holds."""
        self._ros.wait_until(predicate, 100.0, what)

    def rest(self, duration_s: float) -> None:
        """Let the node do what it does in a pause."""
        end_s = time.monotonic() + duration_s
        self.wait_until(lambda: time.monotonic() > end_s, 'time to pass')

    def tick(self) -> None:
        """Tick once."""
        self._ticks += 1
        self.topics.tick(time.monotonic(), self.time_ns, self._data)

    def move_ball(self) -> None:
        """Put the ball elsewhere."""
        self._data.qpos[ball_address(self._model) + 2] += 0.2

    @property
    def time_ns(self) -> int:
        """Return the simulated time."""
        return self._ticks * 10_000_000


MakeSet = Callable[..., Set]


@pytest.fixture(name='make_set')
def _make_set() -> Iterator[MakeSet]:
    """Give a function that makes sets of cameras."""
    with ros_sandbox() as ros:
        made: list[Set] = []

        def make(cameras: Mapping[str, str], **parameters: Any) -> Set:
            made.append(Set(ros, cameras, **parameters))
            return made[-1]

        yield make
        for each in made:
            each.topics.close()


def stamp_ns(message: Any) -> int:
    """Return the time of a message."""
    return int(message.header.stamp.sec * 1_000_000_000 + message.header.stamp.nanosec)


def test_color(make_set: MakeSet) -> None:
    """A colour picture has all that a picture needs, and the time of its state."""
    one = make_set({'': 'eye'})
    images = one.collect(Image, 'camera/image_raw')
    one.tick_until(lambda: len(images) >= 2, 'pictures')
    image = images[0]
    assert (image.width, image.height, image.encoding, image.step) == (64, 49, 'rgb8', 192)
    assert image.header.frame_id == 'camera_optical_frame' and not image.is_bigendian
    pixels = np.frombuffer(image.data, np.uint8).reshape(49, 64, 3)
    assert pixels[5, 5] == pytest.approx([128, 130, 128], abs=3)
    assert 0 < stamp_ns(image) < stamp_ns(images[1]) <= one.time_ns


def test_depth(make_set: MakeSet) -> None:
    """A depth picture is in metres."""
    one = make_set({'': 'eye'}, prefix='my_')
    images = one.collect(Image, 'camera/depth/image_raw')
    one.tick_until(lambda: bool(images), 'a picture')
    image = images[0]
    assert image.header.frame_id == 'my_camera_optical_frame'
    assert (image.encoding, image.step) == ('32FC1', 256)
    metres = np.frombuffer(image.data, np.float32).reshape(49, 64)
    assert metres[5, 5] == pytest.approx(2.0, abs=1e-3)


def test_points(make_set: MakeSet) -> None:
    """Points are organised like the picture, and drawn without a subscriber to it."""
    one = make_set({'': 'eye'}, prefix='my_')
    clouds = one.collect(PointCloud2, 'points')
    one.tick_until(lambda: bool(clouds), 'points')
    cloud = clouds[0]
    assert cloud.header.frame_id == 'my_camera_optical_frame'
    assert (cloud.width, cloud.height, cloud.point_step, cloud.row_step) == (64, 49, 12, 768)
    assert not cloud.is_dense and not cloud.is_bigendian
    assert [(field.name, field.offset) for field in cloud.fields] == [('x', 0), ('y', 4), ('z', 8)]
    points_m = np.frombuffer(cloud.data, np.float32).reshape(49, 64, 3)
    focal_px = 24.5 / math.tan(math.radians(30.0))
    expected_m = [2.0 * (5 - 31.5) / focal_px, 2.0 * (5 - 24.0) / focal_px, 2.0]
    assert points_m[5, 5] == pytest.approx(expected_m, abs=2e-3)
    assert 0 < stamp_ns(cloud) <= one.time_ns


def test_info(make_set: MakeSet) -> None:
    """The description of the camera has the geometry and the times of its pictures."""
    one = make_set({'': 'eye'})
    infos = one.collect(CameraInfo, 'camera/camera_info')
    images = one.collect(Image, 'camera/image_raw')
    one.tick_until(lambda: bool(images) and bool(infos), 'a picture and its description')
    info = infos[0]
    focal_px = 24.5 / math.tan(math.radians(30.0))
    assert list(info.k) == pytest.approx([focal_px, 0, 31.5, 0, focal_px, 24, 0, 0, 1])
    assert list(info.p) == pytest.approx([focal_px, 0, 31.5, 0, 0, focal_px, 24, 0, 0, 0, 1, 0])
    assert list(info.r) == [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    assert info.distortion_model == 'plumb_bob' and list(info.d) == [0.0] * 5
    assert (info.width, info.height) == (64, 49)
    one.tick_until(lambda: stamp_ns(images[-1]) in map(stamp_ns, infos), 'the same time')


def test_nothing_is_drawn_for_nobody(make_set: MakeSet) -> None:
    """Without a subscriber to pictures no process is started, but the description is there."""
    one = make_set({'': 'eye'})
    infos = one.collect(CameraInfo, 'camera/camera_info')
    one.tick_until(lambda: len(infos) >= 3, 'descriptions')
    assert one.topics.process_id is None
    assert stamp_ns(infos[2]) - stamp_ns(infos[1]) == 100_000_000


def test_pause(make_set: MakeSet) -> None:
    """In a pause, new subscribers get a picture of the state, and all one of what was moved."""
    one = make_set({'': 'eye'})
    for _ in range(15):
        one.tick()
    first = one.collect(Image, 'camera/image_raw')
    one.wait_until(lambda: bool(first), 'a picture')
    second = one.collect(Image, 'camera/image_raw')
    one.wait_until(lambda: bool(second), 'a picture for the other one')
    assert stamp_ns(first[0]) == stamp_ns(second[0]) == one.time_ns
    one.move_ball()
    one.wait_until(lambda: second[-1].data != first[0].data, 'a picture of what was moved')


def test_nothing_is_drawn_twice(make_set: MakeSet) -> None:
    """In a pause in which nothing changes, no more pictures come."""
    one = make_set({'': 'eye'})
    images = one.collect(Image, 'camera/image_raw')
    one.tick_until(lambda: bool(images), 'a picture')
    one.rest(2.0)
    count = len(images)
    one.rest(0.5)
    assert len(images) == count


def test_two_robots(make_set: MakeSet) -> None:
    """The cameras of two robots publish in their namespaces, drawn by one process."""
    two = make_set({'robot1': 'eye', 'robot2': 'back_eye'})
    first = two.collect(Image, 'robot1/camera/image_raw')
    second = two.collect(Image, 'robot2/camera/image_raw')
    two.tick_until(lambda: bool(first) and bool(second), 'pictures of both')
    wall, sky = list(first[0].data[:3]), list(second[0].data[:3])
    assert wall == pytest.approx([128, 130, 128], abs=3)
    assert sky == pytest.approx([51, 102, 153], abs=3)


def test_off(make_set: MakeSet) -> None:
    """At rate 0 there are no topics."""
    one = make_set({'': 'eye'}, camera_rate_hz=0.0)
    one.tick()
    names = [name for name, _ in one.node.get_topic_names_and_types()]
    assert not [name for name in names if 'camera' in name]


def test_unknown_camera(make_set: MakeSet) -> None:
    """A camera that the model has not is refused."""
    with pytest.raises(SimulationError, match="no camera 'eyes'"):
        make_set({'': 'eyes'})


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('camera_rate_hz', -1.0),
        ('camera_rate_hz', math.nan),
        ('camera_width_px', 0),
        ('camera_height_px', 100_000),
        ('camera_renderer', 'vulkan'),
    ],
)
def test_refused_parameters(name: str, value: Any) -> None:
    """A parameter out of its range is refused, by its name."""
    with pytest.raises(ParameterError, match=name):
        build(CameraParameters, {name: value})
