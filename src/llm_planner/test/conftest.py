# SPDX-License-Identifier: Apache-2.0
"""Planner, executor and a robot for them, in a domain of their own."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_interfaces.action import ExecutePlan
from humanoid_interfaces.srv import MakePlan
from llm_planner.robot_testing import PLACES, RobotStub
from llm_planner.skill_executor import SkillExecutor
from llm_planner.task_planner import TaskPlanner
import pytest
from rclpy.action import ActionClient
from std_msgs.msg import String


@pytest.fixture
def ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


@pytest.fixture
def begin(ros: RosSandbox, tmp_path: Path) -> Iterator[Callable[[Mapping[str, Any]], Any]]:
    """Return what starts all, with parameters of the planner, and returns what tells the robot."""
    clients: list[ActionClient] = []

    def start(parameters: Mapping[str, Any]) -> Any:
        places = tmp_path / 'places.yaml'
        places.write_text(PLACES)
        robot = ros.start(RobotStub)
        executor = ros.start(SkillExecutor, {'places_file': str(places)})
        ros.start(TaskPlanner, {'places_file': str(places), **parameters})

        def send(text: str, *, by_voice: bool = False) -> None:
            publisher = robot.transcripts if by_voice else robot.commands
            publisher.publish(String(data=text))

        send.robot, send.executor = robot, executor  # type: ignore[attr-defined]
        plans = robot.create_client(MakePlan, 'task_planner/plan')
        clients.append(ActionClient(robot, ExecutePlan, 'execute_plan'))

        def is_ready() -> bool:
            """Whether a plan that needs all is made."""
            if not plans.service_is_ready():
                return False
            question = ask('go to the mug').message
            has_model = parameters.get('backend') == 'openai'
            is_aware = has_model or question.startswith('Which mug')
            return is_aware and bool(ask('look around and turn left').success)

        def ask(command: str) -> Any:
            answer = plans.call_async(MakePlan.Request(command=command))
            ros.wait_until(answer.done, 30.0)
            return answer.result()

        ros.wait_until(clients[0].server_is_ready, 60.0, 'the executor')
        for topic in (robot.commands, robot.transcripts):
            ros.wait_until(lambda topic=topic: topic.get_subscription_count() > 0, 60.0, 'ears')
        ros.wait_until(lambda: robot.objects.get_subscription_count() == 2, 60.0, 'both of them')
        ros.wait_until(is_ready, 60.0, 'a planner that knows what runs, and what is remembered')
        return send

    yield start
    for client in clients:
        client.destroy()


@pytest.fixture
def tell(begin: Callable[[Mapping[str, Any]], Any]) -> Any:
    """Start all; return what tells the robot something."""
    return begin({})
