# SPDX-License-Identifier: Apache-2.0
"""
The names in the graph, found in a short and bounded time, and remembered for some seconds.

Who presses TAB often presses it again, to see the choices or after one more letter.
"""

from __future__ import annotations

import json
import os
from pathlib import Path
import time
from typing import Any, NamedTuple

from ros2cli.node.discovery import wait_until_stable
from ros2cli.node.graph import is_local_only, take_snapshot
from ros2cli.node.neighbours import count_neighbours

SPIN_TIME_S = 0.25
QUIET_LOOKS = 4
REMEMBERED_S = 8.0


class Names(NamedTuple):
    """
    What the graph has: topics and services with their types, and the full names of nodes.

    `neighbours` is the number of participants at that time, as far as the kernel tells.
    """

    neighbours: int | None
    topics: dict[str, list[str]]
    services: dict[str, list[str]]
    nodes: list[str]


def graph_names() -> Names:
    """Return the names that are remembered, or look at the graph."""
    neighbours = count_neighbours(_domain_id())
    if is_local_only() and neighbours == 0:
        return Names(neighbours, {}, {}, [])
    path = _memory()
    remembered = _recall(path)
    if remembered and remembered.neighbours == neighbours:
        return remembered
    return _look(path, neighbours)


def _look(path: Path, neighbours: int | None) -> Names:
    from ros2cli.node.direct import DirectNode

    with DirectNode(None, wait=False) as node:
        is_complete = wait_until_stable(
            lambda: take_snapshot(node.node), SPIN_TIME_S, quiet_looks=QUIET_LOOKS
        )
        names = _names_of(node, neighbours)
    if is_complete:
        _remember(path, names)
    return names


def _names_of(node: Any, neighbours: int | None) -> Names:
    from ros2node.api import get_node_names
    from ros2topic.api import get_topic_names_and_types

    nodes = get_node_names(node=node, include_hidden_nodes=True)
    return Names(
        neighbours,
        dict(get_topic_names_and_types(node=node, include_hidden_topics=True)),
        dict(sorted(node.get_service_names_and_types())),
        sorted({name.full_name for name in nodes}),
    )


def _recall(path: Path) -> Names | None:
    try:
        if time.time() - path.stat().st_mtime > REMEMBERED_S:
            return None
        return Names(**json.loads(path.read_text(encoding='utf-8')))
    except (OSError, ValueError, TypeError):
        return None


def _remember(path: Path, names: Names) -> None:
    """Write the names in one step, so that a second shell never reads half of them."""
    new = path.with_name(f'{path.name}.{os.getpid()}')
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        new.write_text(json.dumps(names._asdict()), encoding='utf-8')
        new.replace(path)
    except OSError:
        new.unlink(missing_ok=True)


def _memory() -> Path:
    """Return the file for the part of the network that this shell sees."""
    folder = Path(os.environ.get('ROS_HOME') or '~/.ros').expanduser()
    reach = 'local' if is_local_only() else 'network'
    return folder / 'completion' / f'graph_{_domain_id()}_{reach}.json'


def _domain_id() -> int:
    text = os.environ.get('ROS_DOMAIN_ID', '')
    return int(text) if text.isdigit() else 0
