# SPDX-License-Identifier: Apache-2.0
"""Check that what robot_state_publisher refuses, check_model refuses with the line."""

from __future__ import annotations

from pathlib import Path

from humanoid_description.check_model import main
import pytest

GOOD = """<robot name="arm">
<link name="base"/>
<link name="upper"><inertial><mass value="1"/>
  <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="lower"><inertial><mass value="1"/>
  <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="shoulder" type="revolute">
  <parent link="base"/><child link="upper"/>
  <axis xyz="0 0 2"/>
  <limit lower="-1" upper="1" effort="1" velocity="1"/>
</joint>
<joint name="elbow" type="continuous">
  <parent link="upper"/><child link="lower"/>
  <mimic joint="shoulder" multiplier="-2"/>
</joint>
</robot>
"""
# What to replace in the good one, by what, and the line that is named.
REFUSED = [
    ('</joint>\n</robot>', '</robot>', 15),
    (' name="arm"', '', 1),
    ('<link name="base"/>', '<link/>', 2),
    ('name="lower"', 'name="upper"', 5),
    ('name="elbow"', 'name="shoulder"', 12),
    ('type="revolute"', 'type="revolut"', 7),
    (' type="revolute"', '', 7),
    ('<parent link="base"/>', '', 7),
    ('<child link="upper"/>', '<child/>', 8),
    ('<parent link="base"/>', '<parent link="bas"/>', 7),
    ('<child link="lower"/>', '<child link="upper"/>', 12),
    ('<link name="base"/>', '<link name="base"/><link name="hat"/>', 2),
    ('<parent link="base"/>', '<parent link="lower"/>', 7),
    ('xyz="0 0 2"', 'xyz="0 0 0"', 7),
    ('xyz="0 0 2"', 'xyz="0 1"', 9),
    ('lower="-1"', 'lower="nan"', 10),
    ('<limit lower="-1" upper="1" effort="1" velocity="1"/>', '', 7),
    ('mimic joint="shoulder"', 'mimic joint="nobody"', 12),
    ('mimic joint="shoulder"', 'mimic joint="elbow"', 12),
    ('type="revolute"', 'type="fixed"', 12),
    ('multiplier="-2"', 'multiplier=""', 14),
    ('<robot name="arm">\n<link', '<robot name="arm" xmlns:xacro="x">\n<xacro:leg/><link', 2),
]


@pytest.mark.parametrize(('old', 'new', 'line'), REFUSED)
def test_refused_with_the_line(
    old: str, new: str, line: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Each defect makes the status 1, and is told with its line."""
    assert old in GOOD
    file = tmp_path / 'arm.urdf'
    file.write_text(GOOD.replace(old, new))
    assert main([str(file)]) == 1
    captured = capsys.readouterr()
    assert f'line {line}' in captured.out + captured.err


def test_good_one_passes(tmp_path: Path) -> None:
    """Without these defects the arm is sound."""
    file = tmp_path / 'arm.urdf'
    file.write_text(GOOD)
    assert main([str(file)]) == 0


def test_joint_that_mimics_a_misspelt_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The joint itself is not what is meant."""
    file = tmp_path / 'arm.urdf'
    text = GOOD.replace('"shoulder"', '"elbow_1"').replace('"elbow"', '"elbow_2"')
    file.write_text(text.replace('mimic joint="elbow_1"', 'mimic joint="elbow_3"'))
    assert main([str(file)]) == 1
    assert "which does not exist. Did you mean 'elbow_1'?" in capsys.readouterr().out
