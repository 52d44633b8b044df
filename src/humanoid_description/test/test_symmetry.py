# SPDX-License-Identifier: Apache-2.0
"""Check that the right side mirrors the left one."""

from __future__ import annotations

from xml.etree import ElementTree

import pytest


def vector(element: ElementTree.Element | None, attribute: str) -> list[float]:
    """Return three numbers, which are zero when they are not given."""
    text = '0 0 0' if element is None else element.attrib.get(attribute, '0 0 0')
    return [float(part) for part in text.split()]


def limits(joint: ElementTree.Element) -> tuple[float, float]:
    """Return the range of a joint."""
    limit = joint.find('limit')
    assert limit is not None
    return float(limit.attrib['lower']), float(limit.attrib['upper'])


def mirror_name(name: str) -> str:
    """Return the name of the counterpart on the right side."""
    for left, right in (('left_', 'right_'), ('l_', 'r_')):
        if name.startswith(left):
            return right + name.removeprefix(left)
    return name


def sides(
    robot: ElementTree.Element, tag: str
) -> list[tuple[ElementTree.Element, ElementTree.Element]]:
    """Pair every element of the left side with its counterpart."""
    by_name = {element.attrib['name']: element for element in robot.findall(tag)}
    return [
        (element, by_name[mirror_name(name)])
        for name, element in by_name.items()
        if name.startswith(('left_', 'l_'))
    ]


def test_both_sides_have_the_same(robot: ElementTree.Element) -> None:
    """Each side has ten driven joints, five fixed frames, and a link for each."""
    assert len(sides(robot, 'joint')) == 15
    assert len(sides(robot, 'link')) == 15


def test_places_are_mirrored(robot: ElementTree.Element) -> None:
    """Joints sit at the same place, but on the other side of the middle plane."""
    for left, right in sides(robot, 'joint'):
        x, y, z = vector(left.find('origin'), 'xyz')
        assert vector(right.find('origin'), 'xyz') == pytest.approx([x, -y, z])


def test_left_is_left(robot: ElementTree.Element) -> None:
    """The left limbs are on the side of positive y."""
    for name in ('left_shoulder', 'left_hip_yaw'):
        joint = robot.find(f"joint[@name='{name}']")
        assert joint is not None
        assert vector(joint.find('origin'), 'xyz')[1] > 0


def test_ranges_are_mirrored(robot: ElementTree.Element) -> None:
    """Pitch has the same range on both sides; roll and yaw have the opposite one."""
    for left, right in sides(robot, 'joint'):
        if left.attrib['type'] != 'revolute':
            continue
        low, high = limits(left)
        is_pitch = vector(left.find('axis'), 'xyz')[1] != 0
        assert limits(right) == ((low, high) if is_pitch else (-high, -low))


def test_bodies_are_alike(robot: ElementTree.Element) -> None:
    """Both sides weigh the same, and their centres of mass are mirrored."""
    for left, right in sides(robot, 'link'):
        ours, theirs = left.find('inertial'), right.find('inertial')
        if ours is None or theirs is None:
            assert ours is theirs
            continue
        x, y, z = vector(ours.find('origin'), 'xyz')
        assert vector(theirs.find('origin'), 'xyz') == pytest.approx([x, -y, z])
        for tag in ('mass', 'inertia'):
            mine, other = ours.find(tag), theirs.find(tag)
            assert mine is not None and other is not None and mine.attrib == other.attrib
