# SPDX-License-Identifier: Apache-2.0
"""Check that files which no reader could understand are refused with the line."""

from __future__ import annotations

from humanoid_description.errors import DescriptionError
from humanoid_description.loading import load_robot
import pytest

LINK = '<robot name="r">\n<link name="a">\n'
JOINT = (
    '<robot name="r"><link name="a"/><link name="b"/>\n<joint name="j" type="continuous">'
    '<parent link="a"/><child link="b"/>'
)
UNREADABLE = {
    'nothing': ('', 'm.urdf is not valid XML: '),
    'tags': ('<robot name="r">\n<link name="a"></robot>', 'm.urdf is not valid XML: Opening and'),
    'sdf': ('<sdf/>', 'm.urdf is not a URDF: its root element is <sdf> instead of <robot>.'),
    'no name': ('<robot/>', "m.urdf, line 1: <robot> lacks the attribute 'name'."),
    'no child': (
        '<robot name="r"><link name="a"/>\n<joint name="j" type="fixed"><parent link="a"/>'
        '</joint></robot>',
        "m.urdf, line 2: joint 'j': <joint> lacks the element <child>.",
    ),
    'no mass': (
        LINK + '<inertial><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
        '</link></robot>',
        "m.urdf, line 3: link 'a': <inertial> lacks the element <mass>.",
    ),
    'half an inertia': (
        LINK + '<inertial><mass value="1"/><inertia ixx="1"/></inertial></link></robot>',
        "m.urdf, line 3: link 'a': <inertia> lacks the attribute 'ixy'.",
    ),
    'no number': (
        LINK + '<visual><geometry><sphere radius="1"/></geometry>\n<origin xyz="0 0 O"/></visual>'
        '</link></robot>',
        "m.urdf, line 4: link 'a': <origin> has xyz='0 0 O', which is not 3 numbers.",
    ),
    'not finite': (
        LINK + '<inertial><mass value="nan"/><inertia/></inertial></link></robot>',
        "<mass> has value='nan', which is not a number.",
    ),
    'no colour': (
        '<robot name="r">\n<material name="m"><color rgba="1 x 0"/></material></robot>',
        "m.urdf, line 2: <color> has rgba='1 x 0', which is not 4 numbers.",
    ),
    'no leader': (
        JOINT + '<mimic multiplier="2"/></joint></robot>',
        "m.urdf, line 2: joint 'j': <mimic> lacks the attribute 'joint'.",
    ),
    'no offset': (
        JOINT + '<mimic joint="j" offset=""/></joint></robot>',
        "<mimic> has offset='', which is not a number.",
    ),
    'no soft limit': (
        JOINT + '<safety_controller soft_upper_limit="far"/></joint></robot>',
        "<safety_controller> has soft_upper_limit='far', which is not a number.",
    ),
    'no calibration': (
        JOINT + '<calibration rising="up"/></joint></robot>',
        "<calibration> has rising='up', which is not a number.",
    ),
    'no shape': (
        LINK + '<visual><geometry><cone/></geometry></visual></link></robot>',
        '<geometry> must hold exactly one of box, cylinder, sphere, mesh.',
    ),
}


@pytest.mark.parametrize('name', UNREADABLE)
def test_unreadable(name: str) -> None:
    """The error says what is wrong, and where if that is known."""
    text, sentence = UNREADABLE[name]
    with pytest.raises(DescriptionError) as caught:
        load_robot(text, 'm.urdf')
    assert sentence in str(caught.value)


def test_what_is_not_of_the_robot() -> None:
    """Comments, and elements for simulators, may hold whatever they want."""
    text = (
        '<robot name="r"><!-- a --><link name="a"/><gazebo><mass/></gazebo>'
        '<ros2_control name="c"><joint name="j"/></ros2_control>'
        '<transmission name="t"><joint name="j"/></transmission><mujoco><mass/></mujoco></robot>'
    )
    assert [link.name for link in load_robot(text, 'm.urdf').links] == ['a']
