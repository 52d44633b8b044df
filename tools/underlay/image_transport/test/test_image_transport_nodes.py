# SPDX-License-Identifier: Apache-2.0
"""The programs and the Python library: topics, parameters, and no work that nobody wants."""

from __future__ import annotations

import re
import signal
import subprocess
import sys

from image_transport import (
    decode_compressed,
    encode_compressed,
    ImagePublisher,
    publishing,
    subscribe_to_images,
)
from publisher_probe import Probe, Programs
import pytest
from rclpy.qos import qos_profile_sensor_data, QoSProfile
from sensor_msgs.msg import CompressedImage, Image

MODULE = 'image_transport.republish'
RED = Image(encoding='rgb8', height=1, width=1, step=3, data=[250, 20, 10])
MONO = Image(encoding='mono8', height=1, width=2, step=2, data=[1, 200])


def says(probe: Probe, program, text: str) -> None:
    """Wait until a program has written a text."""
    probe.until(lambda: text in program.output, f'it did not say {text!r}')


def test_compresses_while_somebody_listens(probe: Probe, programs: Programs) -> None:
    """It subscribes with the first listener, obeys its parameters, and leaves with the last.

    In a namespace the names of its parameters begin with a dot.
    """
    remaps = '-r', 'in:=/camera/image_raw', '-r', 'out:=/camera/image_raw', '-r', '__ns:=/robot1'
    program = programs.start(MODULE, 'raw', 'compressed', '--ros-args', *remaps)
    says(probe, program, 'Republishing /camera/image_raw on /camera/image_raw/compressed while')
    camera = probe.node.create_publisher(Image, '/camera/image_raw', 10)
    name = '/robot1/image_republisher'
    (result,) = probe.set_parameters(name, **{'.out.compressed.format': 'gif'})
    assert result.reason == "'gif' is not supported: use jpeg or png."
    (result,) = probe.set_parameters(name, **{'.out.compressed.jpeg_quality': 101})
    assert not result.successful
    assert camera.get_subscription_count() == 0
    heard: list[CompressedImage] = []
    listener = probe.node.create_subscription(
        CompressedImage, '/camera/image_raw/compressed', heard.append, 10
    )
    probe.until(camera.get_subscription_count, 'it did not subscribe')
    probe.send_until(lambda: camera.publish(RED), lambda: heard, 'nothing was compressed')
    assert heard[-1].format == 'rgb8; jpeg compressed bgr8'
    probe.set_parameters(name, **{'.out.compressed.format': 'png'})
    heard.clear()
    probe.send_until(
        lambda: camera.publish(RED), lambda: heard and 'png' in heard[-1].format, 'no PNG'
    )
    assert decode_compressed(heard[-1]) == RED
    probe.node.destroy_subscription(listener)
    probe.until(lambda: camera.get_subscription_count() == 0, 'it did not unsubscribe')
    assert program.end(signal.SIGTERM) == 0
    assert 'Traceback' not in program.output


def test_decompresses(probe: Probe, programs: Programs) -> None:
    """It takes transports as parameters, remaps their topics, and knows remappings of old."""
    remaps = '-r', 'in/compressed:=/camera/small'
    transports = '-p', 'in_transport:=compressed', '-p', 'out_transport:=raw'
    best = '-p', 'qos_overrides./camera/small.subscription.reliability:=best_effort'
    program = programs.start(MODULE, 'out:=/picture', '--ros-args', *remaps, *transports, *best)
    heard = probe.listen(Image, '/picture')
    sender = probe.sender(CompressedImage, '/camera/small', qos_profile_sensor_data)
    probe.send_until(
        lambda: sender.publish(CompressedImage(data=b'nothing')),
        lambda: 'An image on /camera/small is skipped: 7 bytes of data are' in program.output,
        'it says nothing of broken images',
    )
    message = encode_compressed(MONO, publishing.CompressedSettings('png'))
    probe.send_until(lambda: sender.publish(message), lambda: heard, 'nothing was decompressed')
    assert heard[-1] == MONO
    assert program.end() == 0
    assert 'Traceback' not in program.output


@pytest.mark.parametrize(
    ('words', 'reason'),
    [
        (('raw', 'compresed'), "no image transport 'compresed'; .* Did you mean 'compressed'"),
        (('raw', 'raw', 'raw'), 'at most two transports .* follow --ros-args'),
        (('raw', 'raw', '--ros-args', '-r', 'out:=in'), 'receive what it publishes on /in'),
        (('raw', 'compressed', '--ros-args', '-p', 'out.compressed.png_level:=10'), 'png_level'),
    ],
)
def test_wrong_arguments(programs: Programs, words: tuple[str, ...], reason: str) -> None:
    """A mistake ends the program with a sentence."""
    program = programs.start(MODULE, *words)
    assert program.process.wait(100) == 1
    assert re.search(reason, program.output)
    assert 'Traceback' not in program.output


def test_publisher_of_all_transports(probe: Probe, monkeypatch: pytest.MonkeyPatch) -> None:
    """It compresses only for transports that somebody listens to, and tells who listens."""
    done: list[Image] = []

    def encode(image: Image, settings: publishing.CompressedSettings) -> CompressedImage:
        done.append(image)
        return encode_compressed(image, settings)

    monkeypatch.setattr(publishing, 'encode_compressed', encode)
    matches: list[int] = []
    qos = QoSProfile(depth=1)
    publisher = ImagePublisher(
        probe.node, 'image', None, qos, lambda: matches.append(publisher.subscription_count())
    )
    assert publisher.topics() == ['/image/compressed', '/image/compressedDepth', '/image']
    publisher.publish(MONO)
    raw: list[Image] = []
    subscribe_to_images(probe.node, 'image', raw.append, 'image_transport/raw', qos)
    probe.send_until(lambda: publisher.publish(MONO), lambda: raw, 'nothing raw')
    assert done == []
    compressed: list[Image] = []
    subscribe_to_images(probe.node, 'image', compressed.append, 'compressed')
    probe.send_until(lambda: publisher.publish(MONO), lambda: compressed, 'nothing compressed')
    assert done
    assert matches[-1] == 2
    names = {name.rpartition('.')[2] for name in probe.node.get_parameters_by_prefix('image')}
    assert names >= {'enable_pub_plugins', 'depth_max', 'depth_quantization', 'jpeg_quality'}


def test_list_of_transports() -> None:
    """Each transport is listed with what it does."""
    command = [sys.executable, '-m', 'image_transport.list_transports']
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    for name in ('compressed', 'compressedDepth', 'raw'):
        assert f'\nimage_transport/{name}\n' in printed
        assert f'"image_transport/{name}"' in printed
