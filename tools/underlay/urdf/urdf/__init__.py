# SPDX-License-Identifier: Apache-2.0
"""Robot model of a URDF."""

from urdf.following import check_for_loops, followed
from urdf.joint import Joint, Limits, Mimic, Origin
from urdf.reading import parse_urdf, read_urdf_file
from urdf.robot_model import Link, RobotModel
from urdf.shape import Box, Capsule, Color, Cylinder, Geometry, Mesh, Shape, Sphere
from urdf.urdf_error import UrdfError

__all__ = [
    'Box',
    'Capsule',
    'Color',
    'Cylinder',
    'Geometry',
    'Joint',
    'Limits',
    'Link',
    'Mesh',
    'Mimic',
    'Origin',
    'RobotModel',
    'Shape',
    'Sphere',
    'UrdfError',
    'check_for_loops',
    'followed',
    'parse_urdf',
    'read_urdf_file',
]
