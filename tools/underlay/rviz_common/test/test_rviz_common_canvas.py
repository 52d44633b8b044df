# SPDX-License-Identifier: Apache-2.0
"""A part of the scene that is drawn again and again."""

import numpy as np
import pytest
from rviz_common.canvas import Canvas
from rviz_common.page import NO_TOKEN, Page, PageSettings


@pytest.fixture(scope='module')
def scene():
    """Return a scene."""
    with Page('test', PageSettings(token=NO_TOKEN)) as page:
        yield page.viser.scene


@pytest.fixture
def canvas(scene):
    """Return an empty canvas below /root."""
    scene.add_frame('/root')
    yield Canvas(scene, '/root')
    scene.remove_by_name('/root')


def test_what_is_put_again_is_changed(scene, canvas):
    """The same name and kind keep what there is, with the new properties and place."""
    sphere = canvas.put('icosphere', 'ball', radius=1.0, color=(1, 2, 3), position=(1, 0, 0))
    again = canvas.put('icosphere', 'ball', radius=2.0, color=(4, 5, 6), position=(2, 0, 0))
    assert again is sphere is scene.get_handle_by_name('/root/ball')
    assert (sphere.radius, sphere.color) == (2.0, (4, 5, 6))
    assert sphere.position.tolist() == [2, 0, 0]


def test_arrays_of_other_lengths_and_colors(canvas):
    """Points may become more or fewer, and their colours one or many."""
    look = {'points': np.zeros((2, 3), np.float32), 'precision': 'float32'}
    cloud = canvas.put('point_cloud', 'points', colors=(1, 2, 3), **look)
    more = np.ones((5, 3), np.float32)
    canvas.put(
        'point_cloud',
        'points',
        colors=np.full((5, 3), 9, np.uint8),
        points=more,
        precision='float32',
    )
    assert (cloud.points.shape, cloud.colors.shape) == ((5, 3), (5, 3))
    canvas.put('point_cloud', 'points', colors=(1, 2, 3), **look)
    assert cloud.colors.tolist() == [1, 2, 3]


def test_another_kind_or_other_options_replace(scene, canvas):
    """What becomes another thing, or loses a property, is made anew."""
    box = canvas.put('box', 'thing', dimensions=(1, 1, 1), position=(1, 0, 0))
    moved = canvas.put('box', 'thing', dimensions=(1, 1, 1))
    assert moved is not box
    assert moved.position.tolist() == [0, 0, 0]
    sphere = canvas.put('icosphere', 'thing', radius=1.0)
    assert scene.get_handle_by_name('/root/thing') is sphere


def test_what_is_not_put_again_goes(scene, canvas):
    """Drawing anew removes the rest; if it fails, all stays."""
    with canvas.anew():
        canvas.put('box', 'one')
        canvas.put('box', 'two')
    with pytest.raises(ValueError), canvas.anew():
        raise ValueError
    assert scene.get_handle_by_name('/root/one') is not None
    with canvas.anew():
        canvas.put('box', 'two')
    assert scene.get_handle_by_name('/root/one') is None
    assert scene.get_handle_by_name('/root/two') is not None
