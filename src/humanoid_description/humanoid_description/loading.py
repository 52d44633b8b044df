# SPDX-License-Identifier: Apache-2.0
"""Read a URDF by yourdfpy."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

from humanoid_description.errors import DescriptionError
from humanoid_description.robot import Array, Body, Joint, Limits, Link, Robot, Shape
from humanoid_description.urdf_text import lines_of, refuse_what_is_unreadable
import numpy as np


def load_robot(text: str, source: str, folder: Path = Path()) -> Robot:
    """
    Return the robot that a URDF describes.

    :param source: what error messages call it
    :param folder: where the files are that it names without a folder
    """
    refuse_what_is_unreadable(text, source)
    try:
        from yourdfpy import URDF
    except ModuleNotFoundError as error:
        raise DescriptionError(
            f"Models are read by the Python package 'yourdfpy', but {error.name} is not there."
        ) from error

    read = URDF.load(io.BytesIO(text.encode()), build_scene_graph=False, load_meshes=False).robot
    return Robot(
        read.name,
        tuple(map(_link, read.links, lines_of(text, 'link'))),
        tuple(map(_joint, read.joints, lines_of(text, 'joint'))),
        folder,
    )


def _pose(origin: Any) -> Array:
    """Return the pose of an element that may lack an origin."""
    return np.eye(4) if origin is None else np.asarray(origin, dtype=np.float64)


def _link(link: Any, line: int) -> Link:
    """Build a link."""
    return Link(
        link.name,
        _body(link.inertial),
        tuple(map(_shape, link.visuals)),
        tuple(map(_shape, link.collisions)),
        line,
    )


def _body(inertial: Any) -> Body | None:
    """Build what a link weighs."""
    if inertial is None:
        return None
    return Body(inertial.mass, _pose(inertial.origin), inertial.inertia)


def _shape(element: Any) -> Shape:
    """Build the shape of a visual or collision element."""
    geometry, pose = element.geometry, _pose(element.origin)
    if geometry.box:
        return Shape('box', tuple(map(float, geometry.box.size)), pose)
    if geometry.cylinder:
        return Shape('cylinder', (geometry.cylinder.radius, geometry.cylinder.length), pose)
    if geometry.sphere:
        return Shape('sphere', (geometry.sphere.radius,), pose)
    return Shape('mesh', (), pose, geometry.mesh.filename)


def _joint(joint: Any, line: int) -> Joint:
    """Build a joint."""
    limit = joint.limit
    return Joint(
        joint.name,
        joint.type,
        joint.parent,
        joint.child,
        _pose(joint.origin),
        joint.axis,
        # URDF takes an end of the range that is not given as zero.
        limit and Limits(limit.lower or 0.0, limit.upper or 0.0, limit.effort, limit.velocity),
        joint.mimic and joint.mimic.joint,
        line,
    )
