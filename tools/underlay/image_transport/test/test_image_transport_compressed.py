# SPDX-License-Identifier: Apache-2.0
"""The transport `compressed`: formats, losses, and what is refused."""

from __future__ import annotations

import io

from image_transport import CompressedSettings, decode_compressed, encode_compressed
import numpy as np
from PIL import Image as Pillow
import pytest
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import Header

PNG = CompressedSettings(format='png')
RED = {'rgb8': [250, 20, 10], 'bgr8': [10, 20, 250], '8UC3': [10, 20, 250]}
RED |= {'rgba8': [*RED['rgb8'], 255], 'bgra8': [*RED['bgr8'], 255]}


def image(encoding, rows, kind=np.uint8, padding=0):
    """Return an image whose rows are followed by some bytes."""
    pixels = np.asarray(rows, kind)
    height, width = pixels.shape[:2]
    flat = np.frombuffer(pixels.tobytes(), np.uint8).reshape(height, -1)
    flat = np.pad(flat, ((0, 0), (0, padding)), constant_values=77)
    return Image(
        header=Header(frame_id='camera'),
        encoding=encoding,
        height=height,
        width=width,
        step=flat.shape[1],
        data=flat.tobytes(),
    )


def noise(*shape, kind=np.uint8):
    """Return random pixels."""
    return np.random.default_rng(1).integers(0, np.iinfo(kind).max, shape, kind)


@pytest.mark.parametrize(
    ('encoding', 'shape', 'kind'),
    [
        *((name, (5, 7, 3), np.uint8) for name in ('rgb8', 'bgr8', '8UC3')),
        *((name, (5, 7), np.uint8) for name in ('mono8', '8UC1')),
        *((name, (5, 7), np.uint16) for name in ('mono16', '16UC1')),
    ],
)
@pytest.mark.parametrize('padding', [0, 3])
def test_png_loses_nothing(encoding, shape, kind, padding):
    """An image comes back as it was, without what was between its rows."""
    pixels = noise(*shape, kind=kind)
    message = encode_compressed(image(encoding, pixels, kind, padding), PNG)
    assert decode_compressed(message) == image(encoding, pixels, kind)


def test_png_of_alpha_and_of_other_machines():
    """Alpha becomes opaque, and numbers of big-endian machines are read as such."""
    pixels = noise(2, 3, 4)
    opaque = pixels.copy()
    opaque[:, :, 3] = 255
    for encoding in ('rgba8', 'bgra8'):
        message = encode_compressed(image(encoding, pixels), PNG)
        assert decode_compressed(message) == image(encoding, opaque)
    big = image('mono16', [[1, 258]], '>u2')
    big.is_bigendian = 1
    back = decode_compressed(encode_compressed(big, PNG))
    assert back == image('mono16', [[1, 258]], '<u2')


@pytest.mark.parametrize('encoding', sorted(RED))
def test_jpeg_keeps_colours(encoding):
    """Red is red for decoders that know nothing of ROS, and in the encoding that comes back."""
    message = encode_compressed(
        image(encoding, np.full((16, 16, len(RED[encoding])), RED[encoding]))
    )
    with Pillow.open(io.BytesIO(bytes(message.data))) as opened:
        assert opened.format == 'JPEG'
        assert np.asarray(opened)[8, 8].tolist() == pytest.approx(RED['rgb8'], abs=4)
    back = decode_compressed(message)
    assert back.encoding == encoding
    assert back.header.frame_id == 'camera'
    assert list(back.data[: len(RED[encoding])]) == pytest.approx(RED[encoding], abs=4)


def test_error_and_size_of_jpeg():
    """A smooth image keeps within 3 of 255 at 95 %, and is smaller and worse at 20 %."""
    ramp = np.linspace(0, 255, 64 * 64).reshape(64, 64)
    pixels = np.stack([ramp, ramp.T, ramp[::-1]], axis=2).astype(np.uint8)
    sizes, errors = [], []
    for quality in (20, 95):
        message = encode_compressed(image('rgb8', pixels), CompressedSettings('jpeg', quality))
        shown = np.frombuffer(decode_compressed(message).data, np.uint8).reshape(pixels.shape)
        sizes.append(len(message.data))
        errors.append(float(np.abs(shown.astype(int) - pixels).mean()))
    assert errors[1] < 3.0 < pixels.nbytes / sizes[1]
    assert errors[0] > errors[1]
    assert sizes[0] < sizes[1]


@pytest.mark.parametrize(
    ('encoding', 'shape', 'form', 'expected'),
    [
        ('rgb8', (1, 1, 3), 'jpeg', 'rgb8; jpeg compressed bgr8'),
        ('bgra8', (1, 1, 4), 'png', 'bgra8; png compressed bgr8'),
        ('mono8', (1, 1), 'jpeg', 'mono8; jpeg compressed '),
        ('16UC1', (1, 1), 'png', '16UC1; png compressed '),
    ],
)
def test_formats(encoding, shape, form, expected):
    """The format names the encoding before and, for colours, after compression."""
    kind = np.uint16 if encoding == '16UC1' else np.uint8
    message = encode_compressed(
        image(encoding, np.zeros(shape), kind), CompressedSettings(format=form)
    )
    assert message.format == expected


@pytest.mark.parametrize(
    ('pixels', 'format_text', 'expected'),
    [
        (np.full((1, 1, 3), (1, 2, 3)), 'png', ('bgr8', [3, 2, 1])),
        (np.full((1, 1, 3), (1, 2, 3)), '', ('bgr8', [3, 2, 1])),
        (np.full((1, 1, 3), (1, 2, 3)), 'rgb8; png compressed ', ('rgb8', [1, 2, 3])),
        (np.full((1, 1, 3), (100, 100, 100)), 'mono8; png compressed bgr8', ('mono8', [100])),
        (np.full((1, 1), 7), 'bayer_rggb8; png compressed', ('mono8', [7])),
        (np.full((1, 1), 7), 'rgb8; png compressed ', ('rgb8', [7, 7, 7])),
        (np.full((1, 1), 7), 'mono16; png compressed ', ('mono8', [7])),
    ],
)
def test_images_of_others(pixels, format_text, expected):
    """Formats that say less, or something else than the data, are understood."""
    stream = io.BytesIO()
    Pillow.fromarray(pixels.astype(np.uint8)).save(stream, 'PNG')
    back = decode_compressed(CompressedImage(format=format_text, data=stream.getvalue()))
    assert (back.encoding, list(back.data)) == expected


@pytest.mark.parametrize(
    ('message', 'settings', 'reason'),
    [
        (image('16UC1', [[1]], np.uint16), CompressedSettings(), 'Set the format to png, or use'),
        (image('32FC1', [[1]], np.float32), PNG, "Use the transport 'compressedDepth'"),
        (image('yuv422_yuy2', [[1, 2]]), PNG, 'png, which takes rgb8, .* Configure the camera'),
        (Image(encoding='mono8', width=2, height=2, step=2, data=b'abc'), PNG, 'has 3 bytes'),
        (Image(encoding='mono8'), PNG, '0 x 0'),
    ],
)
def test_refused_images(message, settings, reason):
    """What cannot be compressed is refused with advice."""
    with pytest.raises(ValueError, match=reason):
        encode_compressed(message, settings)


def test_broken_data():
    """What is no image, or only its beginning, is refused."""
    whole = encode_compressed(image('mono8', noise(64, 64)), PNG)
    for data, reason in ((b'', '0 bytes of data are no JPEG'), (whole.data[:99], 'broken')):
        with pytest.raises(ValueError, match=reason):
            decode_compressed(CompressedImage(data=data))
