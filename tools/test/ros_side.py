# SPDX-License-Identifier: Apache-2.0
"""What a test hears and says on topics, beside the programs that it has started."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import threading
from typing import Any

from browser import Place
from programs import wait_until
from rcl_interfaces.srv import GetParameters
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from urdf import parse_urdf, RobotModel
from urdf.kinematics import joint_motion

__all__ = ['RosSide', 'expected_place', 'ros_side']

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class RosSide:
    """A node that keeps all that comes on the topics that it is told of."""

    def __init__(self, node: Node) -> None:
        """Take a node that works in another thread."""
        self.node = node
        self._heard: dict[str, list[Any]] = {}

    def listen(self, kind: type, topic: str, qos: QoSProfile | int = 10) -> list[Any]:
        """Return the list to which messages are added as they come."""
        if topic not in self._heard:
            self._heard[topic] = heard = []
            self.node.create_subscription(kind, topic, heard.append, qos)
        return self._heard[topic]

    def first(self, kind: type, topic: str, qos: QoSProfile | int = 10) -> Any:
        """Return the first message of a topic."""
        heard = self.listen(kind, topic, qos)
        wait_until(lambda: heard, 60.0, f'a message of {topic}')
        return heard[0]

    def model(self) -> RobotModel:
        """Return the robot that is described."""
        from std_msgs.msg import String

        return parse_urdf(self.first(String, '/robot_description', LATCHED).data)

    def parameter(self, node: str, name: str) -> Any:
        """Return the value of a parameter of a node, as the node says."""
        client = self.node.create_client(GetParameters, f'{node}/get_parameters')
        assert client.wait_for_service(30.0)
        request = GetParameters.Request(names=[name])
        # A server drops its response to a client that it has not discovered yet.
        answers = (client.call(request, timeout_sec=5.0) for _ in range(6))
        answer = next((each for each in answers if each is not None), None)
        self.node.destroy_client(client)
        assert answer is not None, f'waited 30 s in vain for the answer of {node}'
        return answer.values[0]

    def nodes(self) -> set[str]:
        """Return the names of all nodes."""
        return set(self.node.get_node_names())


def expected_place(model: RobotModel, joint: str, position_rad: float) -> Place:
    """Return where the child of a joint is in its parent, as the URDF says."""
    found = next(each for each in model.joints if each.name == joint)
    x, y, z, qx, qy, qz, qw = joint_motion(found)(position_rad)
    return Place((qw, qx, qy, qz), (x, y, z))


@contextmanager
def ros_side(domain: int) -> Iterator[RosSide]:
    """Give a node that works in a thread of its own."""
    context = Context()
    rclpy.init(context=context, domain_id=domain)
    node = Node('test', context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    is_over = threading.Event()

    def work() -> None:
        while not is_over.is_set():
            executor.spin_once(timeout_sec=0.1)

    thread = threading.Thread(target=work, daemon=True)
    thread.start()
    try:
        yield RosSide(node)
    finally:
        is_over.set()
        thread.join()  # what it waits for must not be destroyed meanwhile
        executor.shutdown()
        node.destroy_node()
        context.try_shutdown()
