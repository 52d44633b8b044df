# SPDX-License-Identifier: Apache-2.0
"""The options and the output of verbs that list names."""

from __future__ import annotations

import argparse
from collections.abc import Iterable


def add_types_argument(parser: argparse.ArgumentParser, what: str) -> None:
    """Add the choice of types behind the names; `what` is singular."""
    parser.add_argument(
        '-t', '--show-types', action='store_true', help=f'Additionally show the {what} type'
    )


def add_count_argument(parser: argparse.ArgumentParser, what: str) -> None:
    """Add the choice of a mere count; `what` is plural."""
    parser.add_argument(
        '-c',
        f'--count-{what}',
        action='store_true',
        help=f'Only display the number of {what} discovered',
    )


def add_all_nodes_argument(parser: argparse.ArgumentParser) -> None:
    """Add the choice of hidden nodes."""
    parser.add_argument(
        '-a', '--all', action='store_true', help='Display all nodes even hidden ones'
    )


def add_hidden_argument(parser: argparse.ArgumentParser, what: str) -> None:
    """Add the choice of hidden names, for a verb whose command has it too; `what` is plural."""
    parser.add_argument(
        f'--include-hidden-{what}',
        action='store_true',
        default=argparse.SUPPRESS,
        help=f'Consider hidden {what} as well',
    )


def print_names(names: list[str], *, only_count: bool) -> None:
    """Print one name a line, or how many there are."""
    for line in [str(len(names))] if only_count else names:
        print(line)


def with_types(names_and_types: Iterable[tuple[str, list[str]]], *, show_types: bool) -> list[str]:
    """Return names, each with its types behind it if these are wanted."""
    return [
        f'{name} [{", ".join(types)}]' if show_types else name for name, types in names_and_types
    ]
