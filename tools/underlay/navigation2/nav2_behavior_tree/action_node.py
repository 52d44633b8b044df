# SPDX-License-Identifier: Apache-2.0
"""Base classes of nodes that send goals to an action server, or requests to a service."""

from __future__ import annotations

from typing import Any, ClassVar

from action_msgs.msg import GoalStatus
from nav2_behavior_tree.node import NodeConfig, TreeNode
from nav2_behavior_tree.ports import in_port, out_port, Port
from nav2_behavior_tree.ros_interface import RosInterface
from nav2_behavior_tree.status import NodeStatus

__all__ = ['BASIC_PORTS', 'ERROR_PORTS', 'ActionNode', 'ServiceNode', 'count_recovery']

RUNNING, SUCCESS, FAILURE = NodeStatus.RUNNING, NodeStatus.SUCCESS, NodeStatus.FAILURE

BASIC_PORTS: dict[str, Port] = {
    'server_name': in_port('text', '', 'The name of the action; empty: the usual one.'),
    'server_timeout': in_port('milliseconds', None, "Time to accept a goal; the navigator's."),
}
ERROR_PORTS: dict[str, Port] = {
    'error_code_id': out_port('natural', 'The error code of the result.'),
    'error_msg': out_port('text', 'The error message of the result.'),
}
_LEAST_TIMEOUT_S = 2.0
_LOOK_AGAIN_S, _ASK_AGAIN_S = 1.0, 5.0


def count_recovery(node: TreeNode) -> None:
    """
    Increment the recovery count, for the feedback of the navigator.

    Parameters
    ----------
    node
        A node of the tree; the count is `number_recoveries` on the blackboard of its main tree.

    """
    count = node.blackboard.get('@number_recoveries', 0)
    node.blackboard.set('@number_recoveries', count + 1)


class _Call:
    """A goal in flight: sent, accepted or rejected, finished."""

    def __init__(self, client: Any, goal: Any, now_s: float) -> None:
        self.handle: Any = None
        self.is_rejected = self._is_abandoned = False
        self.answer: Any = None
        self.feedback: Any = None
        self.sent_s = self._asked_s = now_s
        self._sending = client.send_goal_async(goal, self._keep)
        self._sending.add_done_callback(self._begin)

    def _keep(self, message: Any) -> None:
        self.feedback = message.feedback

    def _begin(self, future: Any) -> None:
        handle = future.result()
        if handle is None or not handle.accepted:
            self.is_rejected = True
            return
        self.handle = handle
        if self._is_abandoned:
            handle.cancel_goal_async()
        else:
            handle.get_result_async().add_done_callback(self._end)

    def _end(self, future: Any) -> None:
        self.answer = future.result()

    def ask_again(self, now_s: float) -> None:
        """Request the result again from time to time, as a response can get lost."""
        if self.handle is not None and now_s - self._asked_s > _ASK_AGAIN_S:
            self._asked_s = now_s
            self.handle.get_result_async().add_done_callback(self._end)

    def cancel(self) -> None:
        """Cancel the goal, even if it is not accepted yet."""
        self._is_abandoned = True
        if self.handle is not None and self.answer is None:
            self.handle.cancel_goal_async()


class ActionNode(TreeNode):
    """
    Base class of nodes that send a goal and return the outcome of the action; halting cancels it.

    Subclasses define `action`, `server`, and `make_goal`.

    Parameters
    ----------
    config
        As for `TreeNode`; its context has a `RosInterface`.

    """

    action: ClassVar[Any]
    server: ClassVar[str]
    """The name of the action if the port `server_name` is empty."""
    purpose: ClassVar[str] = 'The action failed'
    """The error message if the server gives none."""

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        ros: RosInterface = config.context.ros
        self.ros = ros
        self.server_name = self.input('server_name') or self.server
        self._client = ros.action_client(self.action, self.server_name)
        self._call: _Call | None = None
        self._start_s = self._looked_s = 0.0
        self._is_absent = False
        timeout = self.input('server_timeout')
        asked_s = ros.server_timeout_s if timeout is None else 1e-3 * timeout
        # Where all servers share one thread, a planner may block it for this long.
        self._accept_s = max(asked_s, _LEAST_TIMEOUT_S)

    def make_goal(self) -> Any:
        """Make the goal to send; return None to succeed without one."""
        raise NotImplementedError

    def changed_goal(self) -> Any:
        """Return a new goal that replaces the running one, if there is one."""
        return None

    def on_success(self, result: Any) -> NodeStatus:
        """
        Write the result of the action to the output ports.

        Parameters
        ----------
        result
            The result message of the action, which has succeeded.

        Returns
        -------
        NodeStatus
            The final status of the node.

        """
        return SUCCESS

    def on_failure(self) -> None:
        """Write the output ports after a failure."""

    def on_tick(self) -> NodeStatus:
        """Send the goal, or check its progress."""
        if self.state is not RUNNING:
            self._call = None
            goal = self.make_goal()
            if goal is None:
                return SUCCESS
            self._goal = goal
            self._start_s = self._looked_s = self.ros.watchdog_s()
        if self._call is None:
            return self._send()
        call = self._call
        if call.answer is not None:
            return self._finish(call.answer)
        if call.is_rejected:
            return self._failed(
                f"The server of '{self.server_name}' rejected the goal. Is its node active?"
            )
        now_s = self.ros.watchdog_s()
        if call.handle is None:
            if now_s - call.sent_s > self._accept_s:
                return self._failed(
                    f"The server of '{self.server_name}' did not answer within "
                    f'{self._accept_s:g} s.'
                )
            return RUNNING
        goal = self.changed_goal()
        if goal is not None:
            self._goal = goal
            self._call = _Call(self._client, goal, now_s)
        elif now_s - self._looked_s > _LOOK_AGAIN_S:
            return self._look(now_s)
        return RUNNING

    def _send(self) -> NodeStatus:
        now_s = self.ros.watchdog_s()
        if self._client.server_is_ready():
            self._call = _Call(self._client, self._goal, now_s)
            self._looked_s, self._is_absent = now_s, False
        elif self._is_absent or now_s - self._start_s > self.ros.wait_for_service_timeout_s:
            # Only once: a retry after a recovery does not wait again.
            self._is_absent = True
            return self._failed(self._absence())
        return RUNNING

    def _look(self, now_s: float) -> NodeStatus:
        """Check whether the server is still available."""
        if self._client.server_is_ready():
            self._looked_s = now_s
            if self._call is not None:
                self._call.ask_again(now_s)
        elif now_s - self._looked_s > _LOOK_AGAIN_S + self.ros.wait_for_service_timeout_s:
            return self._failed(
                f"The server of '{self.server_name}' disappeared while it executed the goal."
            )
        return RUNNING

    def _absence(self) -> str:
        return (
            f"There is no server of '{self.server_name}'; waited "
            f'{self.ros.wait_for_service_timeout_s:g} s. Is its node running?'
        )

    def _failed(self, message: str) -> NodeStatus:
        if self._call is not None:
            self._call.cancel()
        return self._fail_with(int(getattr(self.action.Result, 'UNKNOWN', 0)), message)

    def _fail_with(self, code: int, message: str) -> NodeStatus:
        self._tell(code, message)
        self.on_failure()
        self.fail(message, code)
        return FAILURE

    def _tell(self, code: int, message: str) -> None:
        if 'error_code_id' in self.ports:
            self.output('error_code_id', code)
            self.output('error_msg', message)

    def _finish(self, answer: Any) -> NodeStatus:
        result, self._call = answer.result, None
        if answer.status == GoalStatus.STATUS_SUCCEEDED:
            self._tell(0, '')
            return self.on_success(result)
        if answer.status == GoalStatus.STATUS_CANCELED:
            self._tell(0, '')
            return self.on_canceled()
        code = int(getattr(result, 'error_code', 0))
        reason = getattr(result, 'error_msg', '') or 'The server gave no reason.'
        return self._fail_with(code, f'{self.purpose}: {reason}')

    def on_canceled(self) -> NodeStatus:
        """Return the status of the node after another client has canceled its goal."""
        return SUCCESS

    def on_halt(self) -> None:
        """Cancel the goal."""
        if self._call is not None:
            self._call.cancel()
            self._call = None


class ServiceNode(TreeNode):
    """
    Base class of nodes that send a service request, and end when the response arrives.

    Subclasses define `service`, `make_request`, and `on_answer` if they evaluate the response.

    Parameters
    ----------
    config
        As for `TreeNode`; its context has a `RosInterface`.

    """

    service: ClassVar[Any]
    default_service: ClassVar[str] = ''

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self.ros: RosInterface = config.context.ros
        self.service_name = self.input('service_name') or self.default_service
        self._client = self.ros.service_client(self.service, self.service_name)
        self._future: Any = None
        self._request: Any = None
        self._start_s = 0.0
        timeout = self.input('server_timeout')
        asked_s = self.ros.server_timeout_s if timeout is None else 1e-3 * timeout
        self._answer_s = max(asked_s, _LEAST_TIMEOUT_S)

    def make_request(self) -> Any:
        """Make the request to send; return None to succeed without one."""
        return self.service.Request()

    def on_answer(self, response: Any) -> NodeStatus:
        """
        Evaluate the response of the service.

        Parameters
        ----------
        response
            The response message.

        Returns
        -------
        NodeStatus
            The final status of the node; RUNNING to send `_request`, which may have changed,
            again.

        """
        return SUCCESS

    def on_tick(self) -> NodeStatus:
        """Send the request, or check for the response."""
        now_s = self.ros.watchdog_s()
        if self.state is not RUNNING:
            self._future, self._start_s = None, now_s
            self._request = self.make_request()
            if self._request is None:
                return SUCCESS
        if self._future is None:
            if self._client.service_is_ready():
                self._future, self._start_s = self._client.call_async(self._request), now_s
            elif now_s - self._start_s > self.ros.wait_for_service_timeout_s:
                self.fail(
                    f"There is no service '{self.service_name}'; waited "
                    f'{self.ros.wait_for_service_timeout_s:g} s. Is its node running?'
                )
                return FAILURE
            return RUNNING
        if self._future.done():
            response, self._future = self._future.result(), None
            return self.on_answer(response)
        if now_s - self._start_s > self._answer_s:
            self.on_halt()
            self.fail(
                f"The service '{self.service_name}' did not answer within {self._answer_s:g} s."
            )
            return FAILURE
        return RUNNING

    def on_halt(self) -> None:
        """Stop waiting for the response."""
        if self._future is not None:
            self._client.remove_pending_request(self._future)
            self._future = None
