# SPDX-License-Identifier: Apache-2.0
"""The lifecycle manager, which brings other nodes up and down in order, and monitors them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
import time
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from lifecycle_msgs.msg import State, Transition
from nav2_lifecycle_manager.managed_node import ManagedNode, TransitionError
from nav2_msgs.srv import ManageLifecycleNodes
from nav2_util.parameters import parameter, ParameterServer
from nav2_util.services import create_async_service, ServiceError, wait_for
from nav2_util.timing import steady_clock
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import Trigger

__all__ = ['LifecycleManager']

_LOOK_S = 0.1
_ANSWER_S = 0.5
_PATIENCE_S = 5.0


@dataclass(frozen=True)
class LifecycleManagerParameters:
    """Parameters of the lifecycle manager."""

    node_names: list[str] = parameter(
        ['controller_server', 'planner_server', 'behavior_server', 'bt_navigator'],
        'The nodes, in the order in which they are brought up.',
        read_only=True,
    )
    autostart: bool = parameter(
        False, 'Whether the nodes are brought up without being asked for.', read_only=True
    )
    bond_timeout: float = parameter(
        4.0,
        'How long a node may not answer until it counts as gone, s; 0 watches none.',
        low=0.0,
        read_only=True,
    )
    attempt_respawn_reconnection: bool = parameter(
        True, 'Whether nodes that come back are brought up again.', read_only=True
    )
    bond_respawn_max_duration: float = parameter(
        10.0, 'How long it is waited for nodes to come back, s.', low=0.0, read_only=True
    )
    service_timeout: float = parameter(
        10.0, 'How long a node may take for a transition, s.', low=0.1, read_only=True
    )


class LifecycleManager(Node):
    """
    Lifecycle manager: brings nodes up in order, and down in reverse order or after a failure.

    Instead of bonds, it polls the state of the nodes: one that does not respond for `bond_timeout`
    counts as failed. The others are then brought down; if all are available again within
    `bond_respawn_max_duration`, they are brought up.

    Parameters
    ----------
    node_name
        The node name, unless remapped.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, node_name: str = 'lifecycle_manager', **options: Any) -> None:
        super().__init__(node_name, **options)
        parameters = ParameterServer(self)
        self._told = parameters.declare(LifecycleManagerParameters).current
        parameters.report()
        self._managed = [
            ManagedNode(self, name, self._told.service_timeout) for name in self._told.node_names
        ]
        self.is_active = False
        self._is_busy = False
        self._is_looking = False
        self._seen_s: dict[str, float] = {}
        create_async_service(self, ManageLifecycleNodes, '~/manage_nodes', self._manage)
        self.create_service(Trigger, '~/is_active', self._say_whether_active)
        self._diagnostics = self.create_publisher(DiagnosticArray, 'diagnostics', 10)
        self.create_timer(1.0, self._publish_diagnostics, clock=steady_clock())
        self._start = self.create_timer(0.0, self._begin, clock=steady_clock())
        if self._told.bond_timeout:
            self._watch_s = self._told.bond_timeout / 4.0
            self.create_timer(self._watch_s, self._look_after, clock=steady_clock())

    async def startup(self) -> bool:
        """Configure, then activate all nodes; return whether that succeeded."""
        await self._appear()
        return await self._in_order(
            'bring up',
            [
                (each, transition)
                for transition in (
                    Transition.TRANSITION_CONFIGURE,
                    Transition.TRANSITION_ACTIVATE,
                )
                for each in self._managed
            ],
            active=True,
        )

    async def pause(self) -> bool:
        """Deactivate all nodes in reverse order; return whether that succeeded."""
        return await self._backwards('pause', Transition.TRANSITION_DEACTIVATE)

    async def resume(self) -> bool:
        """Activate all nodes; return whether that succeeded."""
        steps = [(each, Transition.TRANSITION_ACTIVATE) for each in self._managed]
        return await self._in_order('resume', steps, active=True)

    async def reset(self) -> bool:
        """Deactivate and clean up all nodes; return whether that succeeded."""
        return await self._backwards(
            'reset', Transition.TRANSITION_DEACTIVATE, Transition.TRANSITION_CLEANUP
        )

    async def configure(self) -> bool:
        """Configure all nodes; return whether that succeeded."""
        steps = [(each, Transition.TRANSITION_CONFIGURE) for each in self._managed]
        return await self._in_order('configure', steps, active=False)

    async def clean_up(self) -> bool:
        """Clean up all nodes; return whether that succeeded."""
        return await self._backwards('clean up', Transition.TRANSITION_CLEANUP)

    async def shutdown(self) -> bool:
        """Shut down all nodes; return whether that succeeded."""
        self.is_active = False
        is_well = True
        for each in reversed(self._managed):
            try:
                await each.shut_down()
            except TransitionError as error:
                self.get_logger().error(str(error))
                is_well = False
        return is_well

    async def _backwards(self, what: str, *transitions: int) -> bool:
        steps = [(each, step) for step in transitions for each in reversed(self._managed)]
        return await self._in_order(what, steps, active=False)

    async def _in_order(
        self, what: str, steps: Iterable[tuple[ManagedNode, int]], active: bool
    ) -> bool:
        """Run transitions until one fails; skip those that a node has already made."""
        self.is_active = False
        for node, transition in steps:
            try:
                if not _is_behind(await node.state(), transition):
                    await node.change(transition)
            except (TransitionError, ServiceError) as error:
                self.get_logger().error(f'Failed to {what} all requested nodes. {error}')
                return False
        self.is_active = active
        self._seen_s.clear()
        self.get_logger().info(
            'Managed nodes are active' if active else f'Done: {what} of all managed nodes'
        )
        return True

    async def _appear(self) -> None:
        """Wait until all nodes are available; log the missing ones periodically."""
        said_s = time.monotonic()
        while True:
            missing = [each.name for each in self._managed if not each.is_there]
            if not missing:
                return
            now_s = time.monotonic()
            if now_s - said_s >= _PATIENCE_S:
                self.get_logger().info(f'Waiting for {", ".join(missing)}')
                said_s = now_s
            await wait_for(self, Future(), _LOOK_S)

    async def _answer(self, timeout_s: float) -> bool:
        """Wait until all nodes respond, as a dead node stays discoverable for a while."""
        end_s = time.monotonic() + timeout_s
        for each in self._managed:
            while not await each.answers(_ANSWER_S):
                if time.monotonic() >= end_s:
                    self.get_logger().error(f"'{each.name}' has not come back")
                    return False
        return True

    def _begin(self) -> None:
        self._start.cancel()
        if self._told.autostart and self.executor is not None:
            self.executor.create_task(self._autostart)

    async def _autostart(self) -> None:
        await self._alone(self.startup)

    async def _alone(self, work: Any) -> bool:
        """Run an operation, unless another one is in progress; return whether it succeeded."""
        if self._is_busy:
            self.get_logger().warning('Busy with another change of state: try again later')
            return False
        self._is_busy = True
        try:
            return bool(await work())
        finally:
            self._is_busy = False

    async def _manage(
        self, request: ManageLifecycleNodes.Request, response: ManageLifecycleNodes.Response
    ) -> ManageLifecycleNodes.Response:
        commands = {
            request.STARTUP: self.startup,
            request.PAUSE: self.pause,
            request.RESUME: self.resume,
            request.RESET: self.reset,
            request.SHUTDOWN: self.shutdown,
            request.CONFIGURE: self.configure,
            request.CLEANUP: self.clean_up,
        }
        if request.command not in commands:
            self.get_logger().warning(f'There is no command {request.command}')
            response.success = False
        else:
            response.success = await self._alone(commands[request.command])
        return response

    def _say_whether_active(
        self, _: Trigger.Request, response: Trigger.Response
    ) -> Trigger.Response:
        response.success = self.is_active
        response.message = 'Managed nodes are active' if self.is_active else 'Not active'
        return response

    def _look_after(self) -> None:
        is_due = self.is_active and not self._is_busy and not self._is_looking
        if is_due and self.executor is not None:
            self._is_looking = True
            self.executor.create_task(self._heartbeat)

    async def _heartbeat(self) -> None:
        try:
            await self._ask_all()
        finally:
            self._is_looking = False

    async def _ask_all(self) -> None:
        """Poll the state of all nodes; when one has failed, bring the others down and wait."""
        for each in self._managed:
            try:
                state = await each.state(self._watch_s)
            except ServiceError:
                state = None
            if not self.is_active or self._is_busy:
                return
            now_s = time.monotonic()
            if state == State.PRIMARY_STATE_ACTIVE:
                self._seen_s[each.name] = now_s
                continue
            # A node not seen since the bring-up counts as last seen one period ago.
            seen_s = self._seen_s.setdefault(each.name, now_s - self._watch_s)
            if state is None and now_s - seen_s < self._told.bond_timeout:
                continue
            why = 'no longer responds' if state is None else 'is no longer active'
            self.get_logger().error(f"'{each.name}' {why}. The other nodes are brought down.")
            await self._alone(self._recover)
            return

    async def _recover(self) -> bool:
        """Bring down the remaining nodes; bring all up again when they are available."""
        self.is_active = False
        for each in reversed(self._managed):
            try:
                if await each.state(self._watch_s) == State.PRIMARY_STATE_ACTIVE:
                    await each.change(Transition.TRANSITION_DEACTIVATE)
                if await each.state(self._watch_s) == State.PRIMARY_STATE_INACTIVE:
                    await each.change(Transition.TRANSITION_CLEANUP)
            except (ServiceError, TransitionError):
                continue
        if not self._told.attempt_respawn_reconnection:
            return False
        if not await self._answer(self._told.bond_respawn_max_duration):
            return False
        self.get_logger().info('All nodes are available again: bringing them up')
        return await self.startup()

    def _publish_diagnostics(self) -> None:
        status = DiagnosticStatus(name=f'{self.get_name()}: Nav2 Health')
        status.level = DiagnosticStatus.OK if self.is_active else DiagnosticStatus.WARN
        status.message = 'Managed nodes are active' if self.is_active else 'Not active'
        message = DiagnosticArray(status=[status])
        message.header.stamp = self.get_clock().now().to_msg()
        self._diagnostics.publish(message)


def _is_behind(state: int, transition: int) -> bool:
    """Whether a node has already reached the target state of a transition, or does not need it."""
    if transition == Transition.TRANSITION_CONFIGURE:
        return state in (State.PRIMARY_STATE_INACTIVE, State.PRIMARY_STATE_ACTIVE)
    if transition == Transition.TRANSITION_ACTIVATE:
        return bool(state == State.PRIMARY_STATE_ACTIVE)
    if transition == Transition.TRANSITION_DEACTIVATE:
        return state in (State.PRIMARY_STATE_INACTIVE, State.PRIMARY_STATE_UNCONFIGURED)
    return bool(state == State.PRIMARY_STATE_UNCONFIGURED)
