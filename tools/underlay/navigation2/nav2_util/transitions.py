# SPDX-License-Identifier: Apache-2.0
"""What a lifecycle node does in each transition, and how it reports what went wrong."""

from __future__ import annotations

from collections.abc import Callable
import traceback
from typing import Any

from nav2_util.errors import NavigationError
from nav2_util.timing import is_of_coroutine
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
from rclpy.lifecycle import Node as RclpyLifecycleNode

__all__ = ['TransitioningNode']

_KINDS = ('publisher', 'subscription', 'client', 'service', 'timer')


class TransitioningNode(RclpyLifecycleNode):
    """
    Lifecycle node that reports why a transition failed, and destroys what it has created.

    Subclasses override `configure`, `activate`, `deactivate` and `cleanup`. Publishers,
    subscriptions, clients, services and timers that they create in `configure` or `activate` are
    destroyed on cleanup.

    Parameters
    ----------
    node_name
        The node name, unless remapped.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, node_name: str, **options: Any) -> None:
        super().__init__(node_name, **options)
        self._answer_change = self._service_change_state.callback
        self._service_change_state.callback = self._change_if_possible
        self.is_active = False
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
        if outcome is not TransitionCallbackReturn.SUCCESS:
            self._try('cleaned up', self._clean_up)
        return outcome

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Activate publishers and the node.

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
        else:
            super().on_deactivate(state)
        return outcome

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Deactivate the node and publishers.

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

    def _change_if_possible(self, request: Any, response: Any) -> Any:
        """Reject a transition that is invalid in this state; rclpy would end the process."""
        try:
            return self._answer_change(request, response)
        except _rclpy.RCLError:
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
