# SPDX-License-Identifier: Apache-2.0
"""Detect parameter files that match no launched node."""

from __future__ import annotations

from typing import Optional, TYPE_CHECKING

from launch.launch_context import LaunchContext
from launch.logging import get_logger
from launch_ros.utilities.parameter_file_keys import key_matches, parameter_file_keys
from launch_ros.utilities.parameter_file_problem import parameter_file_problem
from launch_ros.utilities.track_node_names import get_node_names

if TYPE_CHECKING:
    from launch_ros.actions._node_names import NodeNames

FullName = tuple[str, Optional[str]]


class ParameterFilesCheck:
    """Checks that parameter files match at least one launched node."""

    def __init__(self) -> None:
        """Create a check without files."""
        self._readers: dict[str, list[NodeNames]] = {}

    def add(self, path: str, names: NodeNames) -> None:
        """
        Register a parameter file of a node.

        Parameters
        ----------
        path
            The file.
        names
            The name and the namespace of the node, as far as known.

        """
        self._readers.setdefault(path, []).append(names)

    def __call__(self, context: LaunchContext) -> None:
        """Log a warning for each file that is invalid or matches no known node."""
        for path in self._readers:
            _warn_of_problem(path)
        nodes = self._known_nodes(context)
        for path, readers in self._readers.items():
            if nodes is None or any(names.name is None for names in readers):
                continue
            keys = parameter_file_keys(path)
            if keys and not any(key_matches(key, *node) for key in keys for node in nodes):
                _warn(path, keys, nodes)

    def _known_nodes(self, context: LaunchContext) -> Optional[set[FullName]]:
        """Return the nodes launched now or later; None if that cannot be determined."""
        nodes = {
            (names.name, names.namespace)
            for readers in self._readers.values()
            for names in readers
            if names.name is not None
        }
        for full_name in get_node_names(context):
            namespace, _, name = full_name.rpartition('/')
            nodes.add((name, namespace or '/'))
        later = _names_of_waiting_nodes(context)
        return None if later is None else nodes | later


def _names_of_waiting_nodes(context: LaunchContext) -> Optional[set[FullName]]:
    from launch._preflight import constant_text, waiting_entities
    from launch_ros.actions.node import Node

    found: set[FullName] = set()
    for entity in waiting_entities(context):
        if isinstance(entity, Node):
            name = entity._name_parts and constant_text(entity._name_parts, context)
            if not name:
                return None
            found.add((name, None))
    return found


def _warn_of_problem(path: str) -> None:
    problem = parameter_file_problem(path)
    if problem is not None:
        get_logger('launch_ros.actions.node').warning(
            "the parameter file '%s' cannot be used: line %d, %s", path, *problem
        )


def _warn(path: str, keys: list[str], nodes: set[FullName]) -> None:
    names = sorted(f'{(namespace or "").rstrip("/")}/{name}' for name, namespace in nodes)
    get_logger('launch_ros.actions.node').warning(
        "the parameter file '%s' is for %s, but the nodes that are launched are %s: it has no "
        'effect',
        path,
        ', '.join(f"'{key}'" for key in dict.fromkeys(keys)),
        ', '.join(f"'{name}'" for name in names),
    )
