# SPDX-License-Identifier: Apache-2.0
"""
Forces on bodies in a simulator, through a service of it that lasts for a short time each call.

No package of ROS has a type for such a service. So any type will do that has the fields that are
used, and it is looked up while the simulator runs.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
import math
from typing import Any, TYPE_CHECKING

from geometry_msgs.msg import Point as PointMessage
from geometry_msgs.msg import Vector3
from rclpy.qos import QoSProfile, ReliabilityPolicy
from robot_console.panels.services import service_class
from robot_console.service_calls import ServiceCalls
from robot_console.simulator_link import (
    choose_simulator,
    failure_of,
    SERVICES,
    simulators_among,
)
from rosgraph_msgs.msg import Clock
from rviz_common.frames import Pose
from rviz_common.pace import Pace
from rviz_common.polled_topic import PolledTopic
from rviz_common.selection import Point
from simulation_interfaces.srv import GetEntityState

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['Pulses', 'WrenchLink', 'wrench_service']

SERVICE = 'apply_wrench'
USED = {SERVICE, *SERVICES}
FIELDS = {'entity', 'body', 'wrench', 'point', 'duration'}
OWNER = "tool 'robot_console/Push'"
LOOK_S = 1.0
NEWEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)

Failed = Callable[[str], None]
"""Called with a sentence."""
Graph = Sequence[tuple[str, Sequence[str]]]
"""The name and the types of each service."""


def wrench_service(services: Graph, wanted: str, namespace: str) -> tuple[str, str]:
    """
    Find the simulator of a robot, and the type of its service for forces.

    Parameters
    ----------
    services
        The services of the ROS graph.
    wanted, namespace
        As for `choose_simulator`.

    Returns
    -------
    tuple[str, str]
        The name of the simulator, and the type of the service.

    Raises
    ------
    ValueError
        There is no such simulator, or it does not offer the service; the message is a sentence.

    """
    place = choose_simulator(simulators_among(services), wanted, namespace, OWNER)
    kinds = dict(services).get(f'{place}/{SERVICE}')
    if not kinds:
        raise ValueError(
            f"The simulator does not offer the service '{place}/{SERVICE}', through which objects "
            'are pushed.'
        )
    return place, kinds[0]


class Pulses:
    """
    How long forces act that are renewed as simulated time goes on.

    Each lasts as long as has passed since the one before, so that together they have the right
    impulse at any real-time factor, and end by themselves soon after the last one. There is none
    while the time stands still: it would act later, when nobody pushes.

    Parameters
    ----------
    begin_s
        The simulated time at the beginning, in s; None if it is not known yet.

    """

    SHORTEST_S = 0.05
    LONGEST_S = 0.2

    def __init__(self, begin_s: float | None) -> None:
        self._last_s = begin_s

    def due(self, now_s: float) -> float:
        """
        Return how long the next force is to act, in s of simulated time; 0 if it is not due.

        Parameters
        ----------
        now_s
            The simulated time, in s.

        """
        if self._last_s is None or now_s < self._last_s:
            self._last_s = now_s
            return 0.0
        passed_s = now_s - self._last_s
        if passed_s < self.SHORTEST_S:
            return 0.0
        self._last_s = now_s
        return min(passed_s, self.LONGEST_S)


class WrenchLink:
    """
    Applies forces to bodies of a simulator, which may start and end at any time.

    Parameters
    ----------
    node
        The node that owns the clients. It is used in its own thread only.
    wanted, namespace
        As for `choose_simulator`.

    Attributes
    ----------
    problem
        Why nothing can be pushed, as a sentence; '' if it can.

    """

    def __init__(self, node: Node, wanted: str, namespace: str) -> None:
        self._node, self._wanted, self._namespace = node, wanted, namespace
        self._found: tuple[str, str] | None = None
        self._kind: Any = None
        self._client: Any = None
        self._pushes: list[tuple[Any, Failed]] = []
        self._calls = ServiceCalls(node)
        self._clock = PolledTopic(node, Clock, '/clock', NEWEST)
        self._look = Pace(LOOK_S)
        self.problem = ''
        self.now_s: float | None = None

    def update(self) -> None:
        """Look for the simulator, about once a second; take the time and its answers."""
        if self._look.is_due():
            self._find()
        for message, _ in self._clock.take():
            self.now_s = message.clock.sec + message.clock.nanosec / 1e9
        self._calls.update()
        done = [each for each in self._pushes if each[0].done()]
        self._pushes = [each for each in self._pushes if not each[0].done()]
        for future, failed in done:
            reason = failure_of(future.result())
            if reason:
                failed(reason)

    def push(
        self,
        entity: tuple[str, str],
        force_n: Point,
        point: Point,
        duration_s: float,
        failed: Failed,
    ) -> None:
        """
        Apply a force for a short time.

        Parameters
        ----------
        entity
            The names of the robot or object, and of the link.
        force_n
            The force in N, in the axes of the world.
        point
            Where it takes hold, in m in the frame of the body.
        duration_s
            How long it acts, in s of simulated time.
        failed
            Called with a sentence if the simulator rejects it.

        """
        if self._client is None or not self._client.service_is_ready():
            return
        request = self._kind.Request()
        request.entity, request.body = entity
        x, y, z = force_n
        request.wrench.force = Vector3(x=x, y=y, z=z)
        x, y, z = point
        request.point = PointMessage(x=x, y=y, z=z)
        fraction_s, whole_s = math.modf(duration_s)
        request.duration.sec, request.duration.nanosec = int(whole_s), int(fraction_s * 1e9)
        self._pushes.append((self._client.call_async(request), failed))

    def ask_pose(self, entity: str, take: Callable[[Pose], None], failed: Failed) -> None:
        """
        Ask where the simulator has an object.

        Parameters
        ----------
        entity
            The name of the object.
        take
            Called with its pose in the world.
        failed
            Called with a sentence if the simulator does not know the object.

        """

        def answer(response: Any, error: str) -> None:
            reason = error or failure_of(response)
            if reason:
                failed(reason)
                return
            at, turn = response.state.pose.position, response.state.pose.orientation
            take(Pose((at.x, at.y, at.z), (turn.w, turn.x, turn.y, turn.z)))

        if self._found is not None:
            request = GetEntityState.Request(entity=entity)
            self._calls.call(GetEntityState, f'{self._found[0]}/get_entity_state', request, answer)

    def close(self) -> None:
        """Destroy the clients."""
        self._forget()
        self._calls.close()
        self._clock.close()

    def _find(self) -> None:
        """Look for the simulator in the ROS graph."""
        node = self._node
        living = [
            (name, types)
            for name, types in node.get_service_names_and_types()
            if name.rpartition('/')[2] in USED and node.count_services(name)
        ]
        try:
            found = wrench_service(living, self._wanted, self._namespace)
            if found != self._found:
                self._connect(*found)
        except ValueError as error:
            self._forget()
            self.problem = str(error)
        else:
            self._found, self.problem = found, ''

    def _connect(self, place: str, type_name: str) -> None:
        """Create the clients, or raise ValueError."""
        self._forget()
        self._kind = service_class(type_name)
        missing = FIELDS - set(self._kind.Request.get_fields_and_field_types())
        if missing:
            raise ValueError(
                f"The service '{place}/{SERVICE}' is of the type '{type_name}', whose request "
                f'has no {" and no ".join(sorted(missing))}.'
            )
        self._client = self._node.create_client(self._kind, f'{place}/{SERVICE}')

    def _forget(self) -> None:
        self._pushes.clear()
        if self._client is not None:
            self._node.destroy_client(self._client)
        self._client = self._found = None
