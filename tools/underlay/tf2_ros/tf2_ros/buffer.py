# SPDX-License-Identifier: Apache-2.0
"""Transform buffer of a node."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import partial
from typing import Any, NamedTuple, Optional, TYPE_CHECKING, Union
from weakref import finalize, ref

from rclpy.clock import ClockChange, JumpThreshold
from rclpy.duration import Duration
from rclpy.exceptions import InvalidHandle
from rclpy.logging import get_logger
from rclpy.task import Future
from tf2_py import BufferCore, TransformException
from tf2_py.messages import nanoseconds, Reading
from tf2_py.refusals import Complaints
from tf2_py.route import after_waiting
from tf2_ros._waiting import Waiting
from tf2_ros.buffer_interface import BufferInterface

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped
    from rclpy.node import Node
    from rclpy.time import Time

Result = Union[bool, tuple[bool, str]]
_BLOCKED = (
    'No transform could arrive during the wait: the thread that waited is the one that '
    'receives them: create the TransformListener with spin_thread=True, or await '
    'lookup_transform_async'
)

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


class Question(NamedTuple):
    """Query of a buffer: whether a transform is available, or the reason why not."""

    method: Callable[..., tuple[bool, str]]
    arguments: tuple[Any, ...]

    def ask(self) -> tuple[bool, str]:
        """Run the query now."""
        return self.method(*self.arguments)

    @property
    def frames(self) -> list[str]:
        """Return the frames of the query."""
        return [argument for argument in self.arguments if isinstance(argument, str)]


class Buffer(BufferCore, BufferInterface):
    """
    BufferCore that supports waiting and is cleared when time jumps back.

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
        BufferCore.__init__(self, cache_time)
        BufferInterface.__init__(self)
        self._node: Optional[Node] = None
        self._jump_complaints = Complaints(self._warn, silence_s=QUIET_S)
        self._waiting = Waiting(self._is_alive)
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

    def wait_for_transform_async(self, target_frame: str, source_frame: str, time: Time) -> Future:
        """
        Create a future that is done when `lookup_transform` would succeed.

        Parameters
        ----------
        target_frame, source_frame, time
            As for `lookup_transform`.

        Returns
        -------
        Future
            The future, with result True; cancel it to stop waiting.

        """
        arguments = (target_frame, source_frame, time)
        return self._future(Question(self.can_transform_core, arguments))

    def wait_for_transform_full_async(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
    ) -> Future:
        """
        Create a future that is done when `lookup_transform_full` would succeed.

        Parameters
        ----------
        target_frame, target_time, source_frame, source_time, fixed_frame
            As for `lookup_transform_full`.

        Returns
        -------
        Future
            The future, with result True; cancel it to stop waiting.

        """
        arguments = (target_frame, target_time, source_frame, source_time, fixed_frame)
        return self._future(Question(self.can_transform_full_core, arguments))

    async def lookup_transform_async(
        self, target_frame: str, source_frame: str, time: Time
    ) -> TransformStamped:
        """
        Await the transform that maps data from the source frame to the target frame.

        Parameters
        ----------
        target_frame, source_frame, time
            As for `lookup_transform`.

        Returns
        -------
        TransformStamped
            As from `lookup_transform`.

        """
        await self.wait_for_transform_async(target_frame, source_frame, time)
        return self.lookup_transform_core(target_frame, source_frame, time)

    async def lookup_transform_full_async(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
    ) -> TransformStamped:
        """
        Await the transform from the source frame at one time to the target frame at another.

        Parameters
        ----------
        target_frame, target_time, source_frame, source_time, fixed_frame
            As for `lookup_transform_full`.

        Returns
        -------
        TransformStamped
            As from `lookup_transform_full`.

        """
        arguments = (target_frame, target_time, source_frame, source_time, fixed_frame)
        await self.wait_for_transform_full_async(*arguments)
        return self.lookup_transform_full_core(*arguments)

    def insert_readings(
        self, readings: Iterable[Reading], authority: str, is_static: bool
    ) -> None:
        """
        Insert transforms given as frame names and numbers, and end the waits for them.

        Parameters
        ----------
        readings, authority, is_static
            As for `BufferCore.insert_readings`.

        """
        super().insert_readings(readings, authority, is_static)
        self._waiting.announce()

    def _look_up(
        self, look_up: Callable[[], TransformStamped], question: Question, timeout: Duration
    ) -> TransformStamped:
        """Return the transform, after waiting for it up to the timeout."""
        timeout_s = nanoseconds(timeout) / 1e9
        if timeout_s <= 0.0:
            return look_up()
        self._waiting.until(partial(self._answers, question), timeout_s)
        try:
            return look_up()
        except TransformException as error:
            reason = after_waiting(str(error), timeout_s)
            blocked = f'. {_BLOCKED}' if self._waiting.blocks_itself() else ''
            raise type(error)(reason + blocked) from None

    def _wait(self, question: Question, timeout: Duration) -> tuple[bool, str]:
        timeout_s = nanoseconds(timeout) / 1e9
        if timeout_s <= 0.0:
            return question.ask()
        self._waiting.until(partial(self._answers, question), timeout_s)
        is_there, reason = question.ask()
        return is_there, after_waiting(reason, timeout_s)

    def _future(self, question: Question) -> Future:
        future = Future()
        future.add_done_callback(self._wake)
        self._waiting.add(partial(self._answers, question), future)
        return future

    def _wake(self, future: Future) -> None:
        """Wake the executor to resume callbacks; another thread may have filled the buffer."""
        executor = self._node.executor if self._node else None
        if executor is not None:
            executor.wake()

    def _answers(self, question: Question) -> bool:
        """Whether the transform is available; the cheap check for known frames comes first."""
        return self.known_frames.has(*question.frames) and question.ask()[0]

    def _is_alive(self) -> bool:
        return self._node is None or bool(self._node.context.ok())

    def _warn(self, text: str) -> None:
        get_logger('tf2').warning(text)

    def _answer(self, request: Any, response: Any) -> Any:
        response.frame_yaml = self.all_frames_as_yaml()
        return response
