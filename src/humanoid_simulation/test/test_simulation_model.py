# SPDX-License-Identifier: Apache-2.0
"""The simulated robot is that of the URDF."""

from __future__ import annotations

from dataclasses import replace

from humanoid_description.loading import load_robot
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.model import (
    build_world,
    humanoid,
    in_world,
    Physics,
    Placement,
    RobotDescription,
)
from humanoid_simulation.scene import Scene, Thing
import mujoco
import numpy as np
import pytest

ALONE = (Placement(),)


def world_of(description, placements=ALONE, physics=Physics(), scene=Scene()):
    """Return the model of a world."""
    return build_world(description, scene, placements, physics)


@pytest.mark.parametrize('scale', [1.0, 0.65])
def test_bodies_are_those_of_the_urdf(scale: float) -> None:
    """Mass, centre of mass and inertia of every link are kept, at any size."""
    description = humanoid(scale)
    model = world_of(description)
    for link in load_robot(description.urdf, 'the humanoid').links:
        body = model.body(in_world('', link.name))
        if link.body is None:
            assert body.mass[0] == 0.0
            continue
        assert body.mass[0] == pytest.approx(link.body.mass_kg)
        assert body.ipos == pytest.approx(link.body.pose[:3, 3], abs=1e-9)
        turn = np.empty(9)
        mujoco.mju_quat2Mat(turn, body.iquat)
        turn = turn.reshape(3, 3)
        outer = link.body.pose[:3, :3]
        expected = outer @ link.body.inertia_kgm2 @ outer.T
        assert turn @ np.diag(body.inertia) @ turn.T == pytest.approx(expected, abs=1e-9)


def test_joints_are_those_of_the_urdf_and_of_the_drives(description: RobotDescription) -> None:
    """Range, friction, damping, effort, gains and rotor of every joint are what the files say."""
    model = world_of(description)
    robot = load_robot(description.urdf, 'the humanoid')
    for name, drive in description.drives.items():
        joint, servo = model.joint(in_world('', name)), model.actuator(in_world('', name))
        limits = robot.joint[name].limits
        assert limits is not None
        assert tuple(joint.range) == pytest.approx((limits.lower, limits.upper))
        assert tuple(servo.forcerange) == pytest.approx((-drive.effort, drive.effort))
        assert limits.effort == drive.effort
        assert servo.gainprm[0] == drive.kp
        assert servo.biasprm[2] == -drive.kd
        assert joint.armature[0] == drive.armature
        assert joint.damping[0] == drive.damping
        assert joint.frictionloss[0] == drive.friction


def test_a_robot_with_a_prefix_is_simulated_as_well() -> None:
    """The names of links and joints may begin with a prefix."""
    model = world_of(humanoid(prefix='left_robot_'))
    assert model.nu == 23
    assert model.body(in_world('', 'left_robot_torso')).mass[0] == 12.0


def collide(model, first: str, second: str) -> bool:
    """Tell whether the shapes of two links of the world may collide."""

    def shape(name: str) -> int:
        of_body = np.flatnonzero(model.geom_bodyid == model.body(name).id)
        return next(int(geom) for geom in of_body if model.geom_contype[geom])

    a, b = shape(first), shape(second)
    forth = model.geom_contype[a] & model.geom_conaffinity[b]
    back = model.geom_contype[b] & model.geom_conaffinity[a]
    return bool(forth or back)


@pytest.mark.parametrize(
    ('first', 'second', 'kinds'),
    [
        ('left_forearm', 'torso', ('arms', 'all')),
        ('left_forearm', 'left_thigh', ('arms', 'all')),
        ('left_forearm', 'right_forearm', ('arms', 'all')),
        ('right_upper_arm', 'head', ('arms', 'all')),
        ('left_foot', 'right_foot', ('all',)),
        ('left_thigh', 'right_shank', ('all',)),
        ('left_thigh', 'left_foot', ()),
        ('torso', 'left_thigh', ()),
        ('left_forearm', 'left_foot', ()),
    ],
)
def test_self_collisions(
    description: RobotDescription, first: str, second: str, kinds: tuple[str, ...]
) -> None:
    """Arms collide with the trunk, thighs and each other; legs with each other on request."""
    for kind in ('none', 'arms', 'all'):
        model = world_of(description, physics=Physics(self_collision=kind))
        assert collide(model, in_world('', first), in_world('', second)) == (kind in kinds)


def test_all_links_collide_with_the_world_and_with_other_robots(
    description: RobotDescription,
) -> None:
    """Floor, things and other robots are met by every link, whatever the self-collisions."""
    scene = Scene('box', things=(Thing('crate', 'box', (0.1, 0.1, 0.1), (1.0, 1.0, 0.05)),))
    placements = (Placement('a'), Placement('b', y_m=1.0))
    model = world_of(description, placements, Physics(self_collision='none'), scene)
    for link in ('a/torso', 'a/left_foot', 'b/right_forearm'):
        assert collide(model, link, 'floor')
        assert collide(model, link, 'crate')
    assert collide(model, 'a/left_thigh', 'b/right_thigh')
    assert collide(model, 'a/head', 'b/left_foot')


def test_the_camera_looks_along_the_optical_frame(description: RobotDescription) -> None:
    """A camera of MuJoCo looks along -z with y up: that is z and -y of the optical frame."""
    model = world_of(description)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    camera = data.camera(in_world('', 'head_camera')).xmat.reshape(3, 3)
    optical = data.body(in_world('', 'camera_optical_frame')).xmat.reshape(3, 3)
    assert -camera[:, 2] == pytest.approx(optical[:, 2], abs=1e-9)
    assert -camera[:, 1] == pytest.approx(optical[:, 1], abs=1e-9)
    assert -camera[:, 2] == pytest.approx([1.0, 0.0, 0.0], abs=1e-9)


def test_a_link_may_weigh_more(description: RobotDescription) -> None:
    """A factor multiplies mass and inertia of one link."""
    plain = world_of(description).body(in_world('', 'torso'))
    heavy = world_of(description, physics=Physics(mass_factors={'torso': 1.2}))
    torso = heavy.body(in_world('', 'torso'))
    assert torso.mass[0] == pytest.approx(1.2 * plain.mass[0])
    assert torso.inertia == pytest.approx(1.2 * plain.inertia)
    assert heavy.body(in_world('', 'head')).mass[0] == pytest.approx(1.6)


@pytest.mark.parametrize(
    ('change', 'sentence'),
    [
        (lambda d: replace(d, urdf='<robot'), 'its URDF is not valid XML'),
        (lambda d: replace(d, urdf='<robot><link/></robot>'), 'MuJoCo rejects its URDF'),
        (lambda d: replace(d, urdf=d.urdf.replace('imu_link', 'imulink')), "'imulink'?"),
        (lambda d: replace(d, drives={'left_kne': d.drives['left_knee']}), "'left_knee'?"),
    ],
)
def test_a_robot_that_cannot_be_simulated(description, change, sentence: str) -> None:
    """The error says what is wrong with the robot."""
    with pytest.raises(SimulationError) as caught:
        world_of(change(description))
    assert sentence in str(caught.value)


@pytest.mark.parametrize(
    ('placements', 'sentence'),
    [
        ((), 'There is no robot'),
        ((Placement('a'), Placement('a')), "Two robots are named 'a'"),
        ((Placement('a'), Placement()), 'needs a name'),
        ((Placement(x_m=float('nan')),), 'is not finite'),
    ],
)
def test_robots_that_cannot_be_placed(description, placements, sentence: str) -> None:
    """The error says which robot is in the way."""
    with pytest.raises(SimulationError) as caught:
        world_of(description, placements)
    assert sentence in str(caught.value)


@pytest.mark.parametrize(
    ('options', 'sentence'),
    [
        ({'period_s': 0.5}, '0.002 s is a good default'),
        ({'self_collision': 'arm'}, "Did you mean 'arms'?"),
        ({'mass_factors': {'torso': 0.0}}, "The mass factor of link 'torso'"),
    ],
)
def test_physics_that_cannot_be(options, sentence: str) -> None:
    """The error says what to give instead."""
    with pytest.raises(SimulationError) as caught:
        Physics(**options)
    assert sentence in str(caught.value)
