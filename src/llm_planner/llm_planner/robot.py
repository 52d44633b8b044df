# SPDX-License-Identifier: Apache-2.0
"""What skills do with the robot: send goals, speak, and wait; one tick after another."""

from __future__ import annotations

from collections.abc import Generator
from typing import Any

from action_msgs.msg import GoalStatus
from humanoid_common.qos import EVENT
from llm_planner.plan_tree import SkillError, SkillRun
from rclpy.action import ActionClient
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from std_msgs.msg import String

__all__ = ['Robot']

_PATIENCE_S = 5.0
"""How long a server may take to appear, or to accept a goal; by a clock that nobody stops."""


class Robot:
    """
    The actions and topics of a robot, for skills.

    Parameters
    ----------
    node
        The node whose executor ticks the skills.

    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._clients: dict[str, ActionClient] = {}
        self._say = node.create_publisher(String, 'speech/say', EVENT)
        self._steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.said: list[str] = []
        """What was said since somebody emptied this list."""

    def now_s(self) -> float:
        """Return the time of the node in s."""
        return float(self._node.get_clock().now().nanoseconds) * 1e-9

    def say(self, text: str) -> None:
        """Say a text, and take note of it."""
        self.said.append(text)
        self._say.publish(String(data=text))

    def sleep(self, duration_s: float) -> SkillRun:
        """Wait for a time in s."""
        begin_s = self.now_s()
        while begin_s <= self.now_s() < begin_s + duration_s:
            yield

    def act(self, kind: Any, name: str, goal: Any) -> Generator[None, None, Any]:
        """
        Send a goal to an action, and wait for its result; closed before, cancel it.

        Parameters
        ----------
        kind, name
            The type and name of the action.
        goal
            The goal.

        Returns
        -------
        Any
            The result, if it succeeded.

        Raises
        ------
        SkillError
            The action is not there, rejects the goal, or does not succeed.

        """
        if name not in self._clients:
            self._clients[name] = ActionClient(self._node, kind, name)
        client = self._clients[name]
        yield from self._patiently(client.server_is_ready, f"'{name}' is not running.")
        sent = client.send_goal_async(goal)
        end: Any = None
        try:
            yield from self._patiently(sent.done, f"'{name}' does not answer.")
            handle = sent.result()
            if not handle.accepted:
                raise SkillError(f"'{name}' has refused it; the log of the robot says why.")
            end = handle.get_result_async()
            while not end.done():
                yield
                if not client.server_is_ready():
                    yield from self._patiently(
                        client.server_is_ready, f"'{name}' ended in the middle of it."
                    )
                    # What comes back after a crash knows nothing of this goal.
                    if not end.done():
                        raise SkillError(f"'{name}' ended in the middle of it.")
            answer = end.result()
        finally:
            if end is None or not end.done():
                sent.add_done_callback(_cancel)
        if answer.status != GoalStatus.STATUS_SUCCEEDED:
            text = getattr(answer.result, 'error_msg', '') or getattr(
                answer.result, 'error_string', ''
            )
            raise SkillError(text or f"'{name}' did not succeed.")
        return answer.result

    def _patiently(self, condition: Any, failure: str) -> SkillRun:
        """Wait until something holds; SkillError if it does not for too long."""
        begin = self._steady.now()
        while not condition():
            if (self._steady.now() - begin).nanoseconds * 1e-9 > _PATIENCE_S:
                raise SkillError(failure, 'UNAVAILABLE')
            yield


def _cancel(sent: Any) -> None:
    """Cancel a goal as soon as its handle is there."""
    handle = sent.result() if not sent.cancelled() else None
    if handle is not None and handle.accepted:
        handle.cancel_goal_async()
