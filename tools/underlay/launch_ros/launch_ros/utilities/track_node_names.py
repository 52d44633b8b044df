# SPDX-License-Identifier: Apache-2.0
"""Count the nodes of each name."""

from __future__ import annotations

from launch.launch_context import LaunchContext

_KEY = 'unique_ros_node_names'


def add_node_name(context: LaunchContext, node_name: str) -> int:
    """Note that a node of this full name is created; return how many there are now."""
    counts: dict[str, int] = context.get_locals_as_dict().get(_KEY) or {}
    context.extend_globals({_KEY: counts})
    counts[node_name] = counts.get(node_name, 0) + 1
    return counts[node_name]


def get_node_name_count(context: LaunchContext, node_name: str) -> int:
    """Return how many nodes of this full name have been created."""
    counts: dict[str, int] = context.get_locals_as_dict().get(_KEY) or {}
    return counts.get(node_name, 0)


def warn_of_same_names(context: LaunchContext, node_name: str, logger_name: str) -> None:
    """Note that a node of this full name is created; log if it is not the only one."""
    count = add_node_name(context, node_name)
    if count > 1:
        from launch.logging import get_logger

        get_logger(logger_name).warning(
            'there are now at least %s nodes with the name %s created within this launch context',
            count,
            node_name,
        )


def get_node_names(context: LaunchContext) -> list[str]:
    """Return the full names of the nodes that have been created."""
    return list(context.get_locals_as_dict().get(_KEY) or {})
