# SPDX-License-Identifier: Apache-2.0
"""Parse a URDF to a robot model."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from humanoid_description.robot import Array, Body, Joint, Limits, Link, Mimic, Robot, Shape
from humanoid_description.rotations import from_rpy
from humanoid_description.urdf_text import readable
import numpy as np

FORWARD = (1.0, 0.0, 0.0)
"""The default axis of a joint."""


def load_robot(text: str, source: str, folder: Path = Path()) -> Robot:
    """
    Parse a URDF.

    Parameters
    ----------
    text
        The URDF, as XML.
    source
        The name of the URDF in error messages.
    folder
        The folder to which mesh file names without a scheme are relative.

    Returns
    -------
    Robot
        The model, not validated; see `checks.check_robot`.

    Raises
    ------
    DescriptionError
        The text is not a URDF; the message gives the line.

    """
    robot = readable(text, source)
    return Robot(
        robot.get('name'),
        tuple(map(_link, robot.findall('link'))),
        tuple(map(_joint, robot.findall('joint'))),
        folder,
    )


def _link(link: Any) -> Link:
    """Build a link."""
    inertial = link.find('inertial')
    return Link(
        link.get('name'),
        None if inertial is None else _body(inertial),
        tuple(map(_shape, link.findall('visual'))),
        tuple(map(_shape, link.findall('collision'))),
        link.sourceline,
    )


def _body(inertial: Any) -> Body:
    """Build the inertial parameters of a link."""
    inertia = inertial.find('inertia')
    xx, xy, xz, yy, yz, zz = (
        float(inertia.get(name)) for name in ('ixx', 'ixy', 'ixz', 'iyy', 'iyz', 'izz')
    )
    return Body(
        float(inertial.find('mass').get('value')),
        _pose(inertial),
        np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]),
    )


def _shape(element: Any) -> Shape:
    """Build the shape of a visual or collision element."""
    geometry, pose = element.find('geometry')[0], _pose(element)
    if geometry.tag == 'box':
        return Shape('box', tuple(_numbers(geometry.get('size'))), pose)
    if geometry.tag == 'cylinder':
        size_m = float(geometry.get('radius')), float(geometry.get('length'))
        return Shape('cylinder', size_m, pose)
    if geometry.tag == 'sphere':
        return Shape('sphere', (float(geometry.get('radius')),), pose)
    return Shape('mesh', (), pose, geometry.get('filename'))


def _joint(joint: Any) -> Joint:
    """Build a joint."""
    axis, limit, mimic = (joint.find(tag) for tag in ('axis', 'limit', 'mimic'))
    return Joint(
        joint.get('name'),
        joint.get('type'),
        joint.find('parent').get('link'),
        joint.find('child').get('link'),
        _pose(joint),
        np.array(FORWARD if axis is None else _numbers(axis.get('xyz'), FORWARD)),
        None if limit is None else _limits(limit),
        None if mimic is None else _mimic(mimic),
        joint.sourceline,
    )


def _mimic(mimic: Any) -> Mimic:
    """Build the mimic rule of a joint."""
    return Mimic(
        mimic.get('joint'), float(mimic.get('multiplier', 1.0)), float(mimic.get('offset', 0.0))
    )


def _limits(limit: Any) -> Limits:
    """Build the limits of a joint; a missing position limit is zero."""
    lower, upper, effort, velocity = (
        None if limit.get(name) is None else float(limit.get(name))
        for name in ('lower', 'upper', 'effort', 'velocity')
    )
    return Limits(lower or 0.0, upper or 0.0, effort, velocity)


def _pose(element: Any) -> Array:
    """Return the pose (4, 4) of an element; the identity if it has no origin."""
    pose: Array = np.eye(4)
    origin = element.find('origin')
    if origin is not None:
        pose[:3, :3] = from_rpy(*_numbers(origin.get('rpy'), (0.0, 0.0, 0.0)))
        pose[:3, 3] = _numbers(origin.get('xyz'), (0.0, 0.0, 0.0))
    return pose


def _numbers(text: str | None, default: Sequence[float] = ()) -> Sequence[float]:
    """Parse the numbers of an attribute; return the default if it is missing."""
    return default if text is None else [float(part) for part in text.split()]
