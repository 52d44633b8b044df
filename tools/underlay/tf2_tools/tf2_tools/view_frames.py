# SPDX-License-Identifier: Apache-2.0
"""Draw the tf tree: `ros2 run tf2_tools view_frames`."""

from __future__ import annotations

import argparse
from datetime import datetime
from functools import partial
import sys
from typing import TYPE_CHECKING

from tf2_ros.program import number_in, run, spin, wait_for_signal
from tf2_tools.drawing import draw, has_graphviz, write_graph, write_tree
import yaml

if TYPE_CHECKING:
    from rclpy.node import Node
    from tf2_ros.buffer import Buffer

_WAIT_S = 5.0


def main() -> int:
    """Run the program; return the exit status."""
    return run(_parser().parse_args, _view)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='view_frames',
        description='Listen to transforms for some seconds, then draw the tree of the frames.',
    )
    parser.add_argument(
        '--wait-time',
        '-t',
        type=number_in(0.0, 1e6, 'time in seconds'),
        default=_WAIT_S,
        help='seconds to listen (default: 5)',
    )
    parser.add_argument(
        '-o', '--output', default='', help='output path without extension (default: frames_<date>)'
    )
    return parser


def _view(args: argparse.Namespace) -> int:
    """Listen to transforms, write the files and return the exit status."""
    import rclpy
    from tf2_ros.buffer import Buffer
    from tf2_ros.transform_listener import TransformListener

    node = rclpy.create_node('view_frames')
    logger = node.get_logger()
    logger.info(f'Listening to tf data for {args.wait_time} seconds...')
    buffer = Buffer()
    TransformListener(buffer, node)
    if spin(node, args.wait_time):
        return 0
    path = args.output or datetime.now().strftime('frames_%Y-%m-%d_%H.%M.%S')
    drawn = f'{path}.pdf' if has_graphviz() else f'{path}.svg'
    logger.info(f'Generating graph in {drawn} file...')
    try:
        write_graph(path, buffer.known_frames.as_dot())
        if drawn.endswith('.svg'):
            write_tree(path, yaml.safe_load(buffer.all_frames_as_yaml()))
    except OSError as error:
        logger.error(f'{path} cannot be written: {error.strerror}. Give another --output')
        return 1
    if drawn.endswith('.pdf'):
        problem = draw(f'{path}.gv', drawn, partial(wait_for_signal, 0.0))
        if problem:
            logger.warning(problem)
    _say_what_is_missing(node, buffer)
    print(buffer.all_frames_as_yaml().rstrip(), flush=True)
    return 0


def _say_what_is_missing(node: Node, buffer: Buffer) -> None:
    if not buffer.known_frames.names():
        node.get_logger().warning(
            "No transforms received. 'ros2 topic info -v /tf' shows whether a node publishes "
            'them; nodes in other domains or on other machines are not visible'
        )


if __name__ == '__main__':
    sys.exit(main())
