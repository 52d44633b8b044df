# SPDX-License-Identifier: Apache-2.0
"""
Measure what images of the robot's camera take of a network, raw and compressed, without ROS.

Each row has the size of one image, the Mbit/s at the given rate, the rate that fits into a link,
and the CPU time of compressing and decompressing one image.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

from arguments import in_range
from image_transport import (
    CompressedSettings,
    decode_compressed,
    decode_compressed_depth,
    encode_compressed,
    encode_compressed_depth,
)
from image_transport.pixels import image_of
from measuring import median_of
from perception import cost_ms, rendered_view
from std_msgs.msg import Header

WIDTH_PX, HEIGHT_PX = 640, 480
QUALITIES = (95, 80, 50, 30)

Row = tuple[str, Any, Callable[[], Any] | None, Callable[[], Any] | None]


def main() -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=in_range(int, 1), default=20, help='runs of each row')
    parser.add_argument('--rate', type=in_range(float, 0.1), default=30.0, help='images a second')
    parser.add_argument('--link', type=in_range(float, 0.1), default=20.0, help='Mbit/s')
    given = parser.parse_args()
    print(f'{WIDTH_PX} x {HEIGHT_PX} at {given.rate:g} Hz, median of {given.runs} runs')
    link = f'Hz at {given.link:g} Mbit/s'
    print(f'{"KB":>7} {"Mbit/s":>8} {link:>16} {"encode ms":>10} {"decode ms":>10}  what')
    for what, message, encode, decode in rows():
        bits = 8 * len(message.data)
        times = [
            f'{median_of(partial(cost_ms, each), given.runs):10.1f}' if each else f'{"-":>10}'
            for each in (encode, decode)
        ]
        print(
            f'{bits / 8e3:7.1f} {bits * given.rate / 1e6:8.1f} {given.link * 1e6 / bits:16.1f} '
            f'{times[0]} {times[1]}  {what}',
            flush=True,
        )


def rows() -> Iterator[Row]:
    """Yield a name, a message, and what compresses and decompresses it."""
    colors, depths_m, _ = rendered_view(WIDTH_PX, HEIGHT_PX)
    color = image_of(colors, 'rgb8', Header())
    depth = image_of(depths_m, '32FC1', Header())
    yield 'raw, rgb8', color, None, None
    for quality in QUALITIES:
        settings = CompressedSettings(jpeg_quality=quality)
        yield (f'compressed, jpeg {quality}', *_compressed(color, settings))
    yield ('compressed, png 3', *_compressed(color, CompressedSettings(format='png')))
    yield 'raw, 32FC1', depth, None, None
    encode = partial(encode_compressed_depth, depth)
    message = encode()
    yield 'compressedDepth', message, encode, partial(decode_compressed_depth, message)


def _compressed(color: Any, settings: CompressedSettings) -> tuple[Any, Any, Any]:
    encode = partial(encode_compressed, color, settings)
    message = encode()
    return message, encode, partial(decode_compressed, message)


if __name__ == '__main__':
    main()
