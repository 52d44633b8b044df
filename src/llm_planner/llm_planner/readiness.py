# SPDX-License-Identifier: Apache-2.0
"""Announce once that the robot is ready, or is back after a crash and has stopped its work."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
import math

from action_msgs.srv import CancelGoal
from humanoid_common.qos import LATCHED
from humanoid_interfaces.msg import Plan
from llm_planner.skills import Skill
from llm_planner.world_watch import WorldWatch
from rclpy.client import Client
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.task import Future
from rclpy.time import Time
from std_srvs.srv import Trigger

__all__ = ['BACK', 'INTERRUPTED', 'Patience', 'Readiness']

BACK = 'I am back.'
INTERRUPTED = 'I was interrupted, and have stopped. Please tell me again what to do.'
LOST = 'I do not know where I am.'
STARTING = 'Navigation is still starting.'
UNPLANNED = 'I cannot plan, as the task planner is not running.'
_LOOK_S = 0.25
_SETTLE_S = 1.5
"""How long it takes to discover nodes, and receive latched messages, from before the start."""
_PATIENCE_S = 20.0
_MANAGER = 'lifecycle_manager_navigation/is_active'
_FURTHER_ACTIONS = ('backup', 'right_arm_controller/follow_joint_trajectory')
"""Actions that skills use besides their servers."""
_HANDS = frozenset(('empty_hand', 'holding'))
"""Needs of the skills that use hands."""


class Patience:
    """Timing of the announcement that the robot is ready, from what it lacks over time."""

    def __init__(self) -> None:
        self._lacks: frozenset[str] | None = None
        self._begin_s = self._since_s = 0.0

    def sentence(self, lacks: Mapping[str, str], now_s: float) -> str:
        """
        Return the announcement; empty while something may still be starting.

        Parameters
        ----------
        lacks
            The reasons why skills or resources are unavailable, by name.
        now_s
            The time of a steady clock.

        """
        if self._lacks is None:
            self._begin_s = now_s
        if frozenset(lacks) != self._lacks:
            self._lacks, self._since_s = frozenset(lacks), now_s
        waited_s = now_s - (self._since_s if lacks else self._begin_s)
        if waited_s < (_PATIENCE_S if lacks else _SETTLE_S):
            return ''
        return ' '.join(('I am ready.', *dict.fromkeys(lacks.values())))


class Readiness:
    """
    Monitor that announces when everything that skills need is available.

    A node that is restarted after a crash receives the previous plan, which is latched: it cancels
    the goals that the actions of the robot still pursue for that plan, and says so.

    Parameters
    ----------
    node, watch
        The node that executes skills, and the observed world.
    skills
        The skills that can be executed if their servers are running.
    say
        Speaks a text.

    """

    def __init__(
        self,
        node: Node,
        watch: WorldWatch,
        skills: Iterable[Skill],
        say: Callable[[str], None],
    ) -> None:
        self._node, self._watch, self._skills, self._say = node, watch, tuple(skills), say
        self._patience = Patience()
        self._clock = Clock(clock_type=ClockType.STEADY_TIME)
        self._began_ns = self._now_ns()  # a plan may arrive before the first check
        self._plan_ns: int | None = None
        self._is_navigating = False
        self._asked: Future[Trigger.Response] | None = None
        self._manager = node.create_client(Trigger, _MANAGER)
        self._cancels: dict[Client, Future[CancelGoal.Response] | None] = {}
        self._end_s = math.inf
        node.create_subscription(Plan, 'plan', self._take_plan, LATCHED)
        self._timer = node.create_timer(_LOOK_S, self._look, clock=self._clock)

    def _take_plan(self, message: Plan) -> None:
        self._plan_ns = Time.from_msg(message.header.stamp).nanoseconds

    def _look(self) -> None:
        steady_s = self._steady_s()
        self._began_ns = min(self._began_ns, self._now_ns())
        if self._cancels:
            self._cancel(steady_s)
        elif self._plan_ns is not None and self._plan_ns < self._began_ns < math.inf:
            self._find_servers()
            self._end_s = steady_s + _SETTLE_S
        elif sentence := self._patience.sentence(self._lacks(), steady_s):
            self._end(sentence)

    def _now_ns(self) -> float:
        """Return the time of the node in ns; infinite while it is unknown."""
        return self._node.get_clock().now().nanoseconds or math.inf

    def _steady_s(self) -> float:
        return float(self._clock.now().nanoseconds) * 1e-9

    def _end(self, sentence: str) -> None:
        self._timer.cancel()
        self._node.get_logger().info(sentence)
        self._say(sentence)

    def _lacks(self) -> dict[str, str]:
        """Collect the reasons why abilities of the robot are unavailable now."""
        # A robot without hands is not expected to use them.
        lacks = {
            each.name: self._watch.lack(each)
            for each in self._skills
            if self._watch.has_hands or not _HANDS.intersection(each.needs)
        }
        lacks = {name: reason for name, reason in lacks.items() if reason}
        if not self._hears_planner():
            lacks['plan'] = UNPLANNED
        if 'go_to' not in lacks:
            if not self._navigates():
                lacks['navigation'] = STARTING
            elif self._watch.pose() is None:
                lacks['pose'] = LOST
        return lacks

    def _hears_planner(self) -> bool:
        """Check whether the planner is running, and its goals would arrive."""
        planner = self._node.resolve_service_name('task_planner/plan')
        goals = self._node.resolve_service_name('execute_plan/_action/send_goal')
        return bool(self._node.count_services(planner) and self._node.count_clients(goals))

    def _navigates(self) -> bool:
        """Check whether navigation accepts goals, as far as its lifecycle manager reports."""
        if self._asked is not None and self._asked.done():
            answer, self._asked = self._asked.result(), None
            self._is_navigating = answer is not None and answer.success
        if self._asked is None and self._manager.service_is_ready():
            self._asked = self._manager.call_async(Trigger.Request())
        return self._is_navigating or not self._manager.service_is_ready()

    # After a crash

    def _find_servers(self) -> None:
        """Create the clients that cancel the goals of all actions that skills use."""
        used = {each.server for each in self._skills if each.server_kind == 'action'}
        for name in sorted(used.union(_FURTHER_ACTIONS)):
            client = self._node.create_client(CancelGoal, f'{name}/_action/cancel_goal')
            self._cancels[client] = None

    def _cancel(self, steady_s: float) -> None:
        """Cancel the goals of the servers found so far; at the end, announce the outcome."""
        for client, answer in self._cancels.items():
            if answer is None and client.service_is_ready():
                # A request without an id and a stamp cancels all goals.
                self._cancels[client] = client.call_async(CancelGoal.Request())
        if steady_s < self._end_s:
            return
        answers = [each.result() for each in self._cancels.values() if each and each.done()]
        for client in self._cancels:
            self._node.destroy_client(client)
        self._cancels.clear()
        was_busy = any(each is not None and each.goals_canceling for each in answers)
        self._end(f'{BACK} {INTERRUPTED}' if was_busy else BACK)
