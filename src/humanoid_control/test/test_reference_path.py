# SPDX-License-Identifier: Apache-2.0
"""Check that steps that stray come back to the path."""

from __future__ import annotations

from humanoid_control.walking.footsteps import FootstepPlanner
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import PlanarPose
from humanoid_control.walking.reference_path import ReferencePath
from humanoid_control.walking.sides import LEFT, other
from humanoid_control.walking.velocity_command import STANDING, VelocityCommand
import pytest

P = WalkParameters()
PLANNER = FootstepPlanner(P)
FORWARD = VelocityCommand(0.3)


def walked(steps: int, stray: complex, stray_rad: float, slow: float = 1.0) -> PlanarPose:
    """Return where steps forward lead that each land a little off, and take longer by a factor."""
    path, middle, side = ReferencePath(PLANNER), PlanarPose(), LEFT
    for _ in range(steps):
        goal = PLANNER.next_middle(path.corrected(middle), side, FORWARD)
        middle = PlanarPose(goal.position_m + stray, goal.yaw_rad + stray_rad)
        path.advance(side, FORWARD, slow * P.timing.step_s)
        side = other(side)
    return middle


def test_perfect_steps_need_no_correction() -> None:
    """A robot that lands where planned is on its path."""
    end = walked(20, 0j, 0.0)
    assert end.position_m == pytest.approx(20 * P.timing.step_s * 0.3)
    assert end.yaw_rad == 0.0


def test_straying_does_not_add_up() -> None:
    """Forty steps of which each strays stay as near to the line as a few."""
    end = walked(40, 0.002 - 0.004j, 0.01)
    assert abs(end.position_m - 40 * P.timing.step_s * 0.3) < 0.03
    assert abs(end.yaw_rad) < 0.03


def test_slow_steps_go_farther() -> None:
    """A step that takes longer than planned goes as far as the velocity asks in that time."""
    far_m = walked(40, 0j, 0.0, slow=1.03).position_m.real
    assert far_m == pytest.approx(40 * 1.03 * P.timing.step_s * 0.3, rel=0.01)


def test_a_push_is_not_made_up_for() -> None:
    """What moves the robot far off moves its path too, up to a little."""
    path = ReferencePath(PLANNER)
    path.corrected(PlanarPose())
    pushed = PlanarPose(0.3 + 0.4j, 1.0)
    start = path.corrected(pushed)
    back_m = P.footsteps.path_gain * P.footsteps.path_distance_m
    assert abs(start.position_m - pushed.position_m) == pytest.approx(back_m)
    assert pushed.yaw_rad - start.yaw_rad == pytest.approx(
        P.footsteps.path_gain * P.footsteps.path_turn_rad
    )
    again = path.corrected(pushed)
    assert again.position_m == pytest.approx(start.position_m)


def test_a_restart_forgets_the_way() -> None:
    """A robot that begins to walk is where it is."""
    path, here = ReferencePath(PLANNER), PlanarPose(1 + 2j, 0.5)
    path.corrected(PlanarPose())
    path.restart()
    path.advance(LEFT, FORWARD, P.timing.step_s)
    assert path.corrected(here) == here
    path.advance(LEFT, STANDING, P.timing.step_s)
    assert path.corrected(here).position_m == pytest.approx(here.position_m)
