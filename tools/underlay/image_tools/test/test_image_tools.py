# SPDX-License-Identifier: Apache-2.0
"""The burger, the nodes, and what the page is told."""

from __future__ import annotations

from base64 import b64decode
from collections.abc import Callable, Iterator
import json
import time
from typing import Any

from image_tools import camera, parameters
from image_tools.burger import Burger
from image_tools.cam2image import Cam2Image
from image_tools.showimage import PARAMETERS, ShowImage
from image_transport.pixels import unpacked
import numpy as np
import pytest
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Image
from std_msgs.msg import Bool
from tf2_ros.executing import make_executor
from websockets.sync.client import connect

TIMEOUT_S = 100.0
SKY = (70, 130, 180)
PAGE = {'token': 'none'}


class Stage:
    """Runs nodes in this process."""

    def __init__(self) -> None:
        """Make an executor."""
        self.executor = make_executor()
        self.nodes: list[Node] = []

    def start(self, kind: type[Any], **values: Any) -> Any:
        """Start a node with parameters."""
        overrides = [Parameter(name, value=value) for name, value in values.items()]
        self.nodes.append(kind(parameter_overrides=overrides))
        self.executor.add_node(self.nodes[-1])
        return self.nodes[-1]

    def until(self, is_so: Callable[[], Any], what: str) -> None:
        """Work until something is so."""
        end_s = time.monotonic() + TIMEOUT_S
        while not is_so():
            assert time.monotonic() < end_s, what
            self.executor.spin_once(timeout_sec=0.02)


@pytest.fixture
def stage(ros: None) -> Iterator[Stage]:
    """Return what runs nodes, and ends them."""
    made = Stage()
    yield made
    made.executor.shutdown()
    for node in made.nodes:
        node.destroy_node()


def test_the_burger_moves_within_the_image() -> None:
    """It is in other places at other times, never outside, also in small images."""
    burger = Burger(64, 48)
    pictures = [burger.draw(0.1 * index) for index in range(60)]
    assert {picture.shape for picture in pictures} == {(48, 64, 3)}
    assert len({picture.tobytes() for picture in pictures}) == 60
    empty = np.asarray(burger.background)
    covered = [int((picture != empty).any(axis=-1).sum()) for picture in pictures]
    assert min(covered) > 0.7 * max(covered) > 50
    assert Burger(1, 1).draw(0.5).shape == (1, 1, 3)


def test_images_from_one_node_to_the_page_of_the_other(
    stage: Stage, capfd: pytest.CaptureFixture[str]
) -> None:
    """A browser gets the newest image whenever it asks; images can be mirrored."""
    source = stage.start(Cam2Image, burger_mode=True, frequency=50.0, width=80, height=60)
    sink = stage.start(ShowImage, window_name='burgers', **PAGE)
    images: list[Image] = []
    sink.create_subscription(Image, 'image', images.append, 1)
    log = ''

    def is_received() -> bool:
        nonlocal log
        log += capfd.readouterr().err
        return 'Received image #' in log and 'Publishing image #1\n' in log

    stage.until(is_received, 'no image')
    browser = connect(sink.page.urls[0].replace('http', 'ws'))
    heard: list[dict[str, Any]] = []

    def hear() -> bool:
        try:
            heard.append(json.loads(browser.recv(timeout=0.01)))
        except TimeoutError:
            return False
        return 'image' in heard[-1]

    stage.until(hear, 'the page shows nothing')
    assert heard[0] == {'title': 'burgers'}
    for _ in range(2):
        browser.send(json.dumps({'do': 'next'}))
        stage.until(hear, 'the page shows no other image')
    assert heard[-1]['about'] == '80 x 60, rgb8' and heard[-1]['fault'] == ''
    pixels = unpacked(b64decode(heard[-1]['image']))
    assert pixels.shape == (60, 80, 3)
    assert np.abs(pixels[0].mean(axis=0) - SKY).max() < 60

    flipper = stage.start(lambda **_: Node('flipper')).create_publisher(Bool, 'flip_image', 1)
    stage.until(flipper.get_subscription_count, 'nobody flips')
    flipper.publish(Bool(data=True))
    stage.until(lambda: source.is_flipped, 'it is not flipped')
    images.clear()
    stage.until(lambda: len(images) > 1, 'no images')
    number = int(images[-1].header.frame_id)
    expected = Burger(80, 60).draw((number - 1) / 50.0)[:, ::-1]
    assert bytes(images[-1].data) == expected.tobytes()
    browser.close()


def test_a_broken_image_is_a_sentence(stage: Stage) -> None:
    """The page says what is wrong with it."""
    sink = stage.start(ShowImage, **PAGE)
    sink.show(Image(width=2, height=2, encoding='rgb8', data=b'short'))
    browser = connect(sink.page.urls[0].replace('http', 'ws'))
    heard: list[dict[str, Any]] = []

    def hear() -> bool:
        try:
            heard.append(json.loads(browser.recv(timeout=0.01)))
        except TimeoutError:
            return False
        return bool(heard[-1].get('fault'))

    stage.until(hear, 'the page says nothing')
    assert heard[-1]['image'] == '' and 'The image is broken: ' in heard[-1]['fault']
    browser.close()


@pytest.mark.parametrize(
    ('kind', 'values', 'reason'),
    [
        (ShowImage, {'reliability': 'good'}, "reliability is 'good': give reliable or best_eff"),
        (ShowImage, {'depth': 0}, 'depth is 0: give 1 or more'),
        (Cam2Image, {'frequency': 0.0}, 'frequency is 0.0: give more than 0'),
        (Cam2Image, {'device_id': 77}, '(camera 77 cannot be opened|OpenCV reads).*burger_mode'),
    ],
)
def test_mistakes(ros: None, kind: type[Node], values: dict[str, Any], reason: str) -> None:
    """A sentence says what may be given instead."""
    overrides = [Parameter(name, value=value) for name, value in values.items()]
    with pytest.raises(ValueError, match=reason):
        kind(parameter_overrides=overrides)


def test_quality_of_service(stage: Stage) -> None:
    """Parameters choose it."""
    sink = stage.start(ShowImage, show_image=False, reliability='best_effort', depth=3)
    assert sink.page is None
    (subscription,) = [each for each in sink.subscriptions if each.topic_name == '/image']
    qos: QoSProfile = subscription.qos_profile
    assert (qos.reliability, qos.depth) == (ReliabilityPolicy.BEST_EFFORT, 3)


def test_help(capsys: pytest.CaptureFixture[str]) -> None:
    """It lists the parameters, as the tutorial looks them up."""
    with pytest.raises(SystemExit) as end:
        parameters.parse_options('showimage', 'Shows.', ['-h'], PARAMETERS)
    assert end.value.code == 0
    shown = capsys.readouterr().out
    assert all(name in shown for name in (*parameters.QOS, *PARAMETERS, 'token'))


def test_without_opencv(monkeypatch: pytest.MonkeyPatch) -> None:
    """A sentence says that a picture can be drawn instead."""

    def missing(_: str) -> None:
        raise ImportError('OpenCV reads cameras, and it is not installed: run `make setup`')

    monkeypatch.setattr(camera, 'opencv', missing)
    with pytest.raises(ValueError, match=r'run `make setup`\. Without a camera, draw'):
        camera.Camera(0, 320, 240)
