# SPDX-License-Identifier: Apache-2.0
"""Tests that every message and service is what its users count on."""

from __future__ import annotations

from typing import Any

from builtin_interfaces.msg import Duration, Time
from geometry_msgs.msg import Point, Pose, Quaternion, Twist, Vector3, Wrench
from humanoid_interfaces.msg import Contact, Contacts
from humanoid_interfaces.srv import ApplyWrench, ResetSimulation, SetEntityState, StepSimulation
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
PLACE = SetEntityState.Request(
    entity='box',
    pose=Pose(position=Point(x=1.0), orientation=Quaternion(w=0.6, z=0.8)),
    twist=Twist(linear=Vector3(y=0.5)),
)
SERVICES = [ApplyWrench, ResetSimulation, SetEntityState, StepSimulation]


@pytest.mark.parametrize(
    'message',
    [
        CONTACT,
        CONTACTS,
        PUSH,
        PLACE,
        ResetSimulation.Request(keyframe='home'),
        StepSimulation.Request(steps=2**64 - 1),
    ],
    ids=lambda message: type(message).__name__,
)
def test_a_message_arrives_as_it_was_sent(message: Any) -> None:
    """All fields are there again after the way through DDS's format."""
    assert deserialize_message(serialize_message(message), type(message)) == message


@pytest.mark.parametrize('service', SERVICES, ids=lambda service: service.__name__)
def test_an_answer_says_whether_and_why_not(service: Any) -> None:
    """Every answer is that of std_srvs: success, and a message."""
    answer = service.Response(success=True, message='Stepped')
    assert deserialize_message(serialize_message(answer), service.Response) == answer
    assert service.Response.get_fields_and_field_types() == {
        'success': 'boolean',
        'message': 'string',
    }


def test_what_is_left_out_is_harmless() -> None:
    """An empty request turns nothing and pushes nothing: rotations are the identity."""
    assert SetEntityState.Request().pose.orientation.w == 1.0
    assert ApplyWrench.Request().wrench == Wrench()
