# SPDX-License-Identifier: Apache-2.0
"""Check groups of joints."""

from __future__ import annotations

from humanoid_control.dynamics import BodyModel
import numpy as np


def test_group(model: BodyModel) -> None:
    """A group knows the indices of its joints, which carries which, and their armature."""
    group = model.group(['left_knee', 'left_hip_roll', 'right_knee'])
    assert group.indices.tolist() == [model.index(joint) for joint in group.joints]
    assert group.carries.tolist() == [[1, 0, 0], [1, 1, 0], [0, 0, 1]]
    assert group.armature_kgm2.tolist() == np.diag([0.04, 0.04, 0.04]).tolist()


def test_symmetric(model: BodyModel) -> None:
    """What is right of a matrix is on both sides, the rest zero; the diagonal stays."""
    group = model.group(['left_knee', 'left_hip_roll', 'right_knee'])
    below = np.array([[1.0, 99.0, 99.0], [2.0, 3.0, 99.0], [99.0, 99.0, 4.0]])
    assert group.symmetric(below).tolist() == [[1, 2, 0], [2, 3, 0], [0, 0, 4]]
