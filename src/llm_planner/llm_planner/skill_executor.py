# SPDX-License-Identifier: Apache-2.0
"""Execute plans, one at a time: the node `skill_executor` with the action `execute_plan`."""

from __future__ import annotations

import json
import secrets
import sys
from typing import Any

from action_msgs.srv import CancelGoal
from humanoid_common.diagnostics import Diagnostics, PartStatus
from humanoid_common.node_parameters import NodeParameters
from humanoid_common.qos import EVENT, LATCHED
from humanoid_common.running import run_node
from humanoid_common.single_goal import GoalAborted, GoalCanceled, RunningGoal, SingleGoal
from humanoid_interfaces.action import ExecutePlan
from humanoid_interfaces.msg import Plan as PlanMessage
from llm_planner.actions import Actions
from llm_planner.health import skills_status, work_status
from llm_planner.knowledge import begin_watch, KnowledgeParameters
from llm_planner.plan import check, Plan, PlanError, UnavailableError, words_for
from llm_planner.plan_messages import plan_of
from llm_planner.plan_tree import make_tree, Progress, StepNews
from llm_planner.readiness import Readiness
from llm_planner.robot import RobotInterface
from llm_planner.skills import SkillError
from py_trees.common import Status
from rclpy.node import Node
from std_msgs.msg import String

__all__ = ['SkillExecutor', 'main']

_PATIENCE_TICKS = 40
"""Number of checks for a missing server, at twenty per second."""


class SkillExecutor(Node):
    """
    Node that executes the steps of plans with the actions of the robot, and reports on them.

    A plan with the stamp and the command of the previous one is another plan for the same command:
    coming back leads to the pose at the start of the first one, and each reason is spoken only
    once. `executor/state` has an id of the run of the node, so that a client that waits for the
    end of a plan notices that its executor was killed and another one runs.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('skill_executor', **options)
        told = NodeParameters(self, KnowledgeParameters).current
        self._planner, self._watch = begin_watch(self, told, Actions.IMPLEMENTED)
        self._robot = RobotInterface(self)
        self._actions = Actions(self._robot, self._watch, self._planner.skills)
        self._states = self.create_publisher(String, 'executor/state', LATCHED)
        self._command: Any = None
        self._reasons: set[str] = set()
        self._step, self._doing, self._failure = '', '', ''
        self._diagnostics = Diagnostics(self, self._status)
        self._goals = SingleGoal(self, lambda: '')
        self._goals.offer(ExecutePlan, 'execute_plan', self._work)
        self._cancels = self.create_client(CancelGoal, 'execute_plan/_action/cancel_goal')
        for topic in ('user_command', 'speech/transcript'):
            self.create_subscription(String, topic, self._heed_stop, EVENT)
        skills = (each for each in self._planner.skills if each.name in Actions.IMPLEMENTED)
        self._readiness = Readiness(self, self._watch, skills, self._robot.say)
        self._run = secrets.token_hex(8)
        self._tell('', [])

    def _tell(self, command: str, steps: list[dict[str, str]]) -> None:
        """Publish the current command, and the states of its steps."""
        told = {'run': self._run, 'command': command, 'steps': steps}
        self._states.publish(String(data=json.dumps(told)))

    def _heed_stop(self, message: String) -> None:
        """Obey a stop command, even if the planner that sent the plan is gone."""
        if self._planner.is_stop(message.data):
            request = CancelGoal.Request()
            # Cancel all goals accepted up to now: a newer one may be on its way.
            request.goal_info.stamp = self.get_clock().now().to_msg()
            self._cancels.call_async(request)

    async def _work(self, goal: RunningGoal) -> None:
        """Execute a plan; the result reports how far it came in every case."""
        goal.result.failed_step = -1
        self._robot.said = []
        self._begin(goal.request.plan)
        try:
            await self._do(goal)
        except GoalAborted as error:
            if error.name != 'PREEMPTED':
                self._explain(str(error))
            raise
        finally:
            goal.result.said = self._robot.said
            self._doing = ''

    def _begin(self, plan: PlanMessage) -> None:
        """Reset the state of the previous command, unless the plan is another one for it."""
        self._doing, self._step = plan.command or 'a plan', ''
        stamp = (plan.header.stamp.sec, plan.header.stamp.nanosec)
        command = (stamp, plan.command) if any(stamp) else None
        if command is None or command != self._command:
            self._actions.begin_plan()
            self._reasons.clear()
        self._command = command

    def _explain(self, reason: str) -> None:
        """Speak the reason why a plan failed, but not twice for a command."""
        self._failure = reason
        if reason not in self._reasons:
            self._reasons.add(reason)
            self._robot.say(reason)

    def _status(self) -> list[PartStatus]:
        """Return the diagnostic status of the node."""
        missing = self._watch.world().missing
        return [
            work_status(self._doing, self._step, self._failure),
            skills_status(missing, Actions.IMPLEMENTED),
        ]

    async def _checked(self, goal: RunningGoal) -> Plan:
        """Parse and validate the plan of a goal; wait a while for servers that are starting."""
        for tick in range(_PATIENCE_TICKS + 1):
            world = self._watch.world()
            try:
                plan = plan_of(goal.request.plan, self._planner, world)
                check(plan, self._planner.skills, world)
            except UnavailableError as error:
                if world.inhibition or tick == _PATIENCE_TICKS:
                    raise GoalAborted('UNAVAILABLE', str(error)) from None
            except PlanError as error:
                raise GoalAborted('INVALID', str(error)) from None
            else:
                break
            await goal.tick()
        return plan

    async def _do(self, goal: RunningGoal) -> None:
        plan, skills = await self._checked(goal), self._planner.skills
        steps = [
            {'text': words_for(step, skills[step.skill]), 'state': 'waiting'}
            for step in plan.steps
        ]

        def tell(news: StepNews) -> None:
            if news.index >= 0:
                steps[news.index]['state'] = news.state
                self._step = steps[news.index]['text']
            self._tell(plan.command, steps)
            goal.publish_feedback(
                ExecutePlan.Feedback(step=news.index, state=news.state, message=news.text)
            )

        progress = Progress(tell)
        tree = make_tree(
            plan,
            skills,
            self._actions.start,
            lambda: self._watch.inhibition,
            self._robot.now_s,
            progress,
        )
        try:
            while True:
                tree.tick_once()
                if tree.status != Status.RUNNING:
                    break
                await goal.tick()
        except (GoalCanceled, GoalAborted):
            tell(StepNews(progress.index, 'canceled', 'Stopped.'))
            raise
        finally:
            tree.stop(Status.INVALID)
        if tree.status == Status.FAILURE or progress.error is not None:
            goal.result.failed_step = progress.index
            failure = progress.error or SkillError('Something went wrong.', 'UNKNOWN')
            raise GoalAborted(failure.code, str(failure))
        if not self._robot.said:
            self._robot.say('Done.')


def main(args: list[str] | None = None) -> int:
    """
    Run the node `skill_executor`.

    Parameters
    ----------
    args : list[str] | None
        The command line with its ROS arguments; None for that of the process.

    Returns
    -------
    int
        The exit status: 1 if the node cannot start, else 0.

    """
    return run_node(SkillExecutor, args)


if __name__ == '__main__':
    sys.exit(main())
