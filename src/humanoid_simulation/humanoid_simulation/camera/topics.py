# SPDX-License-Identifier: Apache-2.0
"""Publish the images of all cameras of a world, at a rate in simulated time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
import time

from humanoid_simulation.camera.images import PictureNoise
from humanoid_simulation.camera.methods import methods_of
from humanoid_simulation.camera.pinhole import CameraView, pinhole_of
from humanoid_simulation.camera.publisher import CameraPublisher, stamp_of
from humanoid_simulation.camera.renderer import Pictures, Renderer
from humanoid_simulation.simulator_parameters import CameraParameters
import mujoco
import numpy as np
from numpy.typing import NDArray
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

_LOOK_S = 0.05
"""Period of the checks for images and subscribers besides the ticks, which stop in a pause."""
_NANOSECONDS = 1_000_000_000
_TINY = 1e-6
"""Tolerance for rounding errors at the start of a period, in periods."""


@dataclass(frozen=True, eq=False)
class _Taken:
    """State and number of subscribers when images were taken last."""

    time_ns: int
    qpos: NDArray[np.float64]
    subscribers: int


class CameraTopics:
    """
    Publishes the images of all cameras, at a rate in simulated time, while there are subscribers.

    One process renders the images of all cameras; ticks never wait for it. In a pause, new
    subscribers get an image, and all subscribers get one when something was moved.

    Parameters
    ----------
    node
        The node that publishes.
    cameras
        The name of the camera in the model, by the namespace of its robot relative to the node:
        '' for a robot alone.
    model
        The compiled world.
    parameters : CameraParameters
        Rate, image size, frame and rendering method; at rate 0 there are no topics.
    prefix
        Prefix of the frame names.
    noise
        Standard deviations of pixels.

    Raises
    ------
    SimulationError
        The model does not have the cameras.

    """

    def __init__(
        self,
        node: Node,
        cameras: Mapping[str, str],
        model: mujoco.MjModel,
        parameters: CameraParameters,
        prefix: str = '',
        noise: PictureNoise = PictureNoise(),
    ) -> None:
        cameras = cameras if parameters.camera_rate_hz > 0.0 else {}
        width_px, height_px = parameters.camera_width_px, parameters.camera_height_px
        views = [CameraView(camera, width_px, height_px) for camera in cameras.values()]
        methods, log = methods_of(parameters.camera_renderer), node.get_logger()

        def renderer(model: mujoco.MjModel) -> Renderer:
            return Renderer(model, views, methods, log, noise=noise)

        self._make_renderer = renderer
        self._renderer = renderer(model)
        frame = f'{prefix}{parameters.camera_frame}'
        self._publishers = [
            CameraPublisher(node, _folder(robot), pinhole_of(model, view), frame)
            for robot, view in zip(cameras, views)
        ]
        self._shutter = Shutter(parameters.camera_rate_hz)
        self._state: tuple[int, mujoco.MjData] | None = None
        self._taken: _Taken | None = None
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(_LOOK_S, self._look_again, clock=steady)

    @property
    def process_id(self) -> int | None:
        """Return the process id of the render process, if it runs."""
        return self._renderer.process_id

    def tick(self, now_s: float, time_ns: int, data: mujoco.MjData) -> None:
        """
        Publish finished images, and request those that are due. Call once per control period.

        Parameters
        ----------
        now_s
            Time of a monotonic clock, in s.
        time_ns
            Simulated time of the state, in ns.
        data
            The state; it is kept, and also read between ticks while the simulation is paused.

        """
        self._state = time_ns, data
        self._publish_drawn(now_s)
        if self._shutter.is_due(time_ns):
            self._take(now_s, time_ns, data)

    def change_model(self, model: mujoco.MjModel) -> None:
        """
        Render another model from now on, with a new render process.

        Parameters
        ----------
        model
            A model that has all the cameras.

        """
        before, self._renderer = self._renderer, self._make_renderer(model)
        before.close()
        self._state = self._taken = None

    def close(self) -> None:
        """End the render process."""
        self._timer.cancel()
        self._renderer.close()

    def _look_again(self) -> None:
        """Publish and request images that cannot wait for the next tick, as in a pause."""
        now_s = time.monotonic()
        self._publish_drawn(now_s)
        if self._state is not None and self._is_missing(*self._state):
            self._take(now_s, *self._state)

    def _is_missing(self, time_ns: int, data: mujoco.MjData) -> bool:
        """Check whether subscribers lack an image that no tick will provide."""
        subscribers, taken = self._subscribers(), self._taken
        if not subscribers:
            return False
        if taken is None or subscribers > taken.subscribers:
            return True
        return taken.time_ns == time_ns and not np.array_equal(taken.qpos, data.qpos)

    def _take(self, now_s: float, time_ns: int, data: mujoco.MjData) -> None:
        """Request images if the renderer is free, and publish the camera info with them."""
        wanted = [publisher.wanted() for publisher in self._publishers]
        if any(wanted):
            self._renderer.need()
            if not self._renderer.can_draw:
                return
            self._renderer.request(data.qpos, time_ns, wanted, now_s)
        self._shutter.release(time_ns)
        self._taken = _Taken(time_ns, data.qpos.copy(), self._subscribers())
        stamp = stamp_of(time_ns)
        for publisher in self._publishers:
            publisher.publish_info(stamp)

    def _subscribers(self) -> int:
        """Count the subscribers of all cameras."""
        return sum(publisher.subscribers for publisher in self._publishers)

    def _publish_drawn(self, now_s: float) -> None:
        """Publish the images that are finished."""
        pictures = self._renderer.poll(now_s)
        if pictures is not None:
            self._publish(pictures)

    def _publish(self, pictures: Pictures) -> None:
        """Publish the images of all cameras."""
        stamp = stamp_of(pictures.time_ns)
        views = zip(pictures.wanted, pictures.colors, pictures.depths, pictures.clouds)
        for publisher, view in zip(self._publishers, views):
            publisher.publish(*view, stamp)


class Shutter:
    """
    Rate limiter for images on a time grid, so that the mean rate does not depend on the ticks.

    An image that could not be taken in time stays due until it is; those in between are skipped.

    Parameters
    ----------
    rate_hz
        Images per second of simulated time, above 0.

    """

    def __init__(self, rate_hz: float) -> None:
        self._rate_hz = rate_hz
        self._last: int | None = None

    def is_due(self, time_ns: int) -> bool:
        """
        Check whether the period that a time is in has no image yet.

        Parameters
        ----------
        time_ns
            Simulated time, in ns.

        """
        return self._period_of(time_ns) != self._last

    def release(self, time_ns: int) -> None:
        """
        Record that an image was taken.

        Parameters
        ----------
        time_ns
            Simulated time of the image, in ns.

        """
        self._last = self._period_of(time_ns)

    def _period_of(self, time_ns: int) -> int:
        """Return the index of the period that a time is in; exact at the start of periods."""
        return int(time_ns * self._rate_hz / _NANOSECONDS + _TINY)


def _folder(robot: str) -> str:
    """Return the prefix of the topic names of a robot."""
    return f'{robot}/' if robot else ''
