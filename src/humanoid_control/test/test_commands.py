# SPDX-License-Identifier: Apache-2.0
"""Check which commands are taken, why others are refused, and when they are over."""

from __future__ import annotations

from collections.abc import Sequence
import math

from humanoid_control.controllers.command_controllers import Silence
from humanoid_control.controllers.commands import CommandError, JointNames
from humanoid_control.testing import JOINTS
import pytest

NAMES = JointNames(JOINTS)


def test_taken() -> None:
    """A command may name some joints in any order; what it leaves out is zero."""
    command = NAMES.targets(['left_knee', 'left_elbow'], [0.3, 0.1], [], [2.0, 1.0])
    assert command.indices.tolist() == [2, 0]
    assert command.targets.positions_rad.tolist() == [0.3, 0.1]
    assert command.targets.velocities_rad_s.tolist() == [0.0, 0.0]
    assert command.targets.efforts_nm.tolist() == [2.0, 1.0]


@pytest.mark.parametrize(
    ('names', 'positions', 'reason'),
    [
        ([], [], 'It names no joints'),
        (['left_elbow'], [], "field 'position' has length 0, but it names 1 joints"),
        (['left_elbow'], [0.1, 0.2], "field 'position' has length 2"),
        (['left_elbw'], [0.1], "no joint 'left_elbw'. Did you mean 'left_elbow'?"),
        (['x'], [0.1], "no joint 'x'. It has: left_elbow, right_elbow, left_knee."),
        (['left_elbow', 'left_elbow'], [0.1, 0.2], "names 'left_elbow' more than once"),
        (['left_elbow', 'left_knee'], [0.1, math.nan], "position of 'left_knee' is nan"),
        (['left_elbow'], [-math.inf], "position of 'left_elbow' is -inf"),
    ],
)
def test_refused(names: list[str], positions: list[float], reason: str) -> None:
    """A command that is not sound is refused with the reason."""
    with pytest.raises(CommandError) as refusal:
        NAMES.targets(names, positions)
    assert reason in str(refusal.value)


@pytest.mark.parametrize(
    ('velocities', 'efforts', 'field'),
    [
        ([math.nan], [], 'velocity'),
        ([], [math.inf], 'effort'),
        ([1.0, 2.0], [], 'velocity'),
        ([-1e308], [], 'velocity of .* is -1e.308, beyond the limits of any joint'),
    ],
)
def test_other_fields(velocities: Sequence[float], efforts: Sequence[float], field: str) -> None:
    """Velocities and efforts are checked too."""
    with pytest.raises(CommandError, match=field):
        NAMES.targets(['left_elbow'], [0.1], velocities, efforts)


def test_robot_time() -> None:
    """Silent at first, and again when nothing was heard for the timeout."""
    silence = Silence(0.5)
    assert silence.lasts(1.0)
    silence.heard()
    assert not silence.lasts(2.0) and not silence.lasts(2.49)
    silence.heard()
    assert not silence.lasts(2.6) and not silence.lasts(3.0)
    assert silence.lasts(3.1) and silence.lasts(3.2)


def test_both_clocks() -> None:
    """Both times must pass: the simulator may run faster than its user, or be paused."""
    clock = [100.0]
    silence = Silence(0.5, lambda: clock[0])
    silence.heard()
    assert not silence.lasts(0.0) and not silence.lasts(5.0)
    clock[0] = 100.6
    assert silence.lasts(5.1)
    silence.heard()
    clock[0] = 200.0
    assert not silence.lasts(5.2)
    assert silence.lasts(5.8)


def test_end() -> None:
    """An end is silence at once."""
    silence = Silence(0.5)
    silence.heard()
    silence.end()
    assert silence.lasts(0.0)
