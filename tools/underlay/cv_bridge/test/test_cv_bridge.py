# SPDX-License-Identifier: Apache-2.0
"""Images between messages and arrays of OpenCV."""

from __future__ import annotations

import subprocess
import sys

import cv2
from cv_bridge import CvBridge, CvBridgeError
import numpy as np
import pytest
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import Header

BRIDGE = CvBridge()
RED_GREEN = np.array([[[255, 0, 0], [0, 255, 0]]], np.uint8)
KINDS = {'8U': 'u1', '8S': 'i1', '16U': 'u2', '16S': 'i2', '32S': 'i4', '32F': 'f4', '64F': 'f8'}
# Passthrough must not import OpenCV, whose import takes longer than that of rclpy.
WITHOUT_OPENCV = """\
import sys
sys.modules['cv2'] = None
import numpy as np
from cv_bridge import CvBridge
bridge = CvBridge()
image = bridge.cv2_to_imgmsg(np.ones((2, 3), np.uint16), 'mono16')
print(bridge.imgmsg_to_cv2(image).tolist(), bridge.imgmsg_to_cv2(image, '32FC1').dtype)
print(bridge.imgmsg_to_cv2(image, 'mono8').dtype, bridge.encoding_to_dtype_with_channels('bgr8'))
try:
    bridge.imgmsg_to_cv2(image, 'bgr8')
except ImportError as error:
    print(error)
"""


def image(pixels: np.ndarray, encoding: str) -> Image:
    """Return a message with some pixels."""
    return BRIDGE.cv2_to_imgmsg(pixels, encoding)


@pytest.mark.parametrize('channels', [1, 2, 3, 4])
@pytest.mark.parametrize('name', KINDS)
def test_numbers_of_all_types_come_back(name: str, channels: int) -> None:
    """An array becomes a message of its own type, and the same array again."""
    shape = (3, 5) if channels == 1 else (3, 5, channels)
    pixels = np.arange(np.prod(shape)).reshape(shape).astype(KINDS[name])
    message = BRIDGE.cv2_to_imgmsg(pixels, header=Header(frame_id='camera'))
    assert message.encoding == f'{name}C{channels}'
    assert (message.width, message.height) == (5, 3)
    assert message.step == 5 * channels * pixels.itemsize
    assert message.header.frame_id == 'camera'
    back = BRIDGE.imgmsg_to_cv2(message)
    assert back.dtype == pixels.dtype
    assert back.tolist() == pixels.tolist()
    assert BRIDGE.imgmsg_to_cv2(message, message.encoding).tolist() == pixels.tolist()


def test_rows_with_padding_and_the_other_byte_order() -> None:
    """Padding is left out; numbers are right in either byte order."""
    message = Image(width=2, height=2, encoding='16UC1', step=6, is_bigendian=1)
    message.data = bytes([1, 2, 0, 3, 9, 9, 0, 4, 0, 5])
    pixels = BRIDGE.imgmsg_to_cv2(message)
    assert pixels.tolist() == [[258, 3], [4, 5]]
    assert pixels.dtype.isnative
    big = BRIDGE.cv2_to_imgmsg(pixels.astype('>u2'))
    assert big.is_bigendian
    assert bytes(big.data[:2]) == b'\x01\x02'
    assert not BRIDGE.cv2_to_imgmsg(pixels).is_bigendian


def test_passthrough_shares_memory_and_a_named_encoding_does_not() -> None:
    """What is drawn on the array of a passed through image is in the message."""
    message = image(RED_GREEN, 'rgb8')
    BRIDGE.imgmsg_to_cv2(message, 'rgb8')[:] = 7
    assert message.data[0] == 255
    BRIDGE.imgmsg_to_cv2(message)[:] = 7
    assert set(message.data) == {7}


@pytest.mark.parametrize(
    ('encoding', 'expected'),
    [
        ('rgb8', [[255, 0, 0], [0, 255, 0]]),
        ('bgr8', [[0, 0, 255], [0, 255, 0]]),
        ('rgba8', [[255, 0, 0, 255], [0, 255, 0, 255]]),
        ('bgra8', [[0, 0, 255, 255], [0, 255, 0, 255]]),
        ('mono8', [76, 150]),
        ('bgr16', [[0, 0, 65535], [0, 65535, 0]]),
        ('mono16', [76 * 257, 150 * 257]),
        ('8UC3', [[255, 0, 0], [0, 255, 0]]),
        ('32FC3', [[255.0, 0.0, 0.0], [0.0, 255.0, 0.0]]),
    ],
)
def test_colours_in_other_encodings(encoding: str, expected: list[object]) -> None:
    """Colours change their order, alpha is opaque, and white stays white with more bits."""
    found = BRIDGE.imgmsg_to_cv2(image(RED_GREEN, 'rgb8'), desired_encoding=encoding)
    assert found.tolist() == [expected]
    assert (found.dtype.name, 1 if found.ndim == 2 else found.shape[2]) == (
        BRIDGE.encoding_to_dtype_with_channels(encoding)
    )


@pytest.mark.parametrize('pattern', ['rggb', 'bggr', 'gbrg', 'grbg'])
@pytest.mark.parametrize('bits', [8, 16])
def test_bayer_patterns(pattern: str, bits: int) -> None:
    """A red surface seen through any pattern is red."""
    pixels = np.zeros((8, 8), f'u{bits // 8}')
    place = pattern.index('r')
    pixels[place // 2 :: 2, place % 2 :: 2] = 200
    found = BRIDGE.imgmsg_to_cv2(image(pixels, f'bayer_{pattern}{bits}'), f'bgr{bits}')
    assert found[2:6, 2:6].reshape(-1, 3).tolist() == [[0, 0, 200]] * 16
    raw = BRIDGE.imgmsg_to_cv2(image(pixels, f'bayer_{pattern}{bits}'))
    assert raw.tolist() == pixels.tolist()


@pytest.mark.parametrize(
    ('encoding', 'quad'),
    [
        ('yuv422', (90, 82, 240, 82)),
        ('yuv422_yuy2', (82, 90, 82, 240)),
        ('uyvy', (90, 82, 240, 82)),
    ],
)
def test_yuv(encoding: str, quad: tuple[int, ...]) -> None:
    """Red in YUV is red, and bright by its first component."""
    message = image(np.array(quad, np.uint8).reshape(1, 2, 2), encoding)
    red = BRIDGE.imgmsg_to_cv2(message, 'rgb8')[0, 0].astype(int)
    assert red == pytest.approx([255, 0, 0], abs=3)
    assert BRIDGE.imgmsg_to_cv2(message, 'mono8').tolist() == [[82, 82]]
    assert BRIDGE.imgmsg_to_cv2(message).shape == (1, 2, 2)


def test_depths_change_their_type_only() -> None:
    """Depths in mm become floating point numbers in mm, and back by rounding to what fits."""
    depths = np.array([[0, 1500, 65535]], np.uint16)
    floats = BRIDGE.imgmsg_to_cv2(image(depths, '16UC1'), '32FC1')
    assert floats.dtype == np.float32
    assert floats.tolist() == [[0.0, 1500.0, 65535.0]]
    broken = np.array([[np.nan, -3.0, 1.6, 1e9]], np.float32)
    assert BRIDGE.imgmsg_to_cv2(image(broken, '32FC1'), '16UC1').tolist() == [[0, 0, 2, 65535]]


@pytest.mark.parametrize(
    ('source', 'target', 'message'),
    [
        ('16UC1', 'mono8', "numbers of '16UC1' have no meaning as colours"),
        ('8UC3', 'bgr8', "cannot become 'bgr8'"),
        ('rgb8', '8UC1', "'rgb8' has 3 channels and '8UC1' 1"),
        ('rgb8', 'bayer_rggb8', "no conversion from 'rgb8' to 'bayer_rggb8'"),
        ('rgb8', 'jpeg', "encoding 'jpeg' is not supported; supported are rgb8"),
    ],
)
def test_conversions_that_do_not_exist(source: str, target: str, message: str) -> None:
    """They are errors that say why."""
    name, channels = BRIDGE.encoding_to_dtype_with_channels(source)
    shape = (2, 2) if channels == 1 else (2, 2, channels)
    with pytest.raises(CvBridgeError, match=message):
        BRIDGE.imgmsg_to_cv2(image(np.zeros(shape, name), source), target)


def test_broken_messages_and_arrays() -> None:
    """Data that are too short, wrong types and shapes are errors, as is another encoding."""
    with pytest.raises(CvBridgeError, match='its size and its data do not match'):
        BRIDGE.imgmsg_to_cv2(Image(width=4, height=4, encoding='mono8', step=4))
    with pytest.raises(CvBridgeError, match="'bgr8' is an array of 8UC3, but this one is of 8UC1"):
        BRIDGE.cv2_to_imgmsg(np.zeros((2, 2), np.uint8), 'bgr8')
    with pytest.raises(TypeError, match='array of NumPy'):
        BRIDGE.cv2_to_imgmsg([[0]])  # type: ignore[arg-type]
    with pytest.raises(CvBridgeError, match=r'has the shape \(4,\)'):
        BRIDGE.cv2_to_imgmsg(np.zeros(4, np.uint8))
    with pytest.raises(CvBridgeError, match='cannot have values of type int64: .* astype'):
        BRIDGE.cv2_to_imgmsg(np.zeros((2, 2), np.int64))


def test_compressed_images() -> None:
    """PNG keeps the pixels, also with 16 bits, and JPEG about; colours can be converted."""
    smooth = np.dstack([np.tile(np.arange(0, 64, 2, np.uint8), (32, 1))] * 3) + np.uint8(50)
    message = BRIDGE.cv2_to_compressed_imgmsg(smooth, 'png')
    assert message.format == 'png'
    assert BRIDGE.compressed_imgmsg_to_cv2(message).tolist() == smooth.tolist()
    assert BRIDGE.compressed_imgmsg_to_cv2(message, 'mono8').shape == (32, 32)
    jpeg = BRIDGE.compressed_imgmsg_to_cv2(BRIDGE.cv2_to_compressed_imgmsg(smooth), 'bgr8')
    assert jpeg.astype(float) == pytest.approx(smooth.astype(float), abs=4)
    depths = np.array([[0, 65535], [1, 2]], np.uint16)
    packed = BRIDGE.cv2_to_compressed_imgmsg(depths, dst_format='png')
    assert BRIDGE.compressed_imgmsg_to_cv2(packed).tolist() == depths.tolist()


def test_compressed_images_that_are_none() -> None:
    """Broken data and unknown formats are errors; compressed depths say how to read them."""
    for data in (b'', b'no picture'):
        with pytest.raises(CvBridgeError, match='no file that OpenCV can read'):
            BRIDGE.compressed_imgmsg_to_cv2(CompressedImage(format='jpeg', data=data))
    depth = CompressedImage(format='32FC1; compressedDepth png', data=b'123')
    with pytest.raises(CvBridgeError, match='ros2 run image_transport republish'):
        BRIDGE.compressed_imgmsg_to_cv2(depth)
    with pytest.raises(CvBridgeError, match="cannot write an image of 8UC1 as 'mp3'"):
        BRIDGE.cv2_to_compressed_imgmsg(np.zeros((2, 2), np.uint8), 'mp3')


def test_numbers_of_types_are_those_of_opencv() -> None:
    """Encodings have the numbers that the installed OpenCV gives to types."""
    assert BRIDGE.encoding_to_cvtype2('bgr8') == cv2.CV_8UC3
    assert BRIDGE.encoding_to_cvtype2('64FC4') == cv2.CV_64FC4
    assert BRIDGE.encoding_to_cvtype2('32FC1') == cv2.CV_32FC1
    assert BRIDGE.cvtype2_to_dtype_with_channels(cv2.CV_16SC2) == ('int16', 2)
    assert BRIDGE.dtype_with_channels_to_cvtype2(np.dtype('float32'), 4) == '32FC4'
    with pytest.raises(CvBridgeError, match='not an image type'):
        BRIDGE.cvtype2_to_dtype_with_channels(-5)


def test_without_opencv() -> None:
    """What needs no colours works without OpenCV; the rest says how to install it."""
    run = [sys.executable, '-c', WITHOUT_OPENCV]
    printed = subprocess.run(run, capture_output=True, text=True, check=True).stdout
    assert printed.splitlines()[:2] == [
        '[[1, 1, 1], [1, 1, 1]] float32',
        "uint8 ('uint8', 3)",
    ]
    assert 'OpenCV converts colours, and it is not installed: run `make setup`' in printed
