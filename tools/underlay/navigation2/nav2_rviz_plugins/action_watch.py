# SPDX-License-Identifier: Apache-2.0
"""
Monitor of one action, with goals from any client.

An rclpy client only receives updates on its own goals. Goals of navigation come from
scripts, other pages and `goal_pose` as well; the topics and services below `<action>/_action`
(design.ros2.org/articles/actions.html) report all of them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TYPE_CHECKING
import uuid

from action_msgs.msg import GoalStatus
from nav2_rviz_plugins.progress import Goal, Phase, PHASES
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from robot_console.service_calls import ServiceCalls
from rviz_common.polled_topic import PolledTopic

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['ActionWatch']

STATUS = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
FEEDBACK = QoSProfile(depth=5, reliability=ReliabilityPolicy.RELIABLE)
ACTIVE = (GoalStatus.STATUS_ACCEPTED, GoalStatus.STATUS_EXECUTING, GoalStatus.STATUS_CANCELING)
TIMEOUT_S = 5.0


class ActionWatch:
    """
    Monitor of the newest goal of an action, which it can send and cancel.

    `goal` is the monitored goal: the newest active one, else the last one.

    Parameters
    ----------
    node
        The node that subscribes to the action's topics.
    calls
        Calls the action's services.
    kind
        The type of the action, such as `nav2_msgs.action.NavigateToPose`.
    action
        The name of the action without a namespace, one of `progress.ACTIONS`.
    name
        The same name with the namespace of the robot.

    """

    def __init__(self, node: Node, calls: ServiceCalls, kind: Any, action: str, name: str) -> None:
        self.goal: Goal | None = None
        self.changed = 0
        """A counter of goal starts, to find the newest of several actions."""
        self._node, self._calls, self._impl = node, calls, kind.Impl
        self._kind, self._action, self._name = kind, action, name
        self._statuses: dict[bytes, int] = {}
        self._feedback = PolledTopic(
            node, self._impl.FeedbackMessage, f'{name}/_action/feedback', FEEDBACK
        )
        self._status = node.create_subscription(
            self._impl.GoalStatusMessage, f'{name}/_action/status', self._take_status, STATUS
        )

    @property
    def is_there(self) -> bool:
        """Whether the server is available."""
        service = self._node.resolve_service_name(f'{self._name}/_action/send_goal')
        return bool(self._node.count_services(service))

    def send(self, poses: int, /, **fields: Any) -> Goal:
        """
        Send a goal, and monitor it.

        Parameters
        ----------
        poses
            The number of its poses.
        **fields
            The values of the goal's fields by name.

        Returns
        -------
        Goal
            The goal, whose phase is updated by the responses of the server.

        """
        request = self._impl.SendGoalService.Request()
        identity = uuid.uuid4().bytes
        request.goal_id.uuid = list(identity)
        for name, value in fields.items():
            setattr(request.goal, name, value)
        goal = Goal(self._action, identity, poses=poses, is_own=True)
        self._follow(goal)

        def answer(response: Any, problem: str) -> None:
            if response is None:
                self._fail(goal, f'The goal has not been sent: {self._explained(problem)}')
            elif not response.accepted:
                self._fail(
                    goal,
                    f'{self._full_name()} rejected the goal. Its log says why; is navigation '
                    'active?',
                )
            else:
                goal.phase = max(goal.phase, Phase.ACCEPTED, key=_order)
                self._apply(goal)

        service = f'{self._name}/_action/send_goal'
        self._calls.call(self._impl.SendGoalService, service, request, answer, TIMEOUT_S)
        return goal

    def cancel(self, on_problem: Callable[[str], None]) -> None:
        """
        Cancel all goals of the action, from any client.

        Parameters
        ----------
        on_problem
            Called with an error message if they cannot be canceled, possibly later.

        """
        if self.goal is not None and self.goal.phase is Phase.SENDING:
            on_problem('The goal has not been accepted yet: try again in a moment.')
            return

        def answer(response: Any, problem: str) -> None:
            if response is None:
                on_problem(f'The goal has not been canceled: {self._explained(problem)}')
            elif response.return_code == response.ERROR_REJECTED:
                on_problem(f'{self._full_name()} refuses to cancel the goal.')

        kind = self._impl.CancelGoalService
        service = f'{self._name}/_action/cancel_goal'
        self._calls.call(kind, service, kind.Request(), answer, TIMEOUT_S)

    def update(self) -> None:
        """Process the received feedback on the goal."""
        for message, _ in self._feedback.take():
            goal = self.goal
            if goal is not None and bytes(message.goal_id.uuid) == goal.goal_id:
                goal.take_feedback(message.feedback)

    def look(self) -> None:
        """Fail a goal whose server is gone; call this periodically."""
        goal = self.goal
        if goal is None or goal.phase.is_over or goal.phase is Phase.SENDING or self.is_there:
            return
        self._fail(goal, f'{self._full_name()} has disappeared: the goal is no longer executed.')

    def close(self) -> None:
        """Stop monitoring the action."""
        self._feedback.close()
        self._node.destroy_subscription(self._status)

    def _follow(self, goal: Goal) -> None:
        self.goal = goal
        self.changed += 1

    def _take_status(self, message: Any) -> None:
        """Process the status of all goals of the server; monitor the newest active one."""
        self._statuses, stamps = {}, {}
        for each in message.status_list:
            identity = bytes(each.goal_info.goal_id.uuid)
            self._statuses[identity] = each.status
            stamps[identity] = (each.goal_info.stamp.sec, each.goal_info.stamp.nanosec)
        active = [each for each, status in self._statuses.items() if status in ACTIVE]
        newest = max(active, key=lambda each: stamps[each], default=b'')
        if newest and self._is_news(newest, stamps):
            self._follow(Goal(self._action, newest, Phase.ACCEPTED))
        if self.goal is not None and self.goal.phase is not Phase.SENDING:
            self._apply(self.goal)

    def _is_news(self, newest: bytes, stamps: Mapping[bytes, tuple[int, int]]) -> bool:
        """Whether a goal should replace the monitored one."""
        goal = self.goal
        if goal is None:
            return True
        if goal.phase is Phase.SENDING or goal.goal_id == newest:
            return False
        return goal.phase.is_over or stamps[newest] > stamps.get(goal.goal_id, (0, 0))

    def _apply(self, goal: Goal) -> None:
        """Update a goal to its status on the server."""
        phase = PHASES.get(self._statuses.get(goal.goal_id, 0))
        if phase is None or goal.phase.is_over:
            return
        goal.phase = phase
        if phase.is_over:
            self._ask_for_result(goal)

    def _ask_for_result(self, goal: Goal) -> None:
        request = self._impl.GetResultService.Request()
        request.goal_id.uuid = list(goal.goal_id)

        def answer(response: Any, problem: str) -> None:
            if response is None:
                goal.text = f'Its result is not known: {problem}'
            elif PHASES.get(response.status) is not goal.phase:
                goal.text = 'Its result is not known: the server has forgotten it.'
            else:
                goal.take_result(response.result)

        service = f'{self._name}/_action/get_result'
        self._calls.call(self._impl.GetResultService, service, request, answer, TIMEOUT_S)

    def _fail(self, goal: Goal, reason: str) -> None:
        goal.phase, goal.text = Phase.FAILED, reason

    def _full_name(self) -> str:
        return str(self._node.resolve_service_name(self._name))

    def _explained(self, problem: str) -> str:
        """Rephrase an error message about the hidden service to be about the action."""
        if self.is_there:
            return problem
        return f'there is no server of the action {self._full_name()}. Is navigation running?'


def _order(phase: Phase) -> int:
    return list(Phase).index(phase)
