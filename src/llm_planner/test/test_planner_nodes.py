# SPDX-License-Identifier: Apache-2.0
"""The planner and the executor over DDS, beside servers that do as they are told."""

from __future__ import annotations

from typing import Any

from diagnostic_msgs.msg import KeyValue
from humanoid_common.errors import UserError
from humanoid_common.qos import LATCHED
from humanoid_common.testing.ros import RosSandbox
from humanoid_interfaces.action import ExecutePlan
from humanoid_interfaces.msg import Plan, PlanStep
from humanoid_interfaces.srv import MakePlan
from llm_planner.model_testing import ModelStub, says, serving
from llm_planner.robot_testing import detection, MUGS, RobotStub
from llm_planner.skill_executor import SkillExecutor
from llm_planner.task_planner import TaskPlanner
import pytest
from rclpy.action import ActionClient, ActionServer, GoalResponse
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import String
from vision_msgs.msg import Detection3DArray


def test_what_is_typed_is_done(ros: RosSandbox, tell: Any) -> None:
    """It walks into the room, turns, and tells what is beside the mug."""
    robot = tell.robot
    tell('go to the study, turn left and tell me where the red mug is')
    ros.wait_until(robot.heard('going to the study', 'The red mug is on the desk.'), 60.0, 'words')
    assert 2.0 < robot.walks[0].x < 6.0 and robot.spins == [pytest.approx(1.5708, abs=1e-3)]
    assert [each.text for each in robot.plans[-1].steps] == [
        'go to the study', 'turn left', 'say where the red mug is',
    ]  # fmt: skip


def test_what_is_heard_is_done(ros: RosSandbox, tell: Any) -> None:
    """A question by voice; the words for several things are as people say them."""
    tell('what is on the desk', by_voice=True)
    ros.wait_until(tell.robot.heard('On the desk I see a red mug and a blue mug.'), 60.0, 'words')
    tell('how many mugs do you see', by_voice=True)
    ros.wait_until(tell.robot.heard('There are two mugs.'), 60.0, 'words')
    tell('what is next to the red mug', by_voice=True)
    ros.wait_until(tell.robot.heard('A blue mug is beside the red mug.'), 60.0, 'words')


def test_stop_ends_it(ros: RosSandbox, tell: Any) -> None:
    """The goal of navigation is canceled."""
    robot = tell.robot
    robot.is_slow = True
    tell('go to the study and then say hello')
    ros.wait_until(lambda: robot.walks, 60.0, 'a walk')
    tell('Robot, stop!', by_voice=True)
    ros.wait_until(lambda: robot.cancelled == 1, 10.0, 'a canceled walk')
    ros.wait_until(robot.heard('I have stopped.'), 10.0, 'words')
    assert 'hello' not in robot.said


def test_a_newer_command_takes_over(ros: RosSandbox, tell: Any) -> None:
    """The older walk ends; the newer one begins."""
    robot = tell.robot
    robot.is_slow = True
    tell('go to the study')
    ros.wait_until(lambda: len(robot.walks) == 1, 60.0, 'a walk')
    robot.is_slow = False
    tell('go to the desk')
    ros.wait_until(lambda: len(robot.walks) == 2, 60.0, 'another walk')
    assert robot.walks[1].y == pytest.approx(0.5)


def test_a_failure_is_explained(ros: RosSandbox, tell: Any) -> None:
    """Once, whatever else is tried; what would follow is not done."""
    robot = tell.robot
    robot.failure = 'A dog is in the way.'
    tell('go to the study and then say hello')
    ros.wait_until(robot.heard('A dog is in the way.', 'I have given up.'), 60.0, 'words')
    assert len(robot.walks) == 4 and robot.scans == 1 and 'hello' not in robot.said
    assert robot.said.count('A dog is in the way.') == 1


def test_a_collision_ahead_is_said_in_plain_words(ros: RosSandbox, tell: Any) -> None:
    """Not in those of navigation."""
    robot = tell.robot
    robot.is_hemmed_in = True
    tell('turn left')
    ros.wait_until(robot.heard('Something is in my way, so I have stopped.'), 60.0, 'words')
    assert not [each for each in robot.said if 'collide' in each]


def test_it_turns_to_look_at_what_is_behind(ros: RosSandbox, tell: Any) -> None:
    """What is before it, it looks at with the head alone; a head that does not turn is said."""
    robot = tell.robot
    robot.is_stiff = True
    tell('look at the blue mug')
    unseen = 'I cannot turn my head far enough to see the blue mug'
    ros.wait_until(robot.heard(unseen), 60.0, 'words')
    assert robot.looks and robot.spins == []
    robot.is_stiff = False
    robot.move_to(6.0, 1.2)
    tell('look at the red mug')
    ros.wait_until(lambda: robot.looks and robot.looks[-1].x == pytest.approx(3.2), 60.0, 'a look')
    assert [abs(each) for each in robot.spins] == [pytest.approx(3.14, abs=0.01)]


def test_it_tidies(ros: RosSandbox, tell: Any) -> None:
    """All that is there is carried away; what is too wide stays, and is named."""
    robot = tell.robot
    robot.give_hands()
    robot.too_wide = {'red_mug_1'}
    bowl = detection('bowl_1', 'bowl', at=(3.6, 1.2, 0.75))
    robot.remember([*MUGS, bowl])
    ros.wait_until(lambda: robot.count_subscribers('held_objects') == 2, 60.0, 'both of them')
    tell('move everything from the desk to the shelf')
    ros.wait_until(robot.heard('I have moved the blue mug and the bowl.'), 60.0, 'words')
    (told,) = [each for each in robot.said if 'I have moved' in each]
    assert 'The red mug is still there. red_mug_1 is too wide for my hand.' in told
    assert robot.placed == [('blue_mug_1', 'shelf'), ('bowl_1', 'shelf')]
    robot.too_wide = set()
    tell('move everything from the desk to the shelf')
    ros.wait_until(robot.heard('I have moved the red mug.'), 60.0, 'words')
    tell('move everything from the desk to the shelf')
    ros.wait_until(robot.heard('I see nothing at the desk that I could tidy.'), 60.0, 'words')
    tell('tidy up the desk')
    ros.wait_until(robot.heard('kitchen counter'), 60.0, 'a place that there is not here')


def test_it_stops_when_it_has_lost_what_it_carries(ros: RosSandbox, tell: Any) -> None:
    """It says so on the way, rather than at its end, and does not try again."""
    robot = tell.robot
    robot.give_hands()
    ros.wait_until(lambda: robot.count_subscribers('held_objects') == 2, 60.0, 'both of them')
    tell('take the blue mug')
    ros.wait_until(lambda: robot.held, 60.0, 'a mug in its hand')
    tell('where is the blue mug')
    ros.wait_until(robot.heard('I am holding the blue mug.'), 60.0, 'words')
    robot.is_slow, walks = True, len(robot.walks)
    tell('put it on the shelf')
    ros.wait_until(lambda: len(robot.walks) > walks, 60.0, 'a walk')
    robot.holding.publish(Detection3DArray())
    ros.wait_until(robot.heard('I have lost the blue mug on the way.'), 60.0, 'words')
    ros.wait_until(lambda: robot.cancelled == 1, 60.0, 'a canceled walk')
    assert len(robot.walks) == walks + 1 and robot.placed == []


def test_it_waves_and_points_with_a_hand_that_is_free(ros: RosSandbox, tell: Any) -> None:
    """Whichever that is; it does not wave what it holds, even if it is told to."""
    robot = tell.robot
    robot.give_hands()
    ros.wait_until(lambda: robot.count_subscribers('held_objects') == 2, 60.0, 'both of them')
    tell('wave')
    ros.wait_until(lambda: robot.moved == ['right'], 60.0, 'a wave')
    tell('take the blue mug')
    ros.wait_until(lambda: robot.held, 60.0, 'a mug in its hand')
    tell('wave your right arm')
    ros.wait_until(robot.heard('my right hand is holding the blue mug'), 60.0, 'words')
    tell('wave')
    ros.wait_until(lambda: robot.moved == ['right', 'left'], 60.0, 'a wave of the other')
    robot.move_to(3.2, 2.0)
    tell('point at the red mug')
    ros.wait_until(lambda: len(robot.moved) == 3, 60.0, 'an arm that points')
    assert robot.moved[-1] == 'left'
    bowl = detection('bowl_1', 'bowl', at=(3.6, 1.2, 0.75))
    bowl.header.frame_id = 'l_gripper'
    robot.holding.publish(Detection3DArray(detections=[*robot.held, bowl]))
    tell('wave')
    ros.wait_until(robot.heard('Both my hands are full.'), 60.0, 'words')
    assert len(robot.moved) == 3


def test_a_fall_ends_it(ros: RosSandbox, tell: Any) -> None:
    """The walk is given up at once, and the reason is said."""
    robot = tell.robot
    robot.is_slow = True
    tell('go to the study')
    ros.wait_until(lambda: robot.walks, 60.0, 'a walk')
    robot.walking.publish(String(data='fallen'))
    ros.wait_until(robot.heard('The robot has fallen.'), 10.0, 'words')
    ros.wait_until(lambda: robot.cancelled == 1, 10.0, 'a canceled walk')


def test_an_executor_that_was_killed_is_not_waited_for(ros: RosSandbox, tell: Any) -> None:
    """When another one runs, the planner does nothing any more, and can be told anew."""
    robot = tell.robot
    robot.is_slow = True
    states = robot.create_publisher(String, 'executor/state', LATCHED)

    def doing() -> str:
        status = robot.statuses.get('task_planner: planner')
        return next((e.value for e in status.values if e.key == 'doing'), '') if status else ''

    tell('go to the study')
    ros.wait_until(lambda: robot.walks and doing() == 'go to the study', 60.0, 'a walk')
    states.publish(String(data='{"run": "another one", "command": "", "steps": []}'))
    ros.wait_until(lambda: doing() == 'nothing', 60.0, 'the planner to give up')
    robot.is_slow = False
    tell('turn left')
    ros.wait_until(lambda: robot.spins, 60.0, 'a turn')


def test_an_executor_that_ends_is_missed(ros: RosSandbox, tell: Any) -> None:
    """Whoever gave the command is told, and that nothing can be done then."""
    robot = tell.robot
    robot.is_slow = True
    tell('go to the study')
    ros.wait_until(lambda: robot.walks, 60.0, 'a walk')
    ros.end(tell.executor)
    lost = 'I cannot continue, as the skill executor has exited.'
    ros.wait_until(robot.heard(lost), 60.0, 'words')
    tell('turn left')
    missing = 'I cannot do anything, as the skill executor is not running.'
    ros.wait_until(robot.heard(lost, missing), 60.0, 'other words')
    assert robot.said.count(lost) == 1 and not robot.spins


class DeafExecutor(Node):
    """An executor that does not answer the first goals, as if it had not found the planner yet."""

    def __init__(self, **options: Any) -> None:
        super().__init__('deaf_executor', **options)
        self.deaf = self.goals = 0
        self._never: Future[None] = Future()
        self._server = ActionServer(
            self, ExecutePlan, 'execute_plan', self._do, goal_callback=self._consider
        )

    async def _consider(self, request: Any) -> GoalResponse:
        self.goals += 1
        if self.goals <= self.deaf:
            await self._never
        return GoalResponse.ACCEPT

    def _do(self, handle: Any) -> Any:
        handle.succeed()
        return ExecutePlan.Result()


@pytest.mark.parametrize(('deaf', 'goals'), [(1, 2), pytest.param(9, 3, marks=pytest.mark.story)])
def test_a_plan_that_is_not_answered_is_sent_again(ros: RosSandbox, deaf: int, goals: int) -> None:
    """And if that does not help either, it is said."""
    robot, executor = ros.start(RobotStub), ros.start(DeafExecutor)
    executor.deaf = deaf
    planner = ros.start(TaskPlanner)
    ros.wait_until(lambda: robot.commands.get_subscription_count() == 1, 30.0, 'a planner')
    service = '/execute_plan/_action/send_goal'
    ros.wait_until(lambda: planner.count_services(service) == 1, 30.0, 'an executor')
    robot.commands.publish(String(data='wait for one second'))
    ros.wait_until(lambda: executor.goals == goals, 30.0, 'more goals')
    if deaf > goals:
        words = 'I cannot do anything, as the skill executor does not answer.'
        ros.wait_until(robot.heard(words), 30.0, 'words')


def test_what_is_not_understood_is_said(ros: RosSandbox, tell: Any) -> None:
    """Nothing is done; a question is asked, and answered by voice."""
    robot = tell.robot
    tell('dance with me')
    ros.wait_until(robot.heard('I did not understand "dance with me".'), 60.0, 'words')
    tell('bring me the red mug')
    ros.wait_until(
        robot.heard('I cannot take things, as manipulation is not running.'), 60.0, 'words'
    )
    tell('go to the mug')
    ros.wait_until(robot.heard('Which mug: the blue one or the red one?'), 60.0, 'a question')
    assert not robot.walks
    tell('the red one', by_voice=True)
    ros.wait_until(lambda: robot.walks, 60.0, 'a walk')
    assert robot.walks[0].x == pytest.approx(3.2) and robot.walks[0].y == pytest.approx(0.5)


@pytest.mark.parametrize(
    'steps, code, said',
    [
        ([], ExecutePlan.Result.INVALID, 'nothing to do'),
        ([('fly', {})], ExecutePlan.Result.INVALID, "no skill 'fly'"),
        ([('go_to', {'target': 'moon'})], ExecutePlan.Result.INVALID, 'I do not know what'),
        ([('move', {'distance': '9e9'})], ExecutePlan.Result.INVALID, 'out of my range'),
        ([('wave', {})], ExecutePlan.Result.UNAVAILABLE, 'I cannot move my arms'),
        ([('go_to', {'target': 'box_1'})], ExecutePlan.Result.NONE, ''),
    ],
)
def test_plans_of_other_programs(
    ros: RosSandbox, tell: Any, steps: Any, code: int, said: str
) -> None:
    """Whoever sends a plan, it is checked as a whole before its first step."""
    robot = tell.robot
    client = ActionClient(robot, ExecutePlan, 'execute_plan')
    ros.wait_until(client.server_is_ready, 60.0, 'the executor')
    plan = Plan(
        steps=[
            PlanStep(
                skill=skill, arguments=[KeyValue(key=k, value=v) for k, v in arguments.items()]
            )
            for skill, arguments in steps
        ]
    )
    if steps:
        plan.steps.insert(0, PlanStep(skill='say', arguments=[KeyValue(key='text', value='hi')]))
    sent = client.send_goal_async(ExecutePlan.Goal(plan=plan))
    ros.wait_until(sent.done, 60.0, 'an answer')
    end = sent.result().get_result_async()
    ros.wait_until(end.done, 60.0, 'the end')
    result = end.result().result
    client.destroy()
    assert result.error_code == code and said in result.error_msg
    assert ('hi' in result.said) == (code == ExecutePlan.Result.NONE) and result.failed_step == -1


def test_the_grammar_is_published(ros: RosSandbox, tell: Any) -> None:
    """With the places of this home."""
    ros.wait_until(lambda: tell.robot.grammars, 60.0, 'a grammar')
    assert tell.robot.grammars[0].startswith('#JSGF') and 'study' in tell.robot.grammars[0]


def test_a_language_model_plans(ros: RosSandbox, tell: Any) -> None:
    """What the model plans is done; when it fails, the rules plan."""
    robot = tell.robot
    said = {'skill': 'say', 'arguments': {'text': 'Roses are red.'}}
    with serving(ModelStub(says({'steps': [said], 'refusal': None}), (500, ''))) as stub:
        parameters = {'backend': 'openai', 'base_url': stub.url, 'timeout_s': 60.0}
        ros.start(lambda **options: TaskPlanner(namespace='thinking', **options), parameters)
        client = robot.create_client(MakePlan, '/thinking/task_planner/plan')
        ros.wait_until(client.service_is_ready, 60.0, 'the planner')

        def answer(command: str) -> Any:
            future = client.call_async(MakePlan.Request(command=command))
            ros.wait_until(future.done, 60.0, 'an answer')
            return future.result()

        model, rules = answer('recite a poem'), answer('wait for ten seconds')
    assert model.success and model.plan.source == 'openai'
    assert [each.text for each in model.plan.steps] == ['say "Roses are red."']
    assert rules.success and rules.plan.source == 'rules'
    assert [each.text for each in rules.plan.steps] == ['wait 10 seconds']
    assert stub.asked[0]['messages'][1]['content'] == '{"wish": "recite a poem"}'


@pytest.mark.parametrize('kind', [TaskPlanner, SkillExecutor])
@pytest.mark.parametrize('name', ['skills_file', 'places_file'])
def test_files_that_cannot_be_used(ros: RosSandbox, kind: Any, name: str) -> None:
    """The node says which one, and does not start."""
    with pytest.raises(
        UserError, match=r'cannot start. (/nowhere.yaml cannot be read|File of named)'
    ):
        ros.start(kind, {name: '/nowhere.yaml'})
    with pytest.raises(UserError, match="cannot start. .* there is no home folder '~no_one'"):
        ros.start(kind, {name: '~no_one/file.yaml'})
