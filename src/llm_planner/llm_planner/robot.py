# SPDX-License-Identifier: Apache-2.0
"""Interface of the skills to the robot: send goals, speak, and wait, tick by tick."""

from __future__ import annotations

from collections.abc import Generator
from itertools import count
from typing import Any

from action_msgs.msg import GoalStatus
from humanoid_common.client_goals import cancel_goal, ResultRequest
from humanoid_common.periodic import clock_s
from humanoid_common.qos import EVENT
from llm_planner.skills import SkillError, SkillRun
from rclpy.action import ActionClient
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.task import Future
from rclpy.time import Time
from std_msgs.msg import String

__all__ = ['RobotInterface']

_PATIENCE_S = 5.0
"""How long a server may take to appear, or to accept a goal; by a steady clock."""
_WORDS = {'COLLISION_AHEAD': 'Something is in my way, so I have stopped.'}
"""Messages to users that replace those for engineers, by the names of error codes."""
_FINAL = ('NOT_REACHABLE', 'OCCUPIED_HAND', 'EMPTY_HAND')
"""The names of error codes after which a retry is pointless."""
_LOOK_TICKS = 20
"""Number of ticks between checks for another server of an action, and between retries."""


class RobotInterface:
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
        """The texts spoken since this list was last cleared."""

    def now_s(self) -> float:
        """Return the time of the node in s."""
        return clock_s(self._node)

    def say(self, text: str) -> None:
        """
        Publish a text on `speech/say`, and record it in `said`.

        Parameters
        ----------
        text
            The text, for the people around the robot.

        """
        self.said.append(text)
        self._say.publish(String(data=text))

    def sleep(self, duration_s: float) -> SkillRun:
        """
        Wait for a duration, by the clock of the node.

        Parameters
        ----------
        duration_s
            The duration; the wait also ends if the clock is set back to before its start.

        """
        begin_s = self.now_s()
        while begin_s <= self.now_s() < begin_s + duration_s:
            yield

    def act(
        self, kind: Any, name: str, goal: Any, otherwise: str = ''
    ) -> Generator[None, None, Any]:
        """
        Send a goal to an action, and wait for its result; closing the generator cancels the goal.

        Parameters
        ----------
        kind, name
            The type and name of the action.
        goal
            The goal.
        otherwise
            The reason for a failure, for a result that states none itself.

        Returns
        -------
        Any
            The result, if it succeeded.

        Raises
        ------
        SkillError
            The action is unavailable, rejects the goal, or does not succeed.

        """
        if name not in self._clients:
            self._clients[name] = ActionClient(self._node, kind, name)
        client = self._clients[name]
        yield from self._patiently(client.server_is_ready, f"'{name}' is not running.")
        servers = self._servers(name)
        sent = yield from self._accepted(client, name, goal)
        end = ResultRequest(sent.result())
        try:
            yield from self._ended(client, name, end, servers)
            answer = end.result()
        finally:
            if not end.done():
                cancel_goal(sent)
        if answer.status != GoalStatus.STATUS_SUCCEEDED:
            reason = _reason(answer.result) or otherwise or f"'{name}' did not succeed."
            raise SkillError(reason, is_final=_code(answer.result) in _FINAL)
        return answer.result

    def _accepted(
        self, client: ActionClient, name: str, goal: Any
    ) -> Generator[None, None, Future[Any]]:
        """Send a goal until it is accepted: a server that just started may still reject it."""
        begin = self._steady.now()
        while True:
            sent = client.send_goal_async(goal)
            try:
                yield from self._patiently(sent.done, f"'{name}' does not answer.")
            except (GeneratorExit, SkillError):
                cancel_goal(sent)
                raise
            if sent.result().accepted:
                return sent
            if self._is_over(begin):
                raise SkillError(f"'{name}' rejected the goal; the log of the robot says why.")
            for _ in range(_LOOK_TICKS):
                yield

    def _ended(
        self, client: ActionClient, name: str, end: ResultRequest, servers: set[bytes]
    ) -> SkillRun:
        """Wait for a result; raise SkillError if the server that accepted the goal is gone."""
        for tick in count():
            if end.done():
                return
            yield
            if tick % _LOOK_TICKS == 0 and not self._servers(name) <= servers:
                raise SkillError(f"'{name}' ended before it was done, and was restarted.")
            if not client.server_is_ready():
                yield from self._patiently(
                    client.server_is_ready, f"'{name}' ended before it was done."
                )
                # A server restarted after a crash does not know this goal.
                if not end.done():
                    raise SkillError(f"'{name}' ended before it was done.")

    def _servers(self, name: str) -> set[bytes]:
        """Return the GIDs of the servers of an action; killed ones stay in the graph a while."""
        found = self._node.get_publishers_info_by_topic(f'{name}/_action/status')
        return {bytes(each.endpoint_gid) for each in found}

    def _patiently(self, condition: Any, failure: str) -> SkillRun:
        """Wait until a condition holds; raise SkillError after the timeout."""
        begin = self._steady.now()
        while not condition():
            if self._is_over(begin):
                raise SkillError(failure, 'UNAVAILABLE')
            yield

    def _is_over(self, begin: Time) -> bool:
        """Check whether the timeout since a start time has expired."""
        return bool((self._steady.now() - begin).nanoseconds * 1e-9 > _PATIENCE_S)


def _reason(result: Any) -> str:
    """Return the reason for a failed result, as a message to the user; '' if it states none."""
    said = getattr(result, 'error_msg', '') or getattr(result, 'error_string', '')
    return _WORDS.get(_code(result), str(said))


def _code(result: Any) -> str:
    """Return the name of the error code of a result if it is handled here; '' for others."""
    code = getattr(result, 'error_code', 0)
    known = (name for name in (*_WORDS, *_FINAL) if getattr(result, name, None) == code)
    return next(known, '') if code else ''
