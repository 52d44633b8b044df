# SPDX-License-Identifier: Apache-2.0
"""Check kinematics and dynamics against closed solutions and derivatives."""

from __future__ import annotations

import math
from typing import Any

from humanoid_control.dynamics import BodyModel, BodyState
from humanoid_description.robot import Body, Joint, Link, Robot
from humanoid_description.rotations import exp, from_rpy
import numpy as np
import pytest

Array = np.ndarray[Any, Any]
G = 9.81
MASS, LENGTH, INERTIA = 2.0, 0.7, 0.05
STEP_S = 1e-6


def pose_at(x: float, y: float, z: float) -> Array:
    """Return a pose that is not turned."""
    pose = np.eye(4)
    pose[:3, 3] = (x, y, z)
    return pose


def pendulum(arms: int) -> BodyModel:
    """Return a chain of arms that hang down at zero and swing about y; each has its mass below."""
    body = Body(MASS, pose_at(0, 0, -LENGTH), np.diag([INERTIA, INERTIA, 0.01]))
    links = [Link('root', Body(5.0, np.eye(4), np.eye(3)))]
    joints = []
    for number in range(arms):
        links.append(Link(f'arm{number}', body))
        joints.append(
            Joint(
                f'swing{number}',
                'continuous',
                links[-2].name,
                links[-1].name,
                pose_at(0, 0, -LENGTH if number else 0.0),
                np.array([0.0, 1.0, 0.0]),
            )
        )
    return BodyModel.of(
        Robot('pendulum', tuple(links), tuple(joints)), [joint.name for joint in joints]
    )


def swinging(model: BodyModel, turning_rad_s: float, *values: float) -> BodyState:
    """Return a pendulum whose root turns about z; the values are angles, then rates."""
    n = len(model.joints)
    return model.state(
        np.eye(3), np.array([0, 0, turning_rad_s]), np.array(values[:n]), np.array(values[n:])
    )


@pytest.mark.parametrize('angle', [0.0, 0.4, -1.3, 3.0])
def test_pendulum(angle: float) -> None:
    """A pendulum at rest is held against its weight; turning, centrifugal forces lift it."""
    model, turning = pendulum(1), 2.5
    s, c = math.sin(angle), math.cos(angle)
    weight = MASS * G * LENGTH * s
    # The inertia about the upright axis minus that about the pendulum itself, for bodies of any
    # shape: (m l^2 + I_x - I_z) W^2 sin cos.
    lift = (MASS * LENGTH**2 + INERTIA - 0.01) * turning**2 * s * c
    assert swinging(model, 0.0, angle, 0.0).bias_nm == pytest.approx([weight])
    assert swinging(model, turning, angle, 3.0).bias_nm == pytest.approx([weight - lift])


def test_double_pendulum() -> None:
    """Two arms have the inertia and the bias of the textbook."""
    model = pendulum(2)
    (q1, q2), (v1, v2) = (0.7, -1.1), (1.5, -2.0)
    state = swinging(model, 0.0, q1, q2, v1, v2)
    ml2 = MASS * LENGTH**2
    coupling = ml2 * math.cos(q2)
    m22 = ml2 + INERTIA
    m12 = m22 + coupling
    m11 = 2 * m22 + ml2 + 2 * coupling
    inertia = state.inertia_kgm2(model.group(model.joints))
    assert inertia == pytest.approx(np.array([[m11, m12], [m12, m22]]))
    h = ml2 * math.sin(q2)
    weight = MASS * G * LENGTH
    low = weight * math.sin(q1 + q2)
    bias = [2 * weight * math.sin(q1) + low - h * (2 * v1 * v2 + v2**2), low + h * v1**2]
    assert state.bias_nm == pytest.approx(bias)


def test_wrench_at_rest(model: BodyModel) -> None:
    """A robot at rest is held by its weight, which acts at its centre of mass."""
    n = len(model.joints)
    state = model.state(from_rpy(0.3, 0.2, 1.0), np.zeros(3), np.full(n, 0.3), np.zeros(n))
    weight = np.array([0.0, 0.0, model.mass_kg * G])
    expected = [*weight, *np.cross(state.com_m, weight)]
    assert state.bias_wrench == pytest.approx(expected, abs=1e-9)


class Moving:
    """The humanoid in a random motion in which nothing accelerates, at any time."""

    def __init__(self, model: BodyModel) -> None:
        """Choose posture and motion."""
        generator = np.random.default_rng(5)
        n = len(model.joints)
        self.model = model
        self.rotation = from_rpy(*generator.uniform(-1, 1, 3))
        self.turning = generator.normal(size=3)
        self.positions, self.velocities = generator.normal(size=(2, n))

    def at(self, time_s: float) -> BodyState:
        """Return the state; the root turns evenly about a fixed axis of its own."""
        rotation = self.rotation @ exp(self.turning * time_s)
        positions = self.positions + self.velocities * time_s
        return self.model.state(rotation, self.turning, positions, self.velocities)

    def rate(self, quantity: Any) -> Any:
        """Return the numeric derivative of a quantity of the state by time."""
        return (quantity(self.at(STEP_S)) - quantity(self.at(-STEP_S))) / (2 * STEP_S)


@pytest.fixture(name='moving', scope='module')
def _moving(model: BodyModel) -> Moving:
    """Return the humanoid in motion."""
    return Moving(model)


@pytest.mark.parametrize('link', ['base_link', 'l_sole', 'imu_link', 'r_gripper', 'gaze'])
def test_velocity_is_the_derivative(moving: Moving, link: str) -> None:
    """The velocity of a link is the derivative of its position, and so is its turning."""
    state = moving.at(0.0)
    velocity = moving.rate(lambda s: s.position_m(link))
    assert state.velocity_m_s(link) == pytest.approx(velocity, abs=1e-8)
    turn = moving.rate(lambda s: s.rotation(link)) @ state.rotation(link).T
    turning = [turn[2, 1], turn[0, 2], turn[1, 0]]
    assert state.angular_velocity_rad_s(link) == pytest.approx(turning, abs=1e-8)
    assert state.pose(link)[:3, 3] == pytest.approx(state.position_m(link))
    assert state.pose(link)[:3, :3] == pytest.approx(state.rotation(link))


def test_com_velocity_is_the_derivative(moving: Moving) -> None:
    """The centre of mass moves as its velocity says."""
    velocity = moving.rate(lambda s: s.com_m)
    assert moving.at(0.0).com_velocity_m_s == pytest.approx(velocity, abs=1e-8)


def test_wrench_changes_momentum(moving: Moving) -> None:
    """Force less weight is the rate of the linear momentum, torque that of the angular one."""
    state, mass_kg = moving.at(0.0), moving.model.mass_kg
    weight = np.array([0.0, 0.0, mass_kg * G])
    force = moving.rate(lambda s: mass_kg * s.com_velocity_m_s) + weight
    assert state.bias_wrench[:3] == pytest.approx(force, abs=1e-5)
    about_com = moving.rate(lambda s: s.angular_momentum_nms)
    torque = state.bias_wrench[3:] - np.cross(state.com_m, state.bias_wrench[:3])
    assert torque == pytest.approx(about_com, abs=1e-5)


def test_power_changes_energy(robot: Robot, model: BodyModel) -> None:
    """What the joints exert times their rates is the change of kinetic and potential energy."""
    moving = Moving(BodyModel.of(robot, model.joints))
    moving.turning = np.zeros(3)
    group = moving.model.group(model.joints)

    def energy(state: BodyState) -> float:
        v = state.velocities_rad_s
        height_m = state.com_m[2]
        return float(v @ state.inertia_kgm2(group) @ v / 2 + model.mass_kg * G * height_m)

    power = float(moving.at(0.0).bias_nm @ moving.velocities)
    assert power == pytest.approx(moving.rate(energy), abs=1e-5)


@pytest.mark.parametrize('link', ['l_sole', 'torso', 'base_link'])
def test_jacobian_maps_rates(moving: Moving, link: str) -> None:
    """The Jacobians map the motion of root and joints to that of a point on a link."""
    state, point = moving.at(0.0), np.array([0.2, -0.3, 0.5])
    motion = np.concatenate(
        [np.zeros(3), state.base_angular_velocity_rad_s, state.velocities_rad_s]
    )
    velocity = state.velocity_m_s(link, point)
    assert state.jacobian(link, point) @ motion == pytest.approx(velocity)
    turning = state.angular_velocity_rad_s(link)
    assert state.angular_jacobian(link) @ motion == pytest.approx(turning)
    assert state.jacobian(link)[:, :3].tolist() == np.eye(3).tolist()


def test_efforts_of_force(moving: Moving) -> None:
    """A force has the efforts that the transpose of the Jacobian says."""
    state = moving.at(0.0)
    point, force = np.array([0.2, -0.3, 0.5]), np.array([10.0, -20.0, 300.0])
    efforts = state.jacobian('l_sole', point)[:, 6:].T @ force
    assert state.efforts_of_force_nm('l_sole', point, force) == pytest.approx(efforts)


def test_inertia_of_a_group(moving: Moving) -> None:
    """The inertia of some joints, in any order, is a part of that of all."""
    model, state = moving.model, moving.at(0.0)
    group = model.group(['left_knee', 'waist_yaw', 'left_hip_yaw', 'left_elbow'])
    whole = state.inertia_kgm2(model.group(model.joints))
    part = whole[np.ix_(group.indices, group.indices)]
    assert state.inertia_kgm2(group) == pytest.approx(part, abs=1e-12)
    assert part[0, 1] == 0.0 != part[0, 2]


@pytest.mark.parametrize('name', ['com_m', 'com_velocity_m_s', 'bias_nm', 'bias_wrench'])
def test_kept_quantities(moving: Moving, name: str) -> None:
    """What is computed once is handed out again, and cannot be changed by who gets it."""
    state = moving.at(0.0)
    assert getattr(state, name) is getattr(state, name)
    with pytest.raises(ValueError, match='read-only'):
        getattr(state, name)[0] += 1.0


def test_a_state_without_joints(robot: Robot) -> None:
    """A robot of which no joint turns has a centre of mass and no bias."""
    state = BodyModel.of(robot, ()).state(np.eye(3), np.ones(3), np.zeros(0), np.zeros(0))
    assert state.bias_nm.shape == (0,)
    assert state.com_velocity_m_s == pytest.approx(np.cross(np.ones(3), state.com_m))
    assert state.jacobian('l_sole').shape == (3, 6)


@pytest.mark.parametrize('link', ['l_sole', 'head'])
def test_jacobian_of_some_joints(moving: Moving, link: str) -> None:
    """The Jacobian of a group has the columns of its joints, zero where they move nothing."""
    state = moving.at(0.0)
    group = moving.model.group(['left_ankle_roll', 'left_knee', 'head_yaw'])
    whole = np.vstack([state.jacobian(link), state.angular_jacobian(link)])
    assert state.jacobian_of(group, link) == pytest.approx(whole[:, 6 + group.indices])


def test_com_jacobian_maps_to_its_velocity(moving: Moving) -> None:
    """The Jacobian of the centre of mass times all velocities is its velocity."""
    state = moving.at(0.0)
    rates = [np.zeros(3), state.base_angular_velocity_rad_s, moving.velocities]
    assert state.com_jacobian @ np.concatenate(rates) == pytest.approx(state.com_velocity_m_s)


def test_drift_is_the_derivative(moving: Moving) -> None:
    """While nothing accelerates, links and the centre of mass still do: in circles."""
    state = moving.at(0.0)
    linear = moving.rate(lambda s: s.velocity_m_s('l_sole'))
    angular = moving.rate(lambda s: s.angular_velocity_rad_s('l_sole'))
    assert state.drift('l_sole') == pytest.approx(np.concatenate([linear, angular]), abs=1e-6)
    of_com = moving.rate(lambda s: s.com_velocity_m_s)
    assert state.com_drift_m_s2 == pytest.approx(of_com, abs=1e-6)


def test_required_without_accelerations_is_the_bias(moving: Moving) -> None:
    """A robot in which nothing accelerates needs the bias."""
    state, n = moving.at(0.0), len(moving.model.joints)
    wrench, efforts = state.required(np.zeros(6), np.zeros(n))
    assert wrench == pytest.approx(state.bias_wrench)
    assert efforts == pytest.approx(state.bias_nm)


def test_required_force_accelerates_the_com(moving: Moving) -> None:
    """The force on the root is mass times acceleration of the centre of mass, and the weight."""
    state, generator = moving.at(0.0), np.random.default_rng(7)
    accelerations = generator.normal(size=6 + len(moving.model.joints))
    wrench, _ = state.required(accelerations[:6], accelerations[6:])
    expected = state.com_jacobian @ accelerations + state.com_drift_m_s2 + [0.0, 0.0, G]
    assert wrench[:3] == pytest.approx(moving.model.mass_kg * expected)


def test_required_efforts_are_those_of_the_inertia(moving: Moving) -> None:
    """Accelerations of a leg need the bias and the leg's inertia times them."""
    state, model = moving.at(0.0), moving.model
    group = model.group([name for name in model.joints if name.startswith('left_hip')])
    accelerations = np.zeros(len(model.joints))
    accelerations[group.indices] = (1.0, -2.0, 3.0)
    _, efforts = state.required(np.zeros(6), accelerations)
    own = state.inertia_kgm2(group) @ accelerations[group.indices]
    assert efforts[group.indices] - state.bias_nm[group.indices] == pytest.approx(own)


def test_torque_acts_at_the_joints(moving: Moving) -> None:
    """A torque on a link acts at the joints as the Jacobian of its turning says."""
    state, torque = moving.at(0.0), np.array([1.0, -2.0, 0.5])
    efforts = state.efforts_of_force_nm('l_sole', np.zeros(3), np.zeros(3), torque)
    assert efforts == pytest.approx(state.angular_jacobian('l_sole')[:, 6:].T @ torque)
