# SPDX-License-Identifier: Apache-2.0
"""Check the model of the humanoid: its tree, its names and its bodies."""

from __future__ import annotations

from xml.etree import ElementTree

import pytest

ARM = ('shoulder', 'shoulder_roll', 'shoulder_yaw', 'elbow')
LEG = ('hip_yaw', 'hip_roll', 'hip_pitch', 'knee', 'ankle_pitch', 'ankle_roll')
DRIVEN = {'waist_yaw', 'head_yaw', 'head_pitch'} | {
    f'{side}_{joint}' for side in ('left', 'right') for joint in ARM + LEG
}
FRAMES = {
    'base_link',
    'torso',
    'gaze',
    'l_wrist',
    'r_wrist',
    'l_gripper',
    'r_gripper',
    'l_ankle',
    'r_ankle',
    'l_sole',
    'r_sole',
    'l_foot_contact',
    'r_foot_contact',
    'imu_link',
    'camera_link',
    'camera_optical_frame',
}


def links(robot: ElementTree.Element) -> list[str]:
    """Return the names of all links."""
    return [link.attrib['name'] for link in robot.findall('link')]


def number(element: ElementTree.Element, path: str, attribute: str) -> float:
    """Return a number from an element that must exist."""
    found = element.find(path)
    assert found is not None, f'{path} is missing in {element.attrib}'
    return float(found.attrib[attribute])


def test_one_root(robot: ElementTree.Element) -> None:
    """All links hang from base_link, each from one joint."""
    children = [child.attrib['link'] for child in robot.findall('joint/child')]
    assert sorted([*children, 'base_link']) == sorted(links(robot))


def test_no_loop(robot: ElementTree.Element) -> None:
    """Every link is reached from the root."""
    edges = [(joint.find('parent'), joint.find('child')) for joint in robot.findall('joint')]
    pairs = [
        (p.attrib['link'], c.attrib['link']) for p, c in edges if p is not None and c is not None
    ]
    reached = {'base_link'}
    for _ in pairs:
        reached |= {child for parent, child in pairs if parent in reached}
    assert reached == set(links(robot))


def test_names_are_unique(robot: ElementTree.Element) -> None:
    """No two links, joints or shapes share a name."""
    for path in ('link', 'joint', 'link/visual', 'link/collision'):
        names = [element.attrib['name'] for element in robot.findall(path)]
        assert len(names) == len(set(names)) > 0


def test_driven_joints(robot: ElementTree.Element) -> None:
    """The joints have the names that controllers use."""
    driven = {joint.attrib['name'] for joint in robot.findall("joint[@type='revolute']")}
    assert driven == DRIVEN


def test_frames_of_humanoids(robot: ElementTree.Element) -> None:
    """The frames that REP 120 names are there, and those of the sensors."""
    assert set(links(robot)) >= FRAMES


def test_limits(robot: ElementTree.Element) -> None:
    """Every driven joint has a range around zero, strength and speed."""
    for joint in robot.findall("joint[@type='revolute']"):
        assert number(joint, 'limit', 'lower') <= 0.0 <= number(joint, 'limit', 'upper')
        assert number(joint, 'limit', 'upper') - number(joint, 'limit', 'lower') > 0.5
        assert number(joint, 'limit', 'effort') > 0 and number(joint, 'limit', 'velocity') > 0


def test_axes(robot: ElementTree.Element) -> None:
    """Yaw turns about z, roll about x, all else about y."""
    for joint in robot.findall("joint[@type='revolute']"):
        name = joint.attrib['name']
        kind = name.rsplit('_', 1)[-1]
        axis = joint.find('axis')
        assert axis is not None
        assert axis.attrib['xyz'] == {'yaw': '0 0 1', 'roll': '1 0 0'}.get(kind, '0 1 0'), name


def test_inertia(robot: ElementTree.Element) -> None:
    """Masses are positive, and the moments are those of real bodies."""
    for inertial in robot.findall('link/inertial'):
        assert number(inertial, 'mass', 'value') > 0
        low, middle, high = sorted(
            number(inertial, 'inertia', axis) for axis in ('ixx', 'iyy', 'izz')
        )
        assert 0 < low and high <= low + middle


def test_moving_links_have_a_body(robot: ElementTree.Element) -> None:
    """What a driven joint moves has a mass, as simulators demand."""
    for child in robot.findall("joint[@type='revolute']/child"):
        assert robot.find(f"link[@name='{child.attrib['link']}']/inertial") is not None


def test_total_mass(robot: ElementTree.Element) -> None:
    """The humanoid weighs what it is meant to."""
    masses = [float(mass.attrib['value']) for mass in robot.iter('mass')]
    assert sum(masses) == pytest.approx(42.8)


def height_above_root(robot: ElementTree.Element, link: str) -> float:
    """Return how high a link is above base_link while all joints are at zero."""
    above = {}
    for joint in robot.findall('joint'):
        parent, child, origin = (joint.find(tag) for tag in ('parent', 'child', 'origin'))
        assert parent is not None and child is not None and origin is not None
        height_m = float(origin.attrib['xyz'].split()[2])
        above[child.attrib['link']] = (parent.attrib['link'], height_m)
    total_m = 0.0
    while link in above:
        link, height_m = above[link]
        total_m += height_m
    return total_m


def test_height(robot: ElementTree.Element) -> None:
    """Stretched, the humanoid stands as tall as it is meant to, on both soles."""
    crown_m = height_above_root(robot, 'head') + 0.17
    soles_m = [height_above_root(robot, sole) for sole in ('l_sole', 'r_sole')]
    assert [crown_m - sole_m for sole_m in soles_m] == pytest.approx([1.35, 1.35])
