# SPDX-License-Identifier: Apache-2.0
"""A process with a service that adds, whose calls are introspected, and a client that calls it."""

import signal
import sys
from typing import Any

from example_interfaces.srv import AddTwoInts
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.qos import QoSProfile
from rclpy.service_introspection import ServiceIntrospectionState
from std_msgs.msg import Int64


def main(has_client: bool) -> None:
    """Answer, and call if there is a client, until a signal comes."""
    rclpy.init()
    node = rclpy.create_node('adder')
    sums = node.create_publisher(Int64, 'sums', 10)
    contents = (node.get_clock(), QoSProfile(depth=100), ServiceIntrospectionState.CONTENTS)

    def add(request: Any, response: Any) -> Any:
        response.sum = request.a + request.b
        sums.publish(Int64(data=response.sum))
        if not has_client:
            print(response.sum, flush=True)
        return response

    node.create_service(AddTwoInts, 'add', add).configure_introspection(*contents)
    if has_client:
        client = node.create_client(AddTwoInts, 'add')
        client.configure_introspection(*contents)
        node.create_timer(0.05, lambda: client.call_async(AddTwoInts.Request(a=2, b=3)))
    print('ready', flush=True)
    rclpy.spin(node)


if __name__ == '__main__':
    try:
        main(len(sys.argv) == 1)
    except (KeyboardInterrupt, ExternalShutdownException):
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        rclpy.try_shutdown()
