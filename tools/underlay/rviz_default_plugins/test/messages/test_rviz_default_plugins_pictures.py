# SPDX-License-Identifier: Apache-2.0
"""Pictures of messages, and of maps."""

import io
from types import SimpleNamespace

from image_transport import encode_compressed_depth
from nav_msgs.msg import OccupancyGrid
import numpy as np
from PIL import Image as Pillow
import pytest
from rviz_default_plugins.decoding.images import (
    Brightness,
    decode_compressed_image,
    decode_image,
    MOST_PIXELS,
)
from rviz_default_plugins.decoding.occupancy import apply_update, binary, cells_of, png_of, thinned
from sensor_msgs.msg import CompressedImage, Image


def image(encoding, values, width=1, height=1, step=None, kind='u1', is_bigendian=0):
    """Return an image of numbers."""
    data = np.array(values, kind).tobytes()
    step = len(data) // height if step is None else step
    return Image(
        encoding=encoding,
        width=width,
        height=height,
        step=step,
        data=data,
        is_bigendian=is_bigendian,
    )


def pixels(message, brightness=None):
    """Return the pixels of an image as lists."""
    return decode_image(message, brightness or Brightness()).pixels.tolist()


@pytest.mark.parametrize(
    ('encoding', 'values', 'expected'),
    [
        ('rgb8', [1, 2, 3], [1, 2, 3]),
        ('bgr8', [1, 2, 3], [3, 2, 1]),
        ('rgba8', [1, 2, 3, 4], [1, 2, 3]),
        ('bgra8', [1, 2, 3, 4], [3, 2, 1]),
        ('8UC3', [1, 2, 3], [3, 2, 1]),
        ('8UC4', [1, 2, 3, 4], [3, 2, 1]),
        ('mono8', [9], [9, 9, 9]),
        ('8UC1', [9], [9, 9, 9]),
    ],
)
def test_pixels_of_bytes(encoding, values, expected):
    """Red, green and blue come in their order, whatever the encoding has."""
    assert pixels(image(encoding, values)) == [[expected]]


@pytest.mark.parametrize(('kind', 'is_bigendian'), [('<u2', 0), ('>u2', 1)])
def test_pixels_of_sixteen_bits(kind, is_bigendian):
    """Of 16 bits the upper eight are shown, with either byte first."""
    values = [0x0100, 0x0200, 0xFF00]
    message = image('rgb16', values, kind=kind, is_bigendian=is_bigendian)
    assert pixels(message) == [[[1, 2, 255]]]
    message = image('bgr16', values, kind=kind, is_bigendian=is_bigendian)
    assert pixels(message) == [[[255, 2, 1]]]


@pytest.mark.parametrize(
    ('encoding', 'kind', 'values'),
    [
        ('mono16', '<u2', [1000, 2000, 3000]),
        ('16UC1', '<u2', [1000, 2000, 3000]),
        ('16SC1', '<i2', [-1000, 0, 1000]),
        ('32FC1', '<f4', [0.5, 1.0, 1.5]),
        ('64FC1', '<f8', [0.5, 1.0, 1.5]),
    ],
)
def test_depths_are_shown_between_their_limits(encoding, kind, values):
    """The least number is black, the greatest white."""
    shown = pixels(image(encoding, values, 3, kind=kind))
    assert [gray for gray, _, _ in shown[0]] == [0, 127, 255]


def test_depths_that_are_not_finite_are_black():
    """Depths of a camera have holes, which must not change the limits."""
    values = [1.0, float('nan'), float('inf'), 3.0]
    shown = pixels(image('32FC1', values, 4, kind='<f4'))
    assert [gray for gray, _, _ in shown[0]] == [0, 0, 0, 255]
    assert pixels(image('32FC1', [float('nan')], kind='<f4')) == [[[0, 0, 0]]]


def test_fixed_limits_of_depths():
    """With fixed limits what is beyond them is black or white."""
    message = image('16UC1', [0, 1000, 3000, 9000], 4, kind='<u2')
    shown = pixels(message, Brightness((1000.0, 5000.0)))
    assert [gray for gray, _, _ in shown[0]] == [0, 0, 127, 255]


def test_limits_are_medians_of_the_last_pictures():
    """One picture with a far point does not darken the others."""
    brightness = Brightness(window=3)
    for most in (100, 100, 10000):
        brightness.apply(np.array([0, most], np.uint16))
    assert brightness.apply(np.array([0, 100], np.uint16)).tolist() == [0, 255]


@pytest.mark.parametrize(
    ('encoding', 'values'),
    [('yuv422', [128, 235, 128, 16]), ('yuv422_yuy2', [235, 128, 16, 128])],
)
def test_yuv(encoding, values):
    """White and black have the same two colour numbers."""
    assert pixels(image(encoding, values, 2)) == [[[255, 255, 255], [0, 0, 0]]]


def test_yuv_red():
    """A red of BT.601 is red."""
    red, green, blue = pixels(image('uyvy', [90, 81, 240, 81], 2))[0][0]
    assert red > 250
    assert green < 5
    assert blue < 5


@pytest.mark.parametrize('order', ['rggb', 'bggr', 'gbrg', 'grbg'])
def test_bayer(order):
    """Each square of four becomes a pixel of its three colours."""
    color = {'r': 200, 'g': 100, 'b': 50}
    row = [color[letter] for letter in order[:2]] * 2
    below = [color[letter] for letter in order[2:]] * 2
    picture = decode_image(image(f'bayer_{order}8', row + below, 4, 2), Brightness())
    assert picture.pixels.tolist() == [[[200, 100, 50]] * 2]
    assert picture.step == 1


def test_rows_with_padding():
    """A row may have more bytes than its pixels."""
    message = image('mono8', [1, 2, 0, 0, 3, 4, 0, 0], 2, 2, step=4)
    assert [[gray for gray, _, _ in row] for row in pixels(message)] == [[1, 2], [3, 4]]


def test_great_pictures_are_made_smaller():
    """A picture of 3840 x 2160 is shown three times smaller."""
    message = image('rgb8', np.zeros(3840 * 2160 * 3), 3840, 2160)
    picture = decode_image(message, Brightness())
    assert picture.pixels.shape == (720, 1280, 3)
    assert picture.step == 3
    assert 720 * 1280 <= MOST_PIXELS


@pytest.mark.parametrize(
    ('message', 'reason'),
    [
        (Image(), "encoding '' is not supported"),
        (image('h264', [1]), "encoding 'h264' is not supported; supported are rgb8"),
        (Image(encoding='rgb8'), 'no pixels: it is 0 wide and 0 high'),
        (image('rgb8', [1, 2, 3], 2), 'rows of 3 bytes are too short for 2 pixels'),
        (image('rgb8', [1, 2, 3], 1, 2, step=3), '3 bytes of data, but 2 rows of 3 bytes'),
        (image('bayer_rggb8', [1]), 'too small for a Bayer pattern'),
        (image('yuv422', [1, 2]), 'one pixel wide'),
    ],
)
def test_broken_images_are_refused(message, reason):
    """What is wrong with an image is said."""
    with pytest.raises(ValueError, match=reason):
        decode_image(message, Brightness())


def compressed(array, kind, format_text=''):
    """Return a compressed image."""
    packed = io.BytesIO()
    Pillow.fromarray(array).save(packed, kind)
    return CompressedImage(format=format_text or kind.lower(), data=packed.getvalue())


@pytest.mark.parametrize('kind', ['PNG', 'JPEG'])
def test_compressed_images(kind):
    """JPEG and PNG are unpacked."""
    array = np.full((4, 6, 3), (200, 100, 50), np.uint8)
    picture = decode_compressed_image(compressed(array, kind), Brightness())
    assert picture.pixels.shape == (4, 6, 3)
    assert picture.pixels[0, 0] == pytest.approx([200, 100, 50], abs=4)


def test_compressed_gray_and_depth():
    """A PNG of one channel is gray; one of 16 bits is shown between its limits."""
    gray = decode_compressed_image(compressed(np.array([[7]], np.uint8), 'PNG'), Brightness())
    assert gray.pixels.tolist() == [[[7, 7, 7]]]
    depth = compressed(np.array([[500, 1500]], np.uint16), 'PNG')
    shown = decode_compressed_image(depth, Brightness()).pixels
    assert shown[0, :, 0].tolist() == [0, 255]


def test_compressed_depth():
    """Compressed depths are shown as raw ones are; what was not measured is black."""
    metres = image('32FC1', [1.0, 3.0, float('nan')], 3, kind='<f4')
    picture = decode_compressed_image(encode_compressed_depth(metres), Brightness((0.0, 4.0)))
    assert picture.pixels[0, :, 0].tolist() == [63, 191, 0]


@pytest.mark.parametrize('kind', ['PNG', 'JPEG'])
def test_great_compressed_images_are_made_smaller(kind):
    """A compressed picture of 3840 x 2160 is shown three times smaller, too."""
    message = compressed(np.zeros((2160, 3840, 3), np.uint8), kind)
    picture = decode_compressed_image(message, Brightness())
    assert picture.step == 3
    assert picture.pixels.shape[0] * picture.pixels.shape[1] <= MOST_PIXELS


def test_broken_compressed_images_are_refused():
    """What is no picture, is cut off, is immense or an unknown kind of depth is refused."""
    whole = compressed(np.random.default_rng(1).integers(0, 255, (64, 64, 3), np.uint8), 'PNG')
    for data, format_text, reason in (
        (b'', 'jpeg', '0 bytes'),
        (b'hello', 'jpeg', 'neither a JPEG nor a PNG'),
        (bytes(whole.data)[:500], 'png', 'broken'),
        (b'', '16UC1; compressedDepth rvl', "'16UC1; compressedDepth rvl' is not supported"),
        (immense_png(), 'png', '(too large|broken)'),
    ):
        with pytest.raises(ValueError, match=reason):
            decode_compressed_image(CompressedImage(format=format_text, data=data), Brightness())


def immense_png():
    """Return the beginning of a PNG that says that it has 50000 x 50000 pixels."""
    packed = bytearray(compressed(np.zeros((1, 1, 3), np.uint8), 'PNG').data)
    packed[16:24] = (50000).to_bytes(4, 'big') * 2
    packed[29:33] = __import__('zlib').crc32(bytes(packed[12:29])).to_bytes(4, 'big')
    return bytes(packed)


def grid(rows, resolution=0.1):
    """Return a map whose first row has the smallest y."""
    message = OccupancyGrid(data=[value for row in rows for value in row])
    message.info.resolution = resolution
    message.info.height, message.info.width = len(rows), len(rows[0]) if rows else 0
    return message


def test_cells_of_a_map():
    """Cells are rows of signed numbers."""
    assert cells_of(grid([[0, 100], [-1, 50]])).tolist() == [[0, 100], [-1, 50]]


def test_broken_maps_are_refused():
    """A map without cells, with too few of them or with cells of no size is refused."""
    with pytest.raises(ValueError, match='no cells: it is 0 wide'):
        cells_of(grid([]))
    wrong = grid([[0, 1]])
    wrong.data = [0]
    with pytest.raises(ValueError, match='1 cells, but is 2 wide and 1 high, which needs 2'):
        cells_of(wrong)
    for resolution in (0.0, -1.0, float('nan'), float('inf')):
        with pytest.raises(ValueError, match='m long'):
            cells_of(grid([[0]], resolution))


@pytest.mark.parametrize(
    ('scheme', 'value', 'expected'),
    [
        ('map', 0, [255, 255, 255, 255]),
        ('map', 100, [0, 0, 0, 255]),
        ('map', 50, [128, 128, 128, 255]),
        ('map', -1, [112, 137, 134, 255]),
        ('map', 120, [0, 255, 0, 255]),
        ('map', -128, [255, 0, 0, 255]),
        ('map', -2, [255, 255, 0, 255]),
        ('costmap', 0, [0, 0, 0, 0]),
        ('costmap', 1, [2, 0, 253, 255]),
        ('costmap', 98, [249, 0, 6, 255]),
        ('costmap', 99, [0, 255, 255, 255]),
        ('costmap', 100, [255, 0, 255, 255]),
        ('costmap', -1, [112, 137, 134, 255]),
        ('raw', 77, [77, 77, 77, 255]),
        ('raw', -1, [255, 255, 255, 255]),
    ],
)
def test_colors_of_cells(scheme, value, expected):
    """Each value has the colour that it has in RViz."""
    assert painted(np.array([[value]], np.int8), scheme, 1.0).tolist() == [[expected]]


def painted(cells, scheme, alpha):
    """Return the pixels of a map."""
    return np.asarray(Pillow.open(io.BytesIO(png_of(cells, scheme, alpha))).convert('RGBA'))


def test_alpha_and_order_of_a_painted_map():
    """Alpha counts for all colours, and does not stay; the first row stays the first."""
    cells = np.array([[0], [100]], np.int8)
    picture = painted(cells, 'map', 0.5)
    assert picture[:, 0, 0].tolist() == [255, 0]
    assert picture[:, 0, 3].tolist() == [128, 128]
    assert painted(cells, 'map', 1.0)[0, 0, 3] == 255


def test_binary_map():
    """Cells are occupied from the threshold on; what is unknown stays so."""
    cells = np.array([[-1, 0, 49, 50, 100]], np.int8)
    assert binary(cells, 50).tolist() == [[-1, 0, 0, 100, 100]]


def test_thinned_map_keeps_what_is_occupied():
    """A cell for each block has the greatest value in it, also at the edges."""
    cells = np.full((3, 5), -1, np.int8)
    cells[0, 1], cells[2, 4] = 100, 0
    small, step = thinned(cells, 3)
    assert step == 2
    assert small.tolist() == [[100, -1, -1], [-1, -1, 0]]
    assert thinned(cells, 5) == (pytest.approx(cells), 1)


def update_of(x, y, width, height, data):
    """Return an update, as map_msgs has it."""
    return SimpleNamespace(x=x, y=y, width=width, height=height, data=data)


def test_updates_of_a_map():
    """An update replaces its rectangle; one that is not inside, or has too few cells, does not."""
    cells = np.zeros((2, 3), np.int8)
    apply_update(cells, update_of(1, 0, 2, 2, [1, 2, 3, 4]))
    assert cells.tolist() == [[0, 1, 2], [0, 3, 4]]
    with pytest.raises(ValueError, match='2 x 1 cells at 2, 0 is not inside the map of 3 x 2'):
        apply_update(cells, update_of(2, 0, 2, 1, [1, 2]))
    with pytest.raises(ValueError, match='1 cells'):
        apply_update(cells, update_of(0, 0, 2, 1, [1]))
    assert cells.tolist() == [[0, 1, 2], [0, 3, 4]]
