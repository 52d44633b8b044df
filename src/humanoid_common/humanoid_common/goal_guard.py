# SPDX-License-Identifier: Apache-2.0
"""
Cancel the goals that a node has sent to others when its process dies, even by `kill -9`.

A robot continues with its last goal: an arm to the end of its trajectory, navigation to its goal,
even if the client that sent it has died. A second process therefore receives each goal through a
pipe, which the kernel closes at the moment the first one ends, however it ends. This needs no
polling and no timeout that a busy computer could exceed.
"""

from __future__ import annotations

import argparse
from contextlib import suppress
import os
import signal
import subprocess
import sys
import time
from typing import Any
from uuid import uuid4

from action_msgs.srv import CancelGoal
from humanoid_common.interrupts import STOP_SIGNALS
import rclpy
from rclpy.action import ActionClient
from rclpy.client import Client
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future
from unique_identifier_msgs.msg import UUID

__all__ = ['GoalGuard', 'GuardedActionClient', 'main']

_MODULE = 'humanoid_common.goal_guard'
_APPEAR_S, _ANSWER_S = 0.5, 0.3
"""Maximum time to discover an action, and to wait for its response, when goals are canceled. A
request that was sent arrives, whether or not its response is awaited."""
_START_S = 5.0
"""Time after its start in which a guard can still discover actions."""


class GoalGuard:
    """
    Watchdog process that cancels the goals of a node when this process ends.

    It keeps the newest goal of each action, since a controller runs one at a time.

    Parameters
    ----------
    node
        The node that sends goals to others. Its guard is a hidden node beside it.

    """

    def __init__(self, node: Node) -> None:
        self.node = node
        self._goals: dict[str, str] = {}
        self._process = self._start()

    def add(self, action: str, goal_id: UUID) -> None:
        """
        Register a goal, to be canceled if this process ends.

        Parameters
        ----------
        action, goal_id
            Name of the action, as the node uses it, and id of the goal, which need not be accepted
            yet.

        """
        service = self.node.resolve_service_name(f'{action}/_action/cancel_goal')
        self._goals[service] = bytes(goal_id.uuid).hex()
        try:
            self._tell(service)
        except OSError:  # it was killed
            self.close()
            self._process = self._start()
            for each in self._goals:
                self._tell(each)

    def close(self) -> None:
        """End the guard, which cancels the goals that are still running."""
        assert self._process.stdin is not None
        with suppress(OSError):
            self._process.stdin.close()
        self._process.wait()

    def _tell(self, service: str) -> None:
        assert self._process.stdin is not None
        self._process.stdin.write(f'{service} {self._goals[service]}\n'.encode())
        self._process.stdin.flush()

    def _start(self) -> subprocess.Popen[bytes]:
        domain = str(self.node.context.get_domain_id())
        return subprocess.Popen(
            [sys.executable, '-m', _MODULE, self.node.get_name(), self.node.get_namespace()],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            env={**os.environ, 'ROS_DOMAIN_ID': domain},
        )


class GuardedActionClient(ActionClient):
    """
    Action client whose goals are canceled when this process ends.

    Parameters
    ----------
    guard
        The guard that cancels the goals.
    kind, name
        As for `rclpy.action.ActionClient`.

    """

    def __init__(self, guard: GoalGuard, kind: Any, name: str) -> None:
        super().__init__(guard.node, kind, name)
        self._guard, self._name = guard, name

    def send_goal_async(
        self, goal: Any, feedback_callback: Any = None, goal_uuid: UUID | None = None
    ) -> Future[Any]:
        """
        Send a goal, as `rclpy.action.ActionClient` does.

        Parameters
        ----------
        goal, feedback_callback, goal_uuid
            As there; the goal is registered with the guard before it is sent.

        """
        goal_id = goal_uuid or UUID(uuid=list(uuid4().bytes))
        self._guard.add(self._name, goal_id)
        return super().send_goal_async(goal, feedback_callback, goal_id)


def main() -> int:
    """Read goals until the end of the input, and cancel them."""
    parser = argparse.ArgumentParser(
        description='Cancel goals when stdin closes. Nodes start this as a helper process.'
    )
    parser.add_argument('node', help='name of the node')
    parser.add_argument('namespace', help='namespace of the node')
    told = parser.parse_args()
    for number in STOP_SIGNALS:  # Ctrl-C ends the other process, and thereby this one
        signal.signal(number, signal.SIG_IGN)
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    node = Node(
        f'_{told.node}_goal_guard',
        namespace=told.namespace,
        start_parameter_services=False,
        enable_rosout=False,
    )
    begin_s = time.monotonic()
    clients: dict[str, Client] = {}
    goals: dict[str, str] = {}
    for line in sys.stdin:
        service, goal_id = line.split()
        if service not in clients:  # created now, as discovery takes a while
            clients[service] = node.create_client(CancelGoal, service)
        goals[service] = goal_id
    end_s = max(time.monotonic() + _APPEAR_S, begin_s + _START_S)
    _cancel(node, {clients[service]: goal_id for service, goal_id in goals.items()}, end_s)
    node.destroy_node()
    rclpy.try_shutdown()
    return 0


def _cancel(node: Node, goals: dict[Client, str], end_s: float) -> None:
    """Cancel each goal with its service client; discover the services until the deadline."""
    left, answers = dict(goals), []
    while time.monotonic() < end_s:
        for client in [each for each in left if each.service_is_ready()]:
            request = CancelGoal.Request()
            request.goal_info.goal_id.uuid = list(bytes.fromhex(left.pop(client)))
            answers.append(client.call_async(request))
            if not left:
                end_s = time.monotonic() + _ANSWER_S
        if not left and all(each.done() for each in answers):
            return
        rclpy.spin_once(node, timeout_sec=0.02)


if __name__ == '__main__':
    sys.exit(main())
