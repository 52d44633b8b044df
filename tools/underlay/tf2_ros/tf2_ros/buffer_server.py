# SPDX-License-Identifier: Apache-2.0
"""Action server for transform lookups, also a program: `ros2 run tf2_ros buffer_server`."""

from __future__ import annotations

from functools import partial
import sys
from typing import Any, TYPE_CHECKING

from tf2_ros.program import run_node

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.task import Future
    from tf2_ros.buffer import Buffer

_NAME = 'tf2_buffer_server'
_CACHE_S = 120.0
_RESULT_TIMEOUT_S = 900.0


class BufferServer:
    """
    Action server that offers a buffer to each BufferClient, which needs no listener of its own.

    Parameters
    ----------
    buffer
        The buffer in which transforms are looked up.
    node
        The node that offers the action.
    ns
        The name of the action.

    """

    def __init__(self, buffer: Buffer, node: Node, ns: str) -> None:
        from rclpy.action import ActionServer
        from rclpy.callback_groups import ReentrantCallbackGroup
        from tf2_msgs.action import LookupTransform
        from tf2_ros.executing import RESULT_MARGIN_S

        self._buffer = buffer
        self._node = node
        self._group = ReentrantCallbackGroup()
        self._waits: dict[bytes, Future] = {}
        self._result = LookupTransform.Result
        self._server = ActionServer(
            node,
            LookupTransform,
            ns,
            self._execute,
            cancel_callback=self._cancel,
            result_timeout=_RESULT_TIMEOUT_S + RESULT_MARGIN_S,
            callback_group=self._group,
        )

    def destroy(self) -> None:
        """Destroy the action server."""
        self._server.destroy()

    async def _execute(self, goal: Any) -> Any:
        """Execute a goal: respond when its transform is available or its timeout expires."""
        from tf2_py import TransformException
        from tf2_ros._error_codes import to_message

        look_up, waiting = self._questions(goal.request)
        await self._end_of(goal, waiting)
        result = self._result()
        if goal.is_cancel_requested:
            goal.canceled()
            return result
        try:
            result.transform = look_up()
        except TransformException as error:
            result.error = to_message(error)
        goal.succeed()
        return result

    def _questions(self, request: Any) -> tuple[partial[Any], Future]:
        """Return the lookup of a goal, and a future that is done when it would succeed."""
        frames = (request.target_frame, request.source_frame)
        if not request.advanced:
            arguments: tuple[Any, ...] = (*frames, request.source_time)
            waiting = self._buffer.wait_for_transform_async(*arguments)
            return partial(self._buffer.lookup_transform_core, *arguments), waiting
        target, source = frames
        times = (request.target_time, request.source_time)
        arguments = (target, times[0], source, times[1], request.fixed_frame)
        waiting = self._buffer.wait_for_transform_full_async(*arguments)
        return partial(self._buffer.lookup_transform_full_core, *arguments), waiting

    async def _end_of(self, goal: Any, waiting: Future) -> None:
        """Wait until the transform of a goal is available, it times out, or it is canceled."""
        from rclpy.clock import Clock, ClockType
        from rclpy.task import Future
        from tf2_py.messages import nanoseconds

        timeout_s = nanoseconds(goal.request.timeout) / 1e9
        if waiting.done() or timeout_s <= 0.0:
            waiting.cancel()
            return
        executor = self._node.executor
        end = self._waits[bytes(goal.goal_id.uuid)] = Future(executor=executor)
        waiting.add_done_callback(end.set_result)
        waiting.add_done_callback(lambda _: executor.wake())  # another thread may fill the buffer
        timer = self._node.create_timer(
            timeout_s,
            lambda: end.set_result(None),
            callback_group=self._group,
            clock=Clock(clock_type=ClockType.STEADY_TIME),
        )
        await end
        waiting.cancel()
        self._node.destroy_timer(timer)
        del self._waits[bytes(goal.goal_id.uuid)]

    def _cancel(self, goal: Any) -> Any:
        """Accept the cancellation of a goal and end its wait."""
        from rclpy.action import CancelResponse

        wait = self._waits.get(bytes(goal.goal_id.uuid))
        if wait is not None:
            wait.set_result(None)
        return CancelResponse.ACCEPT


def make_node(words: list[str]) -> Node:
    """
    Create the node of the program buffer_server: a listener whose buffer is offered as an action.

    Parameters
    ----------
    words
        The command line without ROS arguments; must be empty.

    Raises
    ------
    ValueError
        There are command line arguments.

    """
    from rclpy.duration import Duration
    from rclpy.node import Node
    from tf2_ros.buffer import Buffer
    from tf2_ros.transform_listener import TransformListener

    if words:
        raise ValueError(
            f"buffer_server takes no arguments, but got '{' '.join(words)}'. Set its "
            'parameters like this: --ros-args -p buffer_size:=120.0'
        )
    node = Node('tf_buffer')
    cache_s = float(node.declare_parameter('buffer_size', _CACHE_S).value)
    is_named_as_node = node.declare_parameter('use_node_namespace', False).value
    buffer = Buffer(Duration(seconds=cache_s))
    TransformListener(buffer, node)
    BufferServer(buffer, node, node.get_name() if is_named_as_node else _NAME)
    return node


def main() -> int:
    """Run the program; return the exit status."""
    return run_node(make_node)


if __name__ == '__main__':
    sys.exit(main())
