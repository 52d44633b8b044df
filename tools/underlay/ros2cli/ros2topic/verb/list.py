# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 topic list`."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.arguments import (
    add_count_argument,
    add_hidden_argument,
    add_strategy_arguments,
    add_types_argument,
)
from ros2cli.names import print_names, with_types
from ros2topic.verb import VerbExtension


class ListVerb(VerbExtension):
    """Output a list of available topics."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the options for types, details, hidden topics and for printing only a count.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 topic list`; unused.

        """
        add_strategy_arguments(parser)
        add_types_argument(parser, 'topic')
        add_count_argument(parser, 'topics')
        add_hidden_argument(parser, 'topics')
        parser.add_argument(
            '-v', '--verbose', action='store_true', help='List full details about each topic'
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the names of the topics, with types or details if wanted, or their number.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.node.strategy import NodeStrategy
        from ros2topic.api import get_topic_names_and_types

        with NodeStrategy(args) as node:
            topics = get_topic_names_and_types(
                node=node, include_hidden_topics=args.include_hidden_topics
            )
        if args.verbose and not args.count_topics:
            _print_verbose(node, topics)
        else:
            lines = with_types(topics, show_types=args.show_types)
            print_names(lines, only_count=args.count_topics)
        return None


def _print_verbose(node: Any, topics: list[tuple[str, list[str]]]) -> None:
    print('Published topics:')
    _print_counts(topics, [node.count_publishers(name) for name, _ in topics], 'publisher')
    print('\nSubscribed topics:')
    _print_counts(topics, [node.count_subscribers(name) for name, _ in topics], 'subscriber')


def _print_counts(topics: list[tuple[str, list[str]]], counts: list[int], what: str) -> None:
    for (name, types), count in zip(topics, counts):
        if count:
            plural = '' if count == 1 else 's'
            print(f' * {name} [{", ".join(types)}] {count} {what}{plural}')
