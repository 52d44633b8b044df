# SPDX-License-Identifier: Apache-2.0
"""Check that the robot walks over what the scene `uneven` has, and stands again at its end."""

from __future__ import annotations

import math

from humanoid_control.walking import VelocityCommand, Walker, WalkParameters
from humanoid_description.loading import load_robot
from humanoid_simulation.backend import BackendSettings, MujocoBackend
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.model import humanoid, Placement
from humanoid_simulation.scene import load_scene
import pytest


class UnevenWalk:
    """A robot in the scene, that is told where to go."""

    def __init__(self, place: Placement, settings: BackendSettings = BackendSettings()) -> None:
        """Stand at a place."""
        description = humanoid()
        self.backend = MujocoBackend(description, load_scene('uneven'), [place], settings)
        robot = load_robot(description.urdf, 'the humanoid')
        drives, joints = description.drives, self.backend.joints
        self.walker = Walker.of(robot, drives, joints, WalkParameters())
        self.go(1.0)

    def go(self, duration_s: float, *velocity: float) -> None:
        """Walk at a velocity (forward, left, turn) for some time, without falling."""
        self.walker.command(VelocityCommand(*velocity))
        for _ in range(round(duration_s / self.backend.period_s)):
            self.backend.step({'': self.walker.update(self.backend.observe()[''])})
            assert not self.walker.has_fallen, f'fell at {self.place_m}'

    @property
    def place_m(self) -> list[float]:
        """Return where the base truly is."""
        place: list[float] = self.backend.ground_truth().position_m.tolist()
        return place

    def stands(self) -> bool:
        """Tell whether the robot stands."""
        status = self.walker.status
        return status is not None and status.phase == 'stand'


@pytest.mark.parametrize(('speed_m_s', 'noise'), [(0.3, False), (0.25, True)])
def test_over_plates(speed_m_s: float, noise: bool) -> None:
    """Plates of up to 20 mm, which every step meets in another way, at two speeds."""
    settings = BackendSettings(noise=REALISTIC) if noise else BackendSettings()
    walk = UnevenWalk(Placement(), settings)
    walk.go(3.8 / speed_m_s, speed_m_s)
    walk.go(4.0)
    assert walk.stands()
    x, y, _ = walk.place_m
    assert x == pytest.approx(3.8, abs=0.5)
    assert abs(y) < 0.5


def test_over_a_hill() -> None:
    """Up a slope of 5 degrees, along its top and down on the other side."""
    walk, heights_m = UnevenWalk(Placement(yaw_rad=math.pi / 2)), []
    for _ in range(22):
        walk.go(1.0, 0.25)
        heights_m.append(walk.place_m[2])
    walk.go(4.0)
    assert walk.stands()
    assert max(heights_m) == pytest.approx(0.7 + 1.5 * math.sin(math.radians(5.0)), abs=0.03)
    assert walk.place_m[1] > 4.8
    assert walk.place_m[2] == pytest.approx(0.695, abs=0.02)


def test_across_a_slope() -> None:
    """Up a little, around by a quarter turn, and along the slope."""
    walk = UnevenWalk(Placement(x_m=0.8, y_m=-1.0, yaw_rad=-math.pi / 2))
    walk.go(4.5, 0.25)
    walk.go(math.pi / 2 / 0.5, 0.0, 0.0, 0.5)
    walk.go(5.0, 0.25)
    walk.go(4.0)
    assert walk.stands()
    x, y, z = walk.place_m
    assert x > 1.5
    assert z > 0.695 + 0.5 * math.tan(math.radians(5.0)) * (-1.2 - y)
