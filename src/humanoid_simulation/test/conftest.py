# SPDX-License-Identifier: Apache-2.0
"""What the tests share."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from humanoid_control.backends import JointTargets
from humanoid_simulation.backend import MujocoBackend
from humanoid_simulation.keyframes import Keyframe, load_keyframes
from humanoid_simulation.model import humanoid, RobotDescription
import numpy as np
import pytest

MakeBackend = Callable[..., MujocoBackend]
Hold = Callable[[np.ndarray], JointTargets]


@pytest.fixture(scope='session')
def description() -> RobotDescription:
    """Return the humanoid."""
    return humanoid()


@pytest.fixture(scope='session')
def keyframes() -> dict[str, Keyframe]:
    """Return the installed keyframes."""
    return load_keyframes()


@pytest.fixture
def make_backend(description: RobotDescription, keyframes: dict[str, Keyframe]) -> MakeBackend:
    """Return what makes a world with the humanoid."""

    def make(**options: Any) -> MujocoBackend:
        return MujocoBackend(description, keyframes=keyframes, **options)

    return make


@pytest.fixture
def backend(make_backend: MakeBackend) -> MujocoBackend:
    """Return the humanoid, alone on a floor."""
    return make_backend()


@pytest.fixture
def hold() -> Hold:
    """Return what makes targets that hold positions."""

    def make(positions: np.ndarray) -> JointTargets:
        return JointTargets(positions, np.zeros(len(positions)), np.zeros(len(positions)))

    return make
