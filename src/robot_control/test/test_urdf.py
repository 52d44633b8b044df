# SPDX-License-Identifier: Apache-2.0
"""Check how a URDF is read and refused."""

from __future__ import annotations

import pytest
from robot_control.urdf import Joint, parse_urdf, UrdfError

ARM = """<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/><link name="upper"/><link name="slide"/><link name="tip"/>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/>
    <limit lower="-1.5" upper="2" effort="1" velocity="1"/>
  </joint>
  <joint name="rail" type="prismatic">
    <parent link="upper"/><child link="slide"/>
    <limit upper="0.3" effort="1" velocity="1"/>
  </joint>
  <joint name="tip_fixed" type="fixed"><parent link="slide"/><child link="tip"/></joint>
  <transmission name="t"><joint name="shoulder"/></transmission>
</robot>
"""


def test_model() -> None:
    """Name, links, joints, their types and limits are read; missing limits are zero."""
    model = parse_urdf(ARM)
    assert (model.name, model.links) == ('arm', ('base', 'upper', 'slide', 'tip'))
    assert model.joints == (
        Joint('shoulder', 'revolute', 'base', 'upper', -1.5, 2.0),
        Joint('rail', 'prismatic', 'upper', 'slide', 0.0, 0.3),
        Joint('tip_fixed', 'fixed', 'slide', 'tip'),
    )


def test_description() -> None:
    """The model is described in one line for the whole and one for each joint."""
    assert parse_urdf(ARM).describe() == [
        "Loaded robot 'arm': 4 links (base, upper, slide, tip), 3 joints",
        '  shoulder: revolute, base -> upper, -1.5 to 2 rad',
        '  rail: prismatic, upper -> slide, 0 to 0.3 m',
        '  tip_fixed: fixed, slide -> tip',
    ]


@pytest.mark.parametrize(
    ('old', 'new', 'words'),
    [
        (ARM, ' ', 'is empty'),
        ('</robot>', '', 'not valid XML.*line'),
        (ARM, '<model/>', 'starts with <model>, but a URDF starts with <robot>'),
        (' name="arm"', '', "no attribute 'name' in the robot"),
        ('type="fixed"', 'type="fxied"', "type of joint 'tip_fixed' is 'fxied'.*one of revolute"),
        ('<parent link="slide"/>', '', "no <parent> in joint 'tip_fixed'"),
        ('lower="-1.5"', 'lower="3"', "lower limit of joint 'shoulder' is 3.*must not exceed"),
        ('lower="-1.5"', 'lower="nan"', "is 'nan', but must be a number"),
        ('lower="-1.5"', 'lower="low"', "is 'low', but must be a number"),
        ('<limit lower="-1.5" upper="2" effort="1" velocity="1"/>', '', "no <limit> in joint 'sh"),
        (
            '<child link="tip"/>',
            '<child link="tpi"/>',
            "'tpi', which does not.*Did you mean 'tip'",
        ),
        (
            '<link name="tip"/>',
            '<link name="tip"/><link name="tip"/>',
            "several links named 'tip'",
        ),
        ('<link name="tip"/>', '<link name="tip"/><link name="lost"/>', 'single tree: base, lost'),
        ('<child link="tip"/>', '<child link="slide"/>', "'slide' is the child of several joints"),
        ('name="rail"', 'name="shoulder"', "several joints named 'shoulder'"),
        ('<parent link="upper"/>', '<parent link="tip"/>', 'loop among slide, tip'),
    ],
)
def test_refused(old: str, new: str, words: str) -> None:
    """A bad URDF is refused in a sentence that names the place."""
    with pytest.raises(UrdfError, match=words):
        parse_urdf(ARM.replace(old, new))


def test_no_links() -> None:
    """A robot without links is refused."""
    with pytest.raises(UrdfError, match="'ghost' has no links"):
        parse_urdf('<robot name="ghost"/>')
