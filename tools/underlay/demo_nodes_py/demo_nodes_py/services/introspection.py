# SPDX-License-Identifier: Apache-2.0
"""Service introspection: a service and a client whose events `ros2 service echo` shows."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from demo_nodes_py.services.add_two_ints_server import AddTwoIntsServer
from example_interfaces.srv import AddTwoInts
from rcl_interfaces.msg import SetParametersResult
from rclpy.client import Client
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_system_default
from rclpy.service import Service
from rclpy.service_introspection import ServiceIntrospectionState
from rclpy.task import Future
from tf2_ros.program import run_node

__all__ = [
    'IntrospectionClientNode',
    'IntrospectionServiceNode',
    'check_parameter',
    'configure_introspection',
    'main',
]

STATES = {
    'disabled': ServiceIntrospectionState.OFF,
    'metadata': ServiceIntrospectionState.METADATA,
    'contents': ServiceIntrospectionState.CONTENTS,
}
_PERIOD_S = 0.5
_PERIODS_UNTIL_REPEAT = 4


def check_parameter(parameter_list: list[Parameter], parameter_name: str) -> SetParametersResult:
    """
    Check the value of a parameter that says what is published about each call.

    Parameters
    ----------
    parameter_list
        Parameters that are to be set.
    parameter_name
        The name of the parameter.

    """
    for parameter in parameter_list:
        if parameter.name != parameter_name:
            continue
        if parameter.type_ != Parameter.Type.STRING:
            return SetParametersResult(successful=False, reason='must be a string')
        if parameter.value not in STATES:
            reason = "must be one of 'disabled', 'metadata', or 'contents'"
            return SetParametersResult(successful=False, reason=reason)
    return SetParametersResult(successful=True)


def configure_introspection(node: Node, name: str, endpoint: Client | Service) -> None:
    """
    Declare a parameter that says what is published about each call.

    Parameters
    ----------
    node
        The node of the client or service.
    name
        The name of the parameter; its values are disabled (the default), metadata and contents.
    endpoint
        The client or service.

    """

    def check(parameters: list[Parameter]) -> SetParametersResult:
        return check_parameter(parameters, name)

    def configure(parameters: list[Parameter]) -> None:
        for parameter in parameters:
            if parameter.name == name:
                state = STATES[parameter.value]
                endpoint.configure_introspection(
                    node.get_clock(), qos_profile_system_default, state
                )

    node.add_on_set_parameters_callback(check)
    node.add_post_set_parameters_callback(configure)
    node.declare_parameter(name, 'disabled')


class IntrospectionServiceNode(AddTwoIntsServer):
    """
    Offers the service `add_two_ints`; `service_configure_introspection` says what it publishes.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('introspection_service', **options)
        configure_introspection(self, 'service_configure_introspection', self.srv)


class IntrospectionClientNode(Node):
    """
    Calls `add_two_ints` twice per second; `client_configure_introspection` says what it publishes.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('introspection_client', **options)
        self._client = self.create_client(AddTwoInts, 'add_two_ints')
        configure_introspection(self, 'client_configure_introspection', self._client)
        self._answer: Future[AddTwoInts.Response] | None = None
        self._periods_waited = 0
        self.create_timer(_PERIOD_S, self.timer_callback)

    def timer_callback(self) -> None:
        """Call the service if it is available; wait for a response for two seconds at most."""
        self._periods_waited += 1
        is_waiting = self._answer is not None and not self._answer.done()
        if is_waiting and self._periods_waited < _PERIODS_UNTIL_REPEAT:
            return
        if self._client.service_is_ready():
            self._periods_waited = 0
            self._answer = self._client.call_async(AddTwoInts.Request(a=2, b=3))
            self._answer.add_done_callback(self._log)

    def _log(self, answer: Future[AddTwoInts.Response]) -> None:
        self.get_logger().info(f'Result of add_two_ints: {answer.result().sum}')


def _make_nodes(_: list[str]) -> Node:
    service = IntrospectionServiceNode()
    service.companions = (IntrospectionClientNode(),)
    return service


def main(args: Sequence[str] | None = None) -> int:
    """
    Run both nodes; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(_make_nodes, args)


if __name__ == '__main__':
    sys.exit(main())
