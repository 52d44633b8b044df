# SPDX-License-Identifier: Apache-2.0
"""The arguments of rviz2."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

__all__ = ['parse']


def parse(words: Sequence[str]) -> argparse.Namespace:
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
        description='Show in a browser what a robot says and knows. The address is printed.',
        epilog='Parameters of the node, after --ros-args -p: host:=ADDRESS (default '
        '127.0.0.1), port:=NUMBER (default: the first free one from 8080 on), '
        'token:=TEXT (made up, and part of the address; none: whoever is on this machine), '
        'use_sim_time:=true.',
    )
    parser.add_argument('-d', '--display-config', metavar='FILE', help='a .rviz file to show')
    parser.add_argument(
        '-f', '--fixed-frame', metavar='FRAME', help='the fixed frame, instead of that of the file'
    )
    ignored = parser.add_argument_group('without meaning in a browser, and ignored')
    ignored.add_argument('-l', '--ogre-log', action='store_true')
    ignored.add_argument('-s', '-t', '--splash-screen', metavar='FILE')
    ignored.add_argument('--fullscreen', action='store_true')
    return parser.parse_args(words)
