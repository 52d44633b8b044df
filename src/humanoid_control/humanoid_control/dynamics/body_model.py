# SPDX-License-Identifier: Apache-2.0
"""A robot on a floating base, as arrays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
import math

from humanoid_common.naming import did_you_mean
from humanoid_control.dynamics.body_matrices import BodyMatrices
from humanoid_control.dynamics.body_state import BodyState
from humanoid_control.dynamics.errors import DynamicsError
from humanoid_control.dynamics.forward import ForwardKinematics
from humanoid_control.dynamics.joint_group import JointGroup
from humanoid_control.dynamics.tree import Mount, Tree
from humanoid_description.robot import Robot
import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
GRAVITY_M_S2 = 9.81


@dataclass(frozen=True, eq=False)
class BodyModel:
    """
    Rigid bodies of which one floats, and n joints that turn the others.

    Body 0 is the root of the robot with all that is fixed to it; body 1 + j is what joint j moves
    directly. Build it by `of`; then ask `state` about a posture and its motion.
    """

    tree: Tree
    armature_kgm2: Array
    """(n,)"""
    gravity_m_s2: float = GRAVITY_M_S2

    @classmethod
    def of(
        cls,
        robot: Robot,
        joints: Sequence[str],
        armature_kgm2: ArrayLike = 0.0,
        gravity_m_s2: float = GRAVITY_M_S2,
    ) -> BodyModel:
        """
        Build the model of a robot from its description.

        Parameters
        ----------
        robot
            A tree of links with one root.
        joints
            Joints that turn, in the order of all arrays; others are taken as fixed at zero.
        armature_kgm2
            Inertia of the rotors as seen at the joints: one for all, or (n,).
        gravity_m_s2
            Along -z of the world.

        Raises
        ------
        DynamicsError
            As for `Tree.of`, or the armature has another number of values, or one that is negative
            or not finite.

        """
        tree = Tree.of(robot, tuple(joints))
        return cls(tree, _armature(tree.joints, armature_kgm2), gravity_m_s2)

    @property
    def joints(self) -> tuple[str, ...]:
        """Return the names of the joints, in the order of all arrays."""
        return self.tree.joints

    @property
    def links(self) -> Mapping[str, Mount]:
        """Return the links by their names, frames without mass as well."""
        return self.tree.mounts

    @property
    def mass_kg(self) -> float:
        """Return the mass of all bodies."""
        return self.tree.mass_kg

    @cached_property
    def forward(self) -> ForwardKinematics:
        """Return what computes the poses."""
        return ForwardKinematics.of(self.tree)

    def group(self, joints: Sequence[str]) -> JointGroup:
        """
        Select joints whose inertia or Jacobian a state is to compute.

        Parameters
        ----------
        joints
            Names of k joints, in the order that the group is to have.

        Raises
        ------
        DynamicsError
            The model has no such joint.

        """
        indices = np.array([self.index(joint) for joint in joints], dtype=np.intp)
        return JointGroup.of(tuple(joints), indices, self.tree.moves, self.armature_kgm2)

    def index(self, joint: str) -> int:
        """
        Look up the index of a joint in all arrays (n,).

        Parameters
        ----------
        joint
            Its name.

        Raises
        ------
        DynamicsError
            The model has no such joint.

        """
        if joint not in self.joints:
            raise DynamicsError(
                f"The model has no joint '{joint}'. {did_you_mean(joint, self.joints)}".rstrip()
            )
        return self.joints.index(joint)

    def state(
        self,
        rotation: Array,
        angular_velocity_rad_s: Array,
        positions_rad: Array,
        velocities_rad_s: Array,
    ) -> BodyState:
        """
        Describe the robot in a posture and motion; what is not asked for is not computed.

        The origin of the root is at zero and does not move: add its position and velocity. The
        arrays are not copied: leave them as they are while the state is in use.

        Parameters
        ----------
        rotation
            Of the root in the world (3, 3).
        angular_velocity_rad_s
            Of the root (3,), in its own axes, as a gyroscope measures it.
        positions_rad, velocities_rad_s
            Of the joints, (n,) each.

        Raises
        ------
        DynamicsError
            An array has another shape, or holds a value that is not finite.

        """
        n = len(self.joints)
        given = (
            ('rotation', rotation, (3, 3)),
            ('angular_velocity_rad_s', angular_velocity_rad_s, (3,)),
            ('positions_rad', positions_rad, (n,)),
            ('velocities_rad_s', velocities_rad_s, (n,)),
        )
        for name, values, shape in given:
            _check(name, values, shape)
        matrices = BodyMatrices(
            self.tree,
            self.forward,
            self.gravity_m_s2,
            rotation,
            rotation @ angular_velocity_rad_s,
            positions_rad,
            velocities_rad_s,
        )
        return BodyState(self.tree, matrices, self.armature_kgm2)


def _armature(joints: tuple[str, ...], given: ArrayLike) -> Array:
    """Return the armature of every joint."""
    values = np.asarray(given, dtype=np.float64)
    if values.shape not in ((), (len(joints),)):
        raise DynamicsError(
            f'{values.size} values of armature are given for {len(joints)} joints. '
            'Give one for each, or one for all.'
        )
    armature = np.full(len(joints), values)
    for joint, value in zip(joints, armature):
        if not 0.0 <= value < math.inf:
            raise DynamicsError(
                f"The armature of joint '{joint}' is {value}: give an inertia in kg m2, "
                'zero or more.'
            )
    return armature


def _check(name: str, values: Array, shape: tuple[int, ...]) -> None:
    """Refuse what cannot be computed with."""
    if values.shape != shape:
        raise DynamicsError(f'{name} has the shape {values.shape}, but {shape} is needed.')
    flat = values.ravel()
    # The sum of squares is finite only if all are: much faster than to look at each.
    if not math.isfinite(flat @ flat):
        bad = int(np.argmax(~(np.abs(flat) < 1e100)))
        raise DynamicsError(f'{name} holds {flat[bad]} at place {bad}: give finite numbers.')
