# SPDX-License-Identifier: Apache-2.0
"""The server and the client, each with a partner in the test."""

from __future__ import annotations

import re
import signal
from typing import Any

from action_tutorials_interfaces.action import Fibonacci
from publisher_probe import Probe, Programs
from rclpy.action import ActionClient, ActionServer, GoalResponse
from rclpy.task import Future

SERVER = 'action_tutorials_py.fibonacci_action_server'
CLIENT = 'action_tutorials_py.fibonacci_action_client'


def done(probe: Probe, future: Future[Any]) -> Any:
    """Wait for a future; return its result."""
    probe.until(future.done, 'no answer')
    return future.result()


def test_server(probe: Probe, programs: Programs) -> None:
    """It computes the sequence step by step, rejects what it cannot, and ends during a goal."""
    server = programs.start(SERVER)
    client = ActionClient(probe.node, Fibonacci, 'fibonacci')
    probe.until(client.server_is_ready, 'there is no server')
    feedback: list[list[int]] = []

    def take(message: Any) -> None:
        feedback.append(list(message.feedback.partial_sequence))

    too_high = done(probe, client.send_goal_async(Fibonacci.Goal(order=47)))
    assert not too_high.accepted
    goal = done(probe, client.send_goal_async(Fibonacci.Goal(order=3), feedback_callback=take))
    assert list(done(probe, goal.get_result_async()).result.sequence) == [0, 1, 1, 2]
    assert feedback == [[0, 1, 1], [0, 1, 1, 2]]
    done(probe, client.send_goal_async(Fibonacci.Goal(order=46), feedback_callback=take))
    probe.until(lambda: len(feedback) > 2, 'the last goal is not worked on')
    assert server.end(signal.SIGINT) == 0
    assert "Feedback: array('i', [0, 1, 1, 2])" in server.output
    assert 'A goal of order 47 is rejected' in server.output
    assert 'Traceback' not in server.output
    client.destroy()


def test_client(probe: Probe, programs: Programs) -> None:
    """It waits for a server, then logs the answer, feedback and the result, and ends."""
    wanted = [
        'Waiting for action server...',
        'Sending goal request...',
        'Goal accepted :)',
        "Received feedback: array('i', [0, 1, 1])",
        "Goal succeeded! Result: array('i', [0, 1, 10])",
    ]
    client = programs.start(CLIENT)
    probe.until(lambda: wanted[0] in client.output, 'it does not wait')
    is_heard: Future[None] = Future(executor=probe.node.executor)

    async def execute(goal: Any) -> Fibonacci.Result:
        goal.publish_feedback(Fibonacci.Feedback(partial_sequence=[0, 1, 1]))
        await is_heard
        goal.succeed()
        return Fibonacci.Result(sequence=[0, 1, goal.request.order])

    server = ActionServer(probe.node, Fibonacci, 'fibonacci', execute)
    for text in wanted[1:4]:  # the feedback may come before the answer
        probe.until(lambda text=text: text in client.output, f'it does not say {text!r}')
    is_heard.set_result(None)
    probe.until(lambda: client.process.poll() is not None, 'it does not end')
    assert client.process.returncode == 0
    lines = re.sub(r'\[INFO\] \[[\d.]+\] \[fibonacci_action_client\]: ', '', client.output)
    assert sorted(lines.splitlines()) == sorted(wanted) and lines.endswith(f'{wanted[-1]}\n')
    server.destroy()


def test_client_is_rejected(probe: Probe, programs: Programs) -> None:
    """It says so, and ends."""

    def reject(_: Any) -> GoalResponse:
        return GoalResponse.REJECT

    server = ActionServer(probe.node, Fibonacci, 'fibonacci', print, goal_callback=reject)
    client = programs.start(CLIENT)
    probe.until(lambda: client.process.poll() is not None, 'it does not end')
    assert client.process.returncode == 0 and client.output.endswith('Goal rejected :(\n')
    server.destroy()


def test_client_is_stopped(probe: Probe, programs: Programs) -> None:
    """It ends in order while it waits for a server."""
    client = programs.start(CLIENT)
    probe.until(lambda: 'Waiting for action server...' in client.output, 'it does not wait')
    assert client.end(signal.SIGTERM) == 0
    assert 'Traceback' not in client.output
