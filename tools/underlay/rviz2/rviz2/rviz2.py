# SPDX-License-Identifier: Apache-2.0
"""Show the topics and frames of a robot in a browser: `ros2 run rviz2 rviz2 -d FILE.rviz`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import sys
from typing import TYPE_CHECKING

from ros2cli.graph.servers import as_super_client
from rviz_common.config import ConfigError, Configuration
from tf2_ros.program import run, spin

if TYPE_CHECKING:
    from rclpy.node import Node
    from rviz_common.page import Page

__all__ = ['main']

Job = tuple[argparse.Namespace, Configuration, str]


def main(args: Sequence[str] | None = None) -> None:
    """
    Run rviz2 until a signal stops it, and exit with its status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line with the program's name; by default that of the process.

    Raises
    ------
    SystemExit
        Always: status 1 if the .rviz file cannot be read or the page cannot be served.

    """
    with as_super_client():  # panels list topics, services and nodes that nobody here uses
        sys.exit(run(_job, _show, args))


def _job(words: list[str]) -> Job:
    """
    Return the configuration to show, and a warning if it is not the requested one.

    An unreadable file ends the program before anything starts. A missing file does not, as in the
    genuine RViz: launch files in books name some that are never printed there.
    """
    arguments = _parse(words)
    if not arguments.display_config:  # launch files pass '' for none
        return arguments, Configuration.default(), ''
    try:
        return arguments, Configuration.read(arguments.display_config), ''
    except ConfigError as error:
        if isinstance(error.__cause__, FileNotFoundError):
            warning = f'{error} RViz opens with its defaults; saving them makes the file.'
            return arguments, Configuration.default(), warning
        sys.stderr.write(f'{error}\n')
        sys.exit(1)


def _parse(words: Sequence[str]) -> argparse.Namespace:
    """
    Parse the command line of rviz2.

    Options of RViz that mean nothing in a browser are accepted and ignored. Invalid arguments and
    `--help` end the program, as `argparse` does.

    Parameters
    ----------
    words
        The arguments without the name of the program, and without those for ROS.

    Returns
    -------
    argparse.Namespace
        `display_config` is the path of a .rviz file and `fixed_frame` the name of a frame, each
        None if not given.

    """
    parser = argparse.ArgumentParser(
        prog='rviz2',
        allow_abbrev=False,
        description='Show the topics and frames of a robot in a browser. The address is printed.',
        epilog='Parameters of the node, after --ros-args -p: host:=ADDRESS (default '
        '127.0.0.1), port:=NUMBER (default: the first free one from 8080 on), '
        'token:=TEXT (default: generated, part of the address; none: anyone on this machine), '
        'use_sim_time:=true.',
    )
    parser.add_argument('-d', '--display-config', metavar='FILE', help='a .rviz file to show')
    parser.add_argument(
        '-f', '--fixed-frame', metavar='FRAME', help='the fixed frame, instead of that of the file'
    )
    ignored = parser.add_argument_group('ignored, as they have no meaning in a browser')
    ignored.add_argument('-l', '--ogre-log', action='store_true')
    ignored.add_argument('-s', '-t', '--splash-screen', metavar='FILE')
    ignored.add_argument('--fullscreen', action='store_true')
    return parser.parse_args(words)


def _show(job: Job) -> int:
    """Show the configuration until a signal arrives; return the exit status."""
    from rclpy.exceptions import ParameterException
    from rviz_common.guarded_node import GuardedNode
    from rviz_common.page import Page, PortError
    from rviz_common.page.address import declare_settings

    node = GuardedNode('rviz2')
    try:
        page = Page('RViz', declare_settings(node))
    except (ValueError, ParameterException, PortError) as error:
        sys.stderr.write(f'{error}\n')
        return 1
    _visualize(node, page, *job)
    node.destroy_node()
    return 0


def _visualize(
    node: Node,
    page: Page,
    arguments: argparse.Namespace,
    configuration: Configuration,
    warning: str,
) -> None:
    from robot_state_publisher.node_arguments import unknown_overrides
    from rviz_common.visualizer import Visualizer
    from rviz_common.visualizer.global_options import FIXED_FRAME

    visualizer = Visualizer(
        node, page, configuration, arguments.display_config or '', may_rest=True
    )
    if arguments.fixed_frame is not None:
        visualizer.set_option(FIXED_FRAME, arguments.fixed_frame)
    for sentence in filter(None, [warning, *unknown_overrides(node)]):
        node.get_logger().warning(sentence)
    node.get_logger().info(f'RViz is at {" and ".join(page.urls)}')
    spin(node)
    page.close()  # first, so that browsers keep the scene and report the lost connection
    visualizer.close()


if __name__ == '__main__':
    main()
