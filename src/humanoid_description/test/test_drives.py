# SPDX-License-Identifier: Apache-2.0
"""Check that Python and the model agree on what drives the joints."""

from __future__ import annotations

from xml.etree import ElementTree

from humanoid_description.drives import load_drives
from humanoid_description.errors import DescriptionError
from humanoid_description.expansion import humanoid_urdf
import pytest


def number(joint: ElementTree.Element, path: str, attribute: str) -> float:
    """Return a number of an element that must exist."""
    found = joint.find(path)
    assert found is not None
    return float(found.attrib[attribute])


@pytest.mark.parametrize('upper_body_only', [False, True])
@pytest.mark.parametrize(('scale', 'prefix'), [(1.0, ''), (0.5, 'r1_'), (1.3, '')])
def test_drives_are_those_of_the_model(scale: float, prefix: str, upper_body_only: bool) -> None:
    """Names, ranges, strengths and friction are the same in the URDF and in Python."""
    robot = ElementTree.fromstring(humanoid_urdf(scale, prefix, upper_body_only))
    drives = load_drives(scale, prefix, upper_body_only)
    joints = {joint.attrib['name']: joint for joint in robot.findall("joint[@type='revolute']")}
    assert set(drives) == set(joints)
    for name, drive in drives.items():
        joint = joints[name]
        assert number(joint, 'limit', 'lower') == drive.lower_rad
        assert number(joint, 'limit', 'upper') == drive.upper_rad
        assert number(joint, 'limit', 'effort') == pytest.approx(drive.effort_nm)
        assert number(joint, 'limit', 'velocity') == pytest.approx(drive.velocity_rad_s)
        assert number(joint, 'dynamics', 'damping') == pytest.approx(drive.damping_nms_rad)
        assert number(joint, 'dynamics', 'friction') == pytest.approx(drive.friction_nm)


def test_gains() -> None:
    """A servo has the gains of the file, on both sides."""
    drives = load_drives()
    for name in ('left_knee', 'right_knee'):
        drive = drives[name]
        assert (drive.kp_nm_rad, drive.kd_nms_rad, drive.armature_kgm2) == (500.0, 15.0, 0.04)


def test_mirrored_range() -> None:
    """A roll of the right side has the range of the left one the other way round."""
    drives = load_drives()
    left, right = drives['left_shoulder_roll'], drives['right_shoulder_roll']
    assert (right.lower_rad, right.upper_rad) == (-left.upper_rad, -left.lower_rad)


def test_scale_out_of_range() -> None:
    """There are no drives for a size that there is no model of."""
    with pytest.raises(DescriptionError, match=r'The scale 2 is out of range\. Give one from'):
        load_drives(2.0)
