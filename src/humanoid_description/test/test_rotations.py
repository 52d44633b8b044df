# SPDX-License-Identifier: Apache-2.0
"""Check rotations against those of scipy."""

from __future__ import annotations

import math

from humanoid_description import rotations
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

RANDOM = Rotation.random(50, random_state=np.random.default_rng(1))
ANGLES = [(0.0, 0.0, 0.0), (0.3, -0.2, 0.9), (-2.0, 1.2, -3.0), (0.0, math.pi / 2, 0.4)]
HALF_TURNS = Rotation.from_rotvec(np.pi * np.vstack([np.eye(3), [[0.6, 0.0, 0.8]]]))


@pytest.mark.parametrize('length', [1.0, 1e-3, 200.0])
def test_from_quaternion(length: float) -> None:
    """A quaternion w, x, y, z of any length is the rotation that scipy has."""
    for rotation in RANDOM:
        quaternion = length * np.roll(rotation.as_quat(), 1)
        assert rotations.from_quaternion(quaternion) == pytest.approx(rotation.as_matrix())


@pytest.mark.parametrize('w', [0.0, math.nan, math.inf])
def test_no_quaternion(w: float) -> None:
    """A quaternion without a direction is refused."""
    with pytest.raises(ValueError, match='is not a rotation'):
        rotations.from_quaternion((w, 0.0, 0.0, 0.0))


def test_rpy() -> None:
    """Roll, pitch and yaw turn about fixed axes in this order, and are found again."""
    for rotation in RANDOM:
        roll, pitch, yaw = rotation.as_euler('xyz')
        matrix = rotations.from_rpy(roll, pitch, yaw)
        assert matrix == pytest.approx(rotation.as_matrix())
        assert rotations.to_rpy(matrix) == pytest.approx((roll, pitch, yaw))
        assert rotations.yaw_of(matrix) == pytest.approx(yaw)


def test_about_z() -> None:
    """A quarter of a turn about z brings x to y."""
    assert rotations.about_z(math.pi / 2) @ (1, 0, 0) == pytest.approx([0, 1, 0])


@pytest.mark.parametrize('angle', [0.0, 1e-12, 1e-5, 1.0, 3.0])
def test_exp(angle: float) -> None:
    """The rotation about a vector is that of scipy, however small."""
    vector = angle * np.array([0.6, -0.48, 0.64])
    expected = Rotation.from_rotvec(vector).as_matrix()
    assert rotations.exp(vector) == pytest.approx(expected, abs=1e-14)


@pytest.mark.parametrize('angle', [0.0, 1e-12, 1e-5, 1.0, 3.0, math.pi - 1e-7])
def test_log(angle: float) -> None:
    """The vector of a rotation is found again, from none to nearly half a turn."""
    vector = angle * np.array([0.6, -0.48, 0.64])
    assert rotations.log(rotations.exp(vector)) == pytest.approx(vector, abs=1e-14)


def test_log_of_half_turns() -> None:
    """After half a turn both directions of the axis are right."""
    for matrix in HALF_TURNS.as_matrix():
        vector = rotations.log(matrix)
        assert np.linalg.norm(vector) == pytest.approx(math.pi)
        assert rotations.exp(vector) == pytest.approx(matrix)


@pytest.mark.parametrize('angle', [0.0, 0.7, -3.0])
def test_about_axis(angle: float) -> None:
    """The rotation is about the axis, by the right-hand rule."""
    axis = np.array([0.6, 0.0, 0.8])
    expected = Rotation.from_rotvec(angle * axis).as_matrix()
    assert rotations.about_axis(axis, angle) == pytest.approx(expected)


@pytest.mark.parametrize('angles', ANGLES)
def test_quaternion_from_rpy(angles: tuple[float, float, float]) -> None:
    """The quaternion is the same rotation as the matrix."""
    quaternion = rotations.quaternion_from_rpy(*angles)
    assert rotations.from_quaternion(quaternion) == pytest.approx(rotations.from_rpy(*angles))


def test_quaternion_from_vector() -> None:
    """A vector turns about itself by its length, also when it is zero."""
    turned = rotations.quaternion_from_vector(np.array([0.0, 0.0, 0.7]))
    assert turned == pytest.approx(rotations.quaternion_from_rpy(0.0, 0.0, 0.7))
    still = rotations.quaternion_from_vector(np.zeros(3))
    assert still == pytest.approx([1.0, 0.0, 0.0, 0.0])


def test_skew() -> None:
    """The matrix multiplies by the cross product."""
    a, b = np.array([1.0, 2.0, 3.0]), np.array([-4.0, 5.0, 7.0])
    assert rotations.skew(a) @ b == pytest.approx(np.cross(a, b))


@pytest.mark.parametrize(
    ('angle', 'wrapped'), [(0.5, 0.5), (4.0, 4.0 - 2 * math.pi), (-7.0, 2 * math.pi - 7.0)]
)
def test_wrap_angle(angle: float, wrapped: float) -> None:
    """Whole turns are taken away."""
    assert rotations.wrap_angle(angle) == pytest.approx(wrapped)
