# SPDX-License-Identifier: Apache-2.0
"""Extensions of other packages that add arguments to node command lines."""

from __future__ import annotations

from functools import cache
from typing import Any, Optional, TYPE_CHECKING

from launch._entry_points import entry_points_of
from launch.utilities.normalize_to_list_of_substitutions_impl import (
    normalize_to_list_of_substitutions,
)
from launch.utilities.perform_substitutions_impl import perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch_ros.actions.node import Node

_GROUP = 'launch_ros.node_action'


class NodeActionExtension:
    """Base class of extensions that register as entry points of `launch_ros.node_action`."""

    NAME: Optional[str] = None
    EXTENSION_POINT_VERSION = '0.1'

    def prepare_for_execute(
        self,
        context: LaunchContext,
        ros_specific_arguments: dict[str, Any],
        node_action: Node,
    ) -> tuple[list[Any], dict[str, Any]]:
        """
        Extend the command line of a node; to be overridden by subclasses.

        Added arguments may refer to `ros_specific_arguments` by a LocalSubstitution.

        Parameters
        ----------
        context
            The launch context.
        ros_specific_arguments
            The rules `__node:=...` under `name` and `__ns:=...` under `ns`, each only if known.
        node_action
            The action that is about to start the node.

        Returns
        -------
        tuple
            The arguments to add, as strings or substitutions, and the rules to use instead.

        """
        return [], ros_specific_arguments


def extend_node(
    context: LaunchContext,
    ros_specific_arguments: dict[str, Any],
    node: Node,
) -> tuple[list[str], dict[str, Any]]:
    """
    Apply all installed extensions to the command line of a node.

    Parameters
    ----------
    context
        The launch context; receives the local `ros_specific_arguments` if arguments are added.
    ros_specific_arguments
        The rules for the name and the namespace, by `name` and `ns`.
    node
        The action that is about to start the node.

    Returns
    -------
    tuple
        The arguments to add, as strings, and the rules to use.

    """
    added: list[Any] = []
    for extension in extensions():
        more, ros_specific_arguments = extension.prepare_for_execute(
            context, ros_specific_arguments, node
        )
        added += more
    if added:
        context.extend_locals({'ros_specific_arguments': ros_specific_arguments})
    words = [
        perform_substitutions(context, normalize_to_list_of_substitutions(word)) for word in added
    ]
    return words, ros_specific_arguments


@cache
def extensions() -> list[Any]:
    """Instantiate all extensions; log and skip those that cannot be loaded."""
    found = []
    for entry_point in entry_points_of(_GROUP):
        try:
            found.append(entry_point.load()())
        except Exception as error:
            from launch.logging import get_logger

            get_logger('launch_ros.actions.node').warning(
                "the extension '%s' (%s) of nodes cannot be loaded and is left out: %s: %s",
                entry_point.name,
                entry_point.value,
                type(error).__name__,
                error,
            )
    return found
