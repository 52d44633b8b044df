# SPDX-License-Identifier: Apache-2.0
"""Check the polynomials between points."""

from __future__ import annotations

from humanoid_control.controllers.spline import inner_velocities, Spline
import numpy as np
import pytest

TIMES_S = np.array([0.0, 1.0, 3.0])
POSITIONS = np.array([[0.0, 0.0], [1.0, -1.0], [2.0, 0.0]])
VELOCITIES = np.array([[0.0, 0.3], [0.5, -0.1], [0.0, 0.0]])


@pytest.mark.parametrize('accelerations', [None, np.array([[0.0, 1.0], [2.0, 0.0], [0.0, 0.0]])])
def test_points_are_met(accelerations: np.ndarray | None) -> None:
    """Positions and velocities are met at every point, and stay so before and after."""
    spline = Spline(TIMES_S, POSITIONS, VELOCITIES, accelerations)
    for time_s, position, velocity in zip(TIMES_S, POSITIONS, VELOCITIES):
        at = spline.at(time_s)
        assert at[0] == pytest.approx(position) and at[1] == pytest.approx(velocity)
    assert spline.at(9.0)[0] == pytest.approx(POSITIONS[-1])
    assert spline.at(-1.0)[0] == pytest.approx(POSITIONS[0])


def test_accelerations_are_met() -> None:
    """With accelerations, these are met too."""
    accelerations = np.array([[0.0, 1.0], [2.0, 0.0], [0.0, -1.0]])
    spline = Spline(TIMES_S, POSITIONS, VELOCITIES, accelerations)
    for time_s, acceleration in zip((1e-4, 1.0, 3.0 - 1e-4), accelerations):
        slope = (spline.at(time_s + 1e-4)[1] - spline.at(time_s - 1e-4)[1]) / 2e-4
        assert slope == pytest.approx(acceleration, abs=0.02)


def test_velocity_is_the_derivative() -> None:
    """The velocities are those of the positions."""
    spline = Spline(TIMES_S, POSITIONS, VELOCITIES, None)
    for time_s in np.linspace(0.01, 2.99, 30):
        slope = (spline.at(time_s + 1e-6)[0] - spline.at(time_s - 1e-6)[0]) / 2e-6
        assert spline.at(time_s)[1] == pytest.approx(slope, abs=1e-5)


def test_way_stays_between_the_points() -> None:
    """With velocities of its own choice no joint goes beyond the points; it ends at rest."""
    velocities = inner_velocities(TIMES_S, POSITIONS)
    spline = Spline(TIMES_S, POSITIONS, velocities, None)
    way = np.array([spline.at(time_s)[0] for time_s in np.linspace(0.0, 3.0, 301)])
    assert (np.diff(way[:, 0]) >= -1e-12).all()
    assert way[:, 1].min() >= -1.0 - 1e-12 and way[:, 1].max() <= 1e-12
    assert not velocities[[0, -1]].any() and velocities[1, 1] == 0.0
