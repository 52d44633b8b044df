# SPDX-License-Identifier: Apache-2.0
"""Robot model of a URDF."""

from urdf.reading import parse_urdf, read_urdf_file
from urdf.robot_model import (
    Box,
    Capsule,
    check_for_loops,
    Color,
    Cylinder,
    followed,
    Geometry,
    Joint,
    Limits,
    Link,
    Mesh,
    Mimic,
    Origin,
    RobotModel,
    Shape,
    Sphere,
)
from urdf.xml_element import UrdfError

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
