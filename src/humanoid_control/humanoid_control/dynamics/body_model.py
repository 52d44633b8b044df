# SPDX-License-Identifier: Apache-2.0
"""Floating-base rigid-body model of a robot."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
import math

from humanoid_common.naming import did_you_mean
from humanoid_control.dynamics.body_matrices import BodyMatrices
from humanoid_control.dynamics.body_state import BodyState
from humanoid_control.dynamics.tree import (
    DynamicsError,
    ForwardKinematics,
    JointGroup,
    Mount,
    Tree,
)
from humanoid_description.robot import Robot
import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
GRAVITY_M_S2 = 9.81


@dataclass(frozen=True, eq=False)
class BodyModel:
    """
    Rigid-body model of a robot with a floating base and n revolute joints.

    Body 0 is the root of the robot with all links that are fixed to it; body 1 + j is the child
    of joint j. Build a model with `of`; `state` returns its kinematics and dynamics for a posture
    and motion.
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
            Description of the robot: a tree of links with one root.
        joints
            Revolute or continuous joints, in the order of all arrays; others are fixed at zero.
        armature_kgm2
            Reflected rotor inertia at the joints: one value for all, or (n,).
        gravity_m_s2
            Gravitational acceleration along -z of the world.

        Raises
        ------
        DynamicsError
            As for `Tree.of`; or the armature has the wrong number of values, or a value that is
            negative or not finite.

        """
        tree = Tree.of(robot, tuple(joints))
        return cls(tree, _armature(tree.joints, armature_kgm2), gravity_m_s2)

    @property
    def joints(self) -> tuple[str, ...]:
        """Return the names of the joints, in the order of all arrays."""
        return self.tree.joints

    @property
    def links(self) -> Mapping[str, Mount]:
        """Return the mounts of all links by name, including massless frames."""
        return self.tree.mounts

    @property
    def mass_kg(self) -> float:
        """Return the mass of all bodies."""
        return self.tree.mass_kg

    @cached_property
    def forward(self) -> ForwardKinematics:
        """Return the forward kinematics of the tree."""
        return ForwardKinematics.of(self.tree)

    def group(self, joints: Sequence[str]) -> JointGroup:
        """
        Select joints for which a state computes the inertia matrix or the Jacobian.

        Parameters
        ----------
        joints
            Names of k joints, in the order of the group.

        Raises
        ------
        DynamicsError
            The model has no such joint.

        """
        indices = np.array([self.index(joint) for joint in joints], dtype=np.intp)
        return JointGroup.of(tuple(joints), indices, self.tree.moves, self.armature_kgm2)

    def index(self, joint: str) -> int:
        """
        Find the index of a joint in the arrays (n,).

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
        Build the state of the robot in a posture and motion; quantities are computed on demand.

        The origin of the root is at zero and at rest: add its position and velocity. The arrays
        are not copied: do not modify them while the state is in use.

        Parameters
        ----------
        rotation
            Rotation (3, 3) of the root in the world.
        angular_velocity_rad_s
            Angular velocity (3,) of the root, in its own axes, as a gyroscope measures it.
        positions_rad, velocities_rad_s
            Joint positions and velocities, (n,) each.

        Raises
        ------
        DynamicsError
            An array has the wrong shape, or contains a non-finite value.

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
    """Validate the armature, and broadcast it to all joints."""
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
    """Reject an array of the wrong shape or with non-finite values."""
    if values.shape != shape:
        raise DynamicsError(f'{name} has the shape {values.shape}, but {shape} is needed.')
    flat = values.ravel()
    # The sum of squares is finite only if all values are: much faster than checking each.
    if not math.isfinite(flat @ flat):
        bad = int(np.argmax(~(np.abs(flat) < 1e100)))
        raise DynamicsError(f'{name} holds {flat[bad]} at index {bad}: give finite numbers.')
