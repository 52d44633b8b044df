# SPDX-License-Identifier: Apache-2.0
"""Connection between a launch and a lifecycle node."""

from __future__ import annotations

import asyncio
from typing import Any, TYPE_CHECKING

from launch.event_handler import BaseEventHandler
from launch.logging import get_logger
from launch_ros._service_calls import ServiceCaller, ServiceGoneError
from launch_ros.events.lifecycle import ChangeState, StateTransition
from lifecycle_msgs import srv
from lifecycle_msgs.msg import TransitionEvent

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch_ros._ros_adapter import ROSAdapter
    from launch_ros.actions.lifecycle_node import LifecycleNode


class LifecycleLink:
    """
    Connects a launch to a lifecycle node through its `transition_event` and `change_state`.

    Each message on the topic `transition_event` becomes a StateTransition event; each ChangeState
    event for the node becomes a call of its service `change_state`.

    Parameters
    ----------
    action
        The executed action that is about to start the node.
    context
        The launch context in which events are emitted and handled.
    adapter
        The adapter of the launch's own node, which has the subscription and the service client.

    """

    def __init__(
        self,
        action: LifecycleNode,
        context: LaunchContext,
        adapter: ROSAdapter,
    ) -> None:
        self._action = action
        self._context = context
        self._adapter = adapter
        self._logger = get_logger('launch_ros.actions.lifecycle_node')
        self._one_at_a_time = asyncio.Lock()
        node, name = adapter.ros_node, action.node_name
        self._subscription = node.create_subscription(
            TransitionEvent, f'{name}/transition_event', self._on_transition, 10
        )
        self._caller = ServiceCaller(
            node, srv.ChangeState, name, 'change_state', self._logger, action.get_asyncio_future()
        )
        context.register_event_handler(_ChangeStateHandler(self))

    def _on_transition(self, msg: TransitionEvent) -> None:
        self._context.emit_event_sync(StateTransition(action=self._action, msg=msg))

    def is_target(self, event: Any) -> bool:
        """
        Whether an event requests a transition of this node.

        Parameters
        ----------
        event
            Any event of the launch.

        """
        return isinstance(event, ChangeState) and event.lifecycle_node_matcher(self._action)

    def change_state(self, transition_id: int) -> None:
        """
        Request a transition of the node, once earlier requests are done.

        Returns immediately; a failure is logged.

        Parameters
        ----------
        transition_id
            A constant of lifecycle_msgs/Transition, one of `ChangeState.valid_transitions`.

        """
        if self._adapter.is_running and not self._context.is_shutdown:
            task = self._adapter.start_task(self._change_state(transition_id))
            self._context.add_completion_future(task)
        else:
            self._caller.report_abandoned()

    async def _change_state(self, transition_id: int) -> None:
        request = srv.ChangeState.Request()
        request.transition.id = transition_id
        problem = ''
        async with self._one_at_a_time:
            try:
                answer = await self._caller.call(request)
            except ServiceGoneError as error:
                problem = str(error)
            else:
                if answer.success:
                    return
        self._report_failure(transition_id, problem)

    def _report_failure(self, transition_id: int, problem: str) -> None:
        self._logger.error(
            "Failed to make transition '%s' for LifecycleNode '%s'",
            ChangeState.valid_transitions[transition_id],
            self._action.node_name,
        )
        if problem:
            self._logger.error('%s', problem)


class _ChangeStateHandler(BaseEventHandler):
    """Event handler that forwards ChangeState events to the link of the node."""

    def __init__(self, link: LifecycleLink) -> None:
        super().__init__(matcher=link.is_target)
        self._link = link

    def handle(self, event: Any, context: LaunchContext) -> None:
        """Request the transition of the event."""
        super().handle(event, context)
        self._link.change_state(event.transition_id)
