# SPDX-License-Identifier: Apache-2.0
"""A container for one component, which runs as long as the command."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
import subprocess

from ros2cli.graph.graph import Graph
from ros2cli.node.direct import DirectNode
from ros2cli.waiting import Patience
from ros2component.api import get_containers, load_component
from ros2pkg.api import PackageNotFoundError
from ros2run.api import get_executable_path
from ros_environment.workspace import explain_missing_package

PACKAGE = 'rclcpp_components'
EXECUTABLE = 'component_container'
END_TIMEOUT_S = 5.0


def run_standalone(args: argparse.Namespace) -> int:
    """
    Start a container, load one component into it, and wait until the container exits.

    The container is terminated when this returns or raises, and killed after another 5 s.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_load_arguments` and of a node, and `container_node_name`.

    Returns
    -------
    int
        The exit status of the container; negative if a signal has ended it.

    Raises
    ------
    RuntimeError
        There is no container executable, it exits early, or it rejects the component.

    """
    with _container_process(args.container_node_name) as process:
        _load(process, args)
        return process.wait()


def _load(process: subprocess.Popen[bytes], args: argparse.Namespace) -> None:
    name = f'/{args.container_node_name}'
    with DirectNode(args) as node:

        def is_over(graph: Graph) -> bool:
            return process.poll() is not None or name in get_containers(graph)

        node.watch.wait_for(is_over, Patience(f"the container '{name}'"))
        if process.poll() is not None:
            raise RuntimeError(f"The container '{name}' exited with status {process.returncode}")
        component = load_component(node, name, args)
    print(f"Loaded component {component.uid} into '{name}' container node as '{component.name}'")


@contextmanager
def _container_process(name: str) -> Iterator[subprocess.Popen[bytes]]:
    """Start a container; it is terminated at the end of the block at the latest."""
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
