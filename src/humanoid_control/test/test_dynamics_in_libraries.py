# SPDX-License-Identifier: Apache-2.0
"""Check that other libraries compute the same kinematics and dynamics."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields
from typing import Any

from humanoid_control.dynamics import BodyModel
from humanoid_description.robot import Robot
from humanoid_description.rotations import from_quaternion
import mujoco
import numpy as np
import pytest

Array = np.ndarray[Any, Any]
ROOT, SOLE = 'base_link', 'r_sole'
STATES = 10


@dataclass(frozen=True)
class Found:
    """What a library computes of a state."""

    positions: Array
    rotations: Array
    com: Array
    com_velocity: Array
    angular_momentum: Array
    sole_velocity: Array
    sole_turning: Array
    jacobian: Array
    angular_jacobian: Array
    bias: Array
    wrench: Array
    inertia: Array


@dataclass(frozen=True)
class Motion:
    """A random state; the quaternion is w, x, y, z."""

    quaternion: Array
    turning: Array
    positions: Array
    velocities: Array


def motions(n: int) -> Iterator[Motion]:
    """Yield fast motions in any posture."""
    generator = np.random.default_rng(4)
    for _ in range(STATES):
        quaternion = generator.normal(size=4)
        yield Motion(
            quaternion / np.linalg.norm(quaternion),
            generator.normal(size=3) * 2,
            generator.uniform(-3, 3, n),
            generator.normal(size=n) * 3,
        )


def found_here(model: BodyModel, motion: Motion) -> Found:
    """Return what this package computes."""
    state = model.state(
        from_quaternion(motion.quaternion), motion.turning, motion.positions, motion.velocities
    )
    return Found(
        np.array([state.position_m(link) for link in model.links]),
        np.array([state.rotation(link) for link in model.links]),
        state.com_m,
        state.com_velocity_m_s,
        state.angular_momentum_nms,
        state.velocity_m_s(SOLE),
        state.angular_velocity_rad_s(SOLE),
        state.jacobian(SOLE),
        state.angular_jacobian(SOLE),
        state.bias_nm,
        state.bias_wrench,
        state.inertia_kgm2(model.group(model.joints)),
    )


class InMujoco:
    """MuJoCo: the base moves linearly in the world, and turns in its own axes."""

    def __init__(self, urdf: str, model: BodyModel) -> None:
        """Read the robot, with a floating base and the armature of its joints."""
        options = '<mujoco><compiler fusestatic="false"/></mujoco></robot>'
        spec = mujoco.MjSpec.from_string(urdf.replace('</robot>', options))
        spec.body(ROOT).add_freejoint()
        for name, armature in zip(model.joints, model.armature_kgm2):
            spec.joint(name).armature = armature
        self.links = tuple(model.links)
        self.model = spec.compile()
        self.dofs = np.array([self.model.joint(name).dofadr[0] for name in model.joints])

    def __call__(self, motion: Motion) -> Found:
        """Return what MuJoCo computes."""
        model, data = self.model, mujoco.MjData(self.model)
        data.qpos[3:7], data.qpos[self.dofs + 1] = motion.quaternion, motion.positions
        data.qvel[3:6], data.qvel[self.dofs] = motion.turning, motion.velocities
        mujoco.mj_forward(model, data)
        mujoco.mj_subtreeVel(model, data)
        sole, root = model.body(SOLE).id, model.body(ROOT).id
        linear, angular = np.zeros((2, 3, model.nv))
        mujoco.mj_jacBody(model, data, linear, angular, sole)
        bias, inertia = np.zeros(model.nv), np.zeros((model.nv, model.nv))
        mujoco.mj_rne(model, data, 0, bias)
        mujoco.mj_fullM(model, data, inertia)
        rotation = data.xmat[root].reshape(3, 3)
        return Found(
            np.array([data.body(link).xpos for link in self.links]),
            np.array([data.body(link).xmat.reshape(3, 3) for link in self.links]),
            data.subtree_com[root],
            data.subtree_linvel[root],
            data.subtree_angmom[root],
            linear @ data.qvel,
            angular @ data.qvel,
            self._columns(linear, rotation),
            self._columns(angular, rotation),
            bias[self.dofs],
            np.concatenate([bias[:3], rotation @ bias[3:6]]),
            inertia[np.ix_(self.dofs, self.dofs)],
        )

    def _columns(self, jacobian: Array, rotation: Array) -> Array:
        """Return a Jacobian with the columns that this package has."""
        turning = jacobian[:, 3:6] @ rotation.T
        return np.hstack([jacobian[:, :3], turning, jacobian[:, self.dofs]])


class InPinocchio:
    """Pinocchio: the base moves in its own axes."""

    def __init__(self, urdf: str, model: BodyModel) -> None:
        """Read the robot, with a floating base and the armature of its joints."""
        self.pin: Any = pytest.importorskip('pinocchio')
        self.model = self.pin.buildModelFromXML(urdf, self.pin.JointModelFreeFlyer())
        self.links = tuple(model.links)
        joints = [self.model.joints[self.model.getJointId(name)] for name in model.joints]
        self.indices = np.array([joint.idx_q for joint in joints])
        self.dofs = np.array([joint.idx_v for joint in joints])
        self.armature = np.diag(model.armature_kgm2)

    def __call__(self, motion: Motion) -> Found:
        """Return what Pinocchio computes."""
        pin, model, data = self.pin, self.model, self.model.createData()
        q, v = pin.neutral(model), np.zeros(model.nv)
        q[3:7], q[self.indices] = np.roll(motion.quaternion, -1), motion.positions
        v[3:6], v[self.dofs] = motion.turning, motion.velocities
        bias = pin.nonLinearEffects(model, data, q, v).copy()
        inertia = pin.crba(model, data, q)
        inertia = np.triu(inertia) + np.triu(inertia, 1).T
        pin.ccrba(model, data, q, v)
        pin.centerOfMass(model, data, q, v)
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        pose = {link: data.oMf[self._frame(link)] for link in self.links}
        jacobian = pin.getFrameJacobian(
            model, data, self._frame(SOLE), pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        )
        rotation = pose[ROOT].rotation
        return Found(
            np.array([pose[link].translation for link in self.links]),
            np.array([pose[link].rotation for link in self.links]),
            data.com[0],
            data.vcom[0],
            data.hg.angular,
            jacobian[:3] @ v,
            jacobian[3:] @ v,
            self._columns(jacobian[:3], rotation),
            self._columns(jacobian[3:], rotation),
            bias[self.dofs],
            np.concatenate([rotation @ bias[:3], rotation @ bias[3:6]]),
            inertia[np.ix_(self.dofs, self.dofs)] + self.armature,
        )

    def _frame(self, link: str) -> int:
        """Return the number of a link."""
        return int(self.model.getFrameId(link, self.pin.FrameType.BODY))

    def _columns(self, jacobian: Array, rotation: Array) -> Array:
        """Return a Jacobian with the columns that this package has."""
        linear, turning = jacobian[:, :3] @ rotation.T, jacobian[:, 3:6] @ rotation.T
        return np.hstack([linear, turning, jacobian[:, self.dofs]])


@pytest.mark.parametrize('scale', [0.5, 1.0, 1.3], indirect=True)
@pytest.mark.parametrize('library', [InMujoco, InPinocchio])
def test_same_in(
    library: Callable[[str, BodyModel], Callable[[Motion], Found]], urdf: str, model: BodyModel
) -> None:
    """Kinematics, Jacobians, bias and inertia are those that a library of its own finds."""
    ask_library = library(urdf, model)
    for motion in motions(len(model.joints)):
        here, there = found_here(model, motion), ask_library(motion)
        for field in fields(Found):
            ours, theirs = getattr(here, field.name), getattr(there, field.name)
            assert ours == pytest.approx(theirs, rel=0, abs=1e-9), field.name


def test_some_joints_only(urdf: str, robot: Robot) -> None:
    """Joints that the model leaves out are at zero, as MuJoCo has it."""
    whole = BodyModel.of(robot, [joint.name for joint in robot.joints if joint.is_driven])
    arm = BodyModel.of(robot, [name for name in whole.joints if 'left_' in name])
    for motion in motions(len(arm.joints)):
        positions, velocities = np.zeros((2, len(whole.joints)))
        chosen = [whole.index(name) for name in arm.joints]
        positions[chosen], velocities[chosen] = motion.positions, motion.velocities
        there = InMujoco(urdf, whole)(
            Motion(motion.quaternion, motion.turning, positions, velocities)
        )
        here = found_here(arm, motion)
        assert here.com == pytest.approx(there.com, abs=1e-9)
        assert here.bias == pytest.approx(there.bias[chosen], abs=1e-9)
        assert here.inertia == pytest.approx(there.inertia[np.ix_(chosen, chosen)], abs=1e-9)
