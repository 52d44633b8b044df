# SPDX-License-Identifier: Apache-2.0
"""Count the launched nodes by fully qualified name."""

from __future__ import annotations

from launch.launch_context import LaunchContext

_KEY = 'unique_ros_node_names'


def add_node_name(context: LaunchContext, node_name: str) -> int:
    """
    Increment the count of nodes with a fully qualified name.

    Parameters
    ----------
    context
        The launch context, which stores the counts.
    node_name
        The fully qualified name of the node.

    Returns
    -------
    int
        The number of nodes with this name, including the new one.

    """
    counts: dict[str, int] = context.get_locals_as_dict().get(_KEY) or {}
    context.extend_globals({_KEY: counts})
    counts[node_name] = counts.get(node_name, 0) + 1
    return counts[node_name]


def get_node_name_count(context: LaunchContext, node_name: str) -> int:
    """
    Return the number of nodes created with a fully qualified name.

    Parameters
    ----------
    context
        The context of the launch.
    node_name
        The fully qualified name.

    """
    counts: dict[str, int] = context.get_locals_as_dict().get(_KEY) or {}
    return counts.get(node_name, 0)


def warn_of_same_names(context: LaunchContext, node_name: str, logger_name: str) -> None:
    """
    Increment the count of a fully qualified name, and log a warning if it is a duplicate.

    Parameters
    ----------
    context
        The context of the launch.
    node_name
        The fully qualified name of the node.
    logger_name
        The name of the logger.

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
    Return the fully qualified names of the nodes created so far.

    Parameters
    ----------
    context
        The context of the launch.

    """
    return list(context.get_locals_as_dict().get(_KEY) or {})
