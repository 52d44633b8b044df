# SPDX-License-Identifier: Apache-2.0
"""
Options that the verbs of several commands share, and argument types for numbers and names.

Importing this does not import rclpy.
"""

from __future__ import annotations

import argparse
import re

from ros2cli.graph import DEFAULT_SPIN_TIME_S


def add_node_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options for discovery and simulated time.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument(
        '--spin-time',
        type=positive_number,
        default=DEFAULT_SPIN_TIME_S,
        metavar='SECONDS',
        help='time to wait for nodes on other machines, and for names that are not there yet '
        '(default: %(default)s)',
    )
    parser.add_argument(
        '-s', '--use-sim-time', action='store_true', help='use the time of the topic /clock'
    )


def add_ros_args_argument(parser: argparse.ArgumentParser) -> None:
    """
    Add the option for the arguments of ROS of the node of a command.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument(
        '--ros-args',
        nargs=argparse.REMAINDER,
        default=[],
        help="arguments of ROS for the node of this command, such as '-r __ns:=/robot1'",
    )


def add_strategy_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options of verbs that read the graph.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    add_node_arguments(parser)
    parser.add_argument(
        '--no-daemon',
        action='store_true',
        help='accepted for compatibility: discovery is always direct, there is no daemon',
    )


def add_hidden_nodes_argument(parser: argparse.ArgumentParser) -> None:
    """
    Add the option to consider hidden nodes.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument(
        '--include-hidden-nodes', action='store_true', help='Consider hidden nodes as well'
    )


def add_types_argument(parser: argparse.ArgumentParser, what: str) -> None:
    """
    Add the option to show types after names.

    Parameters
    ----------
    parser
        The parser of the verb.
    what
        The kind of the names, in the singular, such as `topic`.

    """
    parser.add_argument(
        '-t', '--show-types', action='store_true', help=f'Additionally show the {what} type'
    )


def add_count_argument(parser: argparse.ArgumentParser, what: str) -> None:
    """
    Add the option to show a count only.

    Parameters
    ----------
    parser
        The parser of the verb.
    what
        The counted kind, in the plural, such as `topics`.

    """
    parser.add_argument(
        '-c',
        f'--count-{what}',
        action='store_true',
        help=f'Only display the number of {what} discovered',
    )


def add_all_nodes_argument(parser: argparse.ArgumentParser) -> None:
    """
    Add the option to show hidden nodes as well.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument(
        '-a', '--all', action='store_true', help='Display all nodes even hidden ones'
    )


def add_hidden_argument(parser: argparse.ArgumentParser, what: str) -> None:
    """
    Add the option to consider hidden names, for a verb whose command has it too.

    Parameters
    ----------
    parser
        The parser of the verb.
    what
        The kind of the names, in the plural, such as `topics`.

    """
    parser.add_argument(
        f'--include-hidden-{what}',
        action='store_true',
        default=argparse.SUPPRESS,
        help=f'Consider hidden {what} as well',
    )


def regular_expression(text: str) -> re.Pattern[str]:
    """
    Compile a regular expression argument.

    Parameters
    ----------
    text
        The argument text.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is not a regular expression.

    """
    try:
        return re.compile(text)
    except re.error as error:
        raise argparse.ArgumentTypeError(
            f'{text!r} is not a regular expression: {error}'
        ) from error


def positive_int(text: str) -> int:
    """
    Parse a positive integer argument.

    Parameters
    ----------
    text
        The argument text.

    Returns
    -------
    int
        One or more.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is not such a number.

    """
    try:
        value = int(text)
    except ValueError:
        value = 0
    if value <= 0:
        raise argparse.ArgumentTypeError(f'{text!r} is not a whole number above zero')
    return value


def positive_number(text: str) -> float:
    """
    Parse a finite positive number argument.

    Parameters
    ----------
    text
        The argument text.

    Returns
    -------
    float
        More than zero.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is not such a number.

    """
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value < float('inf'):
        raise argparse.ArgumentTypeError(f'{text!r} is not a number above zero')
    return value


def whole_number(text: str) -> int:
    """
    Parse a non-negative integer argument, written in digits only.

    Parameters
    ----------
    text
        The argument text.

    Returns
    -------
    int
        Zero or more.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is not such a number.

    """
    if not (text.isascii() and text.isdigit()):
        raise argparse.ArgumentTypeError(f'{text!r} is not a whole number')
    return int(text)


def node_name(text: str) -> str:
    """
    Validate a node name argument, without namespace.

    Parameters
    ----------
    text
        The argument text.

    Returns
    -------
    str
        The text itself.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is not a valid name.

    """
    if not (text.isascii() and text.isidentifier()):
        raise argparse.ArgumentTypeError(
            f'{text!r} is not a valid node name: letters, digits and underscores, no digit first'
        )
    return text
