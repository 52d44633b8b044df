# SPDX-License-Identifier: Apache-2.0
"""The trajectory controllers of a robot: which are active, and which joints each moves."""

from __future__ import annotations

import time
from typing import Any, TYPE_CHECKING

from controller_manager_msgs.srv import ListControllers
from rviz_common.pace import Pace

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['ACTION', 'TrajectoryControllers']

ACTION = 'follow_joint_trajectory'
ACTIVE = 'active'
LOOK_S = 2.0
SILENCE_S = 5.0
"""A controller manager that does not respond within this time is asked again."""


class TrajectoryControllers:
    """
    The trajectory controllers of a controller manager, which may start and end at any time.

    Parameters
    ----------
    node
        The node that owns the client. It is used in its own thread only.
    manager
        The full name of the controller manager; the actions of its controllers are beside it.

    Attributes
    ----------
    joints
        The joints of each active controller with an action server, by its name.
    problem
        Why there is none, as a sentence; '' if there is one.

    """

    def __init__(self, node: Node, manager: str) -> None:
        self._node = node
        self._service = f'{manager}/list_controllers'
        self._space = manager.rpartition('/')[0]
        self._pace = Pace(LOOK_S)
        self._client: Any = None
        self._future: Any = None
        self._asked_s = 0.0
        self.joints: dict[str, tuple[str, ...]] = {}
        self.problem = f"There is no service '{self._service}' yet."

    def action(self, controller: str) -> str:
        """
        Build the full name of the action of a controller.

        Parameters
        ----------
        controller
            The name of the controller.

        """
        return f'{self._space}/{controller}/{ACTION}'

    def update(self) -> None:
        """Take the response of the controller manager, and ask again when it is time."""
        if self._future is not None and self._future.done():
            self._take(self._future.result())
            self._future = None
        if not self._pace.is_due():
            return
        if not self._node.count_services(self._service):
            self.close()
            self.joints = {}
            self.problem = (
                f"There is no service '{self._service}': the controllers of the robot are not "
                'running.'
            )
            return
        if self._client is None:
            self._client = self._node.create_client(ListControllers, self._service)
        if self._future is not None and time.monotonic() - self._asked_s > SILENCE_S:
            self._client.remove_pending_request(self._future)
            self._future = None
            self.problem = f"'{self._service}' does not respond."
        if self._future is None:
            if self._client.service_is_ready():
                self._asked_s = time.monotonic()
                self._future = self._client.call_async(ListControllers.Request())
            else:
                self._pace.hurry()

    def close(self) -> None:
        """Destroy the client."""
        if self._client is not None:
            self._node.destroy_client(self._client)
        self._client = self._future = None

    def _take(self, response: ListControllers.Response) -> None:
        """Take the joints of the active controllers that have an action server."""
        self.joints = {}
        for each in response.controller:
            own = (name.rpartition('/')[0] for name in each.required_command_interfaces)
            server = f'{self.action(each.name)}/_action/send_goal'
            if each.state == ACTIVE and self._node.count_services(server):
                self.joints[each.name] = tuple(dict.fromkeys(own))
        self.problem = (
            ''
            if self.joints
            else (f"'{self._service}' lists no active controller with an action '{ACTION}'.")
        )
