# SPDX-License-Identifier: Apache-2.0
"""Navigation to the pose at which docking starts."""

from __future__ import annotations

from collections.abc import Callable
import math
from typing import Any

from action_msgs.msg import GoalStatus
from geometry_msgs.msg import PoseStamped
from nav2_msgs.action import DockRobot, NavigateToPose
from nav2_util import ActionAborted, ActionServer, LifecycleNode, Rate
from nav2_util.timing import now_s, steady_clock
from rclpy.action import ActionClient

__all__ = ['StagingNavigator']

_CODE = DockRobot.Result.FAILED_TO_STAGE
_LOOK_HZ = 20.0
_SERVER_TIMEOUT_S = 5.0


class StagingNavigator:
    """
    Client of the navigator for the way to the staging pose.

    Parameters
    ----------
    node
        The docking server.

    """

    def __init__(self, node: LifecycleNode) -> None:
        self._node = node
        self._client = ActionClient(node, NavigateToPose, 'navigate_to_pose')

    def close(self) -> None:
        """Destroy the client."""
        self._client.destroy()

    async def navigate(
        self, server: ActionServer, pose: PoseStamped, tree: str, timeout_s: float
    ) -> None:
        """
        Navigate to a pose; a goal that ends before cancels the navigation.

        Parameters
        ----------
        server
            The action server, whose goal may end.
        pose
            The pose.
        tree
            The file of the behavior tree; empty for the default one.
        timeout_s
            The time limit.

        Raises
        ------
        ActionAborted
            The pose was not reached.

        """
        handle: Any = None
        sending: Any = None
        try:
            # On a steady clock: goals can be canceled even while a simulation is paused.
            with Rate(self._node, _LOOK_HZ, clock=steady_clock()) as rate:
                reason = "The navigator does not offer 'navigate_to_pose'. Is it active?"
                await self._until(
                    server, rate, self._client.server_is_ready, _SERVER_TIMEOUT_S, reason
                )
                sending = self._client.send_goal_async(
                    NavigateToPose.Goal(pose=pose, behavior_tree=tree)
                )
                reason = 'The navigator has not answered.'
                await self._until(server, rate, sending.done, _SERVER_TIMEOUT_S, reason)
                handle = sending.result()
                if not handle.accepted:
                    raise ActionAborted(_CODE, 'The navigator rejected the staging pose.')
                ending = handle.get_result_async()
                limit_s = timeout_s if timeout_s > 0.0 else math.inf
                reason = f'The staging pose was not reached within {limit_s:g} s.'
                await self._until(server, rate, ending.done, limit_s, reason)
        except Exception:
            if handle is not None and handle.accepted:
                handle.cancel_goal_async()
            elif sending is not None:
                sending.add_done_callback(_cancel)
            raise
        answer = ending.result()
        if answer.status != GoalStatus.STATUS_SUCCEEDED:
            told = getattr(answer.result, 'error_msg', '') or 'The navigator gave no reason.'
            raise ActionAborted(_CODE, f'The staging pose was not reached. {told}')

    async def _until(
        self,
        server: ActionServer,
        rate: Rate,
        is_done: Callable[[], bool],
        timeout_s: float,
        reason: str,
    ) -> None:
        """Wait until something is true, or the goal ends, or the time is over."""
        end_s = now_s(self._node) + timeout_s
        while not is_done():
            server.check()
            if now_s(self._node) > end_s:
                raise ActionAborted(_CODE, reason)
            await rate.tick()
        server.check()


def _cancel(sending: Any) -> None:
    handle = sending.result()
    if handle is not None and handle.accepted:
        handle.cancel_goal_async()
