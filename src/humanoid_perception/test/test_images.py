# SPDX-License-Identifier: Apache-2.0
"""Test pictures and depth of image messages, and of intrinsics."""

from __future__ import annotations

from humanoid_perception.images import color_of, depth_of, ImageError
from humanoid_perception.lifting import camera_of, CameraInfoError, lift, PinholeCamera, surface_of
import numpy as np
import pytest
from sensor_msgs.msg import Image

CAMERA = PinholeCamera(320, 240, 200.0, 200.0, 160.0, 120.0)
K = (200.0, 0.0, 160.0, 0.0, 200.0, 120.0, 0.0, 0.0, 1.0)


def message(pixels: np.ndarray, encoding: str, padding: int = 0, **fields) -> Image:
    """Return an array as a message whose rows have some bytes more than they need."""
    rows = pixels.reshape(pixels.shape[0], -1)
    rows = np.pad(np.ascontiguousarray(rows).view(np.uint8), ((0, 0), (0, padding)))
    height, width = pixels.shape[:2]
    image = Image(height=height, width=width, encoding=encoding, step=rows.shape[1], **fields)
    image.data = rows.tobytes()
    return image


@pytest.mark.parametrize('padding', [0, 8])
@pytest.mark.parametrize(
    ('encoding', 'order'),
    [
        ('rgb8', [0, 1, 2]),
        ('bgr8', [2, 1, 0]),
        ('rgba8', [0, 1, 2, 0]),
        ('bgra8', [2, 1, 0, 0]),
        ('8UC3', [2, 1, 0]),
    ],
)
def test_pictures_of_each_encoding(encoding: str, order: list[int], padding: int):
    expected = np.random.default_rng(1).integers(0, 255, (5, 7, 3)).astype(np.uint8)
    sent = expected[..., order]
    assert (color_of(message(sent, encoding, padding)) == expected).all()


@pytest.mark.parametrize('encoding', ['mono8', '8UC1'])
def test_grey_pictures_have_three_channels(encoding: str):
    grey = np.arange(12, dtype=np.uint8).reshape(3, 4)
    assert (color_of(message(grey, encoding)) == grey[..., None]).all()


@pytest.mark.parametrize(
    ('changes', 'part'),
    [
        ({'encoding': 'yuv422'}, "encoding 'yuv422'"),
        ({'step': 3}, 'but step is 3'),
        ({'height': 100}, 'bytes, but has'),
        ({'width': 0}, '0 x 3 pixels'),
    ],
)
def test_wrong_pictures_are_refused(changes: dict, part: str):
    image = message(np.zeros((3, 4, 3), np.uint8), 'rgb8')
    for name, value in changes.items():
        setattr(image, name, value)
    with pytest.raises(ImageError, match=part):
        color_of(image)


def test_depth_in_metres_and_millimetres():
    metres = np.array([[0.5, 1.25, 3.0], [0.0, np.nan, -np.inf]], '<f4')
    expected = [[0.5, 1.25, 3.0], [np.nan, np.nan, np.nan]]
    np.testing.assert_allclose(depth_of(message(metres, '32FC1', 4)), expected)
    assert depth_of(message(np.array([[np.inf]], '<f4'), '32FC1')) == np.inf
    millimetres = np.array([[500, 1250, 3000], [0, 0, 0]], '<u2')
    np.testing.assert_allclose(depth_of(message(millimetres, '16UC1')), expected)
    swapped = message(millimetres.astype('>u2').view(np.uint16), '16UC1', is_bigendian=1)
    np.testing.assert_allclose(depth_of(swapped), expected)


def test_other_depth_is_refused():
    with pytest.raises(ImageError, match=r'32FC1 \(m\) or 16UC1 \(mm\)'):
        depth_of(message(np.zeros((3, 4), np.uint8), 'mono8'))


@pytest.mark.parametrize(
    ('k', 'size'),
    [
        ((0.0,) * 9, (320, 240)),
        ((np.nan, *K[1:]), (320, 240)),
        ((2.0, *K[1:]), (320, 240)),
        (K, (640, 480)),
        (K[:6], (320, 240)),
        ((*K[:2], 400.0, *K[3:]), (320, 240)),
    ],
)
def test_wrong_intrinsics_are_refused(k, size):
    with pytest.raises(CameraInfoError):
        camera_of(k, *size, (240, 320))


def test_a_ball_before_a_wall_is_where_it_is():
    depth_m = np.full((240, 320), 3.0, np.float32)
    u, v = np.meshgrid(np.arange(320), np.arange(240))
    rays = np.stack([(u - 160.0) / 200.0, (v - 120.0) / 200.0, np.ones_like(u)], axis=-1)
    centre, radius = np.array([0.2, 0.1, 1.5]), 0.1
    a, b = (rays**2).sum(-1), rays @ centre
    root = b**2 - a * (centre @ centre - radius**2)
    hit = root > 0
    depth_m[hit] = ((b - np.sqrt(np.where(hit, root, 0))) / a)[hit]
    box = (u[hit].min(), v[hit].min(), u[hit].max() + 1, v[hit].max() + 1)
    surface = surface_of(box, depth_m, CAMERA)
    assert surface is not None
    assert (surface.mask == hit).mean() > 0.999
    found = lift('ball', surface, CAMERA)
    assert found.centre_m == pytest.approx([1.5, -0.2, -0.1], abs=0.015)
    assert found.size_m == pytest.approx([0.2, 0.2, 0.2], abs=0.035)


@pytest.mark.parametrize('value', [np.nan, 0.0, np.inf])
def test_depth_without_measurements_gives_no_surface(value: float):
    depth_m = np.full((240, 320), value, np.float32)
    assert surface_of((100.0, 100.0, 130.0, 130.0), depth_m, CAMERA) is None


def test_a_box_beyond_the_picture_gives_no_surface():
    depth_m = np.ones((240, 320), np.float32)
    assert surface_of((400.0, 100.0, 430.0, 130.0), depth_m, CAMERA) is None
    assert surface_of((-50.0, 100.0, -20.0, 130.0), depth_m, CAMERA) is None
