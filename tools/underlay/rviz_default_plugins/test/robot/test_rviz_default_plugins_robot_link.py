# SPDX-License-Identifier: Apache-2.0
"""Links of a robot that are selected: which one a ray meets, and what is known about it."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rviz_common.selection import Ray
from rviz_default_plugins.displays.robot_model import RobotModel
from stage import Stage
import trimesh

URDF = """<robot name="arm">
<link name="base"><inertial><mass value="4.5"/></inertial>
  <visual><origin xyz="0 0 1"/><geometry><box size="1 1 1"/></geometry></visual></link>
<link name="upper"><visual><geometry><sphere radius="0.25"/></geometry></visual></link>
<link name="slide"><visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual></link>
<link name="tip"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
<joint name="glue" type="fixed"><parent link="upper"/><child link="tip"/></joint>
<joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/>
  <axis xyz="0 0 1"/><limit lower="-1" upper="2" velocity="3" effort="40"/></joint>
<joint name="rail" type="prismatic"><parent link="base"/><child link="slide"/>
  <axis xyz="1 0 0"/><limit lower="0" upper="5" velocity="0.5"/></joint>
</robot>"""
COVER = '/display_0/base/upper/highlight'


@pytest.fixture
def robot(stage: Stage) -> Any:
    """Show a robot a metre before the origin, with its shoulder turned by 30 degrees."""
    display = stage.show(RobotModel, {'TF Prefix': 'r1'})
    stage.describe(URDF)
    stage.move('map', 'r1/base', x=1.0)
    half = math.radians(15.0)
    stage.move('r1/base', 'r1/upper', wxyz=(math.cos(half), 0.0, 0.0, math.sin(half)))
    stage.move('r1/base', 'r1/slide', x=2.5)
    stage.move('r1/upper', 'r1/tip', x=1.0, is_static=True)
    display.update()
    return display


def towards(x: float, z: float) -> Ray:
    """Return a ray along y, which passes the plane of x and z at a point."""
    return Ray((x, -10.0, z), (0.0, 1.0, 0.0))


@pytest.mark.parametrize(
    ('x', 'z', 'name', 'distance'),
    [(1.0, 1.4, 'base', 9.5), (1.0, 0.0, 'upper', 9.75), (3.5, 0.0, 'slide', 9.95)],
)
def test_a_ray_meets_the_link_that_is_there(
    robot: Any, x: float, z: float, name: str, distance: float
) -> None:
    """The bodies are where the transforms place the links."""
    hit = robot.pick(towards(x, z))
    assert (hit.found.name, hit.found.frame) == (name, f'r1/{name}')
    assert hit.distance == pytest.approx(distance)
    assert hit.found.entity == ('r1', name)


def test_a_ray_beside_meets_nothing(stage: Stage, robot: Any) -> None:
    """Nor does one towards a robot that is not shown."""
    assert robot.pick(towards(2.5, 0.0)) is None
    robot.stop()
    robot.start()
    assert robot.pick(towards(1.0, 1.4)) is None


def test_what_is_known_about_links(robot: Any) -> None:
    """A link has a mass and the joint that moves it, the root has no joint."""
    base = robot.pick(towards(1.0, 1.4)).found
    assert base.details() == [
        ('Robot', 'arm'),
        ('Mass', '4.5 kg'),
        ('Joint', 'none: it is the root link'),
    ]
    assert robot.pick(towards(1.0, 0.0)).found.details() == [
        ('Robot', 'arm'),
        ('Mass', 'not given'),
        ('Joint', 'shoulder'),
        ('Type', 'revolute'),
        ('Parent link', 'base'),
        ('Joint position', '0.524 rad (30.0°)'),
        ('Limits', '-1.000 rad (-57.3°) to 2.000 rad (114.6°)'),
        ('Largest velocity', '3 rad/s'),
        ('Largest effort', '40 N m'),
    ]
    slide = dict(robot.pick(towards(3.5, 0.0)).found.details())
    assert (slide['Joint position'], slide['Limits']) == ('2.500 m', '0.000 m to 5.000 m')


def test_links_are_followed(stage: Stage, robot: Any) -> None:
    """The pose is that of the newest transforms, in the fixed frame."""
    upper = robot.pick(towards(1.0, 0.0)).found
    stage.move('map', 'r1/base', x=7.0)
    robot.update()
    assert upper.pose().position == pytest.approx((7.0, 0.0, 0.0))
    assert robot.pick(towards(1.0, 0.0)) is None
    assert robot.pick(towards(7.0, 0.0)).found.name == 'upper'


def test_a_link_is_covered_while_it_is_selected(stage: Stage, robot: Any) -> None:
    """The cover is below the link, so that it moves with it; a robot drawn anew has none."""
    upper = robot.pick(towards(1.0, 0.0)).found
    upper.highlight(True)
    cover = stage.node_at(f'{COVER}/0')
    assert cover.radius > 0.25 and 0.0 < cover.opacity < 1.0
    upper.highlight(False)
    assert stage.node_at(COVER) is None
    upper.highlight(True)
    robot.on_change('Alpha')
    assert not upper.is_present
    assert stage.node_at(COVER) is None


def test_fixed_joints_make_one_rigid_body(robot: Any) -> None:
    """A link that does not move in its parent is a part of it; others are on their own."""
    tip = robot.pick(towards(1.0 + math.cos(math.radians(30.0)), 0.0)).found
    assert (tip.name, dict(tip.details())['Type']) == ('tip', 'fixed')
    assert tip.rigid_body().entity == ('r1', 'upper')
    upper = robot.pick(towards(1.0, 0.0)).found
    assert upper.rigid_body() is upper


def test_meshes_are_met(stage: Stage, tmp_path: Path) -> None:
    """A ray through the hole of a ring meets nothing."""
    file = tmp_path / 'ring.stl'
    trimesh.creation.annulus(r_min=1.0, r_max=2.0, height=0.5).export(file)
    display = stage.show(RobotModel)
    stage.describe(
        f'<robot name="r"><link name="map"><visual><geometry>'
        f'<mesh filename="file://{file}" scale="0.1 0.1 0.1"/></geometry></visual></link></robot>'
    )
    stage.work_until(lambda: display._robot is not None)
    display.update()
    down = np.array([0.0, 0.0, -1.0])
    hit = display.pick(Ray((0.15, 0.0, 1.0), tuple(down)))
    assert hit.found.name == 'map'
    assert hit.distance == pytest.approx(0.975)
    assert display.pick(Ray((0.0, 0.0, 1.0), tuple(down))) is None
