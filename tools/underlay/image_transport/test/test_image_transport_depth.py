# SPDX-License-Identifier: Apache-2.0
"""The transport `compressedDepth`: header, quantisation, and what is refused."""

from __future__ import annotations

import io
import struct

from image_transport import decode_compressed_depth, DepthSettings, encode_compressed_depth
import numpy as np
from PIL import Image as Pillow
import pytest
from sensor_msgs.msg import CompressedImage, Image


def depth(encoding, values):
    """Return a depth image of one row."""
    row = np.array([values], np.float32 if encoding == '32FC1' else np.uint16)
    return Image(
        encoding=encoding, height=1, width=len(values), step=row.nbytes, data=row.tobytes()
    )


def values_of(image):
    """Return the depths of an image."""
    return np.frombuffer(image.data, np.float32 if image.encoding == '32FC1' else np.uint16)


def stored(message):
    """Return the header of a message, and the numbers of its PNG."""
    data = bytes(message.data)
    with Pillow.open(io.BytesIO(data[12:])) as opened:
        assert opened.format == 'PNG'
        return struct.unpack('<iff', data[:12]), np.asarray(opened).ravel().tolist()


def test_layout_of_metres():
    """A = 100 * 101, B = 1 - A / 10 m, and A / depth + B is stored; 0 is what is not measured."""
    metres = [1.0, 2.0, 5.0, 10.0, 12.0, 0.0, -1.0, float('nan'), float('inf'), 0.01]
    message = encode_compressed_depth(depth('32FC1', metres))
    assert message.format == '32FC1; compressedDepth png'
    header, numbers = stored(message)
    assert header == (0, 10100.0, -1009.0)
    assert numbers == [9091, 4041, 1011, 0, 0, 0, 0, 0, 0, 65535]


def test_metres_come_back():
    """The error grows with the square of the depth: half a step of A / depth."""
    metres = np.linspace(0.2, 9.99, 200).astype(np.float32)
    back = values_of(decode_compressed_depth(encode_compressed_depth(depth('32FC1', metres))))
    assert np.all(np.abs(back - metres) <= 0.5 * metres**2 / 10100.0 * 1.01)
    assert np.abs(back - metres).max() > 0.001  # it is quantised
    unknown = depth('32FC1', [float('inf'), float('nan'), 11.0])
    assert np.isnan(values_of(decode_compressed_depth(encode_compressed_depth(unknown)))).all()


def test_parameters_of_the_quantisation():
    """A finer quantisation has a smaller error, and a larger range reaches farther."""
    fine = DepthSettings(depth_quantization=150.0, depth_max=50.0)
    message = encode_compressed_depth(depth('32FC1', [30.0]), fine)
    assert stored(message)[0] == (0, 150.0 * 151.0, 1.0 - 150.0 * 151.0 / 50.0)
    assert values_of(decode_compressed_depth(message)) == pytest.approx([30.0], abs=0.02)


def test_millimetres_lose_nothing():
    """Depths in mm are stored as they are; those beyond the largest depth are left out."""
    millimetres = [0, 1, 999, 10000, 10001, 65535]
    message = encode_compressed_depth(depth('16UC1', millimetres))
    assert message.format == '16UC1; compressedDepth png'
    assert stored(message) == ((0, 0.0, 0.0), [0, 1, 999, 10000, 0, 0])
    far = encode_compressed_depth(depth('16UC1', millimetres), DepthSettings(depth_max=100.0))
    assert values_of(decode_compressed_depth(far)).tolist() == millimetres


def test_the_format_of_older_publishers():
    """A format without the name of the codec means PNG."""
    message = encode_compressed_depth(depth('16UC1', [7]))
    message.format = '16UC1; compressedDepth'
    assert values_of(decode_compressed_depth(message)).tolist() == [7]


def test_colours_are_refused():
    """An image that is no depth is refused with advice."""
    with pytest.raises(ValueError, match="takes 16UC1 and 32FC1. Use the transport 'compressed'"):
        encode_compressed_depth(Image(encoding='rgb8'))


@pytest.mark.parametrize(
    ('format_text', 'data', 'reason'),
    [
        ('16UC1; compressedDepth rvl', b'', "'16UC1; compressedDepth rvl' is not supported"),
        ('rgb8; jpeg compressed bgr8', b'', 'not supported'),
        ('16UC1; compressedDepth png', b'short', '5 bytes of data are too few: the header'),
        ('16UC1; compressedDepth png', bytes(20), '8 bytes of data are no PNG'),
    ],
)
def test_broken_messages(format_text, data, reason):
    """What cannot be decompressed is refused."""
    with pytest.raises(ValueError, match=reason):
        decode_compressed_depth(CompressedImage(format=format_text, data=data))


def test_a_png_of_colours_is_refused():
    """The image after the header must have one channel of 16 bits."""
    stream = io.BytesIO()
    Pillow.fromarray(np.zeros((1, 1, 3), np.uint8)).save(stream, 'PNG')
    message = CompressedImage(
        format='16UC1; compressedDepth png', data=bytes(12) + stream.getvalue()
    )
    with pytest.raises(ValueError, match='one channel of 16 bits'):
        decode_compressed_depth(message)
