# SPDX-License-Identifier: Apache-2.0
"""Registry of the node types by their names in XML files."""

from __future__ import annotations

from collections.abc import Callable
import importlib

from nav2_behavior_tree.node import TreeNode
from nav2_util.plugins import did_you_mean

__all__ = ['node_type', 'register', 'registered_types', 'unknown_type']

_TYPES: dict[str, type[TreeNode]] = {}
_MODULES = (
    'behavior_actions',
    'branches',
    'composites',
    'conditions',
    'control',
    'decorators',
    'leaves',
    'navigation_actions',
    'path_actions',
    'pace',
    'robot_conditions',
    'services',
)
_RENAMED = {
    'SequenceStar': 'SequenceWithMemory',
    'SubTreePlus': 'SubTree',
    'RetryUntilSuccesful': 'RetryUntilSuccessful',
    'BlackboardCheckInt': 'Precondition',
    'BlackboardCheckDouble': 'Precondition',
    'BlackboardCheckString': 'Precondition',
}
_NO_ROUTES = 'there is no route server; ComputePathToPose plans on the map instead'
_MISSING = {
    'ManualSelector': 'it would need a user who selects a child',
    'ConsumeQueue': 'deprecated nodes of BehaviorTree.CPP are left out',
    'ComputeRoute': _NO_ROUTES,
    'ComputeAndTrackRoute': _NO_ROUTES,
    'CancelComputeAndTrackRoute': _NO_ROUTES,
    'ComputeCoveragePath': 'there is no coverage server; ComputePathThroughPoses visits poses',
    'CancelCoverage': 'there is no coverage server',
}


def register(*names: str) -> Callable[[type[TreeNode]], type[TreeNode]]:
    """
    Register a class under its names in XML files; return a decorator.

    Parameters
    ----------
    *names
        The names; by default that of the class.

    """

    def keep(kind: type[TreeNode]) -> type[TreeNode]:
        for name in names or (kind.__name__,):
            _TYPES[name] = kind
        return kind

    return keep


def registered_types() -> dict[str, type[TreeNode]]:
    """Return all registered node types by their names."""
    for module in _MODULES:
        importlib.import_module(f'nav2_behavior_tree.nodes.{module}')
    return _TYPES


def node_type(name: str) -> type[TreeNode] | None:
    """
    Look up the class of a node type.

    Parameters
    ----------
    name
        Its name in XML files.

    Returns
    -------
    type of TreeNode or None
        None if it is not registered.

    """
    return registered_types().get(name)


def unknown_type(name: str, further: list[str]) -> str:
    """
    Explain that there is no such node type, and suggest a similar name.

    Parameters
    ----------
    name
        The name in the XML file.
    further
        Further candidates, such as the names of trees.

    Returns
    -------
    str
        One or two sentences.

    """
    if name in _RENAMED:
        return f"BehaviorTree.CPP v4 has no '{name}'; it is '{_RENAMED[name]}' there."
    if name in _MISSING:
        return f"The node type '{name}' is not available: {_MISSING[name]}."
    meant = did_you_mean(name, [*_TYPES, *further], 0.6)
    return f"There is no node type '{name}'.{meant}"
