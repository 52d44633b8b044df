# SPDX-License-Identifier: Apache-2.0
"""The command that saves the map of a topic to files, once."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import sys
import time

from nav2_map_server.map_io import IMAGE_FORMATS
from nav2_map_server.map_saver import MapSaver, SaveOptions
from nav2_map_server.occupancy_map import MODES, Thresholds
from nav2_util.errors import NavigationError
from rclpy.task import Future
from tf2_ros.executing import make_executor, spin_until
from tf2_ros.program import run

__all__ = ['main']


def main(arguments: Sequence[str] | None = None) -> int:
    """
    Run the command; return the exit status.

    Parameters
    ----------
    arguments : Sequence[str] | None
        The command line with the program's name; by default that of the process.

    """
    return run(_parse, _save, arguments)


def _parse(words: list[str]) -> SaveOptions:
    parser = argparse.ArgumentParser(
        prog='map_saver_cli',
        description='Write the map of a topic to a YAML file and an image.',
        epilog='Parameters of the node follow --ros-args: -p save_map_timeout:=5.0 and '
        '-p map_subscribe_transient_local:=true.',
    )
    default = f'map_{int(time.time())}'
    parser.add_argument('-t', dest='topic', default='map', help='the topic of the map')
    parser.add_argument(
        '-f', dest='stem', default=default, help='the path of the files without the ending'
    )
    parser.add_argument(
        '--occ', type=float, default=0.65, help='cells are occupied from this probability (0.65)'
    )
    parser.add_argument(
        '--free', type=float, default=0.25, help='cells are free up to this probability (0.25)'
    )
    parser.add_argument(
        '--fmt',
        default='',
        choices=IMAGE_FORMATS,
        help=f'the format of the image: {", ".join(IMAGE_FORMATS)} (pgm; png in mode scale)',
    )
    parser.add_argument(
        '--mode',
        default='trinary',
        choices=MODES,
        help=f'what cells are: {", ".join(MODES)} (trinary)',
    )
    found = parser.parse_args(words)
    try:
        thresholds = Thresholds(found.free, found.occ)
    except ValueError as error:
        parser.error(str(error))
    return SaveOptions(found.topic, found.stem, found.fmt, found.mode, thresholds)


def _save(options: SaveOptions) -> int:
    node = MapSaver()
    executor = make_executor()
    executor.add_node(node)
    end: Future[int] = Future(executor=executor)

    async def work() -> None:
        status = 1
        try:
            await node.save(options)
            status = 0
        except NavigationError as error:
            sys.stderr.write(f'{error}\n')
        finally:
            end.set_result(status)

    executor.create_task(work)
    spin_until(executor, end)
    node.destroy_node()
    executor.shutdown()
    return end.result() if end.done() else 1
