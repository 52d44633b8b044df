# SPDX-License-Identifier: Apache-2.0
"""The humanoid, read once for all tests."""

from __future__ import annotations

from humanoid_control.dynamics import BodyModel
from humanoid_description.drives import load_drives
from humanoid_description.expansion import humanoid_urdf
from humanoid_description.loading import load_robot
from humanoid_description.robot import Robot
import pytest


@pytest.fixture(name='scale', scope='session')
def _scale(request: pytest.FixtureRequest) -> float:
    """Return the size of the robot: 1, unless a test asks for others."""
    return float(getattr(request, 'param', 1.0))


@pytest.fixture(name='urdf', scope='session')
def _urdf(scale: float) -> str:
    """Return the URDF of the humanoid."""
    return humanoid_urdf(scale)


@pytest.fixture(name='robot', scope='session')
def _robot(urdf: str) -> Robot:
    """Return the humanoid as its URDF describes it."""
    return load_robot(urdf, 'the humanoid')


@pytest.fixture(name='model', scope='session')
def _model(robot: Robot, scale: float) -> BodyModel:
    """Return the humanoid with all its joints and their armature."""
    drives = load_drives(scale)
    return BodyModel.of(robot, tuple(drives), [d.armature for d in drives.values()])
