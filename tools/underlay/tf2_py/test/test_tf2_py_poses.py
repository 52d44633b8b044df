# SPDX-License-Identifier: Apache-2.0
"""Poses: the same as scipy says."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp
from tf2_py import poses


def random_pose(generator: np.random.Generator) -> poses.Pose:
    """Return a pose."""
    quaternion = generator.normal(size=4)
    quaternion /= np.linalg.norm(quaternion)
    return (*generator.uniform(-2, 2, 3).tolist(), *quaternion.tolist())


def matrix(pose: poses.Pose) -> np.ndarray:
    """Return the 4x4 matrix by scipy."""
    result = np.eye(4)
    result[:3, :3] = Rotation.from_quat(pose[3:]).as_matrix()
    result[:3, 3] = pose[:3]
    return result


@pytest.mark.parametrize('seed', range(20))
def test_chain_and_inverse(seed: int) -> None:
    """A chain is a product of matrices, and an inverse the inverse matrix."""
    generator = np.random.default_rng(seed)
    first, second = random_pose(generator), random_pose(generator)
    product = matrix(first) @ matrix(second)
    np.testing.assert_allclose(matrix(poses.chain(first, second)), product, atol=1e-12)
    inverse = np.linalg.inv(matrix(first))
    np.testing.assert_allclose(matrix(poses.inverse(first)), inverse, atol=1e-12)


@pytest.mark.parametrize(
    'angle', [1e-9, 1e-6, 2e-6, 4e-6, 1e-4, 2.8e-4, 3e-4, 0.01, 1.0, 3.0, 3.14159, 5.0]
)
@pytest.mark.parametrize('fraction', [0.0, 0.1, 0.5, 0.999])
def test_interpolation(angle: float, fraction: float) -> None:
    """Rotations are interpolated as by Slerp, for small and large angles."""
    generator = np.random.default_rng(1)
    first = random_pose(generator)
    axis = generator.normal(size=3)
    turn = Rotation.from_quat(first[3:]) * Rotation.from_rotvec(
        axis / np.linalg.norm(axis) * angle
    )
    last = (*generator.uniform(-2, 2, 3).tolist(), *turn.as_quat().tolist())
    expected = Slerp([0, 1], Rotation.from_quat([first[3:], last[3:]]))(fraction)
    result = poses.interpolate(first, last, fraction)
    between = Rotation.from_quat(result[3:]).inv() * expected
    assert between.magnitude() < 1e-11
    # scipy's rotations have the length 1 whatever they are made of.
    assert np.linalg.norm(result[3:]) == pytest.approx(1.0, abs=1e-12)
    straight = np.array(first[:3]) * (1 - fraction) + np.array(last[:3]) * fraction
    np.testing.assert_allclose(result[:3], straight, atol=1e-12)


def test_opposite_quaternions_are_the_same_rotation() -> None:
    """Between q and -q nothing turns."""
    first = (0.0, 0.0, 0.0, 0.6, 0.0, 0.0, 0.8)
    last = (1.0, 0.0, 0.0, -0.6, 0.0, 0.0, -0.8)
    assert poses.interpolate(first, last, 0.5) == pytest.approx((0.5, *first[1:]))


def test_normalized() -> None:
    """A quaternion nearly of length 1 is corrected; others are refused."""
    assert poses.normalized((1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.001)) == (
        1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0,
    )  # fmt: skip
    assert poses.normalized((0.0,) * 7) is None
    assert poses.normalized((0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.01)) is None
    assert poses.normalized((0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0)) is None
