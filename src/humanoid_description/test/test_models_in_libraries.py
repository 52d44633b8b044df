# SPDX-License-Identifier: Apache-2.0
"""Check that other libraries understand the models as this package does."""

from __future__ import annotations

from collections.abc import Callable
import io
from pathlib import Path
from typing import Any

from ament_index_python.packages import get_package_share_directory
from humanoid_description.expansion import humanoid_urdf
from humanoid_description.kinematics import poses
from humanoid_description.loading import load_robot
from humanoid_description.robot import Robot
import numpy as np
import pytest

Poses = dict[str, np.ndarray[Any, Any]]
Angles = dict[str, float]
MODELS = {
    'humanoid': humanoid_urdf,
    'humanoid-0.5': lambda: humanoid_urdf(0.5),
    'humanoid-1.3': lambda: humanoid_urdf(1.3),
    'hands': lambda: humanoid_urdf(hands=True),
    'upper body': lambda: humanoid_urdf(prefix='r1_', upper_body_only=True),
    'simple_arm': lambda: (
        Path(get_package_share_directory('robot_description')) / 'urdf' / 'simple_arm.urdf'
    ).read_text(),
}


def in_yourdfpy(urdf: str, robot: Robot, angles: Angles) -> tuple[float, Poses]:
    """Return mass and poses as yourdfpy has them."""
    yourdfpy = pytest.importorskip('yourdfpy')
    model = yourdfpy.URDF.load(io.BytesIO(urdf.encode()), load_meshes=False)
    model.update_cfg({name: angles[name] for name in model.actuated_joint_names})
    mass_kg = sum(link.inertial.mass for link in model.robot.links if link.inertial)
    return mass_kg, {name: model.get_transform(name, robot.roots[0]) for name in robot.link}


def in_mujoco(urdf: str, robot: Robot, angles: Angles) -> tuple[float, Poses]:
    """Return mass and poses as MuJoCo has them, on a floating base."""
    mujoco = pytest.importorskip('mujoco')
    options = '<mujoco><compiler fusestatic="false"/></mujoco></robot>'
    spec = mujoco.MjSpec.from_string(urdf.replace('</robot>', options))
    spec.body(robot.roots[0]).add_freejoint()
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qpos[:7] = (0, 0, 0, 1, 0, 0, 0)
    for name, angle in with_followers(robot, angles).items():
        data.joint(name).qpos = angle
    mujoco.mj_kinematics(model, data)
    found = {}
    for name in robot.link:
        found[name] = np.eye(4)
        found[name][:3, :3] = data.body(name).xmat.reshape(3, 3)
        found[name][:3, 3] = data.body(name).xpos
    return float(model.body_mass.sum()), found


def in_pin(urdf: str, robot: Robot, angles: Angles) -> tuple[float, Poses]:
    """Return mass and poses as Pinocchio has them, on a floating base."""
    pin = pytest.importorskip('pinocchio')
    model = pin.buildModelFromXML(urdf, pin.JointModelFreeFlyer())
    data, positions = model.createData(), pin.neutral(model)
    for name, angle in with_followers(robot, angles).items():
        positions[model.joints[model.getJointId(name)].idx_q] = angle
    pin.framesForwardKinematics(model, data, positions)
    frames = {name: model.getFrameId(name, pin.FrameType.BODY) for name in robot.link}
    found = {name: data.oMf[frame].homogeneous for name, frame in frames.items()}
    return pin.computeTotalMass(model), found


def random_angles(robot: Robot) -> Angles:
    """Return angles within the limits."""
    generator = np.random.default_rng(1)
    return {
        joint.name: float(generator.uniform(joint.limits.lower, joint.limits.upper))
        for joint in robot.joints
        if joint.is_driven and joint.limits and not joint.mimics
    }


def with_followers(robot: Robot, angles: Angles) -> Angles:
    """Return the positions of all joints, also of those that mimic others."""
    return angles | {
        joint.name: joint.mimics.multiplier * angles[joint.mimics.joint] + joint.mimics.offset
        for joint in robot.joints
        if joint.mimics
    }


@pytest.mark.parametrize('library', [in_yourdfpy, in_mujoco, in_pin])
@pytest.mark.parametrize('name', MODELS)
def test_mass_and_kinematics(
    name: str, library: Callable[[str, Robot, Angles], tuple[float, Poses]]
) -> None:
    """Every library finds the same mass, and every link at the same place."""
    urdf = MODELS[name]()
    robot = load_robot(urdf, name)
    angles = random_angles(robot)
    mass_kg, found = library(urdf, robot, angles)
    assert mass_kg == pytest.approx(robot.mass_kg, abs=1e-9)
    for link, pose in poses(robot, angles).items():
        assert np.allclose(found[link], pose, rtol=0, atol=1e-9), link


def test_no_model_is_forgotten() -> None:
    """The models above are all that this workspace has."""
    files = {path.name for path in Path(__file__).parents[2].glob('*/urdf/*.*')}
    assert files == {'humanoid.urdf.xacro', 'simple_arm.urdf'}
