# SPDX-License-Identifier: Apache-2.0
"""Queue of scans that wait for the transforms of their laser and of the robot at their time."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
import time
from typing import Any, NamedTuple

from nav2_amcl.conversions import rotation_and_translation
from nav2_amcl.occupancy_map import FloatArray
from nav2_util.geometry import Pose2D, yaw_of
from nav2_util.transforms import Transforms
from rclpy.time import Time
from tf2_ros import TransformException

__all__ = ['LocatedScan', 'ScanQueue']

_LONGEST = 10
_TOO_LATE_NS = 1_000_000_000
_PATIENCE_S = 1.0


class LocatedScan(NamedTuple):
    """A scan, the pose of the laser in odometry (rotation, translation), and that of the base."""

    message: Any
    rotation: FloatArray
    translation: FloatArray
    odom: Pose2D


class ScanQueue:
    """
    Queue that passes scans on in order, each as soon as transforms at its time are available.

    It drops the oldest when more than ten wait, and those that are a second older than a newer
    one.

    Parameters
    ----------
    transforms
        The transforms of the process.
    odom_frame, base_frame
        The frames of odometry and of the robot.
    take
        Called with each scan.

    """

    def __init__(
        self,
        transforms: Transforms,
        odom_frame: str,
        base_frame: str,
        take: Callable[[LocatedScan], None],
    ) -> None:
        self._transforms, self._take = transforms, take
        self._odom_frame, self._base_frame = odom_frame, base_frame
        self._waiting: deque[Any] = deque(maxlen=_LONGEST)
        self._future: Any = None
        self._is_working = False
        self._problem = ''
        self._moved_on_s = time.monotonic()

    @property
    def problem(self) -> str:
        """Describe the transform that has been missing for 1 s; empty while scans pass."""
        return self._problem if time.monotonic() - self._moved_on_s > _PATIENCE_S else ''

    def add(self, message: Any) -> None:
        """
        Add a scan to the queue, and pass on those whose transforms are available.

        Parameters
        ----------
        message
            A `sensor_msgs/LaserScan`; the oldest one is dropped if ten wait already.

        """
        if len(self._waiting) == _LONGEST:
            self._give_up()
        self._waiting.append(message)
        self._work()

    def clear(self) -> None:
        """Drop all scans."""
        self._waiting.clear()
        self._give_up()
        self._move_on()

    def _move_on(self) -> None:
        self._problem, self._moved_on_s = '', time.monotonic()

    def _give_up(self) -> None:
        """Cancel waiting for the transforms of the oldest scan."""
        if self._future is not None:
            self._future.cancel()
            self._future = None

    def _work(self) -> None:
        """Pass on the scans that are ready, unless already doing so, as in a future's callback."""
        if self._is_working:
            return
        self._is_working = True
        try:
            while self._waiting and self._hand_on(self._waiting[0]):
                pass
        finally:
            self._is_working = False

    def _hand_on(self, message: Any) -> bool:
        """Pass on or drop the oldest scan; return False if it has to wait."""
        stamp = Time.from_msg(message.header.stamp)
        frame = message.header.frame_id
        look_up = self._transforms.buffer.lookup_transform_core
        wanted = frame
        try:
            laser = look_up(self._odom_frame, frame, stamp)
            wanted = self._base_frame
            base = look_up(self._odom_frame, wanted, stamp).transform
        except TransformException as error:
            self._problem = str(error)
            newest = Time.from_msg(self._waiting[-1].header.stamp)
            if abs(newest.nanoseconds - stamp.nanoseconds) > _TOO_LATE_NS:
                self._give_up()
                self._waiting.popleft()
                return True
            self._wait_for(wanted, stamp)
            return False
        self._give_up()
        self._waiting.popleft()
        self._move_on()
        odom = Pose2D(base.translation.x, base.translation.y, yaw_of(base.rotation))
        self._take(LocatedScan(message, *rotation_and_translation(laser), odom))
        return True

    def _wait_for(self, frame: str, stamp: Time) -> None:
        if self._future is not None and not self._future.done():
            return
        self._future = self._transforms.buffer.wait_for_transform_async(
            self._odom_frame, frame, stamp
        )
        self._future.add_done_callback(self._go_on)

    def _go_on(self, future: Any) -> None:
        if not future.cancelled():
            self._work()
