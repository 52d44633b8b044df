# SPDX-License-Identifier: Apache-2.0
"""The frames in the scene: where they are, how old they are, and which are shown."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from rviz_default_plugins.displays.tf import TF
from rviz_default_plugins.tf_frames import Age, Ageing, FrameFilter, placed
from stage import sentence, Stage
from tf2_py.samples import Sample

TURNED = (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))


def test_axes(stage: Stage) -> None:
    """All frames are one node, which has their poses in the fixed frame."""
    display = stage.show(TF)
    stage.move('map', 'base', x=1.0, wxyz=TURNED)
    stage.move('base', 'hand', x=2.0)
    display.update()
    node = stage.node_at('/display_0/axes')
    places = {tuple(np.round(each, 3)) for each in node.batched_positions.tolist()}
    assert places == {(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 2.0, 0.0)}
    assert node.batched_wxyzs[-1].tolist() == pytest.approx(list(TURNED), abs=1e-6)
    assert sentence(display, 'Frames') == '3 of 3 frames are shown.'


def test_fixed_frame_below(stage: Stage) -> None:
    """The fixed frame may be anywhere in the tree."""
    stage.frames.fixed_frame = 'hand'
    display = stage.show(TF)
    stage.move('map', 'base', x=1.0)
    stage.move('base', 'hand', x=2.0)
    display.update()
    places = stage.node_at('/display_0/axes').batched_positions[:, 0]
    assert sorted(places.tolist()) == [-3.0, -2.0, 0.0]


def test_arrows_and_names(stage: Stage) -> None:
    """An arrow leads from each frame to its parent, and each frame has its name."""
    display = stage.show(TF, {'Show Names': True, 'Marker Scale': 2})
    stage.move('map', 'robot1/base', x=1.0)
    stage.move('robot1/base', 'twin')
    display.update()
    assert stage.node_at('/display_0/arrows').points.tolist() == [[[1, 0, 0], [0, 0, 0]]]
    label = stage.node_at('/display_0/names/robot1%2Fbase')
    assert label.text == 'robot1/base'
    stage.move('map', 'robot1/base', x=5.0)
    display.update()
    assert label.position.tolist() == [5.0, 0.0, 0.0]
    assert stage.node_at('/display_0/axes').axes_length == pytest.approx(0.4)


def test_many_names_take_turns(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> None:
    """If many names move, some do so in each frame, and all of them in the end."""
    monkeypatch.setattr('rviz_default_plugins.tf_scene.MAX_MOVES', 2)
    display = stage.show(TF, {'Show Names': True})
    names = [f'frame_{number}' for number in range(6)]
    for x, counts in ((0.0, [0]), (1.0, [2, 4, 6])):
        for name in names:
            stage.move('map', name, x=x)
        for count in counts:
            display.update()
            labels = [stage.node_at(f'/display_0/names/{name}') for name in names]
            assert sum(label.position[0] == 1.0 for label in labels) == count


def test_what_is_not_shown(stage: Stage) -> None:
    """Without names, axes and arrows nothing is drawn."""
    display = stage.show(TF, {'Show Axes': False, 'Show Arrows': False})
    stage.move('map', 'base', x=1.0)
    display.update()
    assert stage.paths() == ['/display_0']


def test_frames_that_come(stage: Stage) -> None:
    """A new frame is shown, and old ones move on."""
    display = stage.show(TF)
    display.update()
    assert sentence(display, 'Frames') == 'There is no frame [map] yet.'
    for count in range(1, 4):
        stage.move('map', f'frame_{count}', x=float(count))
        display.update()
        assert len(stage.node_at('/display_0/axes').batched_positions) == count + 1


def test_unconnected_frames(stage: Stage) -> None:
    """Frames of another tree are not drawn, and the page says which transform is missing."""
    display = stage.show(TF)
    stage.move('map', 'base')
    stage.move('odom', 'camera')
    display.update()
    assert len(stage.node_at('/display_0/axes').batched_positions) == 2
    said = sentence(display, 'Transform')
    assert said.startswith('No transform from [odom] to [map]: it is not published')
    assert 'camera' in said


def test_old_frames(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> None:
    """A frame that nobody speaks of turns grey and then goes; one that does not move stays."""
    now = [100.0]
    monkeypatch.setattr('rviz_default_plugins.displays.tf.time.monotonic', lambda: now[0])
    display = stage.show(TF, {'Frame Timeout': 6, 'Show Arrows': False, 'Show Names': True})
    stage.move('map', 'base', x=1.0)
    stage.move('map', 'table', x=2.0, is_static=True)
    display.update()
    now[0] += 3.0
    display.update()
    assert stage.node_at('/display_0/old_axes').points[:, 0].tolist() == [[1, 0, 0]] * 3
    assert stage.node_at('/display_0/names/base') is not None
    now[0] += 4.0
    display.update()
    assert stage.node_at('/display_0/old_axes') is None
    assert stage.node_at('/display_0/names/base') is None
    assert len(stage.node_at('/display_0/axes').batched_positions) == 2
    stage.move('map', 'base', x=1.0)
    display.update()
    assert len(stage.node_at('/display_0/axes').batched_positions) == 3


def test_grey_axes_point_where_the_frame_does(stage: Stage) -> None:
    """The axes of a frame that is turned are turned."""
    from rviz_default_plugins.tf_scene import _axis_segments

    half = math.sqrt(0.5)
    pose = np.array([[1.0, 0.0, 0.0, 0.0, 0.0, half, half]], np.float32)
    ends = _axis_segments(pose, 1.0)[:, 1]
    assert ends == pytest.approx(np.array([[1, 1, 0], [0, 0, 0], [1, 0, 1]]), abs=1e-6)


FRAMES = {'All Enabled': False, 'base': {'Value': True}, 'robot1/hand': {'Value': True}}


def test_frames_of_the_file(stage: Stage) -> None:
    """A file says of each frame whether it is shown; it is kept as it is."""
    display = stage.show(TF, {'Frames': FRAMES, 'Tree': {'map': {'base': {}}}})
    for frame in ('base', 'robot1/hand', 'other'):
        stage.move('map', frame)
    display.update()
    assert sentence(display, 'Frames') == '2 of 4 frames are shown.'
    assert display.to_file()['Frames'] == FRAMES
    assert display.unknown == []


def test_all_frames(stage: Stage) -> None:
    """To show no frames overrules what the file says of each."""
    display = stage.show(TF, {'Frames': {'All Enabled': True, 'base': {'Value': True}}})
    stage.move('map', 'base')
    display.values['Frames/All Enabled'] = False
    display.on_change('Frames/All Enabled')
    display.update()
    assert sentence(display, 'Frames') == '0 of 2 frames are shown.'
    assert display.to_file()['Frames']['base'] == {'Value': False}


def test_filters(stage: Stage) -> None:
    """Expressions choose frames; one that is broken chooses all, with a sentence."""
    assert [FrameFilter('arm', 'left').shows(name) for name in ('left_arm', 'arm', 'leg')] == [
        False,
        True,
        False,
    ]
    display = stage.show(TF, {'Filter (whitelist)': '('})
    stage.move('map', 'base')
    display.update()
    assert "'(' is not a valid regular expression" in sentence(display, 'Filter')
    assert sentence(display, 'Frames') == '2 of 2 frames are shown.'


def test_too_many_frames(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> None:
    """More frames than a browser can draw are left out, with both numbers."""
    monkeypatch.setattr('rviz_default_plugins.displays.tf.MAX_FRAMES', 5)
    display = stage.show(TF)
    for number in range(9):
        stage.move('map', f'frame_{number}')
    display.update()
    assert sentence(display, 'Number').startswith('10 frames are too many: 5 are shown.')


@pytest.mark.parametrize('values', [(math.nan,) * 4, (0.0,) * 4, (math.inf, 0.0, 0.0, 0.0)])
def test_malformed_transforms(stage: Stage, values: Any) -> None:
    """A transform that is none harms nothing."""
    display = stage.show(TF)
    stage.move('map', 'base', wxyz=values)
    stage.move('map', 'hand')
    display.update()
    assert sentence(display, 'Frames') == '2 of 2 frames are shown.'


def test_frames_far_away(stage: Stage) -> None:
    """A frame that no browser can draw is left out, with its arrow and those below."""
    stage.move('map', 'far', x=1e300)
    stage.move('far', 'below', x=1.0)
    stage.move('map', 'near', x=1.0)
    display = stage.show(TF)
    display.update()
    assert '2 frames are too far away to be shown (below, far)' in sentence(display, 'Distance')
    assert '2 of 2 frames are shown' in sentence(display, 'Frames')


def test_loop() -> None:
    """Frames that go round in a loop have no place."""
    unit = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
    samples = {
        'a': Sample(1, 'b', unit, ''),
        'b': Sample(1, 'a', unit, ''),
        'c': Sample(1, 'map', unit, ''),
    }
    poses, others = placed(samples, 'map')
    assert set(poses) == {'map', 'c'}
    assert others == {}


def test_ageing() -> None:
    """A frame is fresh when its stamp changes, whichever way."""
    ageing = Ageing()
    ageing.hear({'a': Sample(5, 'map', (0.0,) * 7, '')}, 0.0)
    ageing.hear({'a': Sample(5, 'map', (0.0,) * 7, '')}, 4.0)
    assert ageing.age('a', 4.0, 9.0) is Age.OLD
    ageing.hear({'a': Sample(4, 'map', (0.0,) * 7, '')}, 4.0)
    assert ageing.age('a', 4.0, 9.0) is Age.FRESH
    assert ageing.age('a', 14.0, 9.0) is Age.GONE
    assert ageing.age('a_parent', 99.0, 9.0) is Age.FRESH


@pytest.mark.parametrize('frames', [None, 'x', 3, []])
def test_a_file_without_frames_can_be_saved(stage: Stage, frames: Any) -> None:
    """A file may say nothing of single frames, or something that cannot be used; it is kept."""
    assert stage.show(TF, {'Class': 'c', 'Name': 'n'}).to_file() == {'Class': 'c', 'Name': 'n'}
    assert stage.show(TF, {'Class': 'c', 'Frames': frames}).to_file()['Frames'] == frames
