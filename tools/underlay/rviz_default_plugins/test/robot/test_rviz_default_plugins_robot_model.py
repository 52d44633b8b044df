# SPDX-License-Identifier: Apache-2.0
"""The robot in the scene: its bodies, its movements, and what it says is missing."""

from __future__ import annotations

import math
from pathlib import Path
from random import Random
from typing import Any

import pytest
from rclpy.qos import DurabilityPolicy
from rviz_common.properties import Values
from rviz_default_plugins.displays.robot_model import RobotModel
from stage import sentence, Stage

URDF = """<robot name="arm">
<material name="blue"><color rgba="0 0 1 0.5"/></material>
<link name="base"><visual><origin xyz="0 0 1" rpy="0 0 3.141592653589793"/>
  <geometry><box size="1 2 3"/></geometry><material name="blue"/></visual>
  <collision><geometry><sphere radius="0.5"/></geometry></collision></link>
<link name="upper"><visual><geometry><cylinder radius="0.1" length="2"/></geometry></visual>
  <visual><geometry><capsule radius="0.1" length="2"/></geometry></visual></link>
<link name="hand"/>
<joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/></joint>
<joint name="wrist" type="fixed"><parent link="upper"/><child link="hand"/></joint>
</robot>"""
BASE, UPPER = '/display_0/base', '/display_0/base/upper'


@pytest.fixture
def robot(stage: Stage) -> Any:
    """Show a robot with all its transforms."""
    display = stage.show(RobotModel)
    stage.describe(URDF)
    stage.move('map', 'base', x=1.0)
    stage.move('base', 'upper')
    stage.move('upper', 'hand', x=2.0, is_static=True)
    display.update()
    return display


def test_bodies(stage: Stage, robot: Any) -> None:
    """Each link has its visuals with their measures, places and colours; no collisions."""
    box = stage.node_at(f'{BASE}/visual_0')
    assert tuple(box.dimensions) == (1.0, 2.0, 3.0)
    assert (box.color, box.opacity) == ((0, 0, 255), 0.5)
    assert box.position.tolist() == [0.0, 0.0, 1.0]
    assert box.wxyz.tolist() == pytest.approx([0.0, 0.0, 0.0, 1.0])
    cylinder = stage.node_at(f'{UPPER}/visual_0')
    assert (cylinder.radius, cylinder.height, cylinder.opacity) == (0.1, 2.0, None)
    capsule = stage.node_at(f'{UPPER}/visual_1').vertices
    assert capsule.max(axis=0) == pytest.approx([0.1, 0.1, 1.1], abs=1e-3)
    assert capsule.min(axis=0) == pytest.approx([-0.1, -0.1, -1.1], abs=1e-3)
    assert stage.node_at(f'{BASE}/collision_0') is None


def test_places(stage: Stage, robot: Any) -> None:
    """The root is in the fixed frame, the others are in their parents."""
    turned = (math.cos(0.5), 0.0, 0.0, math.sin(0.5))
    stage.move('base', 'upper', wxyz=turned)
    robot.update()
    assert stage.node_at(BASE).position.tolist() == [1.0, 0.0, 0.0]
    assert stage.node_at(UPPER).wxyz.tolist() == pytest.approx(list(turned))
    assert stage.node_at(f'{UPPER}/hand').position.tolist() == [2.0, 0.0, 0.0]
    assert all(stage.node_at(path).visible for path in (BASE, UPPER, f'{UPPER}/hand'))
    assert [subject for subject, _, _ in robot.status.items()] == ['URDF']


def test_only_what_moves_is_sent(
    stage: Stage, robot: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A joint that turns is one message, and a robot that stands is none."""
    sent: list[Any] = []
    monkeypatch.setattr(stage.server.scene, '_queue_scene_message', sent.append)
    robot.update()
    assert sent == []
    stage.move('base', 'upper', wxyz=(0.0, 1.0, 0.0, 0.0))
    robot.update()
    assert [type(each).__name__ for each in sent] == ['SetOrientationMessage']


def test_link_without_transform(stage: Stage) -> None:
    """A link whose transform is missing is hidden, and the page says who should publish it."""
    display = stage.show(RobotModel)
    stage.describe(URDF)
    stage.move('map', 'base')
    stage.move('upper', 'hand', is_static=True)
    display.update()
    assert stage.node_at(BASE).visible
    assert not stage.node_at(UPPER).visible
    said = sentence(display, 'Link upper')
    assert said.startswith('No transform from [upper] to [base]: robot_state_publisher has ')
    assert "received no joint state for 'shoulder'" in said
    assert sentence(display, 'Link hand') == ''


def test_sentences_go_when_transforms_come(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> None:
    """What was missing is not said any longer once it is there."""
    monkeypatch.setattr('rviz_default_plugins.displays.robot_model.REASONS_S', 0.0)
    display = stage.show(RobotModel)
    stage.describe(URDF)
    display.update()
    assert 'Start robot_state_publisher' in sentence(display, 'Link ...')
    assert 'The robot is not shown' in sentence(display, 'Transform')
    stage.move('map', 'base')
    stage.move('base', 'upper')
    display.update()
    assert sentence(display, 'Link ...') == ''
    assert "joint 'wrist'. Is it running?" in sentence(display, 'Link hand')
    stage.move('upper', 'hand')
    display.update()
    assert [subject for subject, _, _ in display.status.items()] == ['URDF']


def test_prefix_is_suggested(stage: Stage) -> None:
    """If the frames have a prefix, it is named."""
    display = stage.show(RobotModel)
    stage.describe(URDF)
    stage.move('robot1/base', 'robot1/upper')
    display.update()
    assert "set 'TF Prefix' to 'robot1'" in sentence(display, 'Link ...')


def test_prefix(stage: Stage) -> None:
    """Links of a prefix have their transforms below it."""
    display = stage.show(RobotModel, {'TF Prefix': 'robot1'})
    stage.describe(URDF)
    stage.move('map', 'robot1/base', x=3.0)
    stage.move('robot1/base', 'robot1/upper')
    display.update()
    assert stage.node_at(BASE).position.tolist() == [3.0, 0.0, 0.0]
    assert stage.node_at(UPPER).visible


def test_broken_description(stage: Stage, robot: Any) -> None:
    """A broken description is refused with its line, and the old robot stays."""
    stage.describe('<robot name="r">\n<link/></robot>')
    said = sentence(robot, 'URDF')
    assert '/robot_description:2:' in said
    assert said.endswith('The previous robot stays.')
    robot.update()
    assert stage.node_at(BASE).visible


@pytest.mark.parametrize('text', ['', 'nonsense', '<robot', '<a/>', '\x00', '<robot name="r"/>'])
def test_malformed_descriptions(stage: Stage, text: str) -> None:
    """A description that is none gives a sentence and no robot."""
    display = stage.show(RobotModel)
    stage.describe('<robot name="r"><link name="l"/></robot>')
    stage.describe(text)
    display.update()
    assert sentence(display, 'URDF').startswith('/robot_description')


def test_random_descriptions(stage: Stage) -> None:
    """Whatever is wrong with a description, there is a sentence, and the page goes on."""
    random = Random(6)
    display = stage.show(RobotModel)
    words = ['', 'nan', '1e400', '-1', '1e308', '<', '"', '\ud800', '\x00', 'base', '/', '&a;']
    for _ in range(300):
        at = random.randrange(len(URDF))
        end = at + random.choice([0, 1, 5, 50])
        stage.describe(URDF[:at] + random.choice(words) + URDF[end:])
        display.update()
        assert sentence(display, 'URDF')


def test_new_description(stage: Stage, robot: Any) -> None:
    """A new description replaces the robot; the same one again changes nothing."""
    box = stage.node_at(f'{BASE}/visual_0')
    stage.describe(URDF)
    assert stage.node_at(f'{BASE}/visual_0') is box
    stage.describe('<robot name="r"><link name="other"/></robot>')
    robot.update()
    assert stage.node_at(BASE) is None
    assert stage.node_at('/display_0/other') is not None


def test_description_from_before_is_asked_for(stage: Stage, robot: Any) -> None:
    """A file may say Volatile, but descriptions are published once."""
    asked = {qos.durability for _, _, qos in stage.node.subscriptions}
    assert DurabilityPolicy.TRANSIENT_LOCAL in asked


def test_waiting(stage: Stage) -> None:
    """Before a description comes, the page says which topic is listened to."""
    display = stage.show(RobotModel, {'Description Topic': {'Value': '/robot1/description'}})
    assert sentence(display, 'URDF').startswith('No description received on /robot1/description')


@pytest.mark.parametrize('topic', ['', 'with space'])
def test_bad_topics(stage: Stage, topic: str) -> None:
    """A topic that cannot be is refused with a sentence."""
    display = stage.show(RobotModel, {'Description Topic': {'Value': topic}})
    display.update()
    assert 'topic' in sentence(display, 'URDF')


def test_file(stage: Stage, tmp_path: Path) -> None:
    """A description may come from a file."""
    path = tmp_path / 'arm.urdf'
    path.write_text(URDF)
    given = {'Description Source': 'File', 'Description File': f'file://{path}'}
    stage.show(RobotModel, given)
    assert stage.node_at(BASE) is not None


@pytest.mark.parametrize('file', ['', '/not/there.urdf', 'relative.urdf', 'package://nobody/x'])
def test_bad_files(stage: Stage, file: str) -> None:
    """A file that is not there is refused with a sentence."""
    display = stage.show(RobotModel, {'Description Source': 'File', 'Description File': file})
    display.update()
    assert sentence(display, 'URDF')


def test_ghost(stage: Stage) -> None:
    """Alpha makes all of the robot translucent, beyond what its materials are."""
    stage.show(RobotModel, {'Alpha': 0.5, 'Collision Enabled': True})
    stage.describe(URDF)
    assert stage.node_at(f'{BASE}/visual_0').opacity == 0.25
    assert not stage.node_at(f'{BASE}/visual_0').cast_shadow  # it can hardly be seen
    assert stage.node_at(f'{UPPER}/visual_0').opacity == 0.5
    assert stage.node_at(f'{UPPER}/visual_0').cast_shadow
    assert stage.node_at(f'{BASE}/collision_0').radius == 0.5


def test_links_are_hidden_one_by_one(stage: Stage, robot: Any) -> None:
    """The bodies of a link are hidden alone, as a display asks; those of others are shown."""
    bodies = [stage.node_at(f'{path}/visual_0') for path in (BASE, UPPER)]
    for hidden, shown in (
        ({'base'}, [False, True]),
        ({'upper'}, [True, False]),
        (set(), [True] * 2),
    ):
        robot.hidden_links = lambda robot, hidden=hidden: hidden
        robot.update()
        assert [each.visible for each in bodies] == shown
        assert stage.node_at(BASE).visible and stage.node_at(UPPER).visible


def test_changes_while_shown(stage: Stage, robot: Any) -> None:
    """A property that changes redraws the robot without asking for its description again."""
    asked = list(stage.node.subscriptions)
    robot.values['Visual Enabled'] = False
    robot.values['Collision Enabled'] = True
    robot.on_change('Visual Enabled')
    robot.update()
    assert stage.node.subscriptions == asked
    assert stage.node_at(f'{BASE}/visual_0') is None
    assert stage.node_at(f'{BASE}/collision_0') is not None
    assert stage.node_at(BASE).visible


def test_another_topic(stage: Stage, robot: Any) -> None:
    """Another topic means another robot."""
    robot.values['Description Topic/Value'] = '/other'
    robot.on_change('Description Topic/Value')
    assert stage.node_at(BASE) is None
    stage.describe(URDF, '/other')
    assert stage.node_at(BASE) is not None


LINKS = {
    'All Links Enabled': False,
    'base': {'Value': True, 'Alpha': 0.5, 'Show Axes': True, 'Show Trail': False},
    'upper': {'Value': 'nonsense', 'Alpha': 7},
}


def test_links_of_the_file(stage: Stage) -> None:
    """A file says of each link whether and how it is shown; others are as all are."""
    stage.show(RobotModel, {'Links': LINKS})
    stage.describe(URDF)
    assert stage.node_at(f'{BASE}/visual_0').opacity == 0.25
    assert stage.node_at(BASE).show_axes
    assert stage.node_at(f'{UPPER}/visual_0') is None


def test_all_links(stage: Stage) -> None:
    """To show all links overrules the file, and is written to it."""
    display = stage.show(RobotModel, {'Links': LINKS})
    stage.describe(URDF)
    display.values['Links/All Links Enabled'] = True
    display.on_change('Links/All Links Enabled')
    assert stage.node_at(f'{UPPER}/visual_0') is not None
    written = display.to_file()['Links']
    assert written['All Links Enabled'] is True
    assert written['upper']['Value'] is True
    assert written['base']['Alpha'] == 0.5


def test_file_is_kept(stage: Stage) -> None:
    """What a file of RViz has is known, and written back without losses."""
    given = {
        'Class': 'rviz_default_plugins/RobotModel',
        'Name': 'RobotModel',
        'Value': True,
        'Enabled': True,
        'Links': LINKS,
        'Mass Properties': {'Inertia': False, 'Mass': False},
    }
    display = stage.show(RobotModel, given)
    assert display.unknown == []
    assert given.items() <= display.to_file().items()


def test_huge_robot(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> None:
    """A robot of too many bodies is shown in part, and says so."""
    monkeypatch.setattr('rviz_default_plugins.robot.robot_scene.MAX_SHAPES', 5)
    monkeypatch.setattr('rviz_default_plugins.displays.robot_model.MAX_SHAPES', 5)
    ball = '<visual><geometry><sphere radius="1"/></geometry></visual>'
    display = stage.show(RobotModel)
    stage.describe(f'<robot name="r"><link name="l">{ball * 7}</link></robot>')
    assert sentence(display, 'Bodies') == '7 bodies are too many: 5 are shown.'
    assert stage.node_at('/display_0/l/visual_5') is None


def test_too_many_links(stage: Stage) -> None:
    """A robot of more links than a browser can move is refused with both numbers."""
    links = ''.join(f'<link name="l{number}"/>' for number in range(2002))
    joints = ''.join(
        f'<joint name="j{number}" type="fixed"><parent link="l0"/>'
        f'<child link="l{number}"/></joint>'
        for number in range(1, 2002)
    )
    display = stage.show(RobotModel)
    stage.describe(f'<robot name="r">{links}{joints}</robot>')
    display.update()
    assert '2002 links are too many: at most 2000' in sentence(display, 'URDF')


def test_names_with_slashes(stage: Stage) -> None:
    """A link whose name has slashes is one node."""
    stage.show(RobotModel)
    stage.describe('<robot name="r"><link name="a/b"/></robot>')
    assert stage.node_at('/display_0/a%2Fb') is not None


def test_several_robots(stage: Stage, robot: Any) -> None:
    """Each display has a robot of its own."""
    stage.show(RobotModel, {'Description Topic': {'Value': '/two/robot_description'}})
    stage.describe(URDF, '/two/robot_description')
    assert stage.node_at('/display_1/base') is not None
    assert stage.node_at(BASE) is not None


def test_defaults_are_valid() -> None:
    """Each default can be read back from what is written."""
    values = Values(RobotModel.PROPERTIES)
    again = Values(RobotModel.PROPERTIES, values.to_file())
    assert again.refusals == []


@pytest.mark.parametrize('links', [None, 'x', 3, []])
def test_a_file_without_links_can_be_saved(stage: Stage, links: Any) -> None:
    """A file may say nothing of single links, or something that cannot be used; it is kept."""
    given = {'Class': 'c', 'Name': 'n'}
    assert stage.show(RobotModel, given).to_file() == given
    assert stage.show(RobotModel, {**given, 'Links': links}).to_file()['Links'] == links
