# SPDX-License-Identifier: Apache-2.0
"""
The name and the namespace of a node: expand and validate them.

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
from launch_ros.utilities.namespace_utils import make_namespace_absolute, prefix_namespace

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
