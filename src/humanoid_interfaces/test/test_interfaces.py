# SPDX-License-Identifier: Apache-2.0
"""Tests that every message, service and action is what its users count on."""

from __future__ import annotations

from typing import Any

from builtin_interfaces.msg import Duration, Time
from diagnostic_msgs.msg import KeyValue
from geometry_msgs.msg import Point, Pose, PoseWithCovariance, Vector3, Wrench
from humanoid_interfaces.action import Drop, ExecutePlan, HandOver, Pick, Place, Reach, ScanRoom
from humanoid_interfaces.msg import (
    Contact,
    Contacts,
    Plan,
    PlanStep,
    RememberedObject,
    SpeechResult,
)
from humanoid_interfaces.srv import ApplyWrench, FindObjects, MakePlan
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import Header

CONTACT = Contact(
    body1='floor',
    body2='robot1/l_foot',
    position=Point(x=0.1, y=-0.2, z=0.001),
    normal=Vector3(z=1.0),
    force=Vector3(x=3.0, y=-4.0, z=210.5),
)
CONTACTS = Contacts(
    header=Header(stamp=Time(sec=3, nanosec=20_000_000), frame_id='odom'),
    contacts=[CONTACT, Contact(body1='floor', body2='box')],
)
PUSH = ApplyWrench.Request(
    entity='robot1',
    body='torso',
    wrench=Wrench(force=Vector3(x=150.0), torque=Vector3(z=-2.0)),
    point=Point(z=0.2),
    duration=Duration(nanosec=100_000_000),
)
MUG = RememberedObject(
    id='red_mug_1',
    class_id='mug',
    colour='red',
    place='kitchen_table',
    room='kitchen',
    pose=PoseWithCovariance(pose=Pose(position=Point(x=1.0, y=-2.0, z=0.75))),
    size=Vector3(x=0.12, y=0.08, z=0.1),
    score=0.5,
    belief=0.75,
    last_seen=Time(sec=12, nanosec=5),
    sightings=7,
)
FOUND = FindObjects.Response(
    header=Header(stamp=Time(sec=13), frame_id='map'), objects=[MUG], success=True
)
SEEN = ScanRoom.Result(
    error_code=ScanRoom.Result.TIMEOUT, error_msg='Late.', coverage=0.5, seen=['red_mug_1']
)
PLAN = Plan(
    command='go to the kitchen',
    source='rules',
    steps=[
        PlanStep(
            skill='go_to',
            arguments=[KeyValue(key='target', value='kitchen')],
            text='go to the kitchen',
        )
    ],
)
ANSWER = MakePlan.Response(message='Which mug?', choices=['the red one'], plan=PLAN)
DONE = ExecutePlan.Result(
    error_code=ExecutePlan.Result.FAILED, error_msg='No way.', failed_step=-1, said=['Ready.']
)
STEP = ExecutePlan.Feedback(step=1, state='running', message='I am going to the kitchen.')
HEARD = SpeechResult(
    text='stop',
    accepted=True,
    confidence=-1.5,
    backend='pocketsphinx',
    locale='en-US',
    speech_duration=Duration(nanosec=600_000_000),
)
EXECUTE_CODES = (
    *('NONE', 'INVALID', 'UNAVAILABLE', 'FAILED', 'TIMEOUT', 'STOPPED', 'PREEMPTED', 'UNKNOWN'),
)
SCAN_CODES = (
    *('NONE', 'TIMEOUT', 'HEAD_FAILED', 'BODY_FAILED', 'NO_TRANSFORM', 'INHIBITED', 'NO_CAMERA'),
    *('PREEMPTED', 'UNKNOWN'),
)
REACH_CODES = (
    *('NONE', 'INVALID', 'NOT_REACHABLE', 'BLOCKED', 'ARM_FAILED', 'NO_TRANSFORM', 'INHIBITED'),
    *('PREEMPTED', 'UNKNOWN'),
)
PICK_CODES = (
    *('NONE', 'NOT_SEEN', 'NOT_REACHABLE', 'OCCUPIED_HAND', 'SLIPPED', 'BLOCKED', 'WALK_FAILED'),
    *('ARM_FAILED', 'NO_TRANSFORM', 'INHIBITED', 'PREEMPTED', 'UNKNOWN'),
)
HAND_OVER_CODES = (
    *('NONE', 'EMPTY_HAND', 'NOT_TAKEN', 'BLOCKED', 'ARM_FAILED', 'NO_TRANSFORM', 'INHIBITED'),
    *('PREEMPTED', 'UNKNOWN'),
)
DROP_CODES = ('NONE', 'EMPTY_HAND', 'ARM_FAILED', 'INHIBITED', 'PREEMPTED', 'UNKNOWN')
PLACE_CODES = (
    *('NONE', 'INVALID', 'NOT_REACHABLE', 'EMPTY_HAND', 'SLIPPED', 'BLOCKED', 'WALK_FAILED'),
    *('ARM_FAILED', 'NO_TRANSFORM', 'INHIBITED', 'PREEMPTED', 'UNKNOWN'),
)
MESSAGES = [
    *(CONTACT, CONTACTS, PUSH, MUG, FOUND, SEEN, PLAN, ANSWER, DONE, STEP, HEARD),
    *(ScanRoom.Goal(turn_body=True), ExecutePlan.Goal(plan=PLAN), Reach.Goal(side='left')),
    Pick.Goal(object='red_mug_1'),
    Place.Goal(place='desk'),
    HandOver.Goal(side='left'),
    Drop.Goal(side='right'),
    MakePlan.Request(command='stop'),
]


@pytest.mark.parametrize('message', MESSAGES, ids=lambda message: type(message).__name__)
def test_a_message_arrives_as_it_was_sent(message: Any) -> None:
    """All fields are there again after the way through DDS's format."""
    assert deserialize_message(serialize_message(message), type(message)) == message


def test_an_answer_says_whether_and_why_not() -> None:
    """The answer is that of std_srvs: success, and a message."""
    answer = ApplyWrench.Response(success=True, message='Pushed')
    assert deserialize_message(serialize_message(answer), ApplyWrench.Response) == answer
    assert ApplyWrench.Response.get_fields_and_field_types() == {
        'success': 'boolean',
        'message': 'string',
    }


def test_what_is_left_out_is_harmless() -> None:
    """An empty request pushes nothing."""
    assert ApplyWrench.Request().wrench == Wrench()


def test_an_empty_question_asks_for_everything() -> None:
    """What is not said limits nothing."""
    question = FindObjects.Request()
    assert not any((question.class_id, question.colour, question.place, question.id))


def test_a_scan_turns_the_head_alone_unless_it_is_told_more() -> None:
    """The body moves only if asked, and a scan without an error has the code NONE."""
    assert ScanRoom.Goal().turn_body is False
    assert ScanRoom.Result().error_code == ScanRoom.Result.NONE


@pytest.mark.parametrize(
    'result, names',
    [
        (ScanRoom.Result, SCAN_CODES),
        (ExecutePlan.Result, EXECUTE_CODES),
        (Reach.Result, REACH_CODES),
        (Pick.Result, PICK_CODES),
        (Place.Result, PLACE_CODES),
        (HandOver.Result, HAND_OVER_CODES),
        (Drop.Result, DROP_CODES),
        (Place.Result, PLACE_CODES),
    ],
)
def test_each_way_to_fail_has_a_code_of_its_own(result: Any, names: tuple[str, ...]) -> None:
    """Programs tell them apart."""
    assert len({getattr(result, name) for name in names}) == len(names)
