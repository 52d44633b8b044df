# SPDX-License-Identifier: Apache-2.0
"""Do plans, one at a time: the node `skill_executor` with the action `execute_plan`."""

from __future__ import annotations

import json
import sys
from typing import Any

from humanoid_common.node_parameters import NodeParameters
from humanoid_common.qos import LATCHED
from humanoid_common.running import run_node
from humanoid_common.single_goal import GoalAborted, GoalCanceled, RunningGoal, SingleGoal
from humanoid_interfaces.action import ExecutePlan
from llm_planner.actions import Actions
from llm_planner.knowledge import begin_watch, KnowledgeParameters
from llm_planner.plan import check, Plan, PlanError, UnavailableError, words_for
from llm_planner.plan_messages import plan_of
from llm_planner.plan_tree import make_tree, Progress, SkillError, StepNews
from llm_planner.robot import Robot
from py_trees.common import Status
from rclpy.node import Node
from std_msgs.msg import String

__all__ = ['SkillExecutor', 'main']

_PATIENCE_TICKS = 40
"""How often it is looked for a server that is not there; twenty times a second."""


class SkillExecutor(Node):
    """
    Does the steps of plans by the actions of the robot, and says what happens.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('skill_executor', **options)
        told = NodeParameters(self, KnowledgeParameters).current
        self._planner, self._watch = begin_watch(self, told)
        self._robot = Robot(self)
        self._actions = Actions(self._robot, self._watch, self._planner.skills)
        self._states = self.create_publisher(String, 'executor/state', LATCHED)
        self._goals = SingleGoal(self, lambda: '')
        self._goals.offer(ExecutePlan, 'execute_plan', self._work)

    async def _work(self, goal: RunningGoal) -> None:
        """Do a plan; the result says how far it came, whatever happens."""
        goal.result.failed_step = -1
        self._robot.said = []
        try:
            await self._do(goal)
        except GoalAborted as error:
            if error.name != 'PREEMPTED':
                self._robot.say(str(error))
            raise
        finally:
            goal.result.said = self._robot.said

    async def _checked(self, goal: RunningGoal) -> Plan:
        """Return the plan of a goal; wait a while for what it needs and may be starting."""
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
        told = {'command': plan.command, 'steps': steps}

        def tell(news: StepNews) -> None:
            if news.index >= 0:
                steps[news.index]['state'] = news.state
            self._states.publish(String(data=json.dumps(told)))
            goal.publish_feedback(
                ExecutePlan.Feedback(step=news.index, state=news.state, message=news.text)
            )

        progress = Progress(tell)
        self._actions.begin_plan()
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
    """Run the node."""
    return run_node(SkillExecutor, args)


if __name__ == '__main__':
    sys.exit(main())
