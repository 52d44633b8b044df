# SPDX-License-Identifier: Apache-2.0
"""Goals that were sent to another node: their results, and their cancellation."""

from __future__ import annotations

from collections.abc import Callable
import time
from typing import Any

from rclpy.action.client import ClientGoalHandle
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.task import Future

__all__ = ['ResultRequest', 'cancel_goal']

_PERIOD_S = 5.0


class ResultRequest:
    """
    Request for the result of an accepted goal, which is repeated from time to time.

    A client was seen to wait for minutes after its goal had succeeded, for an unknown reason.
    Another request costs little, and the first response counts.

    Parameters
    ----------
    handle
        The client goal handle.
    now_s
        Returns the time of a steady clock in s.

    """

    def __init__(
        self, handle: ClientGoalHandle, now_s: Callable[[], float] = time.monotonic
    ) -> None:
        self._handle, self._now_s = handle, now_s
        self._answers = [handle.get_result_async()]
        self._asked_s = now_s()

    def done(self) -> bool:
        """Check whether the result has come. Call repeatedly until then."""
        if any(each.done() for each in self._answers):
            return True
        if self._now_s() - self._asked_s > _PERIOD_S:
            self._asked_s = self._now_s()
            self._answers.append(self._handle.get_result_async())
        return False

    def result(self) -> Any:
        """Return the response, with status and result, once it has come."""
        return next(each.result() for each in self._answers if each.done())


def cancel_goal(sent: Future[Any]) -> None:
    """
    Cancel a goal that was sent, as soon as its handle is available.

    A coroutine that still waits when its node is destroyed is ended by the garbage collector; with
    the client gone, nothing can be canceled any more, which is not an error.

    Parameters
    ----------
    sent
        What `ActionClient.send_goal_async` returned.

    """
    if sent.done():  # at once: a callback of what is done already waits for the executor
        _cancel(sent)
    else:
        sent.add_done_callback(_cancel)


def _cancel(sent: Future[Any]) -> None:
    """Cancel a goal whose handle has come."""
    handle = sent.result() if not sent.cancelled() else None
    if handle is None or not handle.accepted:
        return
    try:
        handle.cancel_goal_async()
    except (_rclpy.InvalidHandle, _rclpy.RCLError):
        pass
