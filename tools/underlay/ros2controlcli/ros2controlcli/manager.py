# SPDX-License-Identifier: Apache-2.0
"""Shared by the verbs: call the services of a controller manager, and print interfaces."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import Any

from ros2cli.arguments import add_hidden_nodes_argument, add_node_arguments
from ros2cli.names import absolute, closest
from ros2cli.waiting import Patience

DEFAULT = '/controller_manager'
TYPE = 'controller_manager_msgs/srv/'
ANSWER_TIMEOUT_S = 10.0


def add_manager_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options that all verbs of `ros2 control` share.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    add_node_arguments(parser)
    parser.add_argument(
        '-c',
        '--controller-manager',
        metavar='NAME',
        default=DEFAULT,
        help='Name of the controller manager (default: %(default)s)',
    )
    add_hidden_nodes_argument(parser)


def ask(args: argparse.Namespace, name: str, kind: str, /, **request: Any) -> Any:
    """
    Call a service of the controller manager that the command line names.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_manager_arguments`.
    name
        The service, without the name of the manager.
    kind
        Its type, a class of `controller_manager_msgs.srv`.
    request
        The fields of the request.

    Raises
    ------
    RuntimeError
        There is no such manager, or it does not answer.

    """
    from ros2cli.node.direct import DirectNode
    from ros2cli.waiting import call

    with DirectNode(args) as node:
        import controller_manager_msgs.srv

        manager = absolute(args.controller_manager, 'node')
        _find(node, manager, name, f'{TYPE}{kind}', args.spin_time)
        service = getattr(controller_manager_msgs.srv, kind)
        return call(
            node, service, f'{manager}/{name}', service.Request(**request), ANSWER_TIMEOUT_S
        )


def _find(node: Any, manager: str, name: str, kind: str, timeout_s: float) -> None:
    """Wait for a service of a manager; after the timeout, raise an error that lists managers."""

    def is_known(graph: Any) -> bool:
        return kind in dict(graph.get_service_names_and_types()).get(f'{manager}/{name}', [])

    if node.watch.wait_for(is_known, Patience(f"the controller manager '{manager}'"), timeout_s):
        return
    known = sorted(
        service.removesuffix(f'/{name}')
        for service, kinds in node.watch.graph.get_service_names_and_types()
        if kind in kinds and service.endswith(f'/{name}')
    )
    hint = closest(manager, known) or (f'Available: {", ".join(known)}' if known else '')
    advice = hint or 'No controller manager is running: start a robot, or check ROS_DOMAIN_ID'
    raise RuntimeError(f"There is no controller manager '{manager}'\n{advice}")


def command_line(interface: Any) -> str:
    """
    Format a command interface, and whether it is available and claimed.

    Parameters
    ----------
    interface
        A `controller_manager_msgs/HardwareInterface`.

    """
    available = 'available' if interface.is_available else 'unavailable'
    claimed = 'claimed' if interface.is_claimed else 'unclaimed'
    return f'{interface.name} [{available}] [{claimed}]'


def print_lines(title: str, lines: Iterable[str], indent: str = '') -> None:
    """
    Print a title, and indented lines below it.

    Parameters
    ----------
    title
        The first line.
    lines
        The lines below it, indented by one more tab.
    indent
        The indentation of the title.

    """
    print(f'{indent}{title}')
    for line in lines:
        print(f'{indent}\t{line}')
