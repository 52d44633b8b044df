# SPDX-License-Identifier: Apache-2.0
"""What becomes of calls that meet a stop, another call, or a client that is gone."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncGenerator, Callable
import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from action_msgs.msg import GoalStatus
from humanoid_interfaces.action import ExecutePlan
from llm_planner.rules import RulePlanner
from llm_planner.skills_file import load_skills, skills_path
from llm_planner.world import World
import pytest
from robot_mcp.audit import AuditLog
import robot_mcp.calls as calls_module
from robot_mcp.calls import Calls
from robot_mcp.deadlines import in_time
from robot_mcp.robot_link import PlanEnd
from robot_mcp.robot_mcp import arguments_of

SKILLS = load_skills(skills_path(''))
WORLD = World({'desk': 'study'}, ('study',))
TURN = {'direction': 'left'}


class Link:
    """A robot that does a plan until it is told to go on."""

    def __init__(self) -> None:
        self.thread = self
        self.go_on = asyncio.Event()
        self.begun: list[str] = []
        self.left = self.stopped = 0
        self.run: Any = None

    async def do(self, function: Callable[..., Any], *told: Any) -> Any:
        """Call at once."""
        await asyncio.sleep(0)
        return function(*told)

    async def found(self, condition: Callable[[], bool]) -> bool:
        """Ask once."""
        await asyncio.sleep(0)
        return condition()

    async def execute(self, plan: Any, run: Any) -> AsyncGenerator[Any, None]:
        """Begin, say nothing for a while, and succeed."""
        self.begun.append(plan.command)
        self.run = run
        yield ExecutePlan.Feedback(step=0, state='running', message='it begins')
        while not self.go_on.is_set():
            await asyncio.sleep(0.001)
            yield None
        yield PlanEnd(GoalStatus.STATUS_SUCCEEDED, ExecutePlan.Result(said=['It is done.']))

    def leave(self, run: Any) -> None:
        """Count."""
        self.left += 1

    async def stop(self) -> int:
        """Count."""
        self.stopped += 1
        return 1


class Assistant:
    """Says yes, after a while if that is wanted."""

    def __init__(self, answer: bool | None = True) -> None:
        self.name = 'a\nclient'
        self.gone: asyncio.Event | None = asyncio.Event()
        self.questions: list[str] = []
        self.told: list[Any] = []
        self.is_deaf = False
        self.answered = asyncio.Event()
        self.answered.set()
        self._answer = answer

    async def asks(self, question: str, request: str) -> bool | None:
        """Answer."""
        self.questions.append(question)
        await self.answered.wait()
        return self._answer

    async def report(self, progress: float, total: float, text: str) -> None:
        """Take note, unless it does not listen."""
        self.told.append((progress, total, text))
        if self.is_deaf:
            await asyncio.Event().wait()


def play(script: Any, tmp_path: Path, **options: bool) -> Any:
    """Run a script with the calls of a robot; return what it returns."""
    logged: list[str] = []

    async def run() -> Any:
        link = Link()
        watch = SimpleNamespace(world=lambda: WORLD)
        calls = Calls(
            link, RulePlanner(SKILLS), watch, AuditLog(tmp_path / 'audit.jsonl', print),
            logged.append, **{'allow_motion': True, 'confirm': False, **options},
        )  # fmt: skip
        # The time limit must not be what cancels that whose cancellation is tested.
        task = asyncio.create_task(script(calls, link, logged))
        await asyncio.wait((task,), timeout=20.0)
        assert task.done(), 'It takes too long.'
        return task.result()

    return asyncio.run(run())


async def until(condition: Callable[[], Any]) -> None:
    """Wait for a condition."""
    while not condition():
        await asyncio.sleep(0.001)


def outcomes(tmp_path: Path) -> list[str]:
    """Return what was noted."""
    return [json.loads(each)['outcome'] for each in (tmp_path / 'audit.jsonl').open()]


def test_a_stop_overtakes_a_person(tmp_path: Path) -> None:
    """Who agrees after a stop has agreed too late, however that comes."""

    async def script(calls: Any, link: Link, logged: list[str]) -> Any:
        client = Assistant()
        client.answered.clear()
        call = asyncio.create_task(calls.answer(client, 'turn', TURN))
        await until(lambda: client.questions)
        await calls.answer(Assistant(), 'stop', {})
        client.answered.set()
        return await call, link.begun

    answer, begun = play(script, tmp_path, confirm=True)
    assert answer.is_error and 'said stop' in answer.text and begun == []


def test_a_stop_takes_codes_away(tmp_path: Path) -> None:
    """What was waiting for a code has to be asked for anew."""

    async def script(calls: Any, link: Link, logged: list[str]) -> Any:
        client = Assistant(None)
        await calls.answer(client, 'turn', TURN)
        code = logged[0].rpartition(' ')[2]
        assert '\n' not in logged[0] and 'turn left' in logged[0]
        await calls.answer(client, 'stop', {})
        return await calls.answer(client, 'turn', {**TURN, 'confirmation': code}), link.begun

    answer, begun = play(script, tmp_path, confirm=True)
    assert answer.is_error and begun == []


def test_one_at_a_time(tmp_path: Path) -> None:
    """The second is refused, and so is a third after the first was given up only by its end."""

    async def script(calls: Any, link: Link, logged: list[str]) -> Any:
        first = asyncio.create_task(calls.answer(Assistant(), 'turn', TURN))
        await until(lambda: link.begun)
        second = await calls.answer(Assistant(), 'say', {'text': 'hello'})
        link.go_on.set()
        return await first, second, await calls.answer(Assistant(), 'say', {'text': 'hello'})

    first, second, third = play(script, tmp_path)
    assert first.text == 'It is done.' and not third.is_error
    assert second.is_error and 'turn left' in second.text


def test_many_at_once(tmp_path: Path) -> None:
    """A hundred calls in the same moment: one is done."""

    async def script(calls: Any, link: Link, logged: list[str]) -> Any:
        tasks = [
            asyncio.create_task(calls.answer(Assistant(), 'turn', TURN)) for _ in range(100)
        ]  # fmt: skip
        await until(lambda: sum(each.done() for each in tasks) == 99)
        link.go_on.set()
        return await asyncio.gather(*tasks), link.begun

    answers, begun = play(script, tmp_path)
    assert len(begun) == 1 and sum(not each.is_error for each in answers) == 1


def test_a_client_that_is_gone(tmp_path: Path) -> None:
    """The plan is given up; the next call is done."""

    async def script(calls: Any, link: Link, logged: list[str]) -> Any:
        client = Assistant()
        call = asyncio.create_task(calls.answer(client, 'turn', TURN))
        await until(lambda: link.begun)
        assert client.gone is not None
        client.gone.set()
        answer = await call
        link.go_on.set()
        return answer, link.left, await calls.answer(Assistant(), 'turn', TURN)

    answer, left, after = play(script, tmp_path)
    assert answer.is_error and left == 1 and not after.is_error


def test_a_call_that_is_canceled(tmp_path: Path) -> None:
    """It is given up, and noted."""

    async def script(calls: Any, link: Link, logged: list[str]) -> Any:
        call = asyncio.create_task(calls.answer(Assistant(), 'turn', TURN))
        await until(lambda: link.begun)
        call.cancel()
        with pytest.raises(asyncio.CancelledError):
            await call
        return link.left

    assert play(script, tmp_path) == 1
    assert outcomes(tmp_path) == ['begun', 'canceled by the client']


def test_a_cancellation_is_never_lost() -> None:
    """Not even one that comes at the moment in which what is waited for is done."""

    async def script() -> int:
        lost = 0
        for _ in range(10):
            done = asyncio.get_running_loop().create_future()
            waiting = asyncio.create_task(in_time(done, 10.0))
            await asyncio.sleep(0)
            done.set_result(None)
            waiting.cancel()
            try:
                await waiting
                lost += 1
            except asyncio.CancelledError:
                pass
        return lost

    assert asyncio.run(script()) == 0


def test_a_client_that_does_not_listen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It holds nothing up."""
    monkeypatch.setattr(calls_module, '_REPORT_S', 0.01)

    async def script(calls: Any, link: Link, logged: list[str]) -> Any:
        client = Assistant()
        client.is_deaf = True
        link.go_on.set()
        return await calls.answer(client, 'turn', TURN)

    assert not play(script, tmp_path).is_error


def test_progress_goes_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Also while nothing happens, and never backwards."""
    monkeypatch.setattr(calls_module, '_HEARTBEAT_S', 0.0)

    async def script(calls: Any, link: Link, logged: list[str]) -> Any:
        client = Assistant()
        call = asyncio.create_task(calls.answer(client, 'turn', TURN))
        await until(lambda: len(client.told) > 5)
        link.go_on.set()
        await call
        return client.told

    told = play(script, tmp_path)
    values = [progress for progress, _, _ in told]
    assert values == sorted({*values}) and values[-1] < 1.0 and told[0] == (0.0, 1.0, 'it begins')


def test_nothing_is_done_without_leave(tmp_path: Path) -> None:
    """Whatever is called, whether it moves or not; stop is obeyed."""

    async def script(calls: Any, link: Link, logged: list[str]) -> Any:
        client = Assistant()
        for name in SKILLS.skills:
            if name != 'stop':
                answer = await calls.answer(client, name, {})
                assert answer.is_error, name
        answer = await calls.answer(client, 'say', {'text': 'x', 'confirmation': 'ABCDEF'})
        assert answer.is_error and 'allow_motion' in answer.text
        stopped = await calls.answer(client, 'stop', {})
        return link.begun, link.stopped, stopped.is_error

    assert play(script, tmp_path, allow_motion=False) == ([], 1, False)


def test_options_become_parameters() -> None:
    """Beside those for ROS."""
    assert arguments_of(['p', 'confirm:=true', '--ros-args', '-r', 'a:=b']) == [
        'p', '--ros-args', '-p', 'confirm:=true', '-r', 'a:=b',
    ]  # fmt: skip
    assert arguments_of(['p', 'port:=0']) == ['p', '--ros-args', '-p', 'port:=0']
    assert arguments_of(['p', '/a:=b']) == ['p', '/a:=b', '--ros-args']
