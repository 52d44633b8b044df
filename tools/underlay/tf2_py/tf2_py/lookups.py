# SPDX-License-Identifier: Apache-2.0
"""Look up the pose between two frames, at one time or at two, or why there is none."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tf2_py.exceptions import TransformException
from tf2_py.messages import nanoseconds
from tf2_py.poses import chain, Pose

if TYPE_CHECKING:
    import threading

    from rclpy.time import Time
    from tf2_py._frame_store import FrameStore


class Lookups:
    """
    Lookups in the samples of a buffer; all methods are thread-safe.

    A time of 0 is the latest time at which the whole chain between two frames is known.

    Parameters
    ----------
    store
        The frames with their samples.
    lock
        Guards the store.

    """

    def __init__(self, store: FrameStore, lock: threading.RLock) -> None:
        self._store = store
        self._lock = lock

    def pose(self, target: str, source: str, time: Time) -> tuple[int, Pose]:
        """
        Compute the pose of the source frame in the target frame.

        Parameters
        ----------
        target, source
            The frames.
        time
            The time.

        Returns
        -------
        tuple of int and Pose
            The actual time in ns, and translation in m and quaternion x, y, z, w.

        Raises
        ------
        TransformException
            It is not available; the subclass and the message state why.

        """
        with self._lock:
            self._store.check('lookupTransform', target_frame=target, source_frame=source)
            return self._pose(target, source, time)

    def pose_over_time(
        self, target: str, target_time: Time, source: str, source_time: Time, fixed: str
    ) -> tuple[int, Pose]:
        """
        Compute the pose of the source frame at one time in the target frame at another.

        Parameters
        ----------
        target, target_time
            The frame of the result, and its time.
        source, source_time
            The frame of the data, and its time.
        fixed
            The frame that is assumed to be fixed between the two times.

        Returns
        -------
        tuple of int and Pose
            The actual target time in ns, and translation in m and quaternion x, y, z, w.

        Raises
        ------
        TransformException
            It is not available; the subclass and the message state why.

        """
        with self._lock:
            self._check_over_time('lookupTransform', target, source, fixed)
            time_ns, above = self._pose(target, fixed, target_time)
            _, below = self._pose(fixed, source, source_time)
        return time_ns, chain(above, below)

    def problem(self, target: str, source: str, time: Time) -> str:
        """
        State why `pose` would fail with the same arguments; '' if it would succeed.

        Parameters
        ----------
        target, source, time
            As for `pose`.

        """
        try:
            with self._lock:
                self._store.check('canTransform', target_frame=target, source_frame=source)
                self._find(target, source, time)
        except TransformException as error:
            return str(error)
        return ''

    def problem_over_time(
        self, target: str, target_time: Time, source: str, source_time: Time, fixed: str
    ) -> str:
        """
        State why `pose_over_time` would fail with the same arguments; '' if it would succeed.

        Parameters
        ----------
        target, target_time, source, source_time, fixed
            As for `pose_over_time`.

        """
        try:
            with self._lock:
                self._check_over_time('canTransform', target, source, fixed)
                self._find(target, fixed, target_time)
                self._find(fixed, source, source_time)
        except TransformException as error:
            return str(error)
        return ''

    def common_time_ns(self, target: str, source: str) -> int:
        """
        Find the latest time at which the whole chain between two frames is known.

        Parameters
        ----------
        target, source
            The frames.

        Returns
        -------
        int
            The time in ns; 0 if all transforms between the frames are static.

        Raises
        ------
        TransformException
            A frame is unknown, or the frames are in different trees.

        """
        with self._lock:
            self._store.check('getLatestCommonTime', target_frame=target, source_frame=source)
            return self._store.common_time_ns(target, source)

    def _check_over_time(self, call: str, target: str, source: str, fixed: str) -> None:
        self._store.check(call, target_frame=target, source_frame=source, fixed_frame=fixed)

    def _pose(self, target: str, source: str, time: Time) -> tuple[int, Pose]:
        """Return the actual time in ns and the pose at that time."""
        time_ns = nanoseconds(time) or self._store.common_time_ns(target, source)
        return time_ns, self._store.pose(target, source, time_ns)

    def _find(self, target: str, source: str, time: Time) -> None:
        """Raise an exception if two frames are not connected at a time."""
        time_ns = nanoseconds(time) or self._store.common_time_ns(target, source)
        self._store.route(target, source, time_ns)
