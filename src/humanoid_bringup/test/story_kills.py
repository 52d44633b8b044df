# SPDX-License-Identifier: Apache-2.0
"""Each process of the full system is killed while the robot walks: `make stories`."""

from __future__ import annotations

from collections.abc import Iterator
import math
import os
from pathlib import Path
import re
import signal

from humanoid_bringup.testing import ToldRobot
from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.processes import RunningProgram
from humanoid_common.testing.ros import ros_sandbox
import pytest

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'full_system.launch.py'
STARTED = re.compile(r'\[(\w+)-\d+\]: process started with pid \[(\d+)\]')
ROOMS = ('kitchen', 'corridor')
BACK_S, AGAIN_S, NEXT_S = 60.0, 90.0, 120.0

LOCALISED = 'Localisation restarted;'
OTHERS = (
    'audio_source', 'speech_recognizer', 'speaker', 'object_detector', 'object_memory', 'gaze',
    'navigation_guard', 'robot_state_publisher', 'joint_controller', 'sensor_processor', 'rviz2',
)  # fmt: skip

pytestmark = pytest.mark.timeout(3600)


class System:
    """The full system, and the robot that is told what to do."""

    def __init__(self, program: RunningProgram, told: ToldRobot) -> None:
        self.program, self.told = program, told

    def processes(self, name: str) -> list[int]:
        """Return the numbers of the processes that ran an executable, the newest last."""
        found = STARTED.findall(self.program.output)
        return [int(pid) for each, pid in found if each == name]

    def kill(self, name: str) -> None:
        """Kill a process, and wait until the launch has said so and started it anew."""
        before = self.processes(name)
        os.kill(before[-1], signal.SIGKILL)
        died = re.compile(rf'\[{name}-\d+\]: process has died \[pid {before[-1]}, exit code -9')
        self.told.wait_until(
            lambda: died.search(self.program.output) is not None, 10.0, f'a word on {name}'
        )
        self.told.wait_until(
            lambda: len(self.processes(name)) > len(before), BACK_S, f'another {name}'
        )

    def begin_to_walk(self) -> None:
        """Tell the robot to go to another room, and wait until it does."""
        told = self.told
        told.forget()
        begin = told.robot.pose.position_m
        told.tell(f'go to the {next(room for room in ROOMS if room != told.room)}')
        told.wait_until(lambda: abs(told.robot.pose.position_m - begin) > 0.3, 120.0, 'a walk')

    def turns_when_told(self) -> bool:
        """Tell the robot to turn, and return whether it truly does."""
        told = self.told
        told.forget()
        before_rad = told.robot.pose.yaw_rad
        told.tell('turn left by 30 degrees')
        told.wait_for_the_end(NEXT_S)
        turn_rad = math.remainder(told.robot.pose.yaw_rad - before_rad, math.tau)
        return math.radians(15.0) < turn_rad < math.radians(50.0)


@pytest.fixture(scope='module')
def system() -> Iterator[System]:
    """Start everything, with the page."""
    arguments = ('gui:=true', 'audio:=none', 'real_time_factor:=0.7')
    with ros_sandbox() as ros, running_launch_file(LAUNCH_FILE, *arguments) as program:
        yield System(program, ToldRobot(ros))


@pytest.mark.parametrize('name', OTHERS)
def test_what_only_helps_may_die(system: System, name: str) -> None:
    """The robot arrives without it, and it is back before the next command."""
    system.begin_to_walk()
    system.kill(name)
    system.told.wait_for_the_end()
    assert system.told.has_succeeded, system.told.said
    assert system.turns_when_told()


def test_without_the_planner_the_plan_goes_on(system: System) -> None:
    """The next one is made by the new planner."""
    system.begin_to_walk()
    system.kill('task_planner')
    system.told.wait_for_the_end()
    assert system.told.has_succeeded, system.told.said
    system.told.wait_until_it_plans()
    assert system.turns_when_told()


def test_without_the_executor_the_robot_stops(system: System) -> None:
    """It says so, and does the next command."""
    system.begin_to_walk()
    system.kill('skill_executor')
    system.told.wait_for('I am back. I was interrupted, and have stopped.', AGAIN_S)
    assert system.turns_when_told()


def test_without_navigation_the_robot_stands(system: System) -> None:
    """It begins anew, or says why not; afterwards it knows where it is, and goes there."""
    system.begin_to_walk()
    system.kill('component_container')
    told = system.told
    told.wait_for_the_end()
    assert told.has_succeeded or 'ended before it was done' in ' '.join(told.said), told.said
    told.wait_until(lambda: system.program.output.count(LOCALISED) == 1, AGAIN_S, 'a known place')
    goal = next(room for room in ROOMS if room != told.room)
    told.forget()
    told.tell(f'go to the {goal}')
    told.wait_for_the_end()
    assert told.has_succeeded and told.room == goal, told.said


def test_stop_works_without_the_planner(system: System) -> None:
    """The executor hears it, too, and gives up what another planner has asked for."""
    told = system.told
    system.begin_to_walk()
    system.kill('task_planner')
    told.wait_until_it_plans()
    told.tell('stop')
    told.wait_until(lambda: told.is_over, 10.0, 'the end of the plan')
    told.robot.wait(2.0)
    stopped = told.robot.pose.position_m
    told.robot.wait(2.0)
    assert abs(told.robot.pose.position_m - stopped) < 0.05
