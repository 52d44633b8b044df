# SPDX-License-Identifier: Apache-2.0
"""What a URDF says about the joints of a robot."""

from robot_state_publisher.urdf.following import check_for_loops, followed
from robot_state_publisher.urdf.joint import Joint, Limits, Mimic, Origin
from robot_state_publisher.urdf.reading import parse_urdf, read_urdf_file
from robot_state_publisher.urdf.robot_model import Link, RobotModel
from robot_state_publisher.urdf.urdf_error import UrdfError

__all__ = [
    'Joint',
    'Limits',
    'Link',
    'Mimic',
    'Origin',
    'RobotModel',
    'UrdfError',
    'check_for_loops',
    'followed',
    'parse_urdf',
    'read_urdf_file',
]
