# SPDX-License-Identifier: Apache-2.0
"""Client of the lifecycle services of one node."""

from __future__ import annotations

from typing import Any

from lifecycle_msgs.msg import State, Transition
from lifecycle_msgs.srv import ChangeState, GetState
from nav2_util.errors import NavigationError
from nav2_util.services import call, ServiceError
from rclpy.node import Node

__all__ = ['ManagedNode', 'TransitionError']

WORDS = {
    Transition.TRANSITION_CONFIGURE: 'Configuring',
    Transition.TRANSITION_ACTIVATE: 'Activating',
    Transition.TRANSITION_DEACTIVATE: 'Deactivating',
    Transition.TRANSITION_CLEANUP: 'Cleaning up',
    Transition.TRANSITION_UNCONFIGURED_SHUTDOWN: 'Shutting down',
    Transition.TRANSITION_INACTIVE_SHUTDOWN: 'Shutting down',
    Transition.TRANSITION_ACTIVE_SHUTDOWN: 'Shutting down',
}
_SHUTDOWNS = {
    State.PRIMARY_STATE_UNCONFIGURED: Transition.TRANSITION_UNCONFIGURED_SHUTDOWN,
    State.PRIMARY_STATE_INACTIVE: Transition.TRANSITION_INACTIVE_SHUTDOWN,
    State.PRIMARY_STATE_ACTIVE: Transition.TRANSITION_ACTIVE_SHUTDOWN,
}


_AGAIN_S = 1.0


class TransitionError(NavigationError):
    """A lifecycle transition of a node has failed."""


class ManagedNode:
    """
    Client that gets and changes the lifecycle state of another node.

    Parameters
    ----------
    node
        The node that owns the clients.
    name
        The name of the managed node, relative to the namespace of `node`.
    timeout_s
        The timeout of responses, in s.

    """

    def __init__(self, node: Node, name: str, timeout_s: float) -> None:
        self.name = name
        self._node, self._timeout_s = node, timeout_s
        self._get = node.create_client(GetState, f'{name}/get_state')
        self._change = node.create_client(ChangeState, f'{name}/change_state')

    @property
    def is_there(self) -> bool:
        """Whether its services are available."""
        return bool(self._get.service_is_ready() and self._change.service_is_ready())

    async def state(self, timeout_s: float | None = None) -> int:
        """
        Query the lifecycle state of the node, repeating lost requests.

        Parameters
        ----------
        timeout_s
            The timeout in s; by default that of the class.

        Returns
        -------
        int
            A constant of `lifecycle_msgs/msg/State`, such as `PRIMARY_STATE_ACTIVE`.

        Raises
        ------
        ServiceError
            There was no response in time.

        """
        all_s = left_s = timeout_s or self._timeout_s
        while left_s > 0.0:
            try:
                response: Any = await call(
                    self._node, self._get, GetState.Request(), min(left_s, _AGAIN_S)
                )
                return int(response.current_state.id)
            except ServiceError:
                left_s -= _AGAIN_S  # requests can get lost during discovery
        raise ServiceError(f"'{self.name}' did not report its state within {all_s:g} s.")

    async def answers(self, timeout_s: float) -> bool:
        """
        Whether the node reports its state in time, and its transition service is available.

        Parameters
        ----------
        timeout_s
            The timeout for its state, in s.

        """
        try:
            await self.state(timeout_s)
        except ServiceError:
            return False
        return bool(self._change.service_is_ready())

    async def change(self, transition: int) -> None:
        """
        Trigger a lifecycle transition, and wait until it is complete.

        Parameters
        ----------
        transition
            A constant of `lifecycle_msgs/msg/Transition`, one of those in `WORDS`.

        Raises
        ------
        TransitionError
            It was rejected, failed or timed out.

        """
        self._node.get_logger().info(f'{WORDS[transition]} {self.name}')
        request = ChangeState.Request(transition=Transition(id=transition))
        try:
            response: Any = await call(self._node, self._change, request, self._timeout_s)
        except ServiceError as error:
            raise TransitionError(str(error)) from error
        if not response.success:
            raise TransitionError(f"{WORDS[transition]} '{self.name}' failed: its log says why.")

    async def shut_down(self) -> None:
        """Shut the node down from any state; raise TransitionError like `change`."""
        try:
            transition = _SHUTDOWNS.get(await self.state())
        except ServiceError as error:
            raise TransitionError(str(error)) from error
        if transition is not None:
            await self.change(transition)
