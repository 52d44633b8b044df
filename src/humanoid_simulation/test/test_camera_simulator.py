# SPDX-License-Identifier: Apache-2.0
"""Check the camera of a simulator that runs."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import os
import signal
from typing import Any

from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_simulation.simulator import Simulator
import numpy as np
import pytest
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Image

ROOM = {'scene': 'room', 'camera_renderer': 'rays', 'camera_width_px': 64, 'camera_height_px': 48}


@pytest.fixture(name='ros')
def _ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


def collect(ros: RosSandbox, kind: Any, topic: str) -> list[Any]:
    """Collect the messages of a topic."""
    messages: list[Any] = []
    ros.observer().create_subscription(kind, topic, messages.append, 10)
    return messages


def wait_for(ros: RosSandbox, predicate: Callable[[], bool], what: str) -> None:
    """Wait with patience: a process has to start."""
    ros.wait_until(predicate, 100.0, what)


def test_paused_from_the_start(ros: RosSandbox) -> None:
    """Before the first step, the camera already shows the room, in its frame."""
    ros.start(Simulator, {**ROOM, 'start_paused': True, 'prefix': 'my_'})
    colors = collect(ros, Image, 'camera/image_raw')
    depths = collect(ros, Image, 'camera/depth/image_raw')
    wait_for(ros, lambda: bool(colors) and bool(depths), 'pictures')
    assert colors[0].header.frame_id == 'my_camera_optical_frame'
    assert colors[0].header.stamp.sec == colors[0].header.stamp.nanosec == 0
    metres = np.frombuffer(depths[0].data, np.float32).reshape(48, 64)
    # The wall in front is at 4 m, the camera some 0.1 m before the robot, which is at 0; above
    # the wall is the sky.
    assert metres[26, 32] == pytest.approx(3.9, abs=0.1)
    assert np.isposinf(metres[0]).all()


def test_two_robots_see_each_their_own(ros: RosSandbox) -> None:
    """Each robot publishes in its namespace what it sees from where it is."""
    ros.start(Simulator, {**ROOM, 'start_paused': True, 'robots': ['left', 'right']})
    left = collect(ros, Image, 'left/camera/image_raw')
    right = collect(ros, Image, 'right/camera/image_raw')
    wait_for(ros, lambda: bool(left) and bool(right), 'pictures of both')
    assert left[0].data != right[0].data
    assert left[0].header.stamp == right[0].header.stamp


def test_physics_goes_on_without_the_process_that_draws(ros: RosSandbox) -> None:
    """While the process that draws hangs, time passes; when it is killed, another one draws."""
    node = ros.start(Simulator, ROOM)
    clock = collect(ros, Clock, '/clock')
    images = collect(ros, Image, 'camera/image_raw')
    wait_for(ros, lambda: bool(images), 'a picture')
    process = node.camera_process_id
    os.kill(process, signal.SIGSTOP)
    before_s = clock[-1].clock.sec
    wait_for(ros, lambda: clock[-1].clock.sec >= before_s + 2, 'time to pass')
    os.kill(process, signal.SIGKILL)
    count = len(images)
    wait_for(ros, lambda: len(images) > count + 1, 'pictures by another process')
    assert node.camera_process_id != process
