# SPDX-License-Identifier: Apache-2.0
"""Client of a buffer server, which looks up transforms in another node."""

from __future__ import annotations

from collections.abc import Callable
import threading
import time as wall_clock
from typing import Any, TYPE_CHECKING

from rclpy.action import ActionClient
from rclpy.duration import Duration
from rclpy.time import Time
from tf2_msgs.action import LookupTransform
from tf2_py import TimeoutException, TransformException
from tf2_py.messages import nanoseconds
from tf2_ros._error_codes import raise_error
from tf2_ros.buffer_interface import BufferInterface

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped
    from rclpy.node import Node
    from rclpy.task import Future

_SPIN = (
    'A node receives the answer only while it spins: spin it in a thread other than the one '
    'that calls'
)
_REPEAT_S = 1.0
"""Time after which a request without a response is repeated."""


class BufferClient(BufferInterface):
    """
    Action client that looks up transforms in the buffer of another node; calls block.

    Parameters
    ----------
    node
        The node that sends the requests; another thread must spin it.
    ns
        The action name of the server; that of the program `buffer_server` is tf2_buffer_server.
    check_frequency
        The rate of checks whether the server is available, in Hz.
    timeout_padding
        Additional time for communication, on top of the lookup timeout.

    Attributes
    ----------
    action_client
        The `rclpy.action.ActionClient`.

    """

    def __init__(
        self,
        node: Node,
        ns: str,
        check_frequency: float = 10.0,
        timeout_padding: Duration = Duration(seconds=2.0),
    ) -> None:
        super().__init__()
        self.node = node
        self.action_client = ActionClient(node, LookupTransform, ns)
        self.check_frequency = check_frequency
        self.timeout_padding = timeout_padding
        self._ns = ns

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
            The maximum time for which the server waits for it; by default no wait.

        Returns
        -------
        TransformStamped
            Pose of the source frame (child) in the target frame (header), in m and as a
            quaternion.

        Raises
        ------
        TimeoutException
            The server is not available, or has not responded within the timeout plus padding.
        TransformException
            The transform is not available on the server; the subclass and the message state why.

        """
        goal = _goal(target_frame, source_frame, time, timeout)
        return self._answer(goal)

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
            The maximum time for which the server waits for it; by default no wait.

        Returns
        -------
        TransformStamped
            Pose of the source frame (child) in the target frame (header), stamped with the target
            time.

        Raises
        ------
        TimeoutException
            The server is not available, or has not responded within the timeout plus padding.
        TransformException
            The transform is not available on the server; the subclass and the message state why.

        """
        goal = _goal(target_frame, source_frame, source_time, timeout)
        goal.target_time = _stamp(target_time)
        goal.fixed_frame = fixed_frame
        goal.advanced = True
        return self._answer(goal)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time,
        timeout: Duration = Duration(),
    ) -> bool:
        """
        Check whether `lookup_transform` succeeds with the same arguments.

        Parameters
        ----------
        target_frame, source_frame, time, timeout
            As for `lookup_transform`.

        """
        try:
            self.lookup_transform(target_frame, source_frame, time, timeout)
        except TransformException:
            return False
        return True

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration = Duration(),
    ) -> bool:
        """
        Check whether `lookup_transform_full` succeeds with the same arguments.

        Parameters
        ----------
        target_frame, target_time, source_frame, source_time, fixed_frame, timeout
            As for `lookup_transform_full`.

        """
        try:
            self.lookup_transform_full(
                target_frame, target_time, source_frame, source_time, fixed_frame, timeout
            )
        except TransformException:
            return False
        return True

    def _answer(self, goal: LookupTransform.Goal) -> TransformStamped:
        """Send a goal to the server and return the resulting transform."""
        allowed_s = (nanoseconds(goal.timeout) + nanoseconds(self.timeout_padding)) / 1e9
        end_s = wall_clock.monotonic() + allowed_s
        self._wait_for_server(end_s, allowed_s)
        accepted = self._response(
            lambda: self.action_client.send_goal_async(goal), end_s, allowed_s
        )
        try:
            result = self._response(accepted.get_result_async, end_s, allowed_s).result
        except TimeoutException:
            accepted.cancel_goal_async()
            raise
        raise_error(result.error)
        return result.transform

    def _wait_for_server(self, end_s: float, allowed_s: float) -> None:
        while not self.action_client.server_is_ready():
            if wall_clock.monotonic() > end_s or not self.node.context.ok():
                raise TimeoutException(
                    f"No node has offered the action '{self._ns}' for {allowed_s:g} s. Start "
                    "one, such as 'ros2 run tf2_ros buffer_server', or give its name as ns"
                )
            wall_clock.sleep(1.0 / self.check_frequency)

    def _response(self, request: Callable[[], Future], end_s: float, allowed_s: float) -> Any:
        """
        Send a request, and wait for the response, which another thread receives.

        The request is repeated at growing intervals: a response is lost if the server sends it
        before it has discovered the client, and a lookup may safely be done twice.
        """
        is_done = threading.Event()
        futures: list[Future] = []
        interval_s = _REPEAT_S
        while True:
            futures.append(request())
            futures[-1].add_done_callback(lambda _: is_done.set())
            left_s = end_s - wall_clock.monotonic()
            if is_done.wait(max(0.0, min(interval_s, left_s))):
                return next(future for future in futures if future.done()).result()
            if left_s <= interval_s:
                raise TimeoutException(
                    f"The server of the action '{self._ns}' has not answered within "
                    f'{allowed_s:g} s. {_SPIN}'
                )
            interval_s *= 2.0


def _goal(target: str, source: str, time: Time, timeout: Duration) -> LookupTransform.Goal:
    goal = LookupTransform.Goal(target_frame=target, source_frame=source)
    goal.source_time = _stamp(time)
    goal.timeout = Duration(nanoseconds=nanoseconds(timeout)).to_msg()
    return goal


def _stamp(time: Any) -> Any:
    return Time(nanoseconds=nanoseconds(time)).to_msg()
