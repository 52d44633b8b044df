# SPDX-License-Identifier: Apache-2.0
"""Turn commands into plans, and have them executed: the node `task_planner`."""

from __future__ import annotations

from dataclasses import dataclass
import math
import os
import sys
import threading
import time
import traceback
from typing import Any

from humanoid_common.diagnostics import Diagnostics, PartStatus
from humanoid_common.executing import create_async_service
from humanoid_common.node_parameters import NodeParameters
from humanoid_common.parameters import parameter
from humanoid_common.qos import EVENT, LATCHED
from humanoid_common.running import run_node
from humanoid_interfaces.msg import Plan as PlanMessage
from humanoid_interfaces.srv import MakePlan
from llm_planner.actions import Actions
from llm_planner.dialogue import (
    answer_to,
    confirmation,
    Dialogue,
    Question,
    Refusal,
    with_answers,
)
from llm_planner.executor_client import ExecutorClient
from llm_planner.grammar import tokenized
from llm_planner.health import PlannerHealth
from llm_planner.knowledge import begin_watch, KnowledgeParameters
from llm_planner.model_planner import ModelError, ModelPlanner
from llm_planner.plan import Plan
from llm_planner.plan_messages import plan_message
from llm_planner.replanning import Account, Failure, Remedy, ReplanningState
from llm_planner.world import World
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import String

__all__ = ['PlannerParameters', 'TaskPlanner', 'main']

_ANSWER_S = 60.0
"""How long an answer to a question is accepted."""


@dataclass(frozen=True)
class PlannerParameters(KnowledgeParameters):
    """The parameters of the node."""

    backend: str = parameter(
        'rules',
        'The planner: rules, or a language model (openai) with the rules as a fallback.',
        choices=('rules', 'openai'),
        read_only=True,
    )
    base_url: str = parameter(
        'http://127.0.0.1:11434/v1',
        'The base URL of the language model server.',
        read_only=True,
    )
    model: str = parameter(
        '', 'The model to use; may be empty if the server has only one.', read_only=True
    )
    output_mode: str = parameter(
        'auto',
        'How the model is made to answer in JSON; auto tries each in turn.',
        choices=('auto', 'json_schema', 'json_object', 'text'),
        read_only=True,
    )
    timeout_s: float = parameter(
        15.0,
        'The time limit for the model to make a plan (s).',
        at_least=0.5,
        at_most=120.0,
        read_only=True,
    )
    confirm: str = parameter(
        'never',
        'Which plans have to be confirmed by a person: those that move the robot, all, or none.',
        choices=('never', 'motion', 'always'),
        read_only=True,
    )


class TaskPlanner(Node):
    """
    Node that turns commands into plans, and sends these to the action `execute_plan`.

    Commands arrive on `user_command` and `speech/transcript`. After a failed step it may replan;
    all plans for a command have the stamp of the first.

    The API key of a language model server is read from the environment variable OPENAI_API_KEY.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('task_planner', **options)
        told = NodeParameters(self, PlannerParameters).current
        self._planner, self._watch = begin_watch(self, told, Actions.IMPLEMENTED)
        self._model: ModelPlanner | None = None
        if told.backend == 'openai':
            # Imported only if needed: its HTTP library takes a while to import.
            from llm_planner.model_server import ModelServer

            key = os.environ.get('OPENAI_API_KEY', '')
            server = ModelServer(told.base_url, told.model, key, told.output_mode)
            self._model = ModelPlanner(self._planner.skills, server.answer, told.timeout_s)
        self._dialogue = Dialogue()
        self._newest = 0
        self._asked_s = -math.inf
        self._confirm = told.confirm
        self._health = PlannerHealth(told.backend, told.base_url if self._model else '')
        self._executor_client = ExecutorClient(self, self._say)
        self._plans = self.create_publisher(PlanMessage, 'plan', LATCHED)
        self._speech = self.create_publisher(String, 'speech/say', EVENT)
        self._grammar = self.create_publisher(String, 'speech/grammar', LATCHED)
        for topic in ('user_command', 'speech/transcript'):
            self.create_subscription(String, topic, self._take, EVENT)
        create_async_service(self, MakePlan, '~/plan', self._answer)
        self._diagnostics = Diagnostics(self, self._status)
        # A recogniser takes seconds to load a grammar, so this one has the answers from the start.
        commands = self._planner.to_jsgf(self._watch.world())
        grammar = with_answers(commands, asks_to_confirm=told.confirm != 'never')
        self._grammar.publish(String(data=grammar))

    def _take(self, message: String) -> None:
        """Handle a command: stop immediately, or plan and then execute, ask or reject."""
        self._newest += 1
        if self._planner.is_stop(message.data):
            self.get_logger().info(f'Told to stop: {message.data!r}')
            self._stop()
            self._expect(None)
            self._say('I have stopped.')
        elif self.executor is not None:
            self.executor.create_task(self._obey, message.data, self._newest)

    async def _obey(self, text: str, number: int) -> None:
        """Plan and execute a command, unless a newer one arrives meanwhile."""
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
        """Set the question whose answer is expected, or none."""
        self._dialogue.question = question
        self._asked_s = time.monotonic()

    async def _have_done(self, plan: Plan, number: int) -> None:
        """Execute a plan, and replan after a failure if something else makes sense."""
        stamp = self.get_clock().now().to_msg()
        recovery = ReplanningState(plan, self._planner.skills)
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
        """Execute a plan; return its failure, or None if it succeeded or was given up."""
        made = plan_message(plan, self._planner)
        made.header.stamp = stamp
        steps = '; '.join(each.text for each in made.steps)
        self.get_logger().info(f'{plan.command!r}: {steps}')
        if not self._executor_client.is_ready:
            self._say('I cannot do anything, as the skill executor is not running.')
            return None
        self._health.plans += 1
        self._plans.publish(made)
        return await self._executor_client.execute(made)

    async def _remedy(self, command: str, recovery: ReplanningState) -> Remedy | None:
        """Find a remedy after a failure, with the model if there is one, or with the rules."""
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
        """Plan a command with the model if there is one and it answers, else with the rules."""
        world, question = self._watch.world(), dialogue.question
        is_answer = question is not None and answer_to(tokenized(text), question) is not None
        if self._model is not None and not is_answer:
            dialogue.question = None  # commands that arrive meanwhile do not answer it
            outcome = await self._asked(text, world)
            if not isinstance(outcome, ModelError):
                return outcome
        return self._planner.plan(text, world, dialogue)

    async def _asked(
        self, text: str, world: World, account: Account | None = None
    ) -> Plan | Refusal | ModelError:
        """Query the model for a plan; return its failure as a ModelError."""
        told: Future[Any] = Future(executor=self.executor)
        thread = threading.Thread(target=self._ask, args=(text, world, account, told), daemon=True)
        thread.start()
        outcome: Plan | Refusal | ModelError = await told
        if isinstance(outcome, ModelError):
            self.get_logger().warning(f'{outcome} Planning with the rules instead.')
            self._health.fail(str(outcome), time.monotonic())
        return outcome

    def _ask(self, text: str, world: World, account: Account | None, told: Future[Any]) -> None:
        """Query the model in a separate thread, and pass the outcome to the executor."""
        assert self._model is not None
        outcome: Any
        try:
            outcome = self._model.plan(text, world, account)
        except ModelError as error:
            outcome = error
        except Exception:  # whatever a server sends, the rules take over
            self.get_logger().error(traceback.format_exc())
            outcome = ModelError('The model could not be asked.')
        executor = self.executor
        if executor is not None:
            executor.create_task(told.set_result, outcome)

    def _stop(self) -> None:
        """Cancel the plan that is being executed."""
        self._health.command = ''
        self._executor_client.stop()

    def _status(self) -> list[PartStatus]:
        """Return the diagnostic status of the node."""
        question = self._dialogue.question
        self._health.question = question.text if question is not None else ''
        return [self._health.status(time.monotonic(), has_executor=self._executor_client.is_ready)]

    async def _answer(self, request: MakePlan.Request, response: MakePlan.Response) -> Any:
        """Plan a command without executing it, in a dialogue of its own."""
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
