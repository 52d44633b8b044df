# SPDX-License-Identifier: Apache-2.0
"""Robot descriptions that are read, changed and written."""

from __future__ import annotations

from pathlib import Path

import pytest
from urdf_parser_py.urdf import Box, Cylinder, Joint, Link, Mesh, Pose, Robot, Sphere, URDF, Visual

ARM = """<?xml version="1.0"?>
<robot name="arm">
  <!-- a comment -->
  <material name="blue"><color rgba="0 0 1 0.5"/></material>
  <link name="base"/>
  <link name="upper">
    <inertial>
      <origin xyz="0 0 0.1"/>
      <mass value="2.5"/>
      <inertia ixx="0.1" ixy="0.01" ixz="0.02" iyy="0.2" iyz="0.03" izz="0.3"/>
    </inertial>
    <visual name="shell">
      <origin xyz="1 2 3" rpy="0.1 0.2 0.3"/>
      <geometry><mesh filename="package://arm/upper.stl" scale="1 1 2"/></geometry>
      <material name="blue"/>
    </visual>
    <visual><geometry><sphere radius="0.2"/></geometry></visual>
    <collision><geometry><cylinder radius="0.1" length="0.4"/></geometry></collision>
  </link>
  <link name="lower">
    <collision><geometry><box size="0.1 0.2 0.3"/></geometry></collision>
  </link>
  <link name="tool"/>
  <joint name="shoulder" type="revolute">
    <origin xyz="0 0 0.5" rpy="0 1.57 0"/>
    <parent link="base"/>
    <child link="upper"/>
    <axis xyz="0 1 0"/>
    <limit lower="-1.5" upper="2" effort="30" velocity="4"/>
    <dynamics damping="0.7"/>
    <calibration rising="0.5"/>
    <safety_controller k_velocity="10" soft_lower_limit="-1.4" soft_upper_limit="1.9"/>
  </joint>
  <joint name="elbow" type="continuous">
    <parent link="upper"/>
    <child link="lower"/>
    <mimic joint="shoulder" multiplier="-2"/>
  </joint>
  <joint name="flange" type="fixed"><parent link="lower"/><child link="tool"/></joint>
  <ros2_control name="arm" type="system"><hardware><plugin>mock</plugin></hardware></ros2_control>
</robot>
"""


@pytest.fixture
def arm() -> Robot:
    """Return the robot that the text describes."""
    return URDF.from_xml_string(ARM)


def test_joints(arm: Robot) -> None:
    """Joints have what is written, None for what is missing, and defaults of numbers."""
    shoulder, elbow = arm.joint_map['shoulder'], arm.joint_map['elbow']
    assert (shoulder.name, shoulder.type, shoulder.joint_type) == ('shoulder',) + ('revolute',) * 2
    assert (shoulder.parent, shoulder.child, shoulder.axis) == ('base', 'upper', [0.0, 1.0, 0.0])
    assert shoulder.origin == Pose([0.0, 0.0, 0.5], [0.0, 1.57, 0.0])
    limit = shoulder.limit
    assert limit is not None
    assert (limit.lower, limit.upper, limit.effort, limit.velocity) == (-1.5, 2.0, 30.0, 4.0)
    assert shoulder.dynamics is not None
    assert (shoulder.dynamics.damping, shoulder.dynamics.friction) == (0.7, 0.0)
    assert shoulder.safety_controller is not None
    assert shoulder.safety_controller.soft_upper_limit == 1.9
    assert shoulder.calibration is not None
    assert (shoulder.calibration.rising, shoulder.calibration.falling) == (0.5, None)
    assert (elbow.origin, elbow.axis, elbow.limit) == (None, None, None)
    assert elbow.mimic is not None
    assert (elbow.mimic.joint, elbow.mimic.multiplier, elbow.mimic.offset) == ('shoulder', -2, 0)


def test_links(arm: Robot) -> None:
    """Links have masses, all their shapes, and the first of them by a shorter name."""
    upper = arm.link_map['upper']
    assert upper.inertial is not None
    assert upper.inertial.mass == 2.5
    assert upper.inertial.inertia is not None
    assert upper.inertial.inertia.to_matrix()[1] == [0.01, 0.2, 0.03]
    assert upper.visual is upper.visuals[0]
    assert upper.visual is not None
    assert upper.visual.name == 'shell'
    assert upper.visual.geometry == Mesh('package://arm/upper.stl', [1.0, 1.0, 2.0])
    assert upper.visual.origin is not None
    assert upper.visual.origin.position == [1.0, 2.0, 3.0]
    assert upper.visual.origin.rotation == [0.1, 0.2, 0.3]
    assert upper.visual.material is not None
    assert upper.visual.material.name == 'blue'
    assert upper.visuals[1].geometry == Sphere(0.2)
    assert upper.collision is not None
    assert upper.collision.geometry == Cylinder(0.1, 0.4)
    assert arm.links[2].collisions[0].geometry == Box([0.1, 0.2, 0.3])
    assert arm.links[0].collision is None
    assert arm.materials[0].color is not None
    assert arm.materials[0].color.rgba == [0.0, 0.0, 1.0, 0.5]


def test_the_tree(arm: Robot) -> None:
    """Parents, children, the root and chains are found by name."""
    assert arm.get_root() == 'base'
    assert arm.parent_map['upper'] == ('shoulder', 'base')
    assert arm.child_map['upper'] == [('elbow', 'lower')]
    chain = arm.get_chain('base', 'tool')
    assert chain == ['base', 'shoulder', 'upper', 'elbow', 'lower', 'flange', 'tool']
    assert arm.get_chain('base', 'tool', links=False) == ['shoulder', 'elbow', 'flange']
    assert arm.get_chain('upper', 'tool', links=False, fixed=False) == ['elbow']
    assert arm.get_chain('base', 'lower', joints=False) == ['base', 'upper', 'lower']
    with pytest.raises(ValueError, match="no chain from link 'tool' to 'upper'"):
        arm.get_chain('tool', 'upper')
    arm.add_link(Link('loose'))
    with pytest.raises(
        ValueError, match="one link without a parent; this one has 'base', 'loose'"
    ):
        arm.get_root()


def test_what_is_written_is_read_again(arm: Robot, tmp_path: Path) -> None:
    """A file with the written text has the same robot, also what has no class here."""
    upper = arm.link_map['upper']
    assert upper.inertial is not None
    upper.inertial.mass = 3.25
    written = arm.to_xml_string()
    path = tmp_path / 'arm.urdf'
    path.write_text(written)
    again = Robot.from_xml_file(str(path))
    assert written.startswith('<?xml')
    assert again.to_xml_string() == written
    assert '<plugin>mock</plugin>' in written
    assert again.joints == arm.joints
    assert again.materials == arm.materials
    assert again.link_map['upper'].inertial == upper.inertial
    assert again.link_map['upper'].visuals == upper.visuals
    assert again.link_map['lower'].collisions == arm.link_map['lower'].collisions
    assert arm.to_xml_string(addHeader=False).startswith('<robot name="arm">')


def test_robots_that_are_put_together() -> None:
    """Links and joints are added, and the maps follow."""
    robot = Robot('cart')
    for name in ('body', 'wheel'):
        robot.add_link(Link(name, visual=Visual(Box([1.0, 1.0, 1.0]))))
    robot.add_joint(Joint('axle', 'body', 'wheel', 'continuous', axis=[0, 1, 0]))
    again = Robot.from_xml_string(robot.to_xml_string())
    assert again.get_chain('body', 'wheel') == ['body', 'axle', 'wheel']
    assert again.joint_map['axle'].axis == [0.0, 1.0, 0.0]
    wheel = again.link_map['wheel']
    wheel.visual = None
    assert wheel.visuals == []
    wheel.visual = Visual(Sphere(1.0))
    assert len(wheel.visuals) == 1


@pytest.mark.parametrize(
    ('text', 'message'),
    [
        ('<robot', 'not XML'),
        ('<sdf/>', 'begins with <robot>, but this one with <sdf>'),
        ('<robot><link/></robot>', "a <link> without the attribute 'name'"),
        ('<robot><joint name="a" type="hinge"/></robot>', "'hinge', but must be one of revolute"),
        ('<robot><joint name="a" type="fixed"/></robot>', "joint 'a' has no <parent>"),
        (
            ARM.replace('xyz="0 1 0"', 'xyz="0 1"'),
            "a <axis> whose attribute 'xyz' is '0 1', but must be 3 numbers",
        ),
        (ARM.replace('radius="0.2"', 'radius="big"'), "'big', but must be a number"),
        (ARM.replace('<sphere radius="0.2"/>', '<cone/>'), 'none of box, cylinder, sphere, mesh'),
    ],
)
def test_mistakes(text: str, message: str) -> None:
    """They are errors that name the element."""
    with pytest.raises(ValueError, match=message):
        Robot.from_xml_string(text)
