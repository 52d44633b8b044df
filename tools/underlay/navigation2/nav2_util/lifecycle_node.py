# SPDX-License-Identifier: Apache-2.0
"""The base class of the servers: a lifecycle node that reports configuration errors."""

from __future__ import annotations

from collections.abc import Callable
import traceback
from typing import Any, ClassVar

from nav2_util.actions import ActionServer
from nav2_util.errors import NavigationError
from nav2_util.parameters import ParameterServer
from nav2_util.services import wait_for
from nav2_util.timing import give_way, is_of_coroutine
from nav2_util.transforms import Transforms
from rclpy._rclpy_pybind11 import RCLError
from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
from rclpy.lifecycle import Node as RclpyLifecycleNode
from rclpy.node import Node
from rclpy.task import Future

__all__ = ['LifecycleNode']

_UNSUPPORTED = {
    'autostart_node': 'the lifecycle manager, or a call of change_state, brings the node up',
    'bond_heartbeat_period': (
        'instead of bonds, the lifecycle manager asks for the state of the node'
    ),
}
_END_S = 1.0
_LOOK_S = 0.02
_KINDS = ('publisher', 'subscription', 'client', 'service', 'timer')


class LifecycleNode(RclpyLifecycleNode):
    """
    Lifecycle node that can be configured, activated, deactivated and cleaned up.

    Subclasses override `configure`, `activate`, `deactivate` and `cleanup`. Publishers,
    subscriptions, clients, services and timers that they create in `configure` or `activate` are
    destroyed by the base class on cleanup.

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
        self._answer_change = self._service_change_state.callback
        self._service_change_state.callback = self._change_if_possible
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
        self.is_active = False
        self._transforms: Transforms | None = None
        self._kept: dict[str, set[int]] = {}

    def configure(self) -> None:
        """Read parameters and create resources; raise NavigationError if that is impossible."""

    def activate(self) -> None:
        """Start operation."""

    def deactivate(self) -> None:
        """Stop operation."""

    def cleanup(self) -> None:
        """Release the resources of `configure`, besides those that the base class destroys."""

    @property
    def state(self) -> str:
        """Return the state: unconfigured, inactive, active, or a transition state."""
        return str(self._state_machine.current_state[1])

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
        Configure the node; destroy what was created if that fails.

        Parameters
        ----------
        state
            The state before the transition.

        Returns
        -------
        TransitionCallbackReturn
            FAILURE after a NavigationError, ERROR after any other exception, else SUCCESS.

        """
        self._kept = {kind: set(map(id, getattr(self, f'{kind}s'))) for kind in _KINDS}
        outcome = self._try('configured', self.configure)
        self.parameters.report()
        if outcome is not TransitionCallbackReturn.SUCCESS:
            self._try('cleaned up', self._clean_up)
        return outcome

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Activate publishers, actions and the node.

        Parameters
        ----------
        state
            The state before the transition.

        Returns
        -------
        TransitionCallbackReturn
            As of `on_configure`.

        """
        super().on_activate(state)
        outcome = self._try('activated', self.activate)
        if outcome is TransitionCallbackReturn.SUCCESS:
            self.is_active = True
            for server in self.action_servers:
                server.activate()
        else:
            super().on_deactivate(state)
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
        outcome = self._try('deactivated', self.deactivate)
        super().on_deactivate(state)
        return outcome

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Destroy the resources of `configure` and `activate`.

        Parameters
        ----------
        state
            The state before the transition.

        Returns
        -------
        TransitionCallbackReturn
            As of `on_configure`.

        """
        return self._try('cleaned up', self._clean_up)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Deactivate the node if it is active, and clean it up.

        Parameters
        ----------
        state
            The state before the transition.

        Returns
        -------
        TransitionCallbackReturn
            As of `on_configure`.

        """
        if self.is_active:
            self.on_deactivate(state)
        return self._try('shut down', self._clean_up)

    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Clean up the node, which becomes unconfigured if that succeeds.

        Parameters
        ----------
        state
            The state before the transition.

        Returns
        -------
        TransitionCallbackReturn
            As of `on_configure`.

        """
        return self._try('cleaned up', self._clean_up)

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

    def _change_if_possible(self, request: Any, response: Any) -> Any:
        """Reject a transition that is invalid in this state; rclpy would end the process."""
        try:
            return self._answer_change(request, response)
        except RCLError:
            wanted = request.transition.label or request.transition.id
            self.get_logger().error(
                f"There is no transition '{wanted}' from the state of this node, {self.state}."
            )
            response.success = False
            return response

    def _clean_up(self) -> None:
        self.cleanup()
        for kind, kept in self._kept.items():
            destroy = getattr(self, f'destroy_{kind}')
            for each in list(getattr(self, f'{kind}s')):
                if id(each) not in kept and not is_of_coroutine(each):
                    destroy(each)
        self._kept = {}

    def _try(self, what: str, step: Callable[[], None]) -> TransitionCallbackReturn:
        try:
            step()
        except NavigationError as error:
            self.get_logger().error(f'This node could not be {what}. {error}')
            return TransitionCallbackReturn.FAILURE
        except Exception:
            self.get_logger().error(f'This node could not be {what}:\n{traceback.format_exc()}')
            return TransitionCallbackReturn.ERROR
        return TransitionCallbackReturn.SUCCESS
