# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 component standalone`, and its container, which runs as long as the command."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from ros2cli.arguments import add_strategy_arguments, node_name
from ros2component.verb import VerbExtension
from ros2component.verb.load import add_load_arguments

if TYPE_CHECKING:
    import subprocess

    from ros2cli.graph.graph import Graph
    from ros2cli.node.direct import DirectNode
    from ros2component.api import Component

DEFAULT_CONTAINER_NAME = 'standalone_container'
PACKAGE = 'rclcpp_components'
EXECUTABLE = 'component_container'
END_TIMEOUT_S = 5.0


class StandaloneVerb(VerbExtension):
    """Run a component into its own standalone container node."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the container's name and what to load into it.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            '-c',
            '--container-node-name',
            type=node_name,
            default=DEFAULT_CONTAINER_NAME,
            help='Name of the container node to be created (default: %(default)s)',
        )
        add_load_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Start a container, load a component into it, and wait until the container exits.

        The container is terminated when this returns or raises, and killed after another 5 s.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        Returns
        -------
        int or str or None
            The exit status of the container; negative if a signal has ended it.

        Raises
        ------
        RuntimeError
            There is no container executable, it exits early, or it rejects the component.

        """
        from ros2cli.node.direct import DirectNode

        name = args.container_node_name
        with _container_process(name) as process:
            with DirectNode(args) as node:
                component = _load(node, process, args)
            print(
                f"Loaded component {component.uid} into '/{name}' container node as "
                f"'{component.name}'"
            )
            return process.wait()


def _load(
    node: DirectNode, process: subprocess.Popen[bytes], args: argparse.Namespace
) -> Component:
    """Load the component as soon as the container is there."""
    from ros2cli.waiting import Patience
    from ros2component.api import get_containers, load_component

    name = f'/{args.container_node_name}'

    def is_over(graph: Graph) -> bool:
        return process.poll() is not None or name in get_containers(graph)

    node.watch.wait_for(is_over, Patience(f"the container '{name}'"))
    if process.poll() is not None:
        raise RuntimeError(f"The container '{name}' exited with status {process.returncode}")
    return load_component(node, name, args)


@contextmanager
def _container_process(name: str) -> Iterator[subprocess.Popen[bytes]]:
    """Start a container; it is terminated at the end of the block at the latest."""
    import subprocess

    process = subprocess.Popen([_executable(), '--ros-args', '-r', f'__node:={name}'])
    try:
        yield process
    finally:
        process.terminate()
        try:
            process.wait(END_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def _executable() -> str:
    from ros2pkg.api import PackageNotFoundError
    from ros2run.api import get_executable_path
    from ros_environment.workspace import explain_missing_package

    try:
        path = get_executable_path(package_name=PACKAGE, executable_name=EXECUTABLE)
    except PackageNotFoundError:
        path = None
    if path is None:
        advice = explain_missing_package(PACKAGE)
        text = (
            f"The executable '{EXECUTABLE}' of the package '{PACKAGE}' is not installed. {advice}"
        )
        raise RuntimeError(text.rstrip())
    return path
