# SPDX-License-Identifier: Apache-2.0
"""Tests of rays, of what is selected, and of the panel that shows it."""

from __future__ import annotations

from collections.abc import Callable
import math
from typing import Any

import pytest
from rviz_common.frames import Pose
from rviz_common.panels.selection_panel import roll_pitch_yaw, SelectionPanel
from rviz_common.selection import Hit, nearest, Ray, SceneObject, Selection
from rviz_common.visualizer import Visualizer

HALF = math.sqrt(0.5)
LEFT = Pose((1.0, 2.0, 3.0), (HALF, 0.0, 0.0, HALF))
"""A frame whose x axis points along y."""


class Thing(SceneObject):
    """An object that remembers whether it is highlighted."""

    def __init__(self, name: str, pose: Pose | None = None) -> None:
        """Begin in the scene."""
        self.name, self.frame = name, 'base'
        self.at = pose
        self.is_there = True
        self.is_highlighted = False

    @property
    def is_present(self) -> bool:
        """Whether it is there."""
        return self.is_there

    def pose(self) -> Pose | None:
        """Return its pose."""
        return self.at

    def details(self) -> list[tuple[str, str]]:
        """Return a mass."""
        return [('Mass', '2 kg | *heavy*')]

    def highlight(self, is_highlighted: bool) -> None:
        """Remember it."""
        self.is_highlighted = is_highlighted


def test_rays_are_seen_from_frames() -> None:
    """Distances stay the same, and the point that the ray meets is the same."""
    ray = Ray((1.0, 2.0, 3.0), (0.0, 2.0, 0.0))
    seen = ray.seen_from(LEFT)
    assert seen.origin == pytest.approx((0.0, 0.0, 0.0))
    assert seen.direction == pytest.approx((2.0, 0.0, 0.0))
    point = Pose(seen.at(1.5))
    assert LEFT.of(point).position == pytest.approx(ray.at(1.5))
    assert ray.at(1.5) == (1.0, 5.0, 3.0)


def test_poses_of_frames_are_composed() -> None:
    """The inverse leads back."""
    inner = Pose((1.0, 0.0, 0.0))
    assert LEFT.of(inner).position == pytest.approx((1.0, 3.0, 3.0))
    there_and_back = LEFT.of(LEFT.inverse())
    assert there_and_back.position == pytest.approx((0.0, 0.0, 0.0))
    assert there_and_back.wxyz == pytest.approx((1.0, 0.0, 0.0, 0.0))


def test_the_nearest_object_is_found() -> None:
    """Displays that find nothing do not count."""
    near, far = Hit(1.0, Thing('near')), Hit(2.0, Thing('far'))
    assert nearest([None, far, near]) is near
    assert nearest([None]) is None


def test_one_object_is_highlighted() -> None:
    """Who selects another one deselects the first; one that is gone is deselected by itself."""
    selection = Selection(lambda ray: None)
    first, second = Thing('first'), Thing('second')
    selection.choose(first)
    assert first.is_highlighted
    selection.choose(second)
    assert (first.is_highlighted, second.is_highlighted) == (False, True)
    selection.update()
    assert selection.chosen is second
    second.is_there = False
    selection.update()
    assert selection.chosen is None


@pytest.mark.parametrize(
    ('wxyz', 'angles'),
    [
        ((1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
        ((HALF, HALF, 0.0, 0.0), (math.pi / 2, 0.0, 0.0)),
        ((HALF, 0.0, -HALF, 0.0), (0.0, -math.pi / 2, 0.0)),
        ((0.5, -0.5, 0.5, 0.5), (0.0, math.pi / 2, math.pi / 2)),
        ((0.0, 0.0, 0.0, 1.0), (0.0, 0.0, math.pi)),
    ],
)
def test_angles_are_those_of_rep_103(wxyz: Any, angles: Any) -> None:
    """Roll, pitch and yaw are about x, y and z."""
    assert roll_pitch_yaw(Pose(wxyz=wxyz)) == pytest.approx(angles)


def test_the_panel_shows_what_is_selected(show: Callable[..., Visualizer]) -> None:
    """It is hidden before and after; a pose that changes is followed."""
    shown = show(
        'Panels:\n  - Class: rviz_common/Selection\n    Name: Chosen\n'
        'Visualization Manager:\n  Global Options:\n    Fixed Frame: odom\n'
    )
    panel = SelectionPanel(shown.context)
    panel.start()
    assert not panel._folder.visible
    thing = Thing('left_hand', LEFT)
    shown.selection.choose(thing)
    panel.update()
    assert panel._folder.visible
    assert panel._text.content.splitlines() == [
        '| Name | left\\_hand |',
        '|---|---|',
        '| Frame | base |',
        '| Position in odom | 1.000, 2.000, 3.000 m |',
        '| Roll, pitch, yaw | 0.0, 0.0, 90.0 ° |',
        '| Mass | 2 kg \\| \\*heavy\\* |',
    ]
    thing.at = None
    panel._pace.hurry()
    panel.update()
    assert 'unknown: no transform says where it is' in panel._text.content
    shown.selection.choose(None)
    panel.update()
    assert not panel._folder.visible
    panel.close()
