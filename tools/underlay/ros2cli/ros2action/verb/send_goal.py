# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 action send_goal`: it waits for the result, or cancels the goal at a signal."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from contextlib import contextmanager
import signal
import sys
from textwrap import indent
from typing import Any

from ros2action.verb import VerbExtension
from ros2cli.arguments import add_node_arguments
from ros2cli.messages.lookup import get_passed_type, type_name
from ros2cli.messages.outgoing import OutgoingMessage
from ros2cli.messages.text import to_yaml
from ros2cli.messages.values import add_values_arguments, values_text
from ros2cli.names import absolute
from ros2cli.waiting import Patience, wait_until

FIELD_ERROR = 'Failed to populate message fields: {!r}'
STATUSES = ('UNKNOWN', 'ACCEPTED', 'EXECUTING', 'CANCELING', 'SUCCEEDED', 'CANCELED', 'ABORTED')
"""The constants of `action_msgs/msg/GoalStatus`, from 0 on."""
ENDS = ('SUCCEEDED', 'CANCELED', 'ABORTED')
CANCEL_TEXTS = {
    0: 'Goal canceled.',
    1: 'Failed to cancel goal: the server rejected the request',
    3: 'Failed to cancel goal: it has already ended',
}
"""What the return codes of `action_msgs/srv/CancelGoal` mean."""
CANCEL_FAILURE = 'Failed to cancel goal: the server does not know it'
LAST_WORDS_S = 5.0


class SendGoalVerb(VerbExtension):
    """Send an action goal."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the action's name and type, the values of the goal and the option for feedback.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_node_arguments(parser)
        parser.add_argument('action_name', help="Name of the ROS action (e.g. '/fibonacci')")
        parser.add_argument(
            'action_type', help="Type of the ROS action (e.g. 'tf2_msgs/action/LookupTransform')"
        )
        add_values_arguments(parser, 'goal')
        parser.add_argument(
            '-f', '--feedback', action='store_true', help='Echo feedback messages for the goal'
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Send a goal and print its result; Ctrl-C or SIGTERM cancels the goal.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        Raises
        ------
        RuntimeError
            The type, the name or the values are wrong, or the server disappears.

        """
        from ros2action.api import action_hint
        from ros2cli.node.direct import DirectNode

        action_type = get_passed_type(args.action_type, 'action')
        goal = OutgoingMessage(action_type.Goal(), values_text(args), FIELD_ERROR)
        name = absolute(args.action_name, 'action')
        with DirectNode(args, survives_interrupt=True) as node:
            sender = _GoalSender(node, action_type, name, with_feedback=args.feedback)
            sender.wait_for_server(lambda: action_hint(node.graph, name, type_name(action_type)))
            sender.send(goal)
        return None


class _GoalSender:
    """
    Action client that sends a goal and waits for its result.

    Call `wait_for_server`, then `send`.

    Parameters
    ----------
    node
        The node of the client, inside its `with` statement; it is spun while waiting.
    action_type
        The class of the action.
    name
        The full name of the action.
    with_feedback
        Whether to print the feedback.

    """

    def __init__(self, node: Any, action_type: Any, name: str, *, with_feedback: bool) -> None:
        from rclpy.action import ActionClient

        self._node = node
        self._name = name
        self._feedback = _FeedbackPrinter() if with_feedback else None
        self._client = ActionClient(node.node, action_type, name)
        self._check_signals: Callable[[], None] = lambda: None

    def wait_for_server(self, hint: Callable[[], str]) -> None:
        """
        Wait for the action server without a timeout.

        Parameters
        ----------
        hint
            Returns an action that may be meant instead, for a user who waits long, or ''.

        """
        print('Waiting for an action server to become available...')
        patience = Patience(f"a server of the action '{self._name}'", hint)
        wait_until(self._node, self._client.server_is_ready, patience)

    def send(self, message: OutgoingMessage) -> None:
        """
        Send a goal, and print its result.

        SIGINT and SIGTERM cancel the goal before they end the command; each response to that is
        waited for at most 5 s.

        Parameters
        ----------
        message
            The goal; time stamps given as `now` or `auto` are set to the node's time.

        Raises
        ------
        RuntimeError
            The server disappears before the goal has reached a terminal state.
        KeyboardInterrupt, ExternalShutdownException
            SIGINT or SIGTERM was received.

        """
        goal = message.stamped(self._node.get_clock().now().to_msg())
        print(f'Sending goal:\n{_indented(goal, 5)}')
        with _signals_as_requests() as check:
            self._check_signals = check
            self._send(goal)

    def _send(self, goal: Any) -> None:
        from rclpy.executors import ExternalShutdownException

        sending = self._client.send_goal_async(goal, self._feedback)
        try:
            handle = self._wait(sending, 'the acceptance of the goal')
            if handle.accepted:
                self._follow(handle)
            else:
                print('Goal was rejected.')
        except (KeyboardInterrupt, ExternalShutdownException):
            self._cancel(sending)
            raise

    def _follow(self, handle: Any) -> None:
        print(f'Goal accepted with ID: {bytes(handle.goal_id.uuid).hex()}\n')
        if self._feedback:
            self._feedback.begin()
        response = self._wait(handle.get_result_async(), 'the result', tells=not self._feedback)
        print(f'Result:\n{_indented(response.result, 4)}')
        print(f'Goal finished with status: {STATUSES[response.status]}')

    def _cancel(self, sending: Any) -> None:
        """Cancel the goal if it is active; an unresponsive server is not waited for."""
        try:
            handle = self._wait(sending, 'the acceptance of the goal', LAST_WORDS_S)
            if handle.accepted and STATUSES[handle.status] not in ENDS:
                print('Canceling goal...')
                future = handle.cancel_goal_async()
                response = self._wait(future, 'the end of the goal', LAST_WORDS_S)
                print(CANCEL_TEXTS.get(response.return_code, CANCEL_FAILURE))
        except RuntimeError as error:
            print(f'The goal may still be active: {error}', file=sys.stderr)

    def _wait(
        self, future: Any, what: str, timeout_s: float = float('inf'), *, tells: bool = True
    ) -> Any:
        """Wait for the result of a future; raise RuntimeError if the server does not respond."""

        def is_over() -> bool:
            self._check_signals()
            return bool(future.done() or not self._client.server_is_ready())

        patience = Patience(f"{what} from '{self._name}'") if tells else None
        if not wait_until(self._node, is_over, patience, timeout_s):
            raise RuntimeError(f"'{self._name}' has not answered within {timeout_s:g} s")
        if not future.done():
            raise RuntimeError(f"The server of '{self._name}' disappeared before {what} arrived")
        return future.result()


class _FeedbackPrinter:
    """Feedback printer that holds feedback back until its goal is accepted."""

    def __init__(self) -> None:
        """Start by buffering feedback."""
        self._early: list[Any] | None = []

    def __call__(self, message: Any) -> None:
        """Print a feedback message, or buffer it until `begin`."""
        if self._early is None:
            print(f'Feedback:\n{_indented(message.feedback, 4)}')
        else:
            self._early.append(message)

    def begin(self) -> None:
        """Print the buffered feedback, and from now on all feedback immediately."""
        early, self._early = self._early or [], None
        for message in early:
            self(message)


def _indented(message: Any, width: int) -> str:
    """Format a message as indented YAML."""
    return indent(to_yaml(message), ' ' * width)


@contextmanager
def _signals_as_requests() -> Iterator[Callable[[], None]]:
    """
    Handle SIGINT and SIGTERM, and yield a function that raises for the oldest pending one.

    rclpy would shut all communication down at SIGTERM, and an exception inside of a callback or a
    wait loses the message just taken. So callers poll for signals between two steps of work.
    """
    from rclpy.executors import ExternalShutdownException

    exceptions = {signal.SIGINT: KeyboardInterrupt, signal.SIGTERM: ExternalShutdownException}
    received: list[int] = []

    def remember(number: int, _: object) -> None:
        received.append(number)

    def check() -> None:
        if received:
            raise exceptions[signal.Signals(received.pop(0))]

    before = {number: signal.signal(number, remember) for number in exceptions}
    try:
        yield check
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    check()
