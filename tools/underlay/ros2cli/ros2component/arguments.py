# SPDX-License-Identifier: Apache-2.0
"""Arguments for the component to load: its type, its name and its parameters."""

from __future__ import annotations

import argparse

LOG_LEVELS = {'unset': 0, 'debug': 10, 'info': 20, 'warn': 30, 'error': 40, 'fatal': 50}


def add_load_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the arguments for the component to load, its name and its parameters.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    add = parser.add_argument
    add('package_name', help='Package name where the component is to be found')
    add('plugin_name', help='Type name of the component to be loaded')
    add('-n', '--node-name', help='Component node name')
    add('--node-namespace', help='Component node namespace')
    add(
        '--log-level',
        type=_log_level,
        default=LOG_LEVELS['unset'],
        metavar='LEVEL',
        help=f'Component node log level: {", ".join(LOG_LEVELS)}',
    )
    _add_lists(parser)


def _add_lists(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add(
        '-r',
        '--remap-rule',
        action='append',
        default=[],
        help="Component node remapping rules, in the 'from:=to' form",
    )
    add(
        '-p',
        '--parameter',
        action='append',
        type=_assignment,
        default=[],
        help="Component node parameters, in the 'name:=value' form",
    )
    add(
        '-e',
        '--extra-argument',
        action='append',
        type=_assignment,
        default=[],
        help="Extra arguments for the container, in the 'name:=value' form",
    )


def _log_level(text: str) -> int:
    if text.lower() not in LOG_LEVELS:
        raise argparse.ArgumentTypeError(f'{text!r} is not one of {", ".join(LOG_LEVELS)}')
    return LOG_LEVELS[text.lower()]


def _assignment(text: str) -> str:
    name, separator, _ = text.partition(':=')
    if not name or not separator:
        raise argparse.ArgumentTypeError(f"{text!r} is not of the form 'name:=value'")
    return text
