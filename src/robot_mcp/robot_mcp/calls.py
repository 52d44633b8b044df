# SPDX-License-Identifier: Apache-2.0
"""
Handling of tool calls: every call gets an answer, whatever was sent.

Read-only tools are answered directly. A tool that acts becomes a plan: it needs `allow_motion`,
has to pass the validation of `llm_planner`, may have to be confirmed by a person, and is executed
with the action `execute_plan`, one call at a time. `stop` is always obeyed, immediately.
"""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from contextlib import aclosing
from dataclasses import replace
import time
from typing import Any

from action_msgs.msg import GoalStatus
from humanoid_common.errors import UserError
from humanoid_common.naming import did_you_mean, shortened
from humanoid_interfaces.action import ExecutePlan
from llm_planner.plan import check, Plan, PlanError, UnavailableError, words_for
from llm_planner.plan_messages import plan_message, plan_of
from llm_planner.rules import RulePlanner
from llm_planner.world import listed
from llm_planner.world_watch import WorldWatch
from robot_mcp.audit import AuditLog
from robot_mcp.clients import Answer, Client, NeedsInputError
from robot_mcp.confirmations import Confirmations, request_of
from robot_mcp.deadlines import in_time
from robot_mcp.looking import ReadOnlyTools
from robot_mcp.node_thread import RobotError
from robot_mcp.robot_link import PlanEnd, PlanRun, RobotLink
from robot_mcp.tools import CONFIRMATION, LOOKS, plan_of_call, STOP, TELL, Tool, tools_of

__all__ = ['READ_ONLY', 'Calls']

READ_ONLY = (
    'This robot may only be looked at and stopped. To let assistants move it, a person has to '
    'start this server with allow_motion:=true.'
)
_LONGEST_SENTENCE = 500
_REPORT_S = 2.0
_HEARTBEAT_S = 5.0
"""Period without feedback after which progress is reported to a client again."""
_STOPPED = 'Somebody said stop in the meantime.'


class Calls:
    """
    Handler of tool calls.

    Parameters
    ----------
    link, planner, watch
        The link to the robot, the rule planner, and the observed world.
    audit
        The log in which each call is recorded.
    allow_motion, confirm
        Whether calls may move the robot, and whether a person has to confirm each of them.
    log
        Shows a message to the people at the robot, not to clients.

    """

    def __init__(
        self,
        link: RobotLink,
        planner: RulePlanner,
        watch: WorldWatch,
        audit: AuditLog,
        log: Any,
        *,
        allow_motion: bool,
        confirm: bool,
    ) -> None:
        self._link, self._planner, self._watch = link, planner, watch
        self._audit, self._log = audit, log
        self._allow_motion, self._confirm = allow_motion, confirm
        self.asked = Confirmations()
        """Pending questions of clients to their users."""
        self._codes = Confirmations()
        self._looking = ReadOnlyTools(link, planner.skills, watch, may_move=allow_motion)
        self._busy = ''
        self._stops = 0

    async def tools(self) -> list[Tool]:
        """List the tools for the current state of the world."""
        confirm = self._confirm and self._allow_motion
        world = await self._link.thread.do(self._watch.world)
        return tools_of(self._planner.skills, world, confirm=confirm)

    async def answer(self, client: Client, name: str, arguments: Mapping[str, Any]) -> Answer:
        """
        Execute a tool call, and record it in the audit log.

        Parameters
        ----------
        client
            The calling client.
        name, arguments
            The name of the tool, and the arguments as sent.

        """
        acts = name != STOP and name not in LOOKS
        if acts:
            self._audit.write(client.name, name, arguments, 'begun')
        outcome = 'canceled by the client'
        try:
            answer = await self._answer(client, name, arguments)
            kind = 'failed' if answer.is_error else 'done'
            outcome = f'{kind}: {answer.text}' if acts else kind
        except UserError as error:
            outcome, answer = f'failed: {error}', Answer(str(error), is_error=True)
        except NeedsInputError as error:
            outcome = f'asks: {error}'
            raise
        except Exception as error:
            outcome = f'failed: {type(error).__name__}: {error}'
            raise
        finally:
            self._audit.write(client.name, name, arguments, outcome)
        return answer

    async def _answer(self, client: Client, name: str, arguments: Mapping[str, Any]) -> Answer:
        if name == STOP:
            return await self._stop()
        if name in LOOKS:
            return Answer(*await self._looking.look(name))
        skills = self._planner.skills
        if name != TELL and name not in skills.skills:
            names = [*skills.skills, *LOOKS, TELL]
            hint = did_you_mean(name, names)
            raise PlanError(f"There is no tool '{shortened(name)}'. {hint}".strip())
        stops = self._stops
        given = dict(arguments)
        code = given.pop(CONFIRMATION, None)
        if name == TELL:
            return await self._tell(client, given, code, stops)
        world = await self._link.thread.do(self._watch.world)
        plan = plan_of_call(name, given, skills, world)
        if not self._allow_motion:
            raise RobotError(READ_ONLY)
        return await self._act(client, plan, request_of(name, given), code, stops)

    async def _stop(self) -> Answer:
        """Cancel all plans, and invalidate all pending confirmations."""
        self._stops += 1
        self.asked.forget()
        self._codes.forget()
        count = await self._link.stop()
        return Answer('The robot is stopping.' if count else 'The robot was doing nothing.')

    async def _tell(
        self, client: Client, given: Mapping[str, Any], code: Any, stops: int
    ) -> Answer:
        """Plan a natural-language command with the task planner, and execute it."""
        sentence = given.get('sentence')
        if not isinstance(sentence, str) or not sentence.strip() or len(given) > 1:
            raise PlanError("tell takes exactly one argument: 'sentence', a string.")
        if len(sentence) > _LONGEST_SENTENCE:
            raise PlanError(f'Say it in at most {_LONGEST_SENTENCE} characters.')
        if self._planner.is_stop(sentence):
            return await self._stop()
        made = await self._link.plan(sentence)
        if not made.success:
            return Answer(made.message, is_error=True)
        if not self._allow_motion:
            words = listed([each.text for each in made.plan.steps])
            raise RobotError(f'The robot would {words}. {READ_ONLY}')
        world = await self._link.thread.do(self._watch.world)
        plan = plan_of(made.plan, self._planner, world)
        return await self._act(client, plan, request_of(TELL, given), code, stops)

    async def _act(
        self, client: Client, plan: Plan, request: str, code: Any, stops: int
    ) -> Answer:
        """Validate a plan, have it confirmed if required, and execute it unless stopped."""
        await self._check(plan)
        skills = self._planner.skills
        words = _on_a_line(
            listed([words_for(each, skills[each.skill]) for each in plan.steps], 'and then')
        )
        if self._confirm:
            # A confirmation covers the plan that was shown, not what a planner makes next time.
            request = f'{request} {words}'
            refusal = await self._unconfirmed(client, words, request, code)
            if refusal is not None:
                return refusal
            await self._check(plan)  # the world may have changed meanwhile
        if stops != self._stops:
            raise RobotError(_STOPPED)
        if self._busy:
            raise RobotError(
                f'The robot is still doing what {self._busy}. Wait until it is done, or call stop.'
            )
        self._busy = f'{client.name} asked for: {words}'
        try:
            return await self._do(client, replace(plan, command=words))
        finally:
            self._busy = ''

    async def _check(self, plan: Plan) -> None:
        """Validate a plan; wait for servers that may still be starting."""

        def is_available() -> bool:
            try:
                check(plan, self._planner.skills, self._watch.world())
            except UnavailableError:
                return False
            return True

        if not await self._link.thread.found(is_available):
            check(plan, self._planner.skills, await self._link.thread.do(self._watch.world))

    async def _unconfirmed(
        self, client: Client, words: str, request: str, code: Any
    ) -> Answer | None:
        """Return the answer while a confirmation is missing; None if a person has confirmed."""
        if isinstance(code, str):
            if self._codes.redeem(code, request):
                return None
            raise RobotError('This code is wrong, has expired, or belongs to a different call.')
        agrees = await client.asks(f'Let the robot {words}?', request)
        if agrees:
            return None
        if agrees is not None:
            raise RobotError('The user of the assistant did not agree.')
        new = self._codes.ask(request)
        who = _on_a_line(client.name)
        self._log(f'{who} wants the robot to {words}. To agree, give it the code {new}')
        return Answer(
            f'A person has to agree first: the robot would {words}. The log of the robot shows a '
            f'code; ask the person for it, and call again with the same arguments and '
            f"'{CONFIRMATION}'.",
            is_error=True,
        )

    async def _do(self, client: Client, plan: Plan) -> Answer:
        """Execute a plan, and report progress to the client."""
        run, total = PlanRun(), float(len(plan.steps))
        progress = ceiling = told_s = 0.0
        text = ''
        message = plan_message(plan, self._planner)
        end: PlanEnd | None = None
        try:
            async with aclosing(self._link.execute(message, run)) as told:
                async for news in told:
                    if client.gone is not None and client.gone.is_set():
                        raise RobotError('The client has disconnected.')
                    if isinstance(news, PlanEnd):
                        end = news
                        continue
                    if isinstance(news, ExecutePlan.Feedback):
                        progress = max(progress, news.step + (news.state == 'succeeded'))
                        ceiling = min(total, news.step + 1.0)
                        text = news.message
                    elif time.monotonic() > told_s + _HEARTBEAT_S:
                        progress += 0.05 * (ceiling - progress)
                    else:
                        continue
                    told_s = time.monotonic()
                    await _reported(client, progress, total, text)
        finally:
            if end is None:
                self._link.leave(run)
        assert end is not None
        return _told(end)


def _on_a_line(text: str) -> str:
    """Replace non-printable characters, so that the text cannot imitate its surroundings."""
    return ''.join(each if each.isprintable() else ' ' for each in text)


async def _reported(client: Client, progress: float, total: float, text: str) -> None:
    """Report progress to a client; one that does not read it does not block anything."""
    try:
        await in_time(client.report(progress, total, text), _REPORT_S)
    except asyncio.TimeoutError:
        return


def _told(end: PlanEnd) -> Answer:
    """Convert the result of a plan to an answer."""
    said = ' '.join(end.result.said)
    if end.status == GoalStatus.STATUS_SUCCEEDED:
        return Answer(said or 'Done.')
    if end.status == GoalStatus.STATUS_CANCELED:
        return Answer(f'Stopped. {said}'.strip(), is_error=True)
    reason = end.result.error_msg or 'It did not succeed.'
    return Answer(reason if reason in said or not said else f'{reason} {said}', is_error=True)
