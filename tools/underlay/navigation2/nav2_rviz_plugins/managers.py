# SPDX-License-Identifier: Apache-2.0
"""The lifecycle managers of navigation and localization: their state, and commands to them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
import time
from typing import Any, TYPE_CHECKING

from robot_console.service_calls import ServiceCalls
from std_srvs.srv import Trigger

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['COMMANDS', 'ManagerWatch', 'command_all']

COMMANDS = {'startup': 0, 'pause': 1, 'resume': 2, 'reset': 3, 'shutdown': 4}
"""The commands of `nav2_msgs/srv/ManageLifecycleNodes`."""
ASK_S = 1.0
PATIENCE_S = 3.0
COMMAND_S = 60.0
"""Timeout of commands: bringing up a map and costmaps takes a while."""
ACTIVE, INACTIVE, UNKNOWN = 'active', 'inactive', 'unknown'


class ManagerWatch:
    """
    Monitor of the state of a lifecycle manager, which is polled at 1 Hz.

    Parameters
    ----------
    node
        The node that owns the client.
    name
        The name of the manager, with its namespace.

    """

    def __init__(self, node: Node, name: str) -> None:
        self.name = name
        self.state, self.note = UNKNOWN, ''
        self._node = node
        self._client = node.create_client(Trigger, f'{name}/is_active')
        self._future: Any = None
        self._asked_s = -ASK_S
        self._is_due = True

    @property
    def is_there(self) -> bool:
        """Whether the manager is available."""
        return bool(self._node.count_services(self._client.srv_name))

    def update(self, now_s: float) -> None:
        """
        Process the response of the manager, or poll it again after a second; call this often.

        Parameters
        ----------
        now_s
            The time of `time.monotonic` in s.

        """
        if self._future is not None:
            self._take(now_s)
        elif self._is_due or now_s - self._asked_s >= ASK_S:
            self._asked_s, self._is_due = now_s, False
            self._ask()

    def hurry(self) -> None:
        """Poll again after the pending response, as something has changed."""
        self._is_due = True

    def close(self) -> None:
        """Stop polling."""
        self._node.destroy_client(self._client)

    def told(self) -> dict[str, str]:
        """Return the state to show on the page."""
        return {'state': self.state, 'note': self.note}

    def _ask(self) -> None:
        if self._client.service_is_ready():
            self._future = self._client.call_async(Trigger.Request())
        elif self.is_there:
            self.state, self.note = UNKNOWN, f'{self._client.srv_name} does not connect.'
        else:
            self.state, self.note = UNKNOWN, f'No node offers {self._client.srv_name}.'

    def _take(self, now_s: float) -> None:
        if self._future.done():
            error = self._future.exception()
            if error is not None:
                self.state, self.note = UNKNOWN, str(error)
            else:
                self.state = ACTIVE if self._future.result().success else INACTIVE
                self.note = ''
        elif now_s - self._asked_s > PATIENCE_S:
            self._client.remove_pending_request(self._future)
            self.state, self.note = UNKNOWN, f'{self._client.srv_name} does not answer.'
        else:
            return
        self._future = None


def command_all(
    calls: ServiceCalls,
    kind: Any,
    command: str,
    managers: Sequence[ManagerWatch],
    say: Callable[[str], None],
) -> None:
    """
    Send a command to the managers in order, until one fails.

    Parameters
    ----------
    calls
        The service caller, which ends each call.
    kind
        The class ManageLifecycleNodes.
    command
        A name in `COMMANDS`.
    managers
        The managers in order: localization first, for commands that start nodes.
    say
        Called with a message on the progress.

    """
    if not managers:
        say(f'{command.capitalize()} is done.')
        return
    manager, rest = managers[0], managers[1:]
    begun_s = time.monotonic()
    say(f'{command.capitalize()}: waiting for {manager.name} ...')

    def answer(response: Any, problem: str) -> None:
        manager.hurry()
        took_s = time.monotonic() - begun_s
        if response is None:
            say(f'{command.capitalize()} has failed: {problem}')
        elif not response.success:
            say(
                f'{command.capitalize()} has failed after {took_s:.1f} s: {manager.name} could '
                'not bring all of its nodes there. The Log says which one, and why.'
            )
        else:
            command_all(calls, kind, command, rest, say)

    request = kind.Request(command=COMMANDS[command])
    calls.call(kind, f'{manager.name}/manage_nodes', request, answer, COMMAND_S)
