# SPDX-License-Identifier: Apache-2.0
"""A program that leads the talker through all states of its lifecycle."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetState
from rclpy.node import Node
from rclpy.task import Future
from tf2_ros.program import run_node

__all__ = ['LifecycleServiceClient', 'main']

TALKER = 'lc_talker'
STEPS = (
    Transition.TRANSITION_CONFIGURE,
    Transition.TRANSITION_ACTIVATE,
    Transition.TRANSITION_DEACTIVATE,
    Transition.TRANSITION_ACTIVATE,
    Transition.TRANSITION_DEACTIVATE,
    Transition.TRANSITION_CLEANUP,
    Transition.TRANSITION_UNCONFIGURED_SHUTDOWN,
)
PAUSE_S = 5.0


class LifecycleServiceClient(Node):
    """
    Client of the lifecycle services of `lc_talker`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('lc_client', **options)
        self._get_state = self.create_client(GetState, f'{TALKER}/get_state')
        self._change_state = self.create_client(ChangeState, f'{TALKER}/change_state')

    async def lead(self) -> None:
        """Go through all transitions, with a pause before each, until one fails."""
        for client in (self._get_state, self._change_state):
            while not client.service_is_ready():
                self.get_logger().info(f'Waiting for the service {client.srv_name}')
                await self.pause(1.0)
        for step in STEPS:
            await self.pause(PAUSE_S)
            request = ChangeState.Request(transition=Transition(id=step))
            answer = await self._change_state.call_async(request)
            if not answer.success:
                self.get_logger().error(f'Failed to trigger transition {step}')
                return
            self.get_logger().info(f'Transition {step} successfully triggered.')
            if step != STEPS[-1]:  # after it there is nobody to ask
                state = await self._get_state.call_async(GetState.Request())
                self.get_logger().info(
                    f'Node {TALKER} has current state {state.current_state.label}.'
                )

    async def pause(self, duration_s: float) -> None:
        """
        Wait.

        Parameters
        ----------
        duration_s
            How long, in s.

        """
        done = Future(executor=self.executor)
        timer = self.create_timer(duration_s, lambda: done.done() or done.set_result(None))
        await done
        self.destroy_timer(timer)


def main(args: Sequence[str] | None = None) -> int:
    """
    Lead the talker; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: LifecycleServiceClient(), args, LifecycleServiceClient.lead)


if __name__ == '__main__':
    sys.exit(main())
