# SPDX-License-Identifier: Apache-2.0
"""Service introspection: the service and the client as two executables."""

from __future__ import annotations

from collections.abc import Sequence

from demo_nodes_py.services.introspection import IntrospectionClientNode, IntrospectionServiceNode
from tf2_ros.program import run_node

__all__ = ['run_client', 'run_service']


def run_service(args: Sequence[str] | None = None) -> int:
    """
    Run the service; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: IntrospectionServiceNode(), args)


def run_client(args: Sequence[str] | None = None) -> int:
    """
    Run the client; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: IntrospectionClientNode(), args)
