# SPDX-License-Identifier: Apache-2.0
"""
How nodes are named: namespaces are joined, names expanded and validated, and equal ones counted.

Valid names are recognised here; rclpy, which is slow to import, only explains invalid ones.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
import re
from typing import Any, Optional

from launch.launch_context import LaunchContext
from launch.logging import get_logger
from launch.substitution import Substitution
from launch.utilities import perform_substitutions

_UNKNOWN_NAME = '<node_name_unspecified>'
UNKNOWN_NAMESPACE = '<node_namespace_unspecified>'

_NODE_NAME = re.compile(r'(?=.{1,255}\Z)[A-Za-z_][A-Za-z0-9_]*')
_NAMESPACE = re.compile(r'/|(?=.{1,245}\Z)(/[A-Za-z_][A-Za-z0-9_]*)+')


@dataclass(frozen=True)
class NodeNames:
    """The name and the absolute namespace of a node; None for unknown parts."""

    name: Optional[str]
    namespace: Optional[str]

    @property
    def are_complete(self) -> bool:
        """Whether both the name and the namespace are known."""
        return self.name is not None and self.namespace is not None

    @property
    def described_namespace(self) -> str:
        """Return the namespace, or a placeholder if it is unknown."""
        return UNKNOWN_NAMESPACE if self.namespace is None else self.namespace

    @property
    def full_name(self) -> str:
        """Return the fully qualified name, with placeholders for unknown parts."""
        name = _UNKNOWN_NAME if self.name is None else self.name
        return f'{self.described_namespace.rstrip("/")}/{name}'

    @property
    def name_in_root(self) -> str:
        """Return the fully qualified name; an unknown namespace is taken as the root."""
        return NodeNames(self.name, self.namespace or '/').full_name

    @property
    def parameter_key(self) -> str:
        """Return the key of the node in parameter files; `/**` if its names are unknown."""
        return self.full_name if self.are_complete else '/**'

    def ros_specific_arguments(self) -> dict[str, str]:
        """Return the remapping rules for the name and the namespace, by `name` and `ns`."""
        arguments = {}
        if self.name is not None:
            arguments['name'] = f'__node:={self.name}'
        if self.namespace is not None:
            arguments['ns'] = f'__ns:={self.namespace}'
        return arguments


def expand_node_names(
    context: LaunchContext,
    name: Optional[list[Substitution]],
    namespace: Optional[list[Substitution]],
    what: str,
) -> NodeNames:
    """
    Expand and validate the name and the namespace of a node.

    Parameters
    ----------
    context
        The launch context; a relative namespace is below its configuration `ros_namespace`.
    name, namespace
        The substitutions of each; None if not given.
    what
        Description of the node for the log message if expansion or validation fails.

    Returns
    -------
    NodeNames
        The name and the absolute namespace; None for unknown parts.

    Raises
    ------
    InvalidNameError
        The name or the namespace is not allowed in ROS.

    """
    try:
        names = NodeNames(
            None if name is None else perform_substitutions(context, name),
            _expand_namespace(context, namespace),
        )
        _validate(names)
    except Exception:
        get_logger('launch_ros.actions.node').error(
            "Error while expanding or validating node name or namespace for '%s':", what
        )
        raise
    return names


def _expand_namespace(
    context: LaunchContext,
    namespace: Optional[list[Substitution]],
) -> Optional[str]:
    base = context.launch_configurations.get('ros_namespace')
    own = None if namespace is None else perform_substitutions(context, namespace)
    return make_namespace_absolute(prefix_namespace(base, own))


def _validate(names: NodeNames) -> None:
    if names.name is not None:
        validate_node_name(names.name)
    if names.namespace is not None:
        validate_namespace(names.namespace)


class InvalidNameError(ValueError):
    """A name is not allowed in ROS; the message states why, and where."""


def validate_node_name(name: str) -> None:
    """
    Validate a node name.

    Parameters
    ----------
    name
        The name, without a namespace.

    Raises
    ------
    InvalidNameError
        The name is not allowed in ROS; the message states why, and where.

    """
    if not _NODE_NAME.fullmatch(name):
        from rclpy.validate_node_name import validate_node_name as judge

        _let_judge(judge, name)


def validate_namespace(namespace: str) -> None:
    """
    Validate an absolute namespace.

    Parameters
    ----------
    namespace
        The namespace, with its leading slash.

    Raises
    ------
    InvalidNameError
        The name is not allowed in ROS; the message states why, and where.

    """
    if not _NAMESPACE.fullmatch(namespace):
        from rclpy.validate_namespace import validate_namespace as judge

        _let_judge(judge, namespace)


def _let_judge(judge: Callable[[str], Any], name: str) -> None:
    from rclpy.exceptions import NameValidationException

    try:
        judge(name)
    except NameValidationException as error:
        raise InvalidNameError(str(error)) from error


def is_root_namespace(namespace: Optional[str]) -> bool:
    """
    Whether a namespace is the root namespace.

    Parameters
    ----------
    namespace
        The namespace; None is not the root.

    """
    return namespace == '/'


def is_namespace_absolute(namespace: Optional[str]) -> bool:
    """
    Whether a namespace is absolute (starts with a slash).

    Parameters
    ----------
    namespace
        The namespace; None is not absolute.

    """
    return namespace is not None and namespace.startswith('/')


def make_namespace_absolute(namespace: Optional[str]) -> Optional[str]:
    """
    Prepend a slash to a relative namespace.

    Parameters
    ----------
    namespace
        The namespace; an absolute one, or None, is returned unchanged.

    """
    if namespace is None or is_namespace_absolute(namespace):
        return namespace
    return f'/{namespace}'


def prefix_namespace(base: Optional[str], namespace: Optional[str]) -> Optional[str]:
    """
    Join a namespace to a base, without a trailing slash.

    Parameters
    ----------
    base
        The parent of a relative namespace; None or empty leaves the namespace unchanged.
    namespace
        The namespace; an absolute one replaces the base, None stands for the base itself.

    Returns
    -------
    str or None
        The namespace, which is relative if the base is; None if both are None.

    """
    if namespace is None or is_namespace_absolute(namespace):
        combined = base if namespace is None else namespace
    elif not base:
        combined = namespace
    else:
        combined = f'{base.rstrip("/")}/{namespace}'
    if combined is None or is_root_namespace(combined):
        return combined
    return combined.rstrip('/') or '/' * combined.startswith('/')


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
