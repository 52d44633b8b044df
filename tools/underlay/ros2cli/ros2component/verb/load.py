# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 component load`, and its options, which `standalone` shares."""

from __future__ import annotations

import argparse

from ros2cli.arguments import add_strategy_arguments
from ros2component.verb import VerbExtension

LOG_LEVELS = {'unset': 0, 'debug': 10, 'info': 20, 'warn': 30, 'error': 40, 'fatal': 50}


class LoadVerb(VerbExtension):
    """Load a component into a container node."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the container and what to load into it.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            'container_node_name', help='Container node name to load component into'
        )
        add_load_arguments(parser)
        parser.add_argument(
            '-q', '--quiet', action='store_true', help='Only display the ID of the component'
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Load a component into a container, and print its unique ID and name.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        Raises
        ------
        RuntimeError
            The container does not exist, or rejects the component.

        """
        from ros2cli.node.direct import DirectNode
        from ros2component.api import find_container, load_component

        with DirectNode(args) as node:
            container = find_container(node.watch, args.container_node_name)
            component = load_component(node, container, args)
        if args.quiet:
            print(component.uid)
        else:
            print(
                f"Loaded component {component.uid} into '{container}' container node as "
                f"'{component.name}'"
            )
        return None


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
