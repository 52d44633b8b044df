# SPDX-License-Identifier: Apache-2.0
"""Check the hoist on a point mass, and on the robot that has fallen."""

from __future__ import annotations

from humanoid_control.hosting.walking_robot import WalkingRobotControl
from humanoid_description.drives import load_drives
from humanoid_description.expansion import humanoid_urdf
from humanoid_description.loading import load_robot
from humanoid_description.rotations import quaternion_from_rpy, quaternion_from_vector
from humanoid_simulation.backend import EntityState
from humanoid_simulation.backend.hoist import GRAVITY_M_S2, Hoist, HoistSettings
from humanoid_simulation.quaternions import product
import numpy as np
import pytest

MASS_KG, STANDING_M, STEP_S = 40.0, 0.7, 0.002
INERTIA_KGM2 = MASS_KG * (0.6 * STANDING_M / 2) ** 2


def lift(state: EntityState, floor_m: float) -> tuple[list[EntityState], float]:
    """
    Return the way of a body that the hoist lifts onto a floor, and the greatest force.

    The floor carries the body from when it was above it: then its legs are below it.
    """
    hoist, states, most_n = Hoist(state, MASS_KG, STANDING_M), [state], 0.0
    has_legs_below = False
    while not hoist.is_done:
        state = states[-1]
        force, torque = hoist.wrench(state, STEP_S)
        most_n = max(most_n, float(np.linalg.norm(force)))
        weight = np.array([0.0, 0.0, -MASS_KG * GRAVITY_M_S2])
        has_legs_below = has_legs_below or state.position_m[2] > floor_m
        below_m = max(0.0, floor_m - state.position_m[2]) if has_legs_below else 0.0
        speed = state.linear_velocity_m_s
        ground = np.array([0.0, 0.0, (2e4 * below_m - 2e3 * speed[2]) if below_m else 0.0])
        velocity = speed + STEP_S * (force + weight + ground) / MASS_KG
        turning = state.angular_velocity_rad_s + STEP_S * torque / INERTIA_KGM2
        states.append(
            EntityState(
                state.position_m + STEP_S * velocity,
                product(quaternion_from_vector(STEP_S * turning), state.orientation),
                velocity,
                turning,
            )
        )
    return states, most_n


@pytest.mark.parametrize(
    ('roll', 'pitch', 'yaw', 'faces'),
    [
        (0.0, -np.pi / 2, 0.5, 0.5),
        (0.0, np.pi / 2, -1.0, -1.0),
        (np.pi / 2, 0.0, 2.0, 2.0),
        (0.3, 0.2, -2.0, -2.0),
    ],
)
def test_it_puts_a_body_onto_its_feet(roll: float, pitch: float, yaw: float, faces: float) -> None:
    """Upright above where it lay, facing where it faced, gently, and then it lets go."""
    place = np.array([1.0, -2.0, 0.1])
    states, most_n = lift(EntityState(place, quaternion_from_rpy(roll, pitch, yaw)), STANDING_M)
    end = states[-1]
    assert end.position_m == pytest.approx([1.0, -2.0, STANDING_M], abs=0.03)
    upright = quaternion_from_rpy(0.0, 0.0, faces)
    assert abs(end.orientation @ upright) == pytest.approx(1.0, abs=1e-2)
    assert np.abs(end.linear_velocity_m_s).max() < 0.02
    assert max(np.linalg.norm(state.linear_velocity_m_s) for state in states) < 0.8
    assert most_n < 2.0 * MASS_KG * GRAVITY_M_S2
    assert len(states) * STEP_S < 12.0


def test_it_gives_up_on_what_does_not_stand() -> None:
    """A body without feet is let down and let go."""
    state = EntityState(np.array([0.0, 0.0, 0.1]), quaternion_from_rpy(0.0, 1.5, 0.0))
    states, _ = lift(state, 0.0)
    assert len(states) * STEP_S < HoistSettings().give_up_s + HoistSettings().release_s + 0.1
    assert states[-1].position_m[2] < 0.2


@pytest.mark.parametrize(
    'keyframe', [pytest.param('lying_on_back', marks=pytest.mark.story), 'lying_on_face']
)
def test_a_robot_that_lies_stands_up(make_backend, keyframe: str) -> None:
    """Its walker takes the posture of standing while it hangs, and then it stands by itself."""
    backend, drives = make_backend(), load_drives()
    robot = load_robot(humanoid_urdf(1.0), 'the humanoid')
    walker = WalkingRobotControl.of(robot, drives).walker
    backend.reset(keyframe)
    backend.hoist()
    while backend.is_hoisted():
        backend.step({'': walker.update(backend.observe()[''])})
    for _ in range(100):
        backend.step({'': walker.update(backend.observe()[''])})
    assert not walker.has_fallen
    assert backend.ground_truth().position_m[2] > 0.68
