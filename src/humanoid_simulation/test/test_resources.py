# SPDX-License-Identifier: Apache-2.0
"""Worlds and things from names, files and texts."""

from __future__ import annotations

import math
from pathlib import Path

from humanoid_simulation.errors import ResourceError
from humanoid_simulation.scene.objects import CLASSES
from humanoid_simulation.scene.resources import (
    installed_worlds,
    spawnables,
    thing_from,
    world_at,
    world_of,
    worlds_in,
)
import pytest

CRATE = """<robot name="crate">
  <link name="base">
    <inertial><mass value="2.0"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
    <visual><geometry><box size="0.4 0.3 0.2"/></geometry></visual>
    <collision><geometry><box size="0.4 0.3 0.2"/></geometry></collision>
  </link>
  <link name="knob">
    <inertial><mass value="0.5"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
    <visual><origin xyz="0 0 0.05"/><geometry><sphere radius="0.05"/></geometry></visual>
  </link>
  <joint name="fix" type="{kind}">
    <parent link="base"/><child link="knob"/><origin xyz="0 0 0.1" rpy="0 0 1.57"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>
"""  # noqa: E501


@pytest.mark.parametrize('kind', CLASSES)
def test_every_class_can_be_made(kind: str) -> None:
    """By its name alone, or with a colour."""
    assert thing_from(kind, '', 'one').kind == kind
    assert thing_from(f'green {kind}', '', 'one').colour == 'green'
    assert kind in [uri for uri, _, _ in spawnables()]


def test_a_rigid_urdf_is_one_thing() -> None:
    """Links that are fixed to each other add up; what is seen and what is solid differ."""
    thing = thing_from('', CRATE.format(kind='fixed'), 'crate')
    assert thing.mass_kg == pytest.approx(2.5)
    solid = [part for part in thing.parts if part.collides]
    seen = [part for part in thing.parts if part.is_shown]
    assert [part.shape for part in solid] == ['box']
    assert [part.shape for part in seen] == ['box', 'sphere']
    assert seen[1].position_m == pytest.approx((0.0, 0.0, 0.15))


def test_size_of_turned_parts() -> None:
    """The box of an object reaches around its parts, however they are turned."""
    urdf = """<robot name="x"><link name="base">
    <visual><origin rpy="0 0 {yaw}"/><geometry><box size="1 1 0.1"/></geometry></visual>
    <visual><origin rpy="0 {tilt} 0"/><geometry><cylinder radius="0.1" length="0.8"/></geometry>
    </visual><visual><origin rpy="1 1 1"/><geometry><sphere radius="0.1"/></geometry></visual>
    </link></robot>"""
    upright = thing_from('', urdf.format(yaw=math.pi / 4, tilt=0), 'x')
    assert upright.size_m == pytest.approx((math.sqrt(2.0), math.sqrt(2.0), 0.8))
    lying = thing_from('', urdf.format(yaw=0, tilt=math.pi / 2), 'x')
    assert lying.size_m == pytest.approx((1.0, 1.0, 0.2))


def test_files_and_texts_give_the_same(tmp_path: Path) -> None:
    """A path, a file URI and the content of the file."""
    file = tmp_path / 'a b.yaml'
    file.write_text('{shape: box, size: [0.3, 0.2, 0.1], mass: 1.0}\n')
    uri = f'file://{str(file).replace(" ", "%20")}'
    things = [
        thing_from(uri, '', 'box'),
        thing_from(str(file), '', 'box'),
        thing_from('', file.read_text(), 'box'),
    ]
    assert things[0] == things[1] == things[2]
    assert thing_from('', '{class: mug, colour: red}', 'mug').colour == 'red'


@pytest.mark.parametrize(
    ('uri', 'text', 'problem', 'sentence'),
    [
        ('', ' ', 'NO_RESOURCE', 'both are empty'),
        ('mugg', '', 'NO_RESOURCE', 'neither a file nor an object class'),
        ('mauve mug', '', 'NO_RESOURCE', "'mauve mug' is neither"),
        ('/nowhere/x.yaml', '', 'NO_RESOURCE', 'File /nowhere/x.yaml not found'),
        ('box.sdf', '', 'UNSUPPORTED_FORMAT', 'ends with .urdf'),
        ('https://x.org/box.urdf', '', 'UNSUPPORTED_FORMAT', 'file or package URI'),
        ('package://nobodys/x.urdf', '', 'NO_RESOURCE', "Package 'nobodys' of"),
        ('', '{shape: ball}', 'RESOURCE_PARSE_ERROR', 'shape must be one of'),
        ('', '{class: mug, color: red}', 'RESOURCE_PARSE_ERROR', "Did you mean 'colour'"),
        ('', '[1, 2', 'RESOURCE_PARSE_ERROR', 'is not a valid YAML file'),
        ('', '<robot', 'RESOURCE_PARSE_ERROR', ''),
        (
            '',
            CRATE.format(kind='fixed').replace('"knob"/><origin', '"base"/><origin'),
            'RESOURCE_PARSE_ERROR',
            'lead into a loop',
        ),
        ('', CRATE.format(kind='revolute'), 'UNSUPPORTED_FORMAT', "movable joint 'fix'"),
    ],
)
def test_what_cannot_be_made(uri: str, text: str, problem: str, sentence: str) -> None:
    """The error has the number of the standard, and a sentence."""
    with pytest.raises(ResourceError) as caught:
        thing_from(uri, text, 'thing')
    assert caught.value.problem == problem
    assert sentence in str(caught.value)


def test_worlds_say_what_they_are(tmp_path: Path) -> None:
    """Installed ones by name; those of a folder by path; a description comes from the file."""
    worlds = {world.name: world for world in installed_worlds()}
    assert worlds['flat'].description.startswith('Nothing but a floor.')
    (tmp_path / 'mine.yaml').write_text('# A floor of ice.\nfloor: {friction: 0.1}\n')
    (mine,) = worlds_in(f'file://{tmp_path}')
    assert (mine.name, mine.description) == ('mine', 'A floor of ice.')
    loaded, scene = world_of(mine.uri, '')
    assert loaded == mine and scene.floor.friction == pytest.approx(0.1)
    assert world_of('room', '')[1].things
    assert world_of('', 'floor: {friction: 0.2}')[1].floor.friction == pytest.approx(0.2)
    with pytest.raises(ResourceError, match='cannot be read'):
        worlds_in(str(tmp_path / 'none'))
    (tmp_path / 'mine.yaml').write_bytes(b'# \xff\n')
    for ask in (lambda: world_at(mine.uri), lambda: worlds_in(str(tmp_path))):
        with pytest.raises(ResourceError, match=r"mine.yaml' cannot be read: .*utf-8"):
            ask()
    with pytest.raises(ResourceError, match='a world: apartment'):
        world_of('rom', '')
