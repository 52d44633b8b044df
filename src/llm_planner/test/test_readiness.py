# SPDX-License-Identifier: Apache-2.0
"""When the robot says that it is ready, and what it says after a crash."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from action_msgs.msg import GoalInfo
from action_msgs.srv import CancelGoal
from humanoid_common.qos import EVENT, LATCHED
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_interfaces.msg import Plan
from llm_planner.readiness import BACK, INTERRUPTED, Patience
from llm_planner.skill_executor import SkillExecutor
import pytest
from std_msgs.msg import String

WAY = {'go_to': 'I cannot find my way.', 'turn': 'I cannot find my way.'}


def test_it_is_ready_when_nothing_is_lacking() -> None:
    """Not before it could have heard what was there before."""
    patience = Patience()
    assert patience.sentence(WAY, 10.0) == patience.sentence({}, 11.0) == ''
    assert patience.sentence({}, 11.5) == 'I am ready.'


def test_what_never_comes_is_named() -> None:
    """Once, when nothing has changed for a while."""
    patience = Patience()
    assert patience.sentence({**WAY, 'see': 'I cannot see.'}, 0.0) == ''
    assert patience.sentence(WAY, 19.0) == patience.sentence(WAY, 38.0) == ''
    assert patience.sentence(WAY, 39.0) == 'I am ready. I cannot find my way.'


class Walk:
    """Navigation that was told to go somewhere, by an executor that is gone."""

    def __init__(self, ros: RosSandbox) -> None:
        self.said: list[str] = []
        self.is_busy, self.asked = True, 0
        node = ros.observer()
        node.create_service(CancelGoal, 'navigate_to_pose/_action/cancel_goal', self._cancel)
        node.create_subscription(
            String, 'speech/say', lambda message: self.said.append(message.data), EVENT
        )
        self.plans = node.create_publisher(Plan, 'plan', LATCHED)
        plan = Plan()
        plan.header.stamp = node.get_clock().now().to_msg()
        self.plans.publish(plan)

    def _cancel(self, request: Any, response: Any) -> Any:
        assert not any(request.goal_info.goal_id.uuid)
        self.asked += 1
        if self.is_busy:
            response.goals_canceling = [GoalInfo()]
        return response


@pytest.fixture
def ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


@pytest.mark.parametrize('is_busy', [True, False])
def test_after_a_crash_it_ends_what_goes_on(ros: RosSandbox, is_busy: bool) -> None:
    """All goals of navigation are canceled, and it is said whether there were any."""
    walk = Walk(ros)
    walk.is_busy = is_busy
    ros.start(SkillExecutor)
    ros.wait_until(lambda: bool(walk.said), 60.0, 'words')
    assert walk.said == [f'{BACK} {INTERRUPTED}' if is_busy else BACK] and walk.asked == 1
