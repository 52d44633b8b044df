# SPDX-License-Identifier: Apache-2.0
"""Tasks at a waypoint: wait, take a photo, wait for a message."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
import os
from typing import Any

import cv2
from nav2_util import ConfigurationError, LifecycleNode, NavigationError, Rate
from nav2_util.parameters import parameter
from nav2_util.plugins import did_you_mean
from nav2_util.timing import now_s, steady_clock
import numpy as np
import numpy.typing as npt
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image
from std_msgs.msg import Empty

__all__ = ['TASKS', 'InputAtWaypoint', 'PhotoAtWaypoint', 'WaitAtWaypoint', 'make_task']

_LOOK_HZ = 20.0


@dataclass(frozen=True)
class _WaitParameters:
    enabled: bool = parameter(True, 'Whether to wait.')
    waypoint_pause_duration: int = parameter(0, 'For how long, in ms.', low=0)


@dataclass(frozen=True)
class _PhotoParameters:
    enabled: bool = parameter(True, 'Whether to take photos.')
    image_topic: str = parameter('/camera/color/image_raw', 'Where images come from.')
    save_dir: str = parameter('/tmp/waypoint_images', 'The folder for the photos.')
    image_format: str = parameter('png', 'Their format: the extension of their names.')


@dataclass(frozen=True)
class _InputParameters:
    enabled: bool = parameter(True, 'Whether to wait for a word.')
    timeout: float = parameter(10.0, 'For how long, in s.', low=0.0)
    input_topic: str = parameter('input_at_waypoint/input', 'The topic, a std_msgs/Empty.')


class WaitAtWaypoint:
    """
    Waypoint task that waits for a duration.

    Parameters
    ----------
    node, name
        The node with the parameters of the task, and their prefix.

    """

    def __init__(self, node: LifecycleNode, name: str) -> None:
        self._node = node
        self._settings = node.parameters.declare(_WaitParameters, name)

    async def run(self, pose: Any, index: int, check: Callable[[], None]) -> None:
        """
        Wait at a waypoint for the duration of the parameter `waypoint_pause_duration`.

        Parameters
        ----------
        pose, index
            The waypoint; both are ignored.
        check
            Called every 50 ms; raises when the task has to end.

        """
        pause_s = 1e-3 * self._settings.current.waypoint_pause_duration
        if not self._settings.current.enabled or not pause_s:
            return
        end_s = now_s(self._node) + pause_s
        with Rate(self._node, _LOOK_HZ, clock=steady_clock()) as rate:
            while now_s(self._node) < end_s:
                check()
                await rate.tick()


class PhotoAtWaypoint:
    """
    Waypoint task that saves an image of a camera.

    Parameters
    ----------
    node, name
        The node with the parameters of the task, and their prefix.

    Raises
    ------
    ConfigurationError
        The folder for photos cannot be made.

    """

    def __init__(self, node: LifecycleNode, name: str) -> None:
        self._settings = node.parameters.declare(_PhotoParameters, name)
        settings = self._settings.current
        self._image: Image | None = None
        if not settings.enabled:
            return
        try:
            os.makedirs(settings.save_dir, exist_ok=True)
        except OSError as error:
            raise ConfigurationError(
                f"The folder '{settings.save_dir}' of photos cannot be made: {error.strerror}."
            ) from error
        node.create_subscription(Image, settings.image_topic, self._keep, qos_profile_sensor_data)

    def _keep(self, image: Image) -> None:
        self._image = image

    async def run(self, pose: Any, index: int, check: Callable[[], None]) -> None:
        """
        Save the newest image as `<waypoint>_<time>.<format>`.

        Parameters
        ----------
        pose
            The pose of the waypoint; ignored.
        index
            The number of the waypoint, from 0.
        check
            As for `WaitAtWaypoint.run`; ignored.

        Raises
        ------
        NavigationError
            No image was received, or it cannot be saved.

        """
        settings = self._settings.current
        if not settings.enabled:
            return
        image = self._image
        if image is None:
            raise NavigationError(f"There was no image on '{settings.image_topic}' to save.")
        name = f'{index}_{image.header.stamp.sec}.{settings.image_format}'
        path = os.path.join(settings.save_dir, name)
        try:
            pixels = _to_bgr(image.data, image.height, image.width, image.step, image.encoding)
            is_saved = cv2.imwrite(path, pixels)
        except (ValueError, cv2.error) as error:
            raise NavigationError(f"The photo '{path}' could not be saved: {error}") from error
        if not is_saved:
            raise NavigationError(f"The photo '{path}' could not be saved. Can it be written?")


class InputAtWaypoint:
    """
    Waypoint task that waits for a message to continue.

    Parameters
    ----------
    node, name
        The node with the parameters of the task, and their prefix.

    """

    def __init__(self, node: LifecycleNode, name: str) -> None:
        self._node = node
        self._settings = node.parameters.declare(_InputParameters, name)
        self._count = 0
        node.create_subscription(Empty, self._settings.current.input_topic, self._hear, 10)

    def _hear(self, _: Empty) -> None:
        self._count += 1

    async def run(self, pose: Any, index: int, check: Callable[[], None]) -> None:
        """
        Wait for a message on the topic of the parameter `input_topic`.

        Parameters
        ----------
        pose, index, check
            As for `WaitAtWaypoint.run`.

        Raises
        ------
        NavigationError
            No message was received in time.

        """
        settings, count = self._settings.current, self._count
        if not settings.enabled:
            return
        end_s = now_s(self._node) + settings.timeout
        with Rate(self._node, _LOOK_HZ, clock=steady_clock()) as rate:
            while self._count == count:
                check()
                if now_s(self._node) >= end_s:
                    raise NavigationError(
                        f"No message was received on '{settings.input_topic}' within "
                        f'{settings.timeout:g} s.'
                    )
                await rate.tick()


TASKS: dict[str, Any] = {
    'nav2_waypoint_follower::WaitAtWaypoint': WaitAtWaypoint,
    'nav2_waypoint_follower::PhotoAtWaypoint': PhotoAtWaypoint,
    'nav2_waypoint_follower::InputAtWaypoint': InputAtWaypoint,
}
"""The plugins by their official names; `/` may stand for `::`."""


def make_task(node: LifecycleNode, name: str) -> Any:
    """
    Make the task whose type is set by a parameter.

    Parameters
    ----------
    node
        The waypoint follower.
    name
        The name of the task; its type is the parameter `<name>.plugin`.

    Returns
    -------
    Any
        An object of a class of `TASKS`.

    Raises
    ------
    ConfigurationError
        There is no such type.

    """
    default = 'nav2_waypoint_follower::WaitAtWaypoint' if name == 'wait_at_waypoint' else ''
    plugin = node.parameters.declare_value(f'{name}.plugin', default, 'The type of the task.')
    kind = TASKS.get(plugin.replace('/', '::'))
    if kind is None:
        meant = did_you_mean(plugin, TASKS, 0.6) or f' There are {", ".join(TASKS)}.'
        raise ConfigurationError(f"'{name}.plugin' is '{plugin}', which is not a task.{meant}")
    return kind(node, name)


_ENCODINGS: dict[str, tuple[int, int | None]] = {
    'bgr8': (3, None),
    '8UC3': (3, None),
    'rgb8': (3, cv2.COLOR_RGB2BGR),
    'bgra8': (4, cv2.COLOR_BGRA2BGR),
    'rgba8': (4, cv2.COLOR_RGBA2BGR),
    'mono8': (1, None),
    '8UC1': (1, None),
}


def _to_bgr(data: Any, height: int, width: int, step: int, encoding: str) -> npt.NDArray[np.uint8]:
    """
    Convert an image to the pixel format that OpenCV writes.

    Parameters
    ----------
    data
        The bytes, row by row.
    height, width
        The size in pixels.
    step
        The number of bytes per row.
    encoding
        As in `sensor_msgs/Image`, such as rgb8.

    Returns
    -------
    numpy.ndarray
        (height, width, 3) blue, green, red, or (height, width) grey.

    Raises
    ------
    ValueError
        The encoding is not supported, or the data are too short.

    """
    if encoding not in _ENCODINGS:
        raise ValueError(f"images of the encoding '{encoding}' cannot be read")
    channels, conversion = _ENCODINGS[encoding]
    values = np.frombuffer(bytes(data), np.uint8)
    if step < width * channels or len(values) < height * step:
        raise ValueError('the image has too few bytes for its size')
    rows = values[: height * step].reshape(height, step)[:, : width * channels]
    pixels = rows.reshape((height, width) if channels == 1 else (height, width, channels))
    if conversion is None:
        return pixels
    return np.asarray(cv2.cvtColor(np.ascontiguousarray(pixels), conversion), np.uint8)
