# SPDX-License-Identifier: Apache-2.0
"""Messages by name, as plain values and from them."""

from __future__ import annotations

from collections import OrderedDict

from geometry_msgs.msg import PoseArray, Twist
import pytest
from rosidl_runtime_py import (
    message_to_csv,
    message_to_ordereddict,
    message_to_yaml,
    set_message_fields,
)
from rosidl_runtime_py.utilities import get_action, get_interface, get_message, get_service
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import String
from std_srvs.srv import Trigger


def test_classes_by_name() -> None:
    """Each kind is found by its full name; another kind or form is refused."""
    assert get_message('std_msgs/msg/String') is String
    assert get_service('std_srvs/srv/Trigger') is Trigger
    assert get_interface('geometry_msgs/msg/Twist') is Twist
    with pytest.raises(ValueError, match='Expected the full name of a service'):
        get_service('std_msgs/msg/String')
    with pytest.raises(ValueError, match='Expected the full name of a message'):
        get_message('std_msgs/String')
    with pytest.raises(ModuleNotFoundError):
        get_action('no_such_package/action/Fly')
    with pytest.raises(AttributeError):
        get_message('std_msgs/msg/Strin')


def test_messages_as_plain_values() -> None:
    """A message becomes a dictionary, YAML and comma-separated values."""
    twist = Twist()
    twist.linear.x = 2.0
    plain = message_to_ordereddict(twist)
    assert isinstance(plain, OrderedDict)
    assert plain['linear'] == OrderedDict([('x', 2.0), ('y', 0.0), ('z', 0.0)])
    assert message_to_yaml(twist).startswith('linear:\n  x: 2.0\n')
    assert message_to_yaml(String(data='hi'), flow_style=True) == '{data: hi}\n'
    assert message_to_csv(twist) == '2.0,0.0,0.0,0.0,0.0,0.0'
    assert message_to_ordereddict(String(data='hello'), truncate_length=2)['data'] == 'he...'
    joints = JointState(name=['a'], position=[1.0, 2.0])
    assert message_to_ordereddict(joints)['position'] == [1.0, 2.0]


def test_fields_from_plain_values() -> None:
    """Nested messages, arrays and lists of messages are set; the others stay."""
    joints = JointState(velocity=[5.0])
    set_message_fields(joints, {'header': {'frame_id': 'map'}, 'name': ['a'], 'position': [1, 2]})
    assert joints == JointState(
        header=joints.header, name=['a'], position=[1.0, 2.0], velocity=[5.0]
    )
    assert joints.header.frame_id == 'map'
    imu = Imu()
    set_message_fields(imu, {'orientation_covariance': [1] * 9})
    assert imu.orientation_covariance.tolist() == [1.0] * 9
    poses = PoseArray()
    set_message_fields(poses, {'poses': [{'position': {'x': 3}}]})
    assert poses.poses[0].position.x == 3.0
    with pytest.raises(AttributeError):
        set_message_fields(String(), {'date': 'x'})
