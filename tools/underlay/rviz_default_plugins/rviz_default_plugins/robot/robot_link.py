# SPDX-License-Identifier: Apache-2.0
"""The links of a robot as objects that a user can select."""

from __future__ import annotations

import math

from rviz_common.frames import Pose
from rviz_common.selection import Hit, Ray, SceneObject
from rviz_default_plugins.ray_hits import (
    hit_box,
    hit_capsule,
    hit_cylinder,
    hit_sphere,
    hit_triangles,
    unscaled,
)
from rviz_default_plugins.robot.mesh_loading import DrawnMesh
from rviz_default_plugins.robot.robot_scene import RobotScene
from urdf import Box, Capsule, Cylinder, Joint, Mesh, Shape, Sphere
from urdf.kinematics import joint_position, rotation_of

__all__ = ['RobotLink', 'hit_shape', 'joint_rows', 'pick_link']


class RobotLink(SceneObject):
    """
    A link of a robot.

    Parameters
    ----------
    scene
        The robot.
    name
        The name of the link.
    prefix
        The prefix of the links in the names of frames, with a trailing slash, or ''.

    """

    def __init__(self, scene: RobotScene, name: str, prefix: str) -> None:
        self.name, self.frame = name, prefix + name
        self._scene, self._prefix = scene, prefix
        model = scene.model
        self._link = next(link for link in model.links if link.name == name)
        self._joint = next((joint for joint in model.joints if joint.child == name), None)

    @property
    def is_present(self) -> bool:
        """Whether the robot is still shown."""
        return not self._scene.is_removed

    @property
    def entity(self) -> tuple[str, str]:
        """The names of the robot, which is the prefix of its frames, and of the link."""
        return self._prefix.rstrip('/'), self.name

    def rigid_body(self) -> RobotLink:
        """Return the link to which fixed joints attach this one; simulators merge them."""
        joint = self._joint
        if joint is None or joint.kind != 'fixed':
            return self
        return RobotLink(self._scene, joint.parent, self._prefix).rigid_body()

    def pose(self) -> Pose | None:
        """Return the pose of the link in the fixed frame, None if that is unknown."""
        return self._scene.poses().get(self.name)

    def details(self) -> list[tuple[str, str]]:
        """Return the robot, the mass, and the joint that moves the link."""
        mass = self._link.mass
        lines = [
            ('Robot', self._scene.model.name),
            ('Mass', 'not given' if mass is None else f'{mass:.3g} kg'),
        ]
        joint = self._joint
        if joint is None:
            return [*lines, ('Joint', 'none: it is the root link')]
        poses = self._scene.poses()
        above, pose = poses.get(joint.parent), poses.get(self.name)
        moved = None if above is None or pose is None else above.inverse().of(pose)
        return lines + joint_rows(joint, moved)

    def highlight(self, is_highlighted: bool) -> None:
        """
        Highlight the bodies of the link, or stop doing so.

        Parameters
        ----------
        is_highlighted
            As for `SceneObject.highlight`.

        """
        self._scene.highlight(self.name, is_highlighted)


def pick_link(scene: RobotScene, ray: Ray, prefix: str) -> Hit | None:
    """
    Find the first link of a robot on a ray.

    Parameters
    ----------
    scene
        The robot.
    ray
        The ray, in the fixed frame.
    prefix
        As for `RobotLink`.

    """
    hits: list[tuple[float, str]] = []
    for name, pose in scene.poses().items():
        local = ray.seen_from(pose)
        distances = [hit_shape(local, shape, mesh) for shape, mesh in scene.bodies(name)]
        hits.extend((each, name) for each in distances if each is not None)
    if not hits:
        return None
    distance, name = min(hits)
    return Hit(distance, RobotLink(scene, name, prefix))


def hit_shape(ray: Ray, shape: Shape, mesh: DrawnMesh | None) -> float | None:
    """
    Intersect a ray with a body of a link.

    Parameters
    ----------
    ray
        The ray, in the frame of the link.
    shape
        The body.
    mesh
        The mesh, if the body is one and it has been read.

    Returns
    -------
    float | None
        How many times the direction the body is from the origin of the ray; None if the ray
        passes it by.

    """
    x, y, z, w = rotation_of(shape.origin.rpy)
    local = ray.seen_from(Pose(shape.origin.xyz, (w, x, y, z)))
    body = shape.geometry
    if isinstance(body, Box):
        return hit_box(local, body.size)
    if isinstance(body, Sphere):
        return hit_sphere(local, body.radius)
    if isinstance(body, Cylinder):
        return hit_cylinder(local, body.radius, body.length)
    if isinstance(body, Capsule):
        return hit_capsule(local, body.radius, body.length)
    return _hit_mesh(local, body, mesh)


def _hit_mesh(ray: Ray, body: Mesh, mesh: DrawnMesh | None) -> float | None:
    scaled = unscaled(ray, body.scale)
    if mesh is None or scaled is None:
        return None
    hits = [hit_triangles(scaled, each.vertices, each.faces) for each in mesh.surfaces]
    return min((hit for hit in hits if hit is not None), default=None)


def joint_rows(joint: Joint, pose: Pose | None) -> list[tuple[str, str]]:
    """
    Describe a joint: its name, type, position and limits.

    Parameters
    ----------
    joint
        The joint.
    pose
        The pose of its child link in its parent link, None if it is unknown.

    Returns
    -------
    list[tuple[str, str]]
        Names and values; angles in rad and degrees.

    """
    lines = [('Joint', joint.name), ('Type', joint.kind), ('Parent link', joint.parent)]
    if not joint.moves:
        return lines
    if pose is None:
        position = 'unknown: no transform says where the link is'
    else:
        w, x, y, z = pose.wxyz
        position = _amount(joint, joint_position(joint, (*pose.position, x, y, z, w)))
    lines.append(('Joint position', position))
    if joint.limits is not None:
        low, high = (_amount(joint, each) for each in (joint.limits.lower, joint.limits.upper))
        lines.append(('Limits', f'{low} to {high}'))
    unit, effort = ('m', 'N') if joint.kind == 'prismatic' else ('rad', 'N m')
    if joint.max_velocity is not None:
        lines.append(('Largest velocity', f'{joint.max_velocity:g} {unit}/s'))
    if joint.max_effort is not None:
        lines.append(('Largest effort', f'{joint.max_effort:g} {effort}'))
    if joint.mimic is not None:
        lines.append(('Mimics', joint.mimic.joint))
    return lines


def _amount(joint: Joint, position: float) -> str:
    """Format a position of a joint with its unit."""
    position += 0.0 if abs(position) >= 5e-4 else -position  # no "-0.000"
    if joint.kind == 'prismatic':
        return f'{position:.3f} m'
    return f'{position:.3f} rad ({math.degrees(position):.1f}°)'
