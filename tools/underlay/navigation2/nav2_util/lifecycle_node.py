# SPDX-License-Identifier: Apache-2.0
"""The base class of the servers: a lifecycle node with parameters, transforms and actions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

from nav2_util.actions import ActionServer
from nav2_util.parameters import ParameterServer, Unsupported
from nav2_util.services import wait_for
from nav2_util.timing import give_way, is_of_coroutine
from nav2_util.transforms import Transforms
from nav2_util.transitions import TransitioningNode
from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
from rclpy.node import Node
from rclpy.task import Future

__all__ = ['LifecycleNode']

_UNSUPPORTED = {
    'autostart_node': Unsupported(
        'the lifecycle manager, or a call of change_state, brings the node up', (False,)
    ),
    'bond_heartbeat_period': Unsupported(
        'instead of bonds, the lifecycle manager asks for the state of the node'
    ),
    'allow_parameter_qos_overrides': Unsupported('the QoS of topics is fixed'),
    'introspection_mode': Unsupported('services are not introspected', ('disabled',)),
    'service_introspection_mode': Unsupported('services are not introspected', ('disabled',)),
}
_END_S = 1.0
_LOOK_S = 0.02


class LifecycleNode(TransitioningNode):
    """
    Lifecycle node that can be configured, activated, deactivated and cleaned up.

    Subclasses override `configure`, `activate`, `deactivate` and `cleanup`, as those of
    `TransitioningNode`.

    Parameters
    ----------
    node_name
        The node name, unless remapped.
    options
        Further keyword arguments of `rclpy.node.Node`, such as `namespace`, `context`,
        `cli_args` and `parameter_overrides`.

    """

    result_timeout_s: ClassVar[float] = 10.0
    """The default of `action_server_result_timeout`."""

    def __init__(self, node_name: str, **options: Any) -> None:
        super().__init__(node_name, **options)
        self.node_options = options
        """The arguments of this node, for nodes that it creates."""
        self.parameters = ParameterServer(self)
        self.parameters.declare_unsupported(_UNSUPPORTED)
        self.companions: list[Node] = []
        """Further nodes to spin together with this one, such as its costmap."""
        self.share_clock: Callable[[Node], Any] | None = None
        """Function that shares the clock of this node with another one; set by a container."""
        self.owner: LifecycleNode | None = None
        """The node that owns this one, and shares its transforms."""
        self.action_servers: list[ActionServer] = []
        self._transforms: Transforms | None = None

    @property
    def transforms(self) -> Transforms:
        """Return the transforms shared by this process."""
        if self.owner is not None:
            return self.owner.transforms
        if self._transforms is None:
            self._transforms = Transforms(self)
            self.add_companion(self._transforms.node)
        return self._transforms

    def add_companion(self, node: Node) -> None:
        """
        Spin another node together with this one, which destroys it at its end.

        Parameters
        ----------
        node
            The node; it is added to the executor of this one, unless it already has an executor.

        """
        self.companions.append(node)
        if node.executor is None and self.share_clock is not None:
            self.share_clock(node)
        if node.executor is None and self.executor is not None:
            self.executor.add_node(node)

    def offer_action(
        self, kind: Any, name: str, work: Callable[..., Any], **options: Any
    ) -> ActionServer:
        """
        Create an action server that accepts goals while the node is active; see `ActionServer`.

        The parameter `action_server_result_timeout` is the time in s for which results are kept.

        An action server from before a cleanup is reused: rclpy's events executor crashes when an
        action server is destroyed.

        Parameters
        ----------
        kind, name
            The type of the action and its name.
        work
            The coroutine function that executes a goal.
        **options
            `takes_over` and `check_goal` of `ActionServer`.

        Returns
        -------
        ActionServer
            The server; the previous one if an action of this name already existed.

        """
        for server in self.action_servers:
            if server.name == name:
                server.set_work(work, **options)
                return server
        result_timeout_s = self.parameters.declare_value(
            'action_server_result_timeout',
            self.result_timeout_s,
            'How long in s the result of a goal is kept; for ever if negative.',
        )
        server = ActionServer(
            self, kind, name, work, result_timeout_s=float(result_timeout_s), **options
        )
        self.action_servers.append(server)
        return server

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Configure the node, and report parameters without effect.

        Parameters
        ----------
        state
            The state before the transition.

        Returns
        -------
        TransitionCallbackReturn
            As of `TransitioningNode`.

        """
        outcome = super().on_configure(state)
        self.parameters.report()
        return outcome

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Activate publishers, the node and its actions.

        Parameters
        ----------
        state
            The state before the transition.

        Returns
        -------
        TransitionCallbackReturn
            As of `on_configure`.

        """
        outcome = super().on_activate(state)
        if outcome is TransitionCallbackReturn.SUCCESS:
            for server in self.action_servers:
                server.activate()
        return outcome

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Deactivate actions, the node and publishers.

        Parameters
        ----------
        state
            The state before the transition.

        Returns
        -------
        TransitionCallbackReturn
            As of `on_configure`.

        """
        self.is_active = False
        for server in self.action_servers:
            server.deactivate()
        return super().on_deactivate(state)

    async def wind_up(self) -> None:
        """
        Deactivate the node and let its goals end, so that their clients receive the results.

        Call this before the node is destroyed while others continue. A goal that has not ended
        after a second, since it is waiting, gets no result.
        """
        if self.is_active:
            self.trigger_deactivate()
        left_s = _END_S
        while left_s > 0.0 and any(server.is_busy for server in self.action_servers):
            await wait_for(self, Future(), _LOOK_S)
            left_s -= _LOOK_S
        for _ in range(3):  # the result is sent after the end of the goal
            for timer in filter(is_of_coroutine, self.timers):
                timer.cancel()  # rclpy's events executor crashes if a timer continues now
            await give_way(self)

    def destroy_node(self) -> None:
        """Destroy the node, its interfaces, and its companions."""
        if self.is_active:
            self.is_active = False
            self._try('deactivated', self.deactivate)
        if self.executor is not None:
            self.executor.remove_node(self)
        self._try('cleaned up', self._clean_up)
        for server in self.action_servers:
            server.destroy()
        shared = None
        if self._transforms is not None:
            shared = self._transforms.node
            self._transforms.close()
        for each in self.companions:
            if each is not shared:
                each.destroy_node()
        super().destroy_node()
        self._state_machine.destroy_when_not_in_use()  # otherwise its services stay in the graph
