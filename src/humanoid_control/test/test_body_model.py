# SPDX-License-Identifier: Apache-2.0
"""Check what a model accepts, and what it refuses."""

from __future__ import annotations

from typing import Any

from humanoid_control.dynamics import BodyModel, DynamicsError
from humanoid_description.robot import Robot
import numpy as np
import pytest


def state_inputs(model: BodyModel) -> dict[str, Any]:
    """Return the arguments of a state at rest."""
    n = len(model.joints)
    return {
        'rotation': np.eye(3),
        'angular_velocity_rad_s': np.zeros(3),
        'positions_rad': np.zeros(n),
        'velocities_rad_s': np.zeros(n),
    }


def test_mass(model: BodyModel, robot: Robot) -> None:
    """The model weighs what the robot weighs."""
    assert model.mass_kg == pytest.approx(robot.mass_kg)


def test_armature(robot: Robot) -> None:
    """One armature is that of all joints; several are theirs, and must be as many."""
    joints = ('left_knee', 'right_knee')
    assert BodyModel.of(robot, joints, 0.1).armature_kgm2.tolist() == [0.1, 0.1]
    assert BodyModel.of(robot, joints, [0.1, 0.2]).armature_kgm2.tolist() == [0.1, 0.2]
    with pytest.raises(DynamicsError, match=r'3 values of armature .* 2 joints'):
        BodyModel.of(robot, joints, [0.1, 0.2, 0.3])


@pytest.mark.parametrize('armature', [-0.1, np.nan, np.inf])
def test_impossible_armature(robot: Robot, armature: float) -> None:
    """An armature is a finite inertia, zero or more."""
    with pytest.raises(DynamicsError, match="armature of joint 'right_knee'"):
        BodyModel.of(robot, ('left_knee', 'right_knee'), [0.1, armature])


@pytest.mark.parametrize('name', ['rotation', 'velocities_rad_s', 'positions_rad'])
def test_wrong_shape(model: BodyModel, name: str) -> None:
    """An array of another shape is refused by its name."""
    inputs = {**state_inputs(model), name: np.zeros(4)}
    with pytest.raises(DynamicsError, match=rf'{name} has the shape \(4,\)'):
        model.state(**inputs)


@pytest.mark.parametrize('bad', [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize(
    'name', ['rotation', 'angular_velocity_rad_s', 'positions_rad', 'velocities_rad_s']
)
def test_not_finite(model: BodyModel, name: str, bad: float) -> None:
    """What is not finite is refused, with its place."""
    inputs = state_inputs(model)
    inputs[name].flat[2] = bad
    with pytest.raises(DynamicsError, match=f'{name} holds {bad} at index 2'):
        model.state(**inputs)


def test_unknown_names(model: BodyModel) -> None:
    """A joint or link that there is not is refused, with the one that was meant."""
    state = model.state(**state_inputs(model))
    with pytest.raises(DynamicsError, match=r"no joint 'left_kne'. Did you mean 'left_knee'\?"):
        model.group(['left_kne'])
    with pytest.raises(DynamicsError, match=r"no link 'l_soul'. Did you mean 'l_sole'\?"):
        state.jacobian('l_soul')
