# SPDX-License-Identifier: Apache-2.0
"""Measure `rviz2`: what it costs to show moving robots to a browser.

`make bench ARGS='--runs 3'`. Robots of 23 joints send their transforms at 100 Hz. A client takes
all that a browser would get, and draws nothing; what a browser costs depends on its machine.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
import os
from pathlib import Path
import socket
from statistics import median
import sys
import tempfile
from threading import Thread
import time
from typing import Any, NamedTuple

from domain_coordinator import domain_id
from measuring import cpu_s, memory_mb, running
import msgspec
from rviz_robots import JOINTS
import viser
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect
import zstandard

COUNTS = (1, 3, 10)
RATES_HZ = (30, 60)
TF_HZ = 100
SECONDS = 10.0
SETTLE_S = 4.0
TIMEOUT_S = 60.0
CAMERA = {
    'wxyz': (1.0, 0.0, 0.0, 0.0),
    'position': (1.0, 1.0, 1.0),
    'fov': 1.0,
    'near': 0.1,
    'far': 100.0,
    'image_height': 800,
    'image_width': 1200,
    'look_at': (0.0, 0.0, 0.0),
    'up_direction': (0.0, 0.0, 1.0),
}
"""The first message of a browser; RViz rests until it is received."""


class Cost(NamedTuple):
    """The cost of showing robots."""

    cpu: float
    memory_mb: float
    kilobytes_s: float
    frames_hz: float


class Visitor:
    """
    Client that counts the data a browser receives, and the updates of one robot link.

    Parameters
    ----------
    connection
        A WebSocket of viser, which is read in a thread until it is closed.

    Attributes
    ----------
    size
        The number of bytes so far.
    frames
        The number of updates of the orientation of the first `link_1` so far.

    """

    def __init__(self, connection: ClientConnection) -> None:
        self.size = self.frames = 0
        self._connection = connection
        self._first = ''
        Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        try:
            for data in self._connection:
                self.size += len(data)
                for message in messages_in(bytes(data)):
                    self._count(message)
        except ConnectionClosed:
            pass

    def _count(self, message: dict[str, Any]) -> None:
        """Count the updates of one link, which give the frame rate."""
        if message['type'] == 'SetOrientationMessage' and message['name'].endswith('/link_1'):
            self._first = self._first or message['name']
            self.frames += message['name'] == self._first


def messages_in(data: bytes) -> list[dict[str, Any]]:
    """
    Decode the messages that the viser server sends in one batch.

    Parameters
    ----------
    data
        One message of the WebSocket.

    """
    packed_size = int.from_bytes(data[8:16], 'little')
    packed = zstandard.ZstdDecompressor().decompress(data[16 : 16 + packed_size])
    messages: list[dict[str, Any]] = msgspec.msgpack.decode(packed)['messages']
    return messages


def main() -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=int, default=1, help='runs of each row')
    parser.add_argument('--robots', type=int, nargs='+', default=COUNTS, help='how many robots')
    parser.add_argument('--rates', type=int, nargs='+', default=RATES_HZ, help='frames per second')
    given = parser.parse_args()
    print(f'\n{JOINTS} joints a robot, tf at {TF_HZ} Hz, median of {given.runs} runs')
    print(f'{"robots":>6} {"Hz":>4} {"CPU %":>7} {"MB":>6} {"kB/s":>7} {"frames/s":>9}')
    with tempfile.TemporaryDirectory() as folder, domain_id() as domain:
        os.environ['ROS_DOMAIN_ID'] = str(domain)
        for count in given.robots:
            for rate_hz in given.rates:
                print_row(Path(folder) / 'robots.rviz', count, rate_hz, given.runs)


def print_row(file: Path, count: int, rate_hz: int, runs: int) -> None:
    """
    Measure repeatedly, and print one row of the table.

    Parameters
    ----------
    file
        The RViz configuration file to write.
    count
        The number of robots.
    rate_hz
        The frame rate of RViz.
    runs
        The number of measurements; the row has the medians.

    """
    file.write_text(rviz_file(count, rate_hz))
    costs = [measure(file, count) for _ in range(runs)]
    cost = Cost(*(median(values) for values in zip(*costs)))
    print(
        f'{count:6} {rate_hz:4} {cost.cpu:7.1%} {cost.memory_mb:6.0f} {cost.kilobytes_s:7.0f} '
        f'{cost.frames_hz:9.1f}',
        flush=True,
    )


def measure(file: Path, count: int) -> Cost:
    """
    Run robots and RViz, and measure the cost of showing them.

    Parameters
    ----------
    file
        The RViz configuration.
    count
        The number of moving robots.

    Returns
    -------
    Cost
        The share of a core, the memory, and the data that a browser receives.

    """
    robots = Path(__file__).with_name('rviz_robots.py')
    port = free_port()
    program = [sys.executable, '-m', 'rviz2.rviz2', '-d', str(file)]
    with (
        running([sys.executable, str(robots), str(count), str(TF_HZ)]),
        running([*program, '--ros-args', '-p', f'port:={port}']) as process,
        connection(port) as page,
    ):
        visitor = Visitor(page)
        time.sleep(SETTLE_S)
        begin_s, begin_cpu_s = time.monotonic(), cpu_s(process.pid)
        size, frames = visitor.size, visitor.frames
        time.sleep(SECONDS)
        wall_s = time.monotonic() - begin_s
        return Cost(
            (cpu_s(process.pid) - begin_cpu_s) / wall_s,
            memory_mb(process.pid),
            (visitor.size - size) / wall_s / 1000,
            (visitor.frames - frames) / wall_s,
        )


@contextmanager
def connection(port: int) -> Iterator[ClientConnection]:
    """
    Connect to viser during a `with` block, as a browser does, as soon as the page is served.

    Parameters
    ----------
    port
        The port of the page on this machine.

    Yields
    ------
    ClientConnection
        The WebSocket, which has sent a first camera.

    Raises
    ------
    OSError
        There is still no page after `TIMEOUT_S`.

    """
    end_s = time.monotonic() + TIMEOUT_S
    while True:
        try:
            with connect(
                f'ws://127.0.0.1:{port}',
                subprotocols=[f'viser-v{viser.__version__}'],
                max_size=None,
                compression=None,
            ) as page:
                page.send(msgspec.msgpack.encode({'type': 'ViewerCameraMessage', **CAMERA}))
                yield page
                return
        except OSError:
            if time.monotonic() > end_s:
                raise
            time.sleep(0.1)


def free_port() -> int:
    """Return a free port."""
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        return int(probe.getsockname()[1])


def rviz_file(count: int, rate_hz: int) -> str:
    """
    Return an RViz configuration that shows some robots, without a display of their frames.

    Parameters
    ----------
    count
        The number of robots.
    rate_hz
        The frame rate.

    """
    robots = ''.join(
        f"""
    - Class: rviz_default_plugins/RobotModel
      Name: Robot {index}
      Enabled: true
      TF Prefix: robot_{index}
      Description Topic:
        Value: /robot_{index}/robot_description"""
        for index in range(count)
    )
    return f"""Visualization Manager:
  Displays:
    - Class: rviz_default_plugins/Grid
      Name: Grid
      Enabled: true{robots}
  Global Options:
    Fixed Frame: map
    Frame Rate: {rate_hz}
"""


if __name__ == '__main__':
    main()
