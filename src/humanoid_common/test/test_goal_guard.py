# SPDX-License-Identifier: Apache-2.0
"""Kill a process that has given goals to others, and see what they are told."""

from __future__ import annotations

from collections.abc import Iterator
import os
from pathlib import Path
import signal
import sys
from typing import Any

from control_msgs.action import GripperCommand
from humanoid_common.goal_guard import GoalGuard, GuardedActionClient
from humanoid_common.testing.actions import ActionCaller
from humanoid_common.testing.processes import is_alive, running_program
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
import pytest
from rclpy.action import ActionServer, CancelResponse
from rclpy.task import Future

CLIENT = """\
import sys
import rclpy
from control_msgs.action import GripperCommand
from humanoid_common.goal_guard import GoalGuard, GuardedActionClient
from humanoid_common.running import run_node

def client():
    node = rclpy.create_node('client')
    guard = GoalGuard(node)
    clients = [GuardedActionClient(guard, GripperCommand, name) for name in ('one', 'another')]
    for client in clients:
        assert client.wait_for_server(30.0)
        for position in (0.01, 0.02):
            sent = client.send_goal_async(GripperCommand.Goal())
            rclpy.spin_until_future_complete(node, sent)
    print('both are on their way', flush=True)
    return node

sys.exit(run_node(client))
"""
PATIENCE_S = 30.0


class Hands:
    """Two actions whose goals never end by themselves, and what was canceled of them."""

    def __init__(self, ros: RosSandbox) -> None:
        """Offer the actions."""
        self.ros, self.node = ros, ros.observer()
        self.ids: dict[str, list[bytes]] = {'one': [], 'another': []}
        self.canceled: dict[str, list[bytes]] = {'one': [], 'another': []}
        self._ends: list[Future[None]] = []
        self._servers = [self._offer(name) for name in self.ids]

    def _offer(self, name: str) -> ActionServer:
        async def execute(handle: Any) -> GripperCommand.Result:
            self.ids[name].append(bytes(handle.goal_id.uuid))
            self._ends.append(Future())
            await self._ends[-1]
            return GripperCommand.Result()

        def cancel(handle: Any) -> CancelResponse:
            self.canceled[name].append(bytes(handle.goal_id.uuid))
            return CancelResponse.ACCEPT

        return ActionServer(self.node, GripperCommand, name, execute, cancel_callback=cancel)

    def have_all(self) -> bool:
        """Return whether the goals of the client are executed, two of each action."""
        return all(len(ids) == 2 for ids in self.ids.values())

    def newest(self) -> dict[str, list[bytes]]:
        """Return the newest goal of each action."""
        return {name: ids[-1:] for name, ids in self.ids.items()}


@pytest.fixture(name='hands')
def _hands() -> Iterator[Hands]:
    """Give two actions."""
    with ros_sandbox() as ros:
        yield Hands(ros)


def guard_of(ros: RosSandbox, pid: int) -> int:
    """Wait until a process has a guard, and return which one that is."""

    def guards() -> list[int]:
        # A process that has just been started has no command for a moment.
        listed = Path(f'/proc/{pid}/task/{pid}/children').read_text().split()
        commands = {int(each): Path(f'/proc/{each}/cmdline').read_bytes() for each in listed}
        return [each for each, command in commands.items() if b'goal_guard' in command]

    ros.wait_until(lambda: len(guards()) == 1, PATIENCE_S, f'a guard of {pid}')
    return guards()[0]


@pytest.mark.parametrize('number', [signal.SIGKILL, signal.SIGINT, signal.SIGTERM])
def test_goals_end_with_who_gave_them(
    hands: Hands, tmp_path: Path, number: signal.Signals
) -> None:
    """However that ended; the goal of somebody else goes on."""
    script = tmp_path / 'client.py'
    script.write_text(CLIENT)
    with running_program([sys.executable, str(script)]) as program:
        hands.ros.wait_until(lambda: 'both' in program.output, PATIENCE_S, program.output)
        guard = guard_of(hands.ros, program.pid)
        # A goal is accepted before it is executed.
        hands.ros.wait_until(hands.have_all, PATIENCE_S, 'the goals')
        given = hands.newest()
        other = ActionCaller(hands.ros, GripperCommand, 'another')
        assert other.send().accepted
        assert not any(hands.canceled.values())
        program.send(number)
        hands.ros.wait_until(lambda: not is_alive(guard), PATIENCE_S, 'the end of the guard')
        hands.ros.wait_until(lambda: hands.canceled == given, PATIENCE_S, program.output)
        other.close()


def test_a_guard_that_was_killed_is_started_anew(hands: Hands) -> None:
    """It learns of the goals that were there before, and its end is waited for."""
    node = hands.ros.observer()
    guard = GoalGuard(node)
    one, another = (GuardedActionClient(guard, GripperCommand, name) for name in hands.ids)
    for client in (one, another):
        hands.ros.wait_until(client.server_is_ready, PATIENCE_S, 'a server')
    first = one.send_goal_async(GripperCommand.Goal())
    hands.ros.wait_until(first.done, PATIENCE_S, 'an answer')
    before = guard_of(hands.ros, os.getpid())
    os.kill(before, signal.SIGKILL)
    hands.ros.wait_until(lambda: not is_alive(before), PATIENCE_S, 'the end of the guard')
    second = another.send_goal_async(GripperCommand.Goal())
    hands.ros.wait_until(second.done, PATIENCE_S, 'an answer')
    after = guard_of(hands.ros, os.getpid())
    guard.close()
    assert not is_alive(after)
    hands.ros.wait_until(
        lambda: hands.canceled == hands.newest(), PATIENCE_S, 'goals that are canceled'
    )
    for client in (one, another):
        client.destroy()
