# SPDX-License-Identifier: Apache-2.0
"""Options and output of verbs that list names."""

from __future__ import annotations

import argparse
from collections.abc import Iterable


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


def print_names(names: list[str], *, only_count: bool) -> None:
    """
    Print names, one per line, or their count.

    Parameters
    ----------
    names
        The lines.
    only_count
        Whether to print the count.

    """
    for line in [str(len(names))] if only_count else names:
        print(line)


def with_types(names_and_types: Iterable[tuple[str, list[str]]], *, show_types: bool) -> list[str]:
    """
    Format names, optionally with their types in brackets.

    Parameters
    ----------
    names_and_types
        The names and types, as the graph returns them.
    show_types
        Whether to add the types.

    """
    return [
        f'{name} [{", ".join(types)}]' if show_types else name for name, types in names_and_types
    ]
