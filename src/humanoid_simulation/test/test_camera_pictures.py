# SPDX-License-Identifier: Apache-2.0
"""Check what is in the pictures, however they are drawn."""

from __future__ import annotations

from collections.abc import Iterator
import math

from humanoid_simulation.camera import CameraView, Wanted
from humanoid_simulation.camera.images import Color, Depth
from humanoid_simulation.camera.pinhole import Pinhole
from humanoid_simulation.camera.renderer import Pictures
from humanoid_simulation.testing.camera_studio import ball_address, Studio, studio
import numpy as np
from numpy.typing import NDArray
import pytest

# Odd on purpose: rows of such pictures do not begin at multiples of four bytes.
VIEWS = (CameraView('eye', 161, 121), CameraView('back_eye', 80, 60))
PINHOLE = Pinhole(161, 121, math.radians(60.0))


@pytest.fixture(name='place', params=['egl', 'osmesa', 'rays'], scope='module')
def _place(request: pytest.FixtureRequest) -> Iterator[Studio]:
    """Give a renderer of each kind; without its library that kind cannot be tested."""
    with studio([request.param], VIEWS) as place:
        off: list[str] = []
        place.log.addFilter(lambda record: off.append(record.getMessage()) or True)
        place.wait_until(lambda: place.renderer.can_draw or bool(off), 'a renderer')
        if not place.renderer.can_draw:
            pytest.skip(off[0])
        yield place


def centre_of(color: Color, channel: int) -> tuple[float, float]:
    """Return the coordinates x, y of the middle of what has a colour."""
    others = np.delete(color, channel, axis=2).max(axis=2)
    y_px, x_px = np.nonzero(color[..., channel].astype(int) - others > 40)
    return float(x_px.mean()), float(y_px.mean())


def projected(point: tuple[float, float, float]) -> NDArray[np.float64]:
    """Return where a point of the world, seen from (0, 0, 1) along x, is in the picture."""
    x, y, z = point
    seen = PINHOLE.matrix @ (-y, 1.0 - z, x)
    return np.asarray(seen[:2] / seen[2])


def test_orientation_and_projection(place: Studio) -> None:
    """Things are where the pinhole projects them: left is left, and down is down."""
    color = place.picture().colors[0]
    assert centre_of(color, 0) == pytest.approx(projected((1.9, 0.5, 1.0)), abs=1.0)
    assert centre_of(color, 2) == pytest.approx(projected((1.9, 0.0, 0.4)), abs=1.0)
    assert centre_of(color, 1) == pytest.approx(projected((1.5, -0.5, 1.2)), abs=1.0)


def test_depth_is_along_the_axis(place: Studio) -> None:
    """A wall that the camera looks at squarely has the same depth everywhere."""
    depth = place.picture().depths[0]
    assert depth[5] == pytest.approx(2.0, abs=1e-3)
    assert depth[5, 0] == pytest.approx(depth[60, 80], abs=1e-3)
    assert depth.min() == pytest.approx(1.4, abs=0.01)


def test_collision_geoms_and_what_is_around_the_camera_are_not_seen(place: Studio) -> None:
    """Neither the geom that only collides nor the case of the camera hides the wall."""
    pictures = place.picture()
    assert pictures.depths[0][60, 80] == pytest.approx(2.0, abs=1e-3)
    red, green, blue = pictures.colors[0][60, 80].astype(int)
    assert abs(red - green) < 10 and abs(red - blue) < 10


def test_nothing_is_infinitely_far(place: Studio) -> None:
    """Where nothing is, the depth is infinite, and the colour that of the sky."""
    pictures = place.picture()
    assert np.all(np.isposinf(pictures.depths[1]))
    assert np.abs(pictures.colors[1].astype(int) - (51, 102, 153)).max() < 4


def test_newest_state(place: Studio) -> None:
    """A picture shows the state that was copied for it."""
    height = ball_address(place.model) + 2
    place.data.qpos[height] += 0.2
    try:
        color = place.picture().colors[0]
        assert centre_of(color, 1) == pytest.approx(projected((1.5, -0.5, 1.4)), abs=1.0)
    finally:
        place.data.qpos[height] -= 0.2


def test_only_what_is_wanted(place: Studio) -> None:
    """A picture that nobody wants is left as it was."""
    pictures = place.picture()
    before = pictures.depths[0].copy()
    height = ball_address(place.model) + 2
    place.data.qpos[height] += 0.2
    try:
        later = place.picture([Wanted(True, False), Wanted(False, False)])
        assert np.array_equal(later.depths[0], before)
    finally:
        place.data.qpos[height] -= 0.2


def test_points_are_those_of_the_depth(place: Studio) -> None:
    """Each pixel has its point in the optical frame, projected onto it, and NaN for the sky."""
    pictures = place.picture([Wanted(False, False, cloud=True)] * 2)
    cloud, depth = pictures.clouds[0], pictures.depths[0]
    assert cloud[5, 5, 2] == pytest.approx(2.0, abs=1e-3)
    assert np.array_equal(cloud[..., 2], depth)
    seen = cloud @ PINHOLE.matrix.T.astype(np.float32)
    x_px, y_px = np.meshgrid(np.arange(161), np.arange(121))
    assert np.allclose(seen[..., 0] / depth, x_px, atol=1e-3)
    assert np.allclose(seen[..., 1] / depth, y_px, atol=1e-3)
    assert np.isnan(pictures.clouds[1]).all()


def test_numbers_without_bounds(place: Studio) -> None:
    """A state that is not finite does not end the process that draws."""
    height = ball_address(place.model) + 2
    process = place.renderer.process_id
    place.data.qpos[height] = np.nan
    try:
        place.picture()
    finally:
        place.data.qpos[height] = 1.2
    assert place.picture().depths[0].min() == pytest.approx(1.4, abs=0.01)
    assert place.renderer.process_id == process


def test_rays_agree_with_opengl(place: Studio) -> None:
    """Apart from edges, depth differs by less than 1 cm, and colours hardly."""
    with studio(['rays'], VIEWS) as other:
        rays, drawn = other.picture(), place.picture()
    assert np.mean(_differs(rays.depths[0], drawn.depths[0], 0.01)) < 0.005
    assert np.mean(_differs(*_gray(rays, drawn), 30.0)) < 0.01


def _gray(one: Pictures, other: Pictures) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the colours of both as numbers that can be subtracted."""
    return one.colors[0].astype(int), other.colors[0].astype(int)


def _differs(
    one: Depth | NDArray[np.int64], other: Depth | NDArray[np.int64], limit: float
) -> NDArray[np.bool_]:
    """Tell where two pictures differ by more than the limit."""
    return np.asarray(np.abs(one - other) > limit)
