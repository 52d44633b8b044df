# SPDX-License-Identifier: Apache-2.0
"""How lookups wait until their transforms are in the buffer: as futures, or by blocking."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
import threading
import time
from typing import Any, NamedTuple, Optional, TYPE_CHECKING

from rclpy.task import Future
from tf2_py import BufferCore, TransformException
from tf2_py.messages import nanoseconds, Reading
from tf2_py.route import after_waiting

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped
    from rclpy.duration import Duration
    from rclpy.node import Node
    from rclpy.time import Time

Check = Callable[[], bool]
_LOOK_S = 0.1
_BLOCKED = (
    'No transform could arrive during the wait: the thread that waited is the one that '
    'receives them: create the TransformListener with spin_thread=True, or await '
    'lookup_transform_async'
)


class Waiting:
    """
    Registry of threads and futures that wait for transforms.

    Parameters
    ----------
    is_alive
        Threads stop waiting as soon as this returns False, such as after a ROS shutdown.

    """

    def __init__(self, is_alive: Callable[[], bool]) -> None:
        self._is_alive = is_alive
        self._changed = threading.Condition()
        self._threads = 0
        self._futures: list[tuple[Check, Any]] = []
        self._feeding_thread = 0

    def until(self, check: Check, timeout_s: float) -> None:
        """
        Block until a check succeeds, a timeout expires or ROS is shut down.

        Parameters
        ----------
        check
            Whether the transform is available; called again after each change of the buffer.
        timeout_s
            The maximum time to block, in s of wall clock time.

        """
        end_s = time.monotonic() + timeout_s
        with self._changed:
            self._threads += 1
            try:
                while not check() and self._is_alive():
                    left_s = end_s - time.monotonic()
                    if left_s <= 0.0:
                        break
                    self._changed.wait(min(left_s, _LOOK_S))
            finally:
                self._threads -= 1

    def add(self, check: Check, future: Any) -> None:
        """
        Complete a future with True as soon as a check succeeds.

        Parameters
        ----------
        check
            Whether the transform is available; called again after each change of the buffer.
        future
            The future to complete; it is dropped if it was canceled or completed before.

        """
        with self._changed:
            self._futures.append((check, future))
        self._settle()

    def announce(self) -> None:
        """Notify waiting threads and futures that the buffer has changed."""
        self._feeding_thread = threading.get_ident()
        if self._threads:
            with self._changed:
                self._changed.notify_all()
        if self._futures:
            self._settle()

    def blocks_itself(self) -> bool:
        """Whether the calling thread is the one that fills the buffer, and so must not block."""
        return self._feeding_thread == threading.get_ident()

    def _settle(self) -> None:
        with self._changed:
            entries = [entry for entry in self._futures if not _is_over(entry[1])]
            ready = [entry for entry in entries if entry[0]()]
            self._futures = [entry for entry in entries if entry not in ready]
        for _, future in ready:
            future.set_result(True)


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


class WaitingBuffer(BufferCore):
    """
    BufferCore whose lookups can be awaited, or block until the transform arrives.

    Parameters
    ----------
    cache_time
        The length of the buffer, as a duration; 10 s by default.

    """

    def __init__(self, cache_time: Optional[Duration] = None) -> None:
        BufferCore.__init__(self, cache_time)
        self._node: Optional[Node] = None
        self._waiting = Waiting(self._is_alive)

    def wait_for_transform_async(self, target_frame: str, source_frame: str, time: Time) -> Future:
        """
        Create a future that is done when `Buffer.lookup_transform` would succeed.

        Parameters
        ----------
        target_frame, source_frame, time
            As for `Buffer.lookup_transform`.

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
        Create a future that is done when `Buffer.lookup_transform_full` would succeed.

        Parameters
        ----------
        target_frame, target_time, source_frame, source_time, fixed_frame
            As for `Buffer.lookup_transform_full`.

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
            As for `Buffer.lookup_transform`.

        Returns
        -------
        TransformStamped
            As from `Buffer.lookup_transform`.

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
            As for `Buffer.lookup_transform_full`.

        Returns
        -------
        TransformStamped
            As from `Buffer.lookup_transform_full`.

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


def _is_over(future: Any) -> bool:
    return bool(future.done() or future.cancelled())
