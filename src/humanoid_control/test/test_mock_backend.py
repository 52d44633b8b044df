# SPDX-License-Identifier: Apache-2.0
"""Check the robots without physics."""

from __future__ import annotations

from humanoid_control.backends import Backend
from humanoid_control.mock_backend import MockBackend
from humanoid_control.testing import DRIVES, JOINTS, PERIOD_S, targets
import numpy as np
import pytest

TIME_CONSTANT_S = (1.8 + 0.2) / 60.0


def run(backend: Backend, steps: int) -> np.ndarray:
    """Let time pass; return the positions."""
    for _ in range(steps):
        backend.step({})
    return backend.observe()[''].positions_rad


def test_approach() -> None:
    """A joint approaches its target exponentially."""
    backend = MockBackend(DRIVES, period_s=TIME_CONSTANT_S)
    backend.step({'': targets(0.1, -0.1, 0.0)})
    seen = backend.observe()['']
    assert seen.positions_rad == pytest.approx([0.1 - 0.1 / np.e, -0.1 + 0.1 / np.e, 0.0])
    assert seen.velocities_rad_s[0] == pytest.approx(0.1 / np.e / TIME_CONSTANT_S)
    assert seen.efforts_nm[0] == pytest.approx(0.2 * seen.velocities_rad_s[0])
    assert run(backend, 30) == pytest.approx([0.1, -0.1, 0.0], abs=1e-9)


def test_period_does_not_matter() -> None:
    """The way is the same in one period as in many, with the limit of velocity in between."""
    slow, fast = (MockBackend(DRIVES, period_s=period_s) for period_s in (0.2, 0.002))
    for backend in (slow, fast):
        backend.step({'': targets(0.9, -1.9, 0.5)})
    assert run(fast, 99) == pytest.approx(run(slow, 0), abs=1e-12)
    assert fast.observe()[''].time_s == pytest.approx(0.2)


def test_velocity_limit() -> None:
    """A joint that is far from its target turns at full speed."""
    backend = MockBackend(DRIVES, period_s=PERIOD_S)
    backend.step({'': targets(-1.9, 0.0, 0.0)})
    seen = backend.observe()['']
    assert seen.positions_rad[0] == pytest.approx(-0.1)
    assert seen.velocities_rad_s[0] == -10.0


def test_range() -> None:
    """A joint stops at the end of its range."""
    backend = MockBackend(DRIVES, period_s=PERIOD_S)
    backend.step({'': targets(5.0, 5.0, -5.0)})
    assert run(backend, 100).tolist() == [1.0, 1.0, -2.0]
    assert backend.observe()[''].velocities_rad_s.tolist() == [0.0, 0.0, 0.0]


def test_moving_target() -> None:
    """A target that moves evenly is followed with hardly a lag."""
    backend = MockBackend(DRIVES, period_s=PERIOD_S)
    for step in range(50):
        now = step * PERIOD_S
        backend.step({'': targets(now, now, now, velocity_rad_s=1.0)})
    assert backend.observe()[''].positions_rad == pytest.approx([0.49] * 3, abs=0.01)


def test_load_is_reported() -> None:
    """The effort of a target carries a load: it moves nothing, and has a limit."""
    backend = MockBackend(DRIVES, period_s=PERIOD_S)
    loaded = targets(0.0, 0.0, 0.0)
    loaded.efforts_nm[:2] = 5.0, 90.0
    backend.step({'': loaded})
    seen = backend.observe()['']
    assert seen.efforts_nm.tolist() == [5.0, 20.0, 0.0]
    assert seen.positions_rad.tolist() == [0.0, 0.0, 0.0]


def test_stands_level() -> None:
    """The inertial sensor is level, and each foot carries half of the weight."""
    seen = MockBackend(DRIVES, mass_kg=40.0).observe()['']
    assert seen.orientation.tolist() == [1.0, 0.0, 0.0, 0.0]
    assert seen.linear_acceleration_m_s2.tolist() == [0.0, 0.0, 9.81]
    assert seen.foot_forces_n[:, 2].tolist() == [pytest.approx(196.2)] * 2


def test_robots_move_apart() -> None:
    """Each robot follows its own targets."""
    backend = MockBackend(DRIVES, ('robot1', 'robot2'))
    backend.step({'robot2': targets(0.1, 0.1, 0.1)})
    seen = backend.observe()
    assert not seen['robot1'].positions_rad.any() and seen['robot2'].positions_rad.all()


def test_reset() -> None:
    """After a reset the joints are at home, also those that cannot be at zero; time goes on."""
    backend = MockBackend(DRIVES, home_rad={JOINTS[1]: 0.3})
    backend.step({'': targets(0.5, 0.5, 0.5)})
    backend.reset()
    assert run(backend, 5).tolist() == [0.0, 0.3, 0.0]
    assert backend.observe()[''].time_s == pytest.approx(0.06)


def test_unknown_posture() -> None:
    """The mock says which posture it knows."""
    with pytest.raises(ValueError, match="no posture 'lying': it knows 'home' alone"):
        MockBackend(DRIVES).reset('lying')


def test_observation_stays() -> None:
    """What was observed does not change later."""
    backend = MockBackend(DRIVES)
    before = backend.observe()['']
    backend.step({'': targets(0.5, 0.5, 0.5)})
    assert not before.positions_rad.any()
