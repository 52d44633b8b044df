# SPDX-License-Identifier: Apache-2.0
"""Check the models."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

from ament_index_python.packages import get_package_share_directory
import pytest

URDF = Path(__file__).parents[1] / 'urdf'
ROBOT = ElementTree.parse(URDF / 'simple_arm.urdf').getroot()


def names(tag: str) -> list[str]:
    """Return the names of all links or joints."""
    return [element.attrib['name'] for element in ROBOT.findall(tag)]


def test_links_form_one_tree() -> None:
    """Every link but the root is the child of exactly one joint."""
    children = [child.attrib['link'] for child in ROBOT.findall('joint/child')]
    parents = {parent.attrib['link'] for parent in ROBOT.findall('joint/parent')}
    assert sorted([*children, 'base_link']) == sorted(names('link'))
    assert parents <= set(names('link'))


def test_joints() -> None:
    """The arm has the joints that others rely on, with a range to move in."""
    assert names('joint') == ['shoulder', 'elbow', 'hand_fixed']
    for limit in ROBOT.findall('joint/limit'):
        assert float(limit.attrib['lower']) < float(limit.attrib['upper'])
        assert float(limit.attrib['effort']) > 0 and float(limit.attrib['velocity']) > 0


@pytest.mark.parametrize('link', ['base_link', 'upper_arm', 'forearm'])
def test_inertia(link: str) -> None:
    """Mass is positive, and the moments are those of a real body."""
    inertial = ROBOT.find(f"link[@name='{link}']/inertial")
    assert inertial is not None
    assert float(inertial.find('mass').attrib['value']) > 0  # type: ignore[union-attr]
    inertia = inertial.find('inertia').attrib  # type: ignore[union-attr]
    moments = sorted(float(inertia[axis]) for axis in ('ixx', 'iyy', 'izz'))
    assert 0 < moments[0] and moments[2] <= moments[0] + moments[1]


def test_every_model_is_installed() -> None:
    """Other packages find each model in the share folder."""
    share = Path(get_package_share_directory('robot_description')) / 'urdf'
    assert {path.name for path in URDF.iterdir()} <= {path.name for path in share.iterdir()}
