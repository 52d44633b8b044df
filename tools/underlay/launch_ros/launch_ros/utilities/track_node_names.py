# SPDX-License-Identifier: Apache-2.0
"""Count the nodes of each name."""

from __future__ import annotations

from launch.launch_context import LaunchContext

_KEY = 'unique_ros_node_names'


def add_node_name(context: LaunchContext, node_name: str) -> int:
    """
    Count one more node of a full name.

    Parameters
    ----------
    context
        The context of the launch, which keeps the counts.
    node_name
        The full name of the node.

    Returns
    -------
    int
        How many nodes of this name there are now.

    """
    counts: dict[str, int] = context.get_locals_as_dict().get(_KEY) or {}
    context.extend_globals({_KEY: counts})
    counts[node_name] = counts.get(node_name, 0) + 1
    return counts[node_name]


def get_node_name_count(context: LaunchContext, node_name: str) -> int:
    """
    Return how many nodes of a full name have been created.

    Parameters
    ----------
    context
        The context of the launch.
    node_name
        The full name.

    """
    counts: dict[str, int] = context.get_locals_as_dict().get(_KEY) or {}
    return counts.get(node_name, 0)


def warn_of_same_names(context: LaunchContext, node_name: str, logger_name: str) -> None:
    """
    Count one more node of a full name, and log a warning if it is not the only one.

    Parameters
    ----------
    context
        The context of the launch.
    node_name
        The full name of the node.
    logger_name
        The logger of the warning.

    """
    count = add_node_name(context, node_name)
    if count > 1:
        from launch.logging import get_logger

        get_logger(logger_name).warning(
            'there are now at least %s nodes with the name %s created within this launch context',
            count,
            node_name,
        )


def get_node_names(context: LaunchContext) -> list[str]:
    """
    Return the full names of the nodes that have been created.

    Parameters
    ----------
    context
        The context of the launch.

    """
    return list(context.get_locals_as_dict().get(_KEY) or {})
