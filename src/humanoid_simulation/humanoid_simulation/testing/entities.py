# SPDX-License-Identifier: Apache-2.0
"""Query the true positions of simulated entities, move them, and apply forces to them."""

from __future__ import annotations

import math
from typing import Any

from geometry_msgs.msg import Vector3, Wrench
from humanoid_common.testing.ros import RosSandbox
from humanoid_interfaces.srv import ApplyWrench
from humanoid_simulation.examples.conversions import refusal
from rclpy.duration import Duration
from simulation_interfaces.srv import GetEntityState, SetEntityState

__all__ = ['EntityClient']

_PATIENCE_S = 60.0
_SERVICES = {
    'get_entity_state': GetEntityState,
    'set_entity_state': SetEntityState,
    'apply_wrench': ApplyWrench,
}


class EntityClient:
    """
    Client of the entity services of a simulator.

    Parameters
    ----------
    ros
        The nodes of the test.
    simulator
        The name of the simulator's node.

    """

    def __init__(self, ros: RosSandbox, simulator: str = 'simulator') -> None:
        self._ros, node = ros, ros.observer()
        self._clients = {
            name: node.create_client(kind, f'{simulator}/{name}')
            for name, kind in _SERVICES.items()
        }
        for name, client in self._clients.items():
            ros.wait_until(client.service_is_ready, _PATIENCE_S, name)

    def position_m(self, name: str) -> tuple[float, float, float]:
        """
        Query the true position of an entity.

        Parameters
        ----------
        name
            The name of the object or robot.

        Returns
        -------
        float, float, float
            The origin of the object, or of the base of the robot, in m in the world frame.

        """
        answer = self._ask('get_entity_state', GetEntityState.Request(entity=name))
        position = answer.state.pose.position
        return position.x, position.y, position.z

    def put(self, name: str, at_m: tuple[float, float, float], yaw_rad: float = 0.0) -> None:
        """
        Move an entity, upright and at rest.

        Parameters
        ----------
        name
            The name of the object or robot.
        at_m
            The new position (3,) of its origin, in the world frame.
        yaw_rad
            Its new heading.

        """
        request = SetEntityState.Request(entity=name)
        pose = request.state.pose
        pose.position.x, pose.position.y, pose.position.z = at_m
        pose.orientation.w, pose.orientation.z = math.cos(yaw_rad / 2.0), math.sin(yaw_rad / 2.0)
        self._ask('set_entity_state', request)

    def pull(
        self, name: str, force_n: tuple[float, float, float], duration_s: float = 1.0
    ) -> None:
        """
        Apply a force at the origin of an entity; returns at once.

        Parameters
        ----------
        name
            The name of the object or robot.
        force_n
            The force (3,), in the world frame.
        duration_s
            Its duration, in s of simulated time.

        """
        x, y, z = force_n
        request = ApplyWrench.Request(entity=name, wrench=Wrench(force=Vector3(x=x, y=y, z=z)))
        request.duration = Duration(seconds=duration_s).to_msg()
        self._ask('apply_wrench', request)

    def _ask(self, name: str, request: Any) -> Any:
        """Call a service, assert that it succeeds, and return the response."""
        future = self._clients[name].call_async(request)
        self._ros.wait_until(future.done, _PATIENCE_S, f'an answer of {name}')
        reason = refusal(future.result())
        assert not reason, f'{name} refused: {reason}'
        return future.result()
