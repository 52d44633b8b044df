# SPDX-License-Identifier: Apache-2.0
"""Shared by the verbs: the controller manager of a command line, and printing of interfaces."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any, TYPE_CHECKING

from ros2cli.arguments import (
    add_hidden_nodes_argument,
    add_node_arguments,
    add_ros_args_argument,
)
from ros2cli.names import absolute, closest
from ros2cli.waiting import CONNECTION_TIMEOUT_S, Patience

if TYPE_CHECKING:
    from ros2cli.node.direct import DirectNode

DEFAULT = 'controller_manager'
TYPES = 'controller_manager_msgs/srv/'
SERVICES = {'switch_controllers': 'switch_controller'}
"""Services that are not named like the functions that call them."""


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
        help='Name of the controller manager ROS node (default: %(default)s)',
    )
    add_hidden_nodes_argument(parser)
    add_ros_args_argument(parser)


class Manager:
    """
    Calls the services of a controller manager with the functions of `controller_manager`.

    Parameters
    ----------
    node
        The node that calls them.
    name
        The name of the manager; without a leading slash it is relative to the node's namespace.
    spin_time_s
        How long to look for the manager, in s.

    Attributes
    ----------
    name
        The full name.

    """

    def __init__(self, node: DirectNode, name: str, spin_time_s: float) -> None:
        self._node, self._spin_time_s = node, spin_time_s
        space = '' if name.startswith('/') else node.get_namespace().rstrip('/')
        self.name = absolute(f'{space}/{name}' if space else name, 'node')

    def ask(self, function: str, /, *arguments: Any) -> Any:
        """
        Call a service.

        Parameters
        ----------
        function
            The name of a function of `controller_manager`.
        arguments
            Its arguments after the name of the manager.

        Returns
        -------
        Any
            The response.

        Raises
        ------
        RuntimeError
            There is no such manager, or it does not answer.

        """
        import controller_manager
        from controller_manager.controller_manager_services import ServiceNotFoundError

        self._find(SERVICES.get(function, function))
        call = getattr(controller_manager, function)
        try:
            return call(
                self._node.node, self.name, *arguments, service_timeout=CONNECTION_TIMEOUT_S
            )
        except ServiceNotFoundError as error:
            raise RuntimeError(str(error)) from error

    def _find(self, service: str) -> None:
        """Wait for a service of the manager; raise an error with the managers there are."""
        watch = self._node.watch

        def names(graph: Any) -> list[str]:
            return [
                name
                for name, kinds in graph.get_service_names_and_types()
                if name.endswith(f'/{service}') and any(each.startswith(TYPES) for each in kinds)
            ]

        def is_known(graph: Any) -> bool:
            return f'{self.name}/{service}' in names(graph)

        patience = Patience(f"the controller manager '{self.name}'")
        if watch.wait_for(is_known, patience, self._spin_time_s):
            return
        known = sorted(name.removesuffix(f'/{service}') for name in names(watch.graph))
        hint = closest(self.name, known) or (f'Available: {", ".join(known)}' if known else '')
        advice = hint or 'No controller manager is running: start a robot, or check ROS_DOMAIN_ID'
        raise RuntimeError(f"There is no controller manager '{self.name}'\n{advice}")

    def set_parameters(self, controller: str, path: str) -> bool:
        """
        Tell the manager the type of a controller, and the file with its parameters.

        Parameters
        ----------
        controller
            The name of the controller.
        path
            The path of the parameter file.

        Returns
        -------
        bool
            Whether the manager has accepted them; its reason is logged if not.

        Raises
        ------
        RuntimeError
            The file cannot be read, or has no parameters of the controller.

        """
        from controller_manager import set_controller_parameters_from_param_files as set_them
        from controller_manager.controller_manager_services import ServiceNotFoundError

        space = self.name.rpartition('/')[0] or '/'
        try:
            return set_them(self._node.node, self.name, controller, [path], space)
        except ServiceNotFoundError as error:
            raise RuntimeError(
                f"The controller manager '{self.name}' takes no parameters: {error}"
            ) from error

    def states(self) -> dict[str, str]:
        """Return the state of each controller that is loaded, by its name."""
        return {each.name: each.state for each in self.ask('list_controllers').controller}


@contextmanager
def connected(args: argparse.Namespace) -> Iterator[Manager]:
    """
    Start a node that can call the controller manager that a command line names.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_manager_arguments`.

    """
    from ros2cli.node.direct import DirectNode

    with DirectNode(args) as node:
        yield Manager(node, args.controller_manager, args.spin_time)


def unknown(what: str, name: str, known: Iterable[str]) -> str:
    """
    Build the message about a name that the controller manager does not know.

    Parameters
    ----------
    what
        What it should name, such as `controller`.
    name
        The name.
    known
        The names that there are.

    """
    names = sorted(known)
    listed = f'There are: {", ".join(names)}' if names else 'There is none'
    return f"There is no {what} '{name}'\n{closest(name, names) or listed}"


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
