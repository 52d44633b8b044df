# SPDX-License-Identifier: Apache-2.0
"""Turn what somebody says into a plan, and have it done: the node `task_planner`."""

from __future__ import annotations

from dataclasses import dataclass
import os
import sys
import threading
import traceback
from typing import Any

from humanoid_common.executing import create_async_service
from humanoid_common.node_parameters import NodeParameters
from humanoid_common.parameters import parameter
from humanoid_common.qos import EVENT, LATCHED
from humanoid_common.running import run_node
from humanoid_interfaces.action import ExecutePlan
from humanoid_interfaces.msg import Plan as PlanMessage
from humanoid_interfaces.srv import MakePlan
from llm_planner.dialogue import Dialogue, Question, Refusal
from llm_planner.knowledge import begin_watch, KnowledgeParameters
from llm_planner.model_planner import ModelError, ModelPlanner
from llm_planner.plan import Plan
from llm_planner.plan_messages import plan_message
from llm_planner.world import World
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import String

__all__ = ['PlannerParameters', 'TaskPlanner', 'main']


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


class TaskPlanner(Node):
    """
    Takes commands from `user_command` and `speech/transcript`, and sends plans to `execute_plan`.

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
        self._newest = 0
        self._client = ActionClient(self, ExecutePlan, 'execute_plan')
        self._plans = self.create_publisher(PlanMessage, 'plan', LATCHED)
        self._speech = self.create_publisher(String, 'speech/say', EVENT)
        self._grammar = self.create_publisher(String, 'speech/grammar', LATCHED)
        for topic in ('user_command', 'speech/transcript'):
            self.create_subscription(String, topic, self._take, EVENT)
        create_async_service(self, MakePlan, '~/plan', self._answer)
        self._grammar.publish(String(data=self._planner.to_jsgf(self._watch.world())))

    def _take(self, message: String) -> None:
        """Do what somebody says: stop at once, or plan and act, or ask, or refuse."""
        self._newest += 1
        if self._planner.is_stop(message.data):
            self.get_logger().info(f'Told to stop: {message.data!r}')
            self._stop()
            self._say('I have stopped.')
        elif self.executor is not None:
            self.executor.create_task(self._obey, message.data, self._newest)

    async def _obey(self, text: str, number: int) -> None:
        """Plan and act, unless something newer was said meanwhile."""
        outcome = await self._outcome(text, self._dialogue)
        if number != self._newest:
            return
        if not isinstance(outcome, Plan):
            self.get_logger().info(f'{text[:200]!r}: {outcome.text}')
            self._say(outcome.text)
            return
        made = plan_message(outcome, self._planner)
        made.header.stamp = self.get_clock().now().to_msg()
        steps = '; '.join(each.text for each in made.steps)
        self.get_logger().info(f'{outcome.command!r}: {steps}')
        if not self._client.server_is_ready():
            self._say('I cannot do anything, as the skill executor is not running.')
            return
        self._plans.publish(made)
        self._sent = self._client.send_goal_async(ExecutePlan.Goal(plan=made))

    async def _outcome(self, text: str, dialogue: Dialogue) -> Plan | Question | Refusal:
        """Return what to do about a sentence, by the model if there is one, else by the rules."""
        world = self._watch.world()
        if self._model is None or dialogue.question is not None:
            return self._planner.plan(text, world, dialogue)
        told: Future[Any] = Future(executor=self.executor)
        thread = threading.Thread(target=self._ask, args=(text, world, told), daemon=True)
        thread.start()
        outcome: Any = await told
        if isinstance(outcome, ModelError):
            self.get_logger().warning(f'{outcome} The rules plan instead.')
            return self._planner.plan(text, world, dialogue)
        return outcome  # type: ignore[no-any-return]

    def _ask(self, text: str, world: World, told: Future[Any]) -> None:
        """Ask the model, in a thread of its own, and hand over what came of it."""
        assert self._model is not None
        outcome: Any
        try:
            outcome = self._model.plan(text, world)
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
        sent, self._sent = self._sent, None
        if sent is not None:
            sent.add_done_callback(_cancel)

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


def _cancel(sent: Any) -> None:
    handle = sent.result()
    if handle is not None and handle.accepted:
        handle.cancel_goal_async()


def main(args: list[str] | None = None) -> int:
    """Run the node."""
    return run_node(TaskPlanner, args)


if __name__ == '__main__':
    sys.exit(main())
