# SPDX-License-Identifier: Apache-2.0
"""Complete the names of a node's parameters."""

from __future__ import annotations

import argparse

TIMEOUT_S = 1.0


def parameters(prefix: str, args: argparse.Namespace) -> list[str]:
    """Return the names of the parameters of the node that the command line names."""
    from rcl_interfaces.srv import ListParameters
    from ros2cli.node.direct import DirectNode

    service = f'/{args.node_name.lstrip("/")}/list_parameters'
    with DirectNode(None, wait=False) as node:
        client = node.create_client(ListParameters, service)
        if not client.wait_for_service(timeout_sec=TIMEOUT_S):
            return []
        future = client.call_async(ListParameters.Request())
        node.executor.spin_until_future_complete(future, timeout_sec=TIMEOUT_S)
        response = future.result() if future.done() else None
    return sorted(response.result.names) if response else []
