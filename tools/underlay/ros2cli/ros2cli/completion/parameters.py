# SPDX-License-Identifier: Apache-2.0
"""
Complete the names of a node's parameters.

Users who press TAB often press it again, to see the choices or after one more letter. So the
answers of nodes are cached for a short while.
"""

from __future__ import annotations

import argparse
from contextlib import suppress
import json
import os
from pathlib import Path
import time
from typing import Any
from urllib.parse import quote

from ros2cli.graph.census import participant_ports
from ros2cli.graph.reach import read_reach

TIMEOUT_S = 1.5
REMEMBERED_S = 8.0


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


def recall(subject: str) -> Any:
    """
    Read cached data from the file system.

    Parameters
    ----------
    subject
        The key under which `remember` has stored them.

    Returns
    -------
    Any
        The data; None if there are none, after 8 s, or when participants on this machine have
        joined or left.

    """
    path = _path(subject)
    try:
        if time.time() - path.stat().st_mtime > REMEMBERED_S:
            return None
        neighbours, data = json.loads(path.read_text(encoding='utf-8'))
    except (OSError, ValueError):
        return None
    return data if neighbours == participant_ports(read_reach().domain_id) else None


def remember(subject: str, data: Any) -> None:
    """
    Cache data in the file system; a failure to do so is ignored.

    The file is replaced atomically, so that another shell never reads a partial one.

    Parameters
    ----------
    subject
        The key, such as the name of the service that was called.
    data
        Any JSON-serializable data except None.

    """
    path = _path(subject)
    new = path.with_name(f'{path.name}.{os.getpid()}')
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        new.write_text(
            json.dumps([participant_ports(read_reach().domain_id), data]), encoding='utf-8'
        )
        new.replace(path)
        return
    with suppress(OSError):
        new.unlink()


def _path(subject: str) -> Path:
    """Return the cache file for a subject, by domain and discovery range of this shell."""
    folder = Path(os.environ.get('ROS_HOME') or '~/.ros').expanduser()
    reach = read_reach()
    name = quote(f'{reach.domain_id}_{reach.extent}_{subject}', safe='')
    return folder / 'completion' / f'{name}.json'
