# SPDX-License-Identifier: Apache-2.0
"""The queue of scans that wait for their transforms."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
import math
from typing import Any

from nav2_util.geometry import yaw_of
import numpy as np
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from slam_toolbox_py.poses import FloatArray, rotation
from slam_toolbox_py.scans import Scan, take_scan
from tf2_ros import TransformException

__all__ = ['ScanIntake', 'TimedScan', 'project']

_QUEUE = 100
_PATIENCE_S = 1.0
_FOREVER = 1000


@dataclass(frozen=True)
class TimedScan:
    """A scan with the pose of the robot in the odometry frame."""

    message: LaserScan
    odometry: FloatArray
    """(3,) pose of the base in the odometry frame."""
    sensor: Any
    """The `geometry_msgs/Transform` of the scanner in the odometry frame."""
    stamp_s: float

    @property
    def tilt_rad(self) -> float:
        """The angle between the scanner's axis and the vertical, whichever side is up."""
        q = self.sensor.rotation
        return math.acos(min(1.0, abs(1.0 - 2.0 * (q.x * q.x + q.y * q.y))))


class ScanIntake:
    """
    Queue of scans that wait until their transforms are available.

    Parameters
    ----------
    buffer
        The transforms.
    odom_frame, base_frame
        The frames of odometry and of the robot.
    keeps_all
        Whether every scan is returned, in order, instead of the newest ones only.
    warn
        Called with a message when scans are dropped.

    """

    def __init__(
        self,
        buffer: Any,
        odom_frame: str,
        base_frame: str,
        keeps_all: bool,
        warn: Callable[[str], None],
    ) -> None:
        self._buffer, self._odom, self._base = buffer, odom_frame, base_frame
        self._keeps_all, self._warn = keeps_all, warn
        self._waiting: deque[LaserScan] = deque(maxlen=_FOREVER if keeps_all else _QUEUE)

    def offer(self, message: LaserScan) -> None:
        """
        Queue a scan until its transforms are available.

        Parameters
        ----------
        message
            The scan; the oldest one is dropped if the queue is full.

        """
        self._waiting.append(message)

    def clear(self) -> int:
        """Drop all queued scans; return their number."""
        count = len(self._waiting)
        self._waiting.clear()
        return count

    def next_scan(self, now_s: float, timeout_s: float) -> TimedScan | None:
        """
        Return the next scan whose transforms are available, and drop the scans before it.

        Parameters
        ----------
        now_s
            The time of the node's clock, in s.
        timeout_s
            Scans that have waited longer for their transforms are dropped.

        """
        count = len(self._waiting)
        for i in [0] if self._keeps_all else sorted({count - 1, count - 2, 0}, reverse=True):
            if not 0 <= i < count:
                break
            message = self._waiting[i]
            try:
                timed = self.located(message)
            except TransformException as error:
                stamp_s = _seconds(message)
                if i == 0 and abs(now_s - stamp_s) > timeout_s + _PATIENCE_S:
                    self._drop(i, stamp_s, error)
                    return None
                continue
            for _ in range(i + 1):
                self._waiting.popleft()
            return timed
        return None

    def located(self, message: LaserScan) -> TimedScan:
        """
        Look up the poses of the robot and the scanner at the time of a scan.

        Parameters
        ----------
        message
            The scan.

        Returns
        -------
        TimedScan
            The scan with both poses in the odometry frame.

        Raises
        ------
        TransformException
            The transforms are not available, or not yet.

        """
        found = self._look_up(self._odom, self._base, message)
        odometry = np.array([found.translation.x, found.translation.y, yaw_of(found.rotation)])
        sensor = self._look_up(self._odom, message.header.frame_id, message)
        return TimedScan(message, odometry, sensor, _seconds(message))

    def _look_up(self, target: str, source: str, message: LaserScan) -> Any:
        time = Time.from_msg(message.header.stamp)
        return self._buffer.lookup_transform(target, source, time).transform

    def _drop(self, index: int, stamp_s: float, error: Exception) -> None:
        del self._waiting[index]
        self._warn(
            f"The scan of {stamp_s:.2f} s was dropped: no transform of '{self._base}' or the "
            f"scanner in '{self._odom}' at that time. {error} Is odometry published as a "
            'transform, and are scans stamped by the same clock?'
        )


def project(timed: TimedScan, range_min_m: float, range_max_m: float) -> Scan:
    """
    Project a scan to the ground, using the tilt of the scanner in the odometry frame.

    Parameters
    ----------
    timed
        The scan.
    range_min_m, range_max_m
        The limits of the ranges, unless those of the scanner are narrower.

    """
    message, sensor = timed.message, timed.sensor
    level = np.eye(3)
    level[:2, :2] = rotation(timed.odometry[2]).T
    at = np.array([sensor.translation.x, sensor.translation.y, sensor.translation.z])
    at[:2] -= timed.odometry[:2]
    ranges = np.array(message.ranges, dtype=float)
    angles = message.angle_min + message.angle_increment * np.arange(len(ranges))
    # Ranges beyond the scanner's maximum are not measurements.
    ranges[ranges >= message.range_max] = math.nan
    low = max(range_min_m, message.range_min)
    turn = level @ _matrix(sensor.rotation)
    return take_scan(ranges, angles, turn, level @ at, low, range_max_m)


def _seconds(message: LaserScan) -> float:
    return float(message.header.stamp.sec) + 1e-9 * float(message.header.stamp.nanosec)


def _matrix(rotation_: Any) -> FloatArray:
    """Return the (3, 3) rotation matrix of a quaternion."""
    x, y, z, w = rotation_.x, rotation_.y, rotation_.z, rotation_.w
    return np.array(
        [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
        ]
    )
