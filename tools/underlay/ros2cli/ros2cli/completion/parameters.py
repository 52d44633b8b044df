# SPDX-License-Identifier: Apache-2.0
"""Complete the names of a node's parameters."""

from __future__ import annotations

import argparse

from ros2cli.completion.memory import recall, remember

TIMEOUT_S = 1.5


def parameters(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the names of a node's parameters.

    Parameters
    ----------
    prefix
        The word to complete (unused).
    args : argparse.Namespace
        The parsed arguments, with the `node_name`.

    """
    service = f'/{args.node_name.lstrip("/")}/list_parameters'
    names: list[str] | None = recall(service)
    if names is None:
        names = _ask(service)
        if names:
            remember(service, names)
    return names


def _ask(service: str) -> list[str]:
    from rcl_interfaces.srv import ListParameters
    from ros2cli.node.direct import DirectNode

    with DirectNode(None) as node:
        client = node.create_client(ListParameters, service)
        if not client.wait_for_service(timeout_sec=TIMEOUT_S):
            return []
        future = client.call_async(ListParameters.Request())
        node.executor.spin_until_future_complete(future, timeout_sec=TIMEOUT_S)
        response = future.result() if future.done() else None
    return sorted(response.result.names) if response else []
