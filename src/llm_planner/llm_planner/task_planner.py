# SPDX-License-Identifier: Apache-2.0
"""Turn what somebody says into a plan, and have it done: the node `task_planner`."""

from __future__ import annotations

from dataclasses import dataclass
import json
import math
import os
import sys
import threading
import time
import traceback
from typing import Any

from action_msgs.msg import GoalStatus
from humanoid_common.client_goals import cancel_goal
from humanoid_common.diagnostics import Diagnostics, PartStatus
from humanoid_common.executing import create_async_service
from humanoid_common.node_parameters import NodeParameters
from humanoid_common.parameters import parameter
from humanoid_common.qos import EVENT, LATCHED
from humanoid_common.running import run_node
from humanoid_interfaces.action import ExecutePlan
from humanoid_interfaces.msg import Plan as PlanMessage
from humanoid_interfaces.srv import MakePlan
from llm_planner.dialogue import (
    answer_to,
    confirmation,
    Dialogue,
    Question,
    Refusal,
    with_answers,
)
from llm_planner.grammar import tokenized
from llm_planner.health import PlannerHealth
from llm_planner.knowledge import begin_watch, KnowledgeParameters
from llm_planner.model_planner import ModelError, ModelPlanner
from llm_planner.plan import Plan
from llm_planner.plan_messages import failure_of, plan_message
from llm_planner.replanning import Account, Failure, Recovery, Remedy
from llm_planner.world import World
from rclpy.action import ActionClient
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import String

__all__ = ['PlannerParameters', 'TaskPlanner', 'main']

_ANSWER_S = 60.0
"""How long a question waits for its answer."""
_ACCEPT_S, _SENDINGS = 3.0, 3
"""How long the answer to a goal is waited for, and how often it is sent."""
_LOOK_S = 1.0
"""How often the node looks whether the executor is still there."""


@dataclass(frozen=True)
class PlannerParameters(KnowledgeParameters):
    """The parameters of the node."""

    backend: str = parameter(
        'rules',
        'What makes plans: rules, or a language model (openai), with the rules if that fails.',
        choices=('rules', 'openai'),
        read_only=True,
    )
    base_url: str = parameter(
        'http://127.0.0.1:11434/v1',
        'Where the interface of the server of language models begins.',
        read_only=True,
    )
    model: str = parameter(
        '', 'The model to ask; empty for the only one that the server has.', read_only=True
    )
    output_mode: str = parameter(
        'auto',
        'How the model is made to answer in JSON; auto tries one after another.',
        choices=('auto', 'json_schema', 'json_object', 'text'),
        read_only=True,
    )
    timeout_s: float = parameter(
        15.0,
        'How long the model may take for a plan (s).',
        at_least=0.5,
        at_most=120.0,
        read_only=True,
    )
    confirm: str = parameter(
        'never',
        'Which plans are asked about before they are done: those that move the robot, all, none.',
        choices=('never', 'motion', 'always'),
        read_only=True,
    )


class _ExecutorLostError(Exception):
    """The executor of a plan has ended before the plan."""


class TaskPlanner(Node):
    """
    Takes commands from `user_command` and `speech/transcript`, and sends plans to `execute_plan`.

    When a step fails, it may plan anew; all plans for a command have the stamp of the first.

    The key for a server of language models is the variable OPENAI_API_KEY of the environment.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('task_planner', **options)
        told = NodeParameters(self, PlannerParameters).current
        self._planner, self._watch = begin_watch(self, told)
        self._model: ModelPlanner | None = None
        if told.backend == 'openai':
            # Its HTTP library takes a while to import; the rules do without.
            from llm_planner.model_server import ModelServer

            key = os.environ.get('OPENAI_API_KEY', '')
            server = ModelServer(told.base_url, told.model, key, told.output_mode)
            self._model = ModelPlanner(self._planner.skills, server.answer, told.timeout_s)
        self._dialogue = Dialogue()
        self._sent: Any = None
        self._unanswered: dict[Future[Any], int] = {}
        """Whether goals were answered, and how often the executor is looked for until then."""
        self._ends: set[Future[Any]] = set()
        self._run = ''
        self._newest = 0
        self._asked_s = -math.inf
        self._confirm = told.confirm
        self._health = PlannerHealth(told.backend, told.base_url if self._model else '')
        self._client = ActionClient(self, ExecutePlan, 'execute_plan')
        self._plans = self.create_publisher(PlanMessage, 'plan', LATCHED)
        self._speech = self.create_publisher(String, 'speech/say', EVENT)
        self._grammar = self.create_publisher(String, 'speech/grammar', LATCHED)
        for topic in ('user_command', 'speech/transcript'):
            self.create_subscription(String, topic, self._take, EVENT)
        self.create_subscription(String, 'executor/state', self._follow, LATCHED)
        create_async_service(self, MakePlan, '~/plan', self._answer)
        self._diagnostics = Diagnostics(self, self._status)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._lookout = self.create_timer(_LOOK_S, self._look_for_executor, clock=steady)
        # A recogniser takes seconds to read it, so that it has the answers from the beginning.
        commands = self._planner.to_jsgf(self._watch.world())
        grammar = with_answers(commands, asks_to_confirm=told.confirm != 'never')
        self._grammar.publish(String(data=grammar))

    def _take(self, message: String) -> None:
        """Do what somebody says: stop at once, or plan and act, or ask, or refuse."""
        self._newest += 1
        if self._planner.is_stop(message.data):
            self.get_logger().info(f'Told to stop: {message.data!r}')
            self._stop()
            self._expect(None)
            self._say('I have stopped.')
        elif self.executor is not None:
            self.executor.create_task(self._obey, message.data, self._newest)

    async def _obey(self, text: str, number: int) -> None:
        """Plan and act, unless something newer was said meanwhile."""
        if time.monotonic() - self._asked_s > _ANSWER_S:
            self._dialogue.question = None
        asked = self._dialogue.question
        outcome = await self._outcome(text, self._dialogue)
        if number != self._newest:
            return
        if isinstance(outcome, Plan) and (asked is None or outcome is not asked.subject):
            outcome = confirmation(outcome, self._planner.skills, self._confirm) or outcome
        self._expect(outcome if isinstance(outcome, Question) else None)
        if isinstance(outcome, Plan):
            await self._have_done(outcome, number)
            return
        self.get_logger().info(f'{text[:200]!r}: {outcome.text}')
        self._say(outcome.text)

    def _expect(self, question: Question | None) -> None:
        """Wait for the answer to a question, or for none."""
        self._dialogue.question = question
        self._asked_s = time.monotonic()

    async def _have_done(self, plan: Plan, number: int) -> None:
        """Have a plan done, and another one if it fails and something else makes sense."""
        stamp = self.get_clock().now().to_msg()
        recovery = Recovery(plan, self._planner.skills)
        self._health.command = plan.command
        while (failure := await self._failure(plan, stamp)) is not None:
            if number != self._newest:
                return
            recovery.fail(failure)
            remedy = await self._remedy(plan.command, recovery)
            if number != self._newest:
                return
            if remedy is not None:
                self._say(remedy.text)
            elif recovery.replans:
                self._say('I have given up.')
            if remedy is None or not remedy.steps:
                break
            plan = recovery.take(remedy)
        if number == self._newest:
            self._health.command = ''

    async def _failure(self, plan: Plan, stamp: Any) -> Failure | None:
        """Have a plan done; return how it failed, unless it succeeded or was given up."""
        made = plan_message(plan, self._planner)
        made.header.stamp = stamp
        steps = '; '.join(each.text for each in made.steps)
        self.get_logger().info(f'{plan.command!r}: {steps}')
        if not self._client.server_is_ready():
            self._say('I cannot do anything, as the skill executor is not running.')
            return None
        self._health.plans += 1
        self._plans.publish(made)
        sent = await self._sent_goal(ExecutePlan.Goal(plan=made))
        if sent is None:
            return None
        try:
            answer = await self._end_of(sent)
        except _ExecutorLostError as error:
            self.get_logger().warning(f'{plan.command!r} is given up. {error}')
            return None
        if answer is None:
            return None
        return failure_of(answer.result) if answer.status == GoalStatus.STATUS_ABORTED else None

    async def _sent_goal(self, goal: ExecutePlan.Goal) -> Any:
        """
        Return the future of the answer to a goal, when it is there; None if it is not to be done.

        A goal to which nothing is answered is sent again: an executor that has only just been
        found may not have found this node yet.
        """
        for _ in range(_SENDINGS):
            sent = self._sent = self._client.send_goal_async(goal)
            answered: Future[Any] = Future(executor=self.executor)
            self._unanswered[answered] = round(_ACCEPT_S / _LOOK_S)
            sent.add_done_callback(lambda _, told=answered: told.done() or told.set_result(True))
            is_answered = await answered
            self._unanswered.pop(answered, None)
            if self._sent is not sent:  # told to stop, or something newer to do
                return None
            if is_answered:
                return sent
            cancel_goal(sent)
        self._say('I cannot do anything, as the skill executor does not answer.')
        return None

    async def _end_of(self, sent: Any) -> Any:
        """
        Return the end of a goal that was sent, None if it was not accepted.

        Raises
        ------
        _ExecutorLostError
            The executor has ended, and can answer no more.

        """
        end: Future[Any] = Future(executor=self.executor)

        def give(answered: Any) -> None:
            if not end.done():
                end.set_result(answered.result())

        def wait(accepted: Any) -> None:
            handle = accepted.result()
            if handle is not None and handle.accepted:
                handle.get_result_async().add_done_callback(give)
            elif not end.done():
                end.set_result(None)

        sent.add_done_callback(wait)
        self._ends.add(end)
        try:
            return await end
        finally:
            self._ends.discard(end)

    def _follow(self, message: String) -> None:
        """Notice that another executor runs."""
        try:
            run = json.loads(message.data)['run']
        except (ValueError, TypeError, KeyError):
            return
        before, self._run = self._run, run
        if before and before != run:  # which says that it has stopped
            self._lose('The skill executor was started anew.')

    def _look_for_executor(self) -> None:
        """Notice that the executor has ended, or does not answer."""
        for answered in list(self._unanswered):
            self._unanswered[answered] -= 1
            if self._unanswered[answered] < 0 and not answered.done():
                answered.set_result(False)
        if not self._client.server_is_ready() and self._lose('The skill executor has ended.'):
            self._say('I cannot go on, as the skill executor has ended.')

    def _lose(self, reason: str) -> bool:
        """Wait no longer for what an executor that has ended was doing; return if it did."""
        lost = [each for each in self._ends if not each.done()]
        for end in lost:
            end.set_exception(_ExecutorLostError(reason))
        return bool(lost)

    async def _remedy(self, command: str, recovery: Recovery) -> Remedy | None:
        """Return what to try after a failure: by the model if there is one, or the rules."""
        world = self._watch.world()
        if not recovery.may_go_on(world):
            return None
        if self._model is not None:
            outcome = await self._asked(command, world, recovery.account())
            if isinstance(outcome, Refusal):
                return Remedy((), outcome.text)
            if isinstance(outcome, Plan):
                remedy = recovery.by_model(outcome, world)
                if remedy is not None:
                    return remedy
        return recovery.by_rules(world)

    async def _outcome(self, text: str, dialogue: Dialogue) -> Plan | Question | Refusal:
        """Return what to do about a sentence, by the model if there is one, else by the rules."""
        world, question = self._watch.world(), dialogue.question
        is_answer = question is not None and answer_to(tokenized(text), question) is not None
        if self._model is not None and not is_answer:
            dialogue.question = None  # what is said while the model thinks does not answer it
            outcome = await self._asked(text, world)
            if not isinstance(outcome, ModelError):
                return outcome
        return self._planner.plan(text, world, dialogue)

    async def _asked(
        self, text: str, world: World, account: Account | None = None
    ) -> Plan | Refusal | ModelError:
        """Return what the model makes of a sentence, or how it failed."""
        told: Future[Any] = Future(executor=self.executor)
        thread = threading.Thread(target=self._ask, args=(text, world, account, told), daemon=True)
        thread.start()
        outcome: Plan | Refusal | ModelError = await told
        if isinstance(outcome, ModelError):
            self.get_logger().warning(f'{outcome} The rules plan instead.')
            self._health.fail(str(outcome), time.monotonic())
        return outcome

    def _ask(self, text: str, world: World, account: Account | None, told: Future[Any]) -> None:
        """Ask the model, in a thread of its own, and hand over what came of it."""
        assert self._model is not None
        outcome: Any
        try:
            outcome = self._model.plan(text, world, account)
        except ModelError as error:
            outcome = error
        except Exception:  # whatever a server sends, the rules go on
            self.get_logger().error(traceback.format_exc())
            outcome = ModelError('The model could not be asked.')
        executor = self.executor
        if executor is not None:
            executor.create_task(told.set_result, outcome)

    def _stop(self) -> None:
        """Cancel what is being done, even if it has only just been sent."""
        self._health.command = ''
        sent, self._sent = self._sent, None
        if sent is not None:
            cancel_goal(sent)

    def _status(self) -> list[PartStatus]:
        """Return how the node is, for diagnostics."""
        question = self._dialogue.question
        self._health.question = question.text if question is not None else ''
        has_executor = self._client.server_is_ready()
        return [self._health.status(time.monotonic(), has_executor=has_executor)]

    async def _answer(self, request: MakePlan.Request, response: MakePlan.Response) -> Any:
        """Plan without doing it, in a dialogue of its own."""
        outcome = await self._outcome(request.command, Dialogue())
        if isinstance(outcome, Plan):
            response.success, response.plan = True, plan_message(outcome, self._planner)
            return response
        response.message = outcome.text
        if isinstance(outcome, Question):
            response.choices = list(outcome.choices)
        return response

    def _say(self, text: str) -> None:
        self._speech.publish(String(data=text))


def main(args: list[str] | None = None) -> int:
    """
    Run the node `task_planner`.

    Parameters
    ----------
    args : list[str] | None
        The command line with its ROS arguments; None for that of the process.

    Returns
    -------
    int
        The exit status: 1 if the node cannot start, else 0.

    """
    return run_node(TaskPlanner, args)


if __name__ == '__main__':
    sys.exit(main())
