# SPDX-License-Identifier: Apache-2.0
"""Transform buffer of a node."""

from __future__ import annotations

from contextlib import suppress
from functools import partial
from typing import Any, Optional, TYPE_CHECKING, Union
from weakref import finalize, ref

from rclpy.clock import ClockChange, JumpThreshold
from rclpy.duration import Duration
from rclpy.exceptions import InvalidHandle
from rclpy.logging import get_logger
from tf2_py.intake import Complaints
from tf2_ros._waiting import Question, WaitingBuffer
from tf2_ros.buffer_interface import BufferInterface

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped
    from rclpy.node import Node
    from rclpy.time import Time

Result = Union[bool, tuple[bool, str]]

QUIET_S = 60.0
"""Period between warnings: with two simulators, each `/clock` message is a time jump."""


def _tell_of_jump(buffer: ref[Buffer], time_jump: Any) -> None:
    """Forward a time jump to a buffer, unless it has been garbage collected."""
    told = buffer()
    if told is not None:
        told.time_jump_callback(time_jump)


def _end(jumps: Any) -> None:
    """Unregister a jump callback; its clock may have been destroyed already."""
    with suppress(InvalidHandle):
        jumps.unregister()


class Buffer(WaitingBuffer, BufferInterface):
    """
    Buffer whose lookups wait up to a timeout, and which is cleared when time jumps back.

    Parameters
    ----------
    cache_time
        The length of the buffer, as a duration; 10 s by default.
    node
        The node that offers the service `tf2_frames` and whose clock is monitored; none by
        default.

    Raises
    ------
    ValueError
        The cache time is negative.

    """

    def __init__(self, cache_time: Optional[Duration] = None, node: Optional[Node] = None) -> None:
        WaitingBuffer.__init__(self, cache_time)
        BufferInterface.__init__(self)
        self._jump_complaints = Complaints(self._warn, silence_s=QUIET_S)
        if node is not None:
            from tf2_msgs.srv import FrameGraph

            self.follow_clock_of(node)
            self._service = node.create_service(FrameGraph, 'tf2_frames', self._answer)

    def follow_clock_of(self, node: Node) -> None:
        """
        Clear the buffer when the clock of a node jumps back.

        Threads also stop waiting when the context of the node is shut down. Only the first call
        has an effect.

        Parameters
        ----------
        node
            The node whose clock and context are monitored.

        """
        if self._node is not None:
            return
        self._node = node
        threshold = JumpThreshold(
            min_forward=None, min_backward=Duration(nanoseconds=-1), on_clock_change=True
        )
        # rcl stores the address of the handle, so the callback must be unregistered before the
        # handle is destroyed; and the handle must not keep the buffer alive.
        myself = ref(self)
        jumps = node.get_clock().create_jump_callback(
            threshold, post_callback=partial(_tell_of_jump, myself)
        )
        finalize(self, _end, jumps)

    def time_jump_callback(self, time_jump: Any) -> None:
        """
        Clear all transforms except static ones after a time jump, and log a warning.

        Parameters
        ----------
        time_jump
            The `rclpy.clock.TimeJump`.

        """
        kept_clock = (ClockChange.ROS_TIME_NO_CHANGE, ClockChange.SYSTEM_TIME_NO_CHANGE)
        is_back = time_jump.clock_change in kept_clock
        what = 'jump back in time' if is_back else 'change between system and simulated time'
        self._jump_complaints.add(f'Detected {what}. Clearing TF buffer.', what)
        self.clear()

    def lookup_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time,
        timeout: Duration = Duration(),
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
        timeout
            The maximum time to wait for it, in wall clock time; by default no wait.

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
        arguments = (target_frame, source_frame, time)
        question = Question(self.can_transform_core, arguments)
        return self._look_up(partial(self.lookup_transform_core, *arguments), question, timeout)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration = Duration(),
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
        timeout
            The maximum time to wait for it, in wall clock time; by default no wait.

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
        arguments = (target_frame, target_time, source_frame, source_time, fixed_frame)
        question = Question(self.can_transform_full_core, arguments)
        look_up = partial(self.lookup_transform_full_core, *arguments)
        return self._look_up(look_up, question, timeout)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time,
        timeout: Duration = Duration(),
        return_debug_tuple: bool = False,
    ) -> Result:
        """
        Check whether `lookup_transform` succeeds with the same arguments.

        Parameters
        ----------
        target_frame, source_frame, time, timeout
            As for `lookup_transform`.
        return_debug_tuple
            Whether to also return the reason for a failure.

        Returns
        -------
        bool or tuple of bool and str
            Whether it succeeds; with `return_debug_tuple`, also the reason for a failure or ''.

        """
        arguments = (target_frame, source_frame, time)
        result = self._wait(Question(self.can_transform_core, arguments), timeout)
        return result if return_debug_tuple else result[0]

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration = Duration(),
        return_debug_tuple: bool = False,
    ) -> Result:
        """
        Check whether `lookup_transform_full` succeeds with the same arguments.

        Parameters
        ----------
        target_frame, target_time, source_frame, source_time, fixed_frame, timeout
            As for `lookup_transform_full`.
        return_debug_tuple
            Whether to also return the reason for a failure.

        Returns
        -------
        bool or tuple of bool and str
            Whether it succeeds; with `return_debug_tuple`, also the reason for a failure or ''.

        """
        arguments = (target_frame, target_time, source_frame, source_time, fixed_frame)
        result = self._wait(Question(self.can_transform_full_core, arguments), timeout)
        return result if return_debug_tuple else result[0]

    def _warn(self, text: str) -> None:
        get_logger('tf2').warning(text)

    def _answer(self, request: Any, response: Any) -> Any:
        response.frame_yaml = self.all_frames_as_yaml()
        return response
