# SPDX-License-Identifier: Apache-2.0
"""Check what is recorded of a walk."""

from __future__ import annotations

import csv
import math
from pathlib import Path

from humanoid_control.walking import VelocityCommand
from humanoid_description.loading import load_robot
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.examples.gait_recording import (
    GaitPlan,
    GaitRecording,
    record_walk,
    zero_moment_point,
)
from humanoid_simulation.examples.record_gait import draw_gait, main, write_table
from humanoid_simulation.model import RobotDescription
import numpy as np
import pytest

G_M_S2 = 9.81


@pytest.fixture(name='walk', scope='module')
def _walk() -> GaitRecording:
    """Record a short walk."""
    return record_walk(GaitPlan(VelocityCommand(forward_m_s=0.2), walking_s=1.5))


def test_robot_is_carried(walk: GaitRecording, description: RobotDescription) -> None:
    """In the mean, the feet carry the weight of the robot."""
    robot = load_robot(description.urdf, 'the humanoid')
    mass_kg = sum(link.body.mass_kg for link in robot.links if link.body)
    assert walk.loads_n.sum(axis=1).mean() == pytest.approx(mass_kg * G_M_S2, rel=0.03)


def test_balance(walk: GaitRecording) -> None:
    """At the end it stands, with the zero-moment point below the centre of mass."""
    assert walk.zmp_m[-1] == pytest.approx(walk.com_m[-1, :2], abs=0.005)
    assert walk.com_m[-1, 0] > walk.com_m[0, 0] + 0.1


def test_feet(walk: GaitRecording) -> None:
    """Both feet are lifted, one after the other, and a foot in the air carries nothing."""
    is_up = walk.soles_m[:, :, 2] > 0.02
    assert is_up.any(axis=0).all() and not is_up.all(axis=1).any()
    assert not walk.loads_n[is_up].any()


def test_shapes(walk: GaitRecording) -> None:
    """There is a row for each control period."""
    moments, joints = len(walk.times_s), len(walk.joints)
    assert moments == pytest.approx(550, abs=1) and walk.times_s[1] == pytest.approx(0.01)
    assert walk.efforts_nm.shape == (moments, joints)
    assert walk.zmp_m.shape == (moments, 2) and walk.loads_n.shape == (moments, 2)


def test_table(walk: GaitRecording, tmp_path: Path) -> None:
    """The table has a name for each column, and the values below."""
    write_table(walk, tmp_path / 'gait.csv')
    with (tmp_path / 'gait.csv').open() as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == len(walk.times_s)
    assert float(rows[-1]['com_x_m']) == pytest.approx(walk.com_m[-1, 0], rel=1e-4)
    assert float(rows[9]['left_knee_nm']) == pytest.approx(
        walk.efforts_nm[9, walk.joints.index('left_knee')], rel=1e-4
    )


def test_picture(walk: GaitRecording, tmp_path: Path) -> None:
    """The picture is a PNG."""
    draw_gait(walk, tmp_path / 'gait')
    assert (tmp_path / 'gait').read_bytes().startswith(b'\x89PNG')


def test_zero_moment_point() -> None:
    """Two feet that carry unequal loads at known points have it in between."""
    soles_m = np.array([[0.0, 0.1, 0.0], [0.2, -0.1, 0.3]])
    forces_n = np.array([[0.0, 0.0, 300.0], [10.0, 20.0, 100.0]])
    at_m = np.array([[0.01, 0.02, 0.0], [0.03, 0.0, 0.0]])
    torques_nm = np.cross(at_m, forces_n)
    # The force on the second foot acts 0.3 m above the ground, which it leans on along itself.
    second = np.array([0.23 - 0.3 * 0.1, -0.1 - 0.3 * 0.2])
    expected = 0.75 * np.array([0.01, 0.12]) + 0.25 * second
    assert zero_moment_point(soles_m, forces_n, torques_nm) == pytest.approx(expected)


def test_no_zero_moment_point_in_the_air() -> None:
    """Where nothing is carried, there is none."""
    nothing = np.zeros((2, 3))
    assert np.isnan(zero_moment_point(nothing, nothing, nothing)).all()


@pytest.mark.parametrize('walking_s', [0.0, -1.0, math.nan, math.inf, 1e6])
def test_refused_plan(walking_s: float) -> None:
    """A walk that takes no time, or too much, is refused."""
    with pytest.raises(SimulationError, match='cannot be recorded'):
        GaitPlan(VelocityCommand(), walking_s)


@pytest.mark.parametrize(
    ('arguments', 'reason'),
    [
        (['--duration', '0'], 'cannot be recorded'),
        (['--forward', 'nan'], 'not finite'),
        (['--scene', 'flatt'], "no scene 'flatt'. Did you mean 'flat'?"),
        (['--duration', '0.1', '--output', 'no/such/folder.png'], 'cannot be written'),
        (['--duration', '0.1', '--output', '/dev/full'], '/dev/full cannot be written: No space'),
    ],
)
def test_refused_command(
    arguments: list[str], reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """What cannot be done is said, with status 1 and no traceback."""
    assert main(arguments) == 1
    assert reason in capsys.readouterr().err
