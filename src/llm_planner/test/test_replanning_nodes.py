# SPDX-License-Identifier: Apache-2.0
"""Planner and executor after a failure, before a confirmation, and what they say of themselves."""

from __future__ import annotations

from collections.abc import Callable, Mapping
import json
from typing import Any

from diagnostic_msgs.msg import DiagnosticStatus
from humanoid_common.testing.ros import RosSandbox
from llm_planner.model_testing import ModelStub, says, serving
from llm_planner.robot_testing import detection, MUGS, RobotStub
import pytest
from std_msgs.msg import String

Begin = Callable[[Mapping[str, Any]], Any]
RED, BLUE, BOX = MUGS
MOVED = detection('red_mug_1', 'mug', 'red mug', at=(-1.0, 0.0, 0.05))
READY = says({'steps': [
    {'skill': 'go_to', 'arguments': {'target': {'class': 'mug', 'id': 'red_mug_1'}}},
    {'skill': 'look_around', 'arguments': {}},
    {'skill': 'turn', 'arguments': {'direction': 'left'}},
], 'refusal': None})  # fmt: skip
"""A plan that can be done as soon as all is known."""


def steps_of(robot: RobotStub) -> list[list[str]]:
    """Return the steps of each plan in words."""
    return [[each.text for each in plan.steps] for plan in robot.plans]


def plans(*steps: tuple[str, Mapping[str, Any]]) -> Any:
    """Return the answer of a model that plans some steps."""
    told = [{'skill': skill, 'arguments': dict(arguments)} for skill, arguments in steps]
    return says({'steps': told, 'refusal': None})


def test_what_is_gone_is_looked_for_elsewhere(ros: RosSandbox, tell: Any) -> None:
    """It is found, and what was asked for is done; what was done is not done again."""
    robot = tell.robot
    robot.after_walk, robot.after_scan = [BLUE, BOX], [MOVED, BLUE, BOX]
    tell('turn left, go to the red mug and tell me where the red mug is')
    ros.wait_until(
        robot.heard(
            'The red mug is not there any more.',
            'I am looking for it.',
            'I see the red mug in the hall.',
            'The red mug is in the hall.',
        ),
        60.0,
        'words',
    )
    assert steps_of(robot) == [
        ['turn left', 'go to the red mug', 'say where the red mug is'],
        ['find the red mug', 'go to the red mug', 'say where the red mug is'],
    ]
    assert [round(angle, 2) for angle in robot.spins].count(1.57) == 1
    assert len(robot.walks) == 2 and robot.walks[-1].x < 1.0


def test_a_room_that_was_searched_lately_is_searched_last(ros: RosSandbox, tell: Any) -> None:
    """Also for another thing, and by another command."""
    robot = tell.robot
    tell('find the can')
    ros.wait_until(lambda: robot.scans == 1, 60.0, 'a look around')
    robot.after_scan = [detection('can_1', 'can', 'red can', at=(3.2, 1.2, 0.75)), *MUGS]
    ros.wait_until(robot.heard('I see the red can on the desk.'), 60.0, 'words')
    walks, scans = len(robot.walks), robot.scans
    assert scans == 2, 'The hall was searched, and the study not wholly.'
    tell('find the bottle')
    ros.wait_until(lambda: robot.scans > scans, 60.0, 'a look around')
    assert len(robot.walks) == walks + 1, 'It looks around in the hall first.'


def test_a_place_is_reached_at_the_second_try(ros: RosSandbox, tell: Any) -> None:
    """The robot stands elsewhere when it tries again; the reason is said once."""
    robot = tell.robot
    robot.failures = ['I am stuck.'] * 2
    tell('go to the desk and say hello')
    ros.wait_until(
        robot.heard('I am stuck.', 'I will look around and try again.', 'hello'), 60.0, 'words'
    )
    stands = [(each.x, each.y) for each in robot.walks]
    assert len(stands) == 3 and stands[0] != stands[1]
    assert robot.said.count('I am stuck.') == 1
    assert steps_of(robot)[1:] == [['look around', 'go to the desk', 'say "hello"']]


def test_coming_back_leads_to_where_the_command_was_given(ros: RosSandbox, tell: Any) -> None:
    """Also when another plan was made on the way."""
    robot = tell.robot
    robot.failures, robot.is_slow = ['I am stuck.'] * 2, True
    tell('go to the study and come back')
    ros.wait_until(lambda: len(robot.walks) == 1, 60.0, 'a walk')
    robot.move_to(1.0, 0.5)
    robot.is_slow = False
    ros.wait_until(lambda: len(robot.walks) == 4, 60.0, 'the way back')
    assert robot.walks[-1].x == pytest.approx(0.0) and robot.walks[-1].y == pytest.approx(0.0)


def test_nothing_is_tried_after_what_is_final(ros: RosSandbox, tell: Any) -> None:
    """A stop, a fall and a newer command end it."""
    robot = tell.robot
    robot.is_slow = True
    tell('go to the study')
    ros.wait_until(lambda: len(robot.walks) == 1, 60.0, 'a walk')
    tell('stop')
    ros.wait_until(lambda: robot.cancelled == 1, 60.0, 'a canceled walk')
    tell('go to the desk')
    ros.wait_until(lambda: len(robot.walks) == 2, 60.0, 'another walk')
    tell('go to the study')
    ros.wait_until(lambda: len(robot.walks) == 3, 60.0, 'a newer walk')
    robot.walking.publish(String(data='fallen'))
    ros.wait_until(robot.heard('The robot has fallen.'), 60.0, 'words')
    tell('what do you see')
    ros.wait_until(robot.heard('The robot has fallen.', 'In the hall I see'), 60.0, 'words')
    assert steps_of(robot) == [
        ['go to the study'], ['go to the desk'], ['go to the study'], ['say what I see'],
    ]  # fmt: skip


def test_a_model_is_told_of_the_failure(ros: RosSandbox, begin: Begin) -> None:
    """As data; what it plans then is done."""
    go = ('go_to', {'target': 'study'})
    with serving(ModelStub(READY)) as stub:
        tell = begin({'backend': 'openai', 'base_url': stub.url, 'timeout_s': 60.0})
        robot = tell.robot
        robot.failures = ['There is a "wall".'] * 2
        stub.asked.clear()
        stub.answers = [
            plans(('say', {'text': 'hi'}), go),
            plans(('say', {'text': 'hi'}), ('go_to', {'target': 'desk'})),
        ]
        tell('greet everybody in the study')
        ros.wait_until(robot.heard('hi', 'There is a "wall".', 'going to the desk'), 60.0, 'words')
        ros.wait_until(lambda: len(robot.walks) == 3, 60.0, 'the third walk')
    first, second = (json.loads(each['messages'][1]['content']) for each in stub.asked)
    assert first == {'wish': 'greet everybody in the study'}
    assert second == {
        **first, 'done': ['say "hi"'], 'failed': 'go to the study',
        'because': 'There is a "wall".',
    }  # fmt: skip
    assert robot.heard('I will try something else: go to the desk.')()
    assert steps_of(robot) == [['say "hi"', 'go to the study'], ['go to the desk']]


@pytest.mark.parametrize(
    'answer, said, count',
    [
        ((500, ''), 'I will look around and try again.', 2),
        (says({'steps': [], 'refusal': 'There is no other way.'}), 'There is no other way.', 1),
        (plans(('go_to', {'target': 'study'})), 'I will look around and try again.', 2),
    ],
)
def test_a_model_that_knows_nothing_new(
    ros: RosSandbox, begin: Begin, answer: Any, said: str, count: int
) -> None:
    """When it fails, or repeats itself, the rules try; what it refuses is said."""
    with serving(ModelStub(READY)) as stub:
        tell = begin({'backend': 'openai', 'base_url': stub.url, 'timeout_s': 60.0})
        robot = tell.robot
        robot.failures = ['There is a wall.'] * 2
        stub.answers = [plans(('go_to', {'target': 'study'})), answer]
        tell('have a look at the study')
        ros.wait_until(robot.heard('There is a wall.', said), 60.0, 'words')
        ros.wait_until(lambda: len(robot.plans) == count, 60.0, 'the plans')


def test_a_plan_is_confirmed(ros: RosSandbox, begin: Begin) -> None:
    """Nothing moves before a yes; after a no, a stop or another command it means nothing."""
    tell = begin({'confirm': 'motion'})
    robot = tell.robot
    tell('turn left and say hello')
    ros.wait_until(robot.heard('Shall I turn left and say "hello"?'), 60.0, 'a question')
    tell('yes', by_voice=True)
    ros.wait_until(lambda: 'hello' in robot.said, 60.0, 'words')
    assert len(robot.spins) == 1 and 'yes [please]' in robot.grammars[-1]
    for answer, reply in (
        ('no', 'All right, I will leave it.'),
        ('stop', 'I have stopped.'),
        ('what do you see', 'In the hall I see'),
    ):
        robot.said.clear()
        tell('turn right')
        ros.wait_until(robot.heard('Shall I turn right?'), 60.0, 'a question')
        tell(answer)
        ros.wait_until(robot.heard(reply), 60.0, 'a reply')
        tell('yes')
        ros.wait_until(robot.heard('I did not understand "yes".'), 60.0, 'a refusal')
    assert len(robot.spins) == 1


def test_what_the_nodes_say_of_themselves(ros: RosSandbox, tell: Any) -> None:
    """Which backend plans, what is done, and which skills are not to be had."""
    statuses: dict[str, DiagnosticStatus] = tell.robot.statuses

    def told(part: str) -> dict[str, str]:
        return {each.key: each.value for each in statuses[part].values}

    names = ('task_planner: planner', 'skill_executor: plan', 'skill_executor: skills')
    ros.wait_until(lambda: {*names} <= {*statuses}, 60.0, 'three statuses')
    skills = statuses['skill_executor: skills']
    assert skills.level == DiagnosticStatus.WARN and 'wave' in skills.message
    assert 'controllers are not running' in told('skill_executor: skills')['wave']
    tell.robot.is_slow = True
    tell('go to the study')
    ros.wait_until(
        lambda: statuses['skill_executor: plan'].message == 'Doing: go to the study', 60.0
    )
    ros.wait_until(lambda: told('task_planner: planner')['doing'] == 'go to the study', 60.0)
    assert statuses['task_planner: planner'].message == 'Planning with rules'
    tell('stop')
    ros.wait_until(lambda: statuses['skill_executor: plan'].message == 'Waiting for a plan', 60.0)
