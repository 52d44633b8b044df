# SPDX-License-Identifier: Apache-2.0
"""The kinds of interfaces and the options that select them."""

from __future__ import annotations

import argparse

HEADINGS = {'msg': 'Messages', 'srv': 'Services', 'action': 'Actions'}


def add_kind_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add an option for each kind of interface.

    Parameters
    ----------
    parser
        The parser of a verb.

    """
    add = parser.add_argument
    add('-m', '--only-msgs', action='store_true', help='Only consider the message types')
    add('-s', '--only-srvs', action='store_true', help='Only consider the service types')
    add('-a', '--only-actions', action='store_true', help='Only consider the action types')


def chosen_kinds(args: argparse.Namespace) -> list[str]:
    """
    List the kinds of interface that the options choose.

    Parameters
    ----------
    args : argparse.Namespace
        The parsed arguments with the options of `add_kind_arguments`.

    Returns
    -------
    list of str
        Some of 'msg', 'srv' and 'action', in this order; all if none is chosen.

    """
    wanted = {'msg': args.only_msgs, 'srv': args.only_srvs, 'action': args.only_actions}
    return [kind for kind in HEADINGS if wanted[kind]] or list(HEADINGS)
