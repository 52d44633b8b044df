# SPDX-License-Identifier: Apache-2.0
"""Tests of views: from properties to cameras, and back."""

import math
from typing import Any

import pytest
from rviz_common.view import KINDS, View
from rviz_common.view_kinds import CameraPose


def close(a: Any, b: Any) -> bool:
    """Tell if two points are about the same."""
    return math.dist(a, b) < 1e-6


def test_an_orbit_looks_from_above_the_corner() -> None:
    """Yaw goes from x to y, and a positive pitch is above the ground."""
    view = View(
        {'Class': 'rviz_default_plugins/Orbit', 'Distance': 2, 'Yaw': math.pi / 2, 'Pitch': 0.5}
    )
    camera = view.camera()
    assert close(camera.position, (0.0, 2 * math.cos(0.5), 2 * math.sin(0.5)))
    assert close(camera.look_at, (0, 0, 0))


def test_fps_looks_ahead_and_down() -> None:
    """At yaw 0 it looks along x; a positive pitch looks down, as in RViz."""
    view = View(
        {'Class': 'rviz_default_plugins/FPS', 'Position': {'X': 1, 'Y': 2, 'Z': 3}, 'Pitch': 0.5}
    )
    camera = view.camera()
    assert close(camera.position, (1, 2, 3))
    assert close(camera.look_at, (1 + math.cos(0.5), 2, 3 - math.sin(0.5)))


def test_top_down_has_x_to_the_right() -> None:
    """Without an angle, y is up on the screen; the scale gives the height."""
    near, far = (
        View({'Class': 'rviz_default_plugins/TopDownOrtho', 'X': 1, 'Y': 2, 'Scale': scale})
        for scale in (100, 10)
    )
    assert close(near.camera().look_at, (1, 2, 0)) and close(near.camera().up, (0, 1, 0))
    assert far.camera().position[2] == pytest.approx(10 * near.camera().position[2])


@pytest.mark.parametrize('kind', KINDS.values(), ids=lambda kind: kind.NAME)
def test_a_camera_comes_back(kind: Any) -> None:
    """What a camera makes of the properties makes the same camera."""
    view = View({'Class': kind.CLASS, 'Yaw': 1.0, 'Pitch': 0.4, 'Angle': 0.3, 'Near': 0.1})
    camera = view.camera()
    view.take(camera)
    again = view.camera()
    assert close(again.position, camera.position)
    assert close(again.look_at, camera.look_at)
    assert close(again.up, camera.up)


@pytest.mark.parametrize('kind', KINDS.values(), ids=lambda kind: kind.NAME)
@pytest.mark.parametrize('pitch', [1e9, -1e9, math.pi / 2])
def test_no_view_is_impossible(kind: Any, pitch: float) -> None:
    """A camera is never where it looks, and looks never along what is up."""
    camera = View({'Class': kind.CLASS, 'Pitch': pitch}).camera()
    ahead = [b - a for a, b in zip(camera.position, camera.look_at)]
    length = math.hypot(*ahead)
    assert length > 0.001
    assert abs(sum(a * b for a, b in zip(ahead, camera.up))) / length < 1.0


def test_an_orbit_on_the_ground_finds_the_ground() -> None:
    """It turns about the point of the ground that is seen in the middle."""
    view = View({'Class': 'rviz_default_plugins/XYOrbit'})
    view.take(CameraPose((0.0, 0.0, 2.0), (1.0, 0.0, 1.0)))
    assert close(view.values['Focal Point'], (2, 0, 0))
    view.take(CameraPose((0.0, 0.0, 2.0), (1.0, 0.0, 2.0)))
    assert close(view.values['Focal Point'], (1, 0, 0))


def test_another_kind_of_view_shows_about_the_same() -> None:
    """Who changes the kind looks from the same place, and follows the same frame."""
    orbit = View({'Class': 'rviz_default_plugins/Orbit', 'Target Frame': 'base_link'})
    fps = orbit.like(KINDS['rviz_default_plugins/FPS'])
    assert close(fps.camera().position, orbit.camera().position)
    assert fps.target == 'base_link'
    assert fps.to_file()['Class'] == 'rviz_default_plugins/FPS'


def test_unknown_views_are_kept_for_the_file() -> None:
    """A view of a class that is not known is an orbit here, and itself in the file."""
    given = {'Class': 'rviz_default_plugins/FrameAligned', 'Foo': 1}
    view = View(given)
    assert not view.is_known
    assert view.camera() == View({}).camera()
    assert view.to_file() == given
