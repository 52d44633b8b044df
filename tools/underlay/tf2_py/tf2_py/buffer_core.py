# SPDX-License-Identifier: Apache-2.0
"""Transform buffer, without ROS nodes."""

from __future__ import annotations

from collections.abc import Iterable
import logging
import threading
from typing import Optional, TYPE_CHECKING

from tf2_py._frame_store import FrameStore
from tf2_py.intake import Intake
from tf2_py.known_frames import FrameIntrospection, KnownFrames
from tf2_py.lookups import Lookups
from tf2_py.messages import nanoseconds, Reading, reading_of, transform_message

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped
    from rclpy.duration import Duration
    from rclpy.time import Time

_CACHE_NS = 10 * 10**9


class BufferCore(FrameIntrospection):
    """
    Buffer of the transforms of the last seconds, with lookups between any two frames.

    All methods are thread-safe.

    Parameters
    ----------
    cache_time
        The length of the buffer, as a duration; 10 s by default.

    Raises
    ------
    ValueError
        The cache time is negative.

    """

    def __init__(self, cache_time: Optional[Duration] = None) -> None:
        cache_ns = _CACHE_NS if cache_time is None else nanoseconds(cache_time)
        if cache_ns < 0:
            raise ValueError(f'The cache time must be 0 s or more, not {cache_ns / 1e9:g} s')
        self._store = FrameStore(cache_ns)
        self._lock = threading.RLock()
        super().__init__(KnownFrames(self._store, self._lock))
        self._lookups = Lookups(self._store, self._lock)
        self._intake = Intake(self._store, self._lock, self._warn)

    def set_transform(self, transform: TransformStamped, authority: str) -> None:
        """
        Insert a transform of a moving frame.

        Invalid or outdated transforms are ignored with a warning.

        Parameters
        ----------
        transform
            The pose of the child frame in the header frame, at the time of the header.
        authority
            The publisher of the transform.

        """
        self.insert_readings([reading_of(transform)], authority, is_static=False)

    def set_transform_static(self, transform: TransformStamped, authority: str) -> None:
        """
        Insert a static transform, which is valid at all times.

        Invalid transforms are ignored with a warning.

        Parameters
        ----------
        transform
            The pose of the child frame in the frame of the header.
        authority
            The publisher of the transform.

        """
        self.insert_readings([reading_of(transform)], authority, is_static=True)

    def lookup_transform_core(
        self, target_frame: str, source_frame: str, time: Time
    ) -> TransformStamped:
        """
        Look up the transform that maps data from the source frame to the target frame.

        Parameters
        ----------
        target_frame
            The frame of the result.
        source_frame
            The frame of the data.
        time
            The time of the transform; 0 is the latest time at which the whole chain is known.

        Returns
        -------
        TransformStamped
            Pose of the source frame (child) in the target frame (header), in m and as a
            quaternion.

        Raises
        ------
        TransformException
            The transform is not available; the subclass and the message state why.

        """
        time_ns, pose = self._lookups.pose(target_frame, source_frame, time)
        return transform_message(target_frame, source_frame, time_ns, pose)

    def lookup_transform_full_core(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
    ) -> TransformStamped:
        """
        Look up the transform from the source frame at one time to the target frame at another.

        Parameters
        ----------
        target_frame, target_time
            The frame of the result, and its time; 0 is the latest.
        source_frame, source_time
            The frame of the data, and its time; 0 is the latest.
        fixed_frame
            The frame that is assumed to be fixed between the two times.

        Returns
        -------
        TransformStamped
            Pose of the source frame (child) in the target frame (header), stamped with the target
            time.

        Raises
        ------
        TransformException
            The transform is not available; the subclass and the message state why.

        """
        time_ns, pose = self._lookups.pose_over_time(
            target_frame, target_time, source_frame, source_time, fixed_frame
        )
        return transform_message(target_frame, source_frame, time_ns, pose)

    def can_transform_core(
        self, target_frame: str, source_frame: str, time: Time
    ) -> tuple[bool, str]:
        """
        Check whether `lookup_transform_core` succeeds with the same arguments.

        Parameters
        ----------
        target_frame, source_frame, time
            As for `lookup_transform_core`.

        Returns
        -------
        tuple of bool and str
            Whether it succeeds, and the reason for a failure or ''.

        """
        reason = self._lookups.problem(target_frame, source_frame, time)
        return not reason, reason

    def can_transform_full_core(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
    ) -> tuple[bool, str]:
        """
        Check whether `lookup_transform_full_core` succeeds with the same arguments.

        Parameters
        ----------
        target_frame, target_time, source_frame, source_time, fixed_frame
            As for `lookup_transform_full_core`.

        Returns
        -------
        tuple of bool and str
            Whether it succeeds, and the reason for a failure or ''.

        """
        reason = self._lookups.problem_over_time(
            target_frame, target_time, source_frame, source_time, fixed_frame
        )
        return not reason, reason

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Time:
        """
        Find the latest time at which the whole chain between two frames is known.

        Parameters
        ----------
        target_frame, source_frame
            The frames.

        Returns
        -------
        Time
            The time; 0 if all transforms between the frames are static.

        Raises
        ------
        TransformException
            A frame is unknown, or the frames are in different trees.

        """
        from rclpy.time import Time

        return Time(nanoseconds=self._lookups.common_time_ns(target_frame, source_frame))

    def clear(self) -> None:
        """Remove all transforms except static ones."""
        with self._lock:
            self._store.clear()

    def insert_readings(
        self, readings: Iterable[Reading], authority: str, is_static: bool
    ) -> None:
        """
        Insert transforms given as frame names and numbers.

        Invalid or outdated transforms are ignored with a warning.

        Parameters
        ----------
        readings
            For each transform: parent frame, child frame, stamp in ns, and pose of the child.
        authority
            The publisher of the transforms.
        is_static
            Whether the transforms are valid at all times.

        """
        self._intake.insert(readings, authority, is_static)

    def _warn(self, text: str) -> None:
        """Log a warning about a transform."""
        logging.getLogger('tf2').warning(text)
