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
@pytest.mark.parametrize('hands', [False, True])
@pytest.mark.parametrize(('scale', 'prefix'), [(1.0, ''), (0.5, 'r1_'), (1.3, '')])
def test_drives_are_those_of_the_model(
    scale: float, prefix: str, upper_body_only: bool, hands: bool
) -> None:
    """Names, ranges, strengths and friction are the same in the URDF and in Python."""
    robot = ElementTree.fromstring(humanoid_urdf(scale, prefix, upper_body_only, hands))
    drives = load_drives(scale, prefix, upper_body_only, hands)
    joints = {
        joint.attrib['name']: joint
        for joint in robot.findall('joint')
        if joint.attrib['type'] != 'fixed' and joint.find('mimic') is None
    }
    assert set(drives) == set(joints)
    for name, drive in drives.items():
        joint = joints[name]
        assert joint.attrib['type'] == drive.kind
        assert number(joint, 'limit', 'lower') == drive.lower
        assert number(joint, 'limit', 'upper') == drive.upper
        assert number(joint, 'limit', 'effort') == pytest.approx(drive.effort)
        assert number(joint, 'limit', 'velocity') == pytest.approx(drive.velocity)
        assert number(joint, 'dynamics', 'damping') == pytest.approx(drive.damping)
        assert number(joint, 'dynamics', 'friction') == pytest.approx(drive.friction)


def test_gains() -> None:
    """A servo has the gains of the file, on both sides."""
    drives = load_drives()
    for name in ('left_knee', 'right_knee'):
        drive = drives[name]
        assert (drive.kp, drive.kd, drive.armature) == (500.0, 15.0, 0.04)


def test_mirrored_range() -> None:
    """A roll of the right side has the range of the left one the other way round."""
    drives = load_drives()
    left, right = drives['left_shoulder_roll'], drives['right_shoulder_roll']
    assert (right.lower, right.upper) == (-left.upper, -left.lower)


def test_a_gripper_of_another_size_grips_what_is_larger() -> None:
    """The gap grows with the robot, and the force with the weight of what is held."""
    small, large = (load_drives(scale, hands=True)['right_gripper'] for scale in (0.5, 1.0))
    assert (large.lower, large.upper, large.effort) == (0.0, 0.05, 40.0)
    assert small.upper == pytest.approx(0.025)
    assert small.effort == pytest.approx(40.0 / 8.0)


def test_scale_out_of_range() -> None:
    """There are no drives for a size that there is no model of."""
    with pytest.raises(DescriptionError, match=r'The scale 2 is out of range\. Give one from'):
        load_drives(2.0)
