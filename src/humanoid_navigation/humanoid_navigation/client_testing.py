# SPDX-License-Identifier: Apache-2.0
"""A node on simulated time that calls the services of Nav2 and waits for its nodes; for tests."""

from __future__ import annotations

from typing import Any

from humanoid_common.qos import SENSOR
from humanoid_common.testing.ros import RosSandbox
from lifecycle_msgs.srv import GetState
from rclpy.client import Client
from rclpy.node import Node
from rclpy.task import Future
from rosgraph_msgs.msg import Clock

PATIENCE_S = 90.0
"""Timeout in real time for responses that should arrive at once."""
SETTLE_S = 1.0
"""Simulated time after which the servers have discovered a client, or AMCL has settled."""


class NavigationClient:
    """
    Client of the lifecycle nodes of Nav2, with the simulated time.

    Parameters
    ----------
    ros
        The nodes of the test.

    """

    def __init__(self, ros: RosSandbox) -> None:
        self._ros = ros
        self.node = ros.start(lambda **options: Node('traveller', **options))
        self.now_s = 0.0
        """Simulated time."""
        self._clients: dict[str, Client] = {}
        self.node.create_subscription(Clock, '/clock', self._take_clock, SENSOR)

    def wait_until(self, predicate: Any, timeout_s: float = PATIENCE_S, what: str = '') -> None:
        """
        Wait until a predicate holds, while spinning the nodes of the test.

        Parameters
        ----------
        predicate
            Called without arguments between callbacks.
        timeout_s
            How long to wait (s), on the computer's clock.
        what
            Description of the predicate, for the error message.

        Raises
        ------
        AssertionError
            The predicate does not hold in time.

        """
        self._ros.wait_until(predicate, timeout_s, what or 'the condition')

    def wait(self, duration_s: float) -> None:
        """
        Wait for a duration in simulated time.

        Parameters
        ----------
        duration_s
            The duration, in s.

        """
        end_s = self.now_s + duration_s
        self.wait_until(lambda: self.now_s >= end_s, PATIENCE_S + duration_s, 'simulated time')

    def answer(self, future: Future) -> Any:
        """
        Wait for the response of a server.

        Parameters
        ----------
        future
            The future of the request.

        Returns
        -------
        Any
            The result of the future.

        Raises
        ------
        AssertionError
            No response arrives in time.

        """
        self.wait_until(future.done, PATIENCE_S, 'an answer')
        return future.result()

    def call(self, kind: Any, name: str, request: Any) -> Any:
        """
        Call an idempotent service, and return its response.

        Parameters
        ----------
        kind, name, request
            The type and name of the service, and the request; repeated if it gets no response.

        """
        if name not in self._clients:
            client = self._clients[name] = self.node.create_client(kind, name)
            self.wait_until(client.service_is_ready, what=f"the service '{name}'")
            # A server drops its response to a client that it has not discovered yet.
            self.wait(SETTLE_S)
        first = self._clients[name].call_async(request)
        try:
            self.wait_until(first.done, PATIENCE_S / 3.0)
        except AssertionError:
            # A response is lost if the server's middleware has lost its match with the client.
            return self.answer(self._clients[name].call_async(request))
        return first.result()

    def wait_for_active(self, *names: str) -> None:
        """
        Wait until lifecycle nodes are active.

        Parameters
        ----------
        *names
            Their names; without any, AMCL, the BT navigator and the waypoint follower.

        """
        for name in names or ('amcl', 'bt_navigator', 'waypoint_follower'):
            self.wait_until(lambda name=name: self.state_of(name) == 'active', what=name)

    def state_of(self, name: str) -> str:
        """
        Query the state of a lifecycle node.

        Parameters
        ----------
        name
            The name of the node, whose service `get_state` is waited for.

        Returns
        -------
        str
            The label of the state, such as `active`; `unknown` if there is no response within 2 s.

        """
        client = self.node.create_client(GetState, f'{name}/get_state')
        self.wait_until(client.service_is_ready, what=f"the node '{name}'")
        future = client.call_async(GetState.Request())
        try:
            self.wait_until(future.done, 2.0)
        except AssertionError:
            return 'unknown'  # the node has gone in the meantime
        finally:
            self.node.destroy_client(client)
        return str(future.result().current_state.label)

    def _take_clock(self, message: Clock) -> None:
        self.now_s = message.clock.sec + message.clock.nanosec * 1e-9
