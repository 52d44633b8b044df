# SPDX-License-Identifier: Apache-2.0
"""Check the names of nodes and namespaces."""

from __future__ import annotations

import re

_TOKEN = re.compile(r'[A-Za-z_][A-Za-z0-9_]*')
_MAX_LENGTH = 255


class InvalidNameError(ValueError):
    """A name is not allowed in ROS; the text says why."""


def validate_node_name(name: str) -> None:
    """Raise an error unless this is the name of a node."""
    problem = _token_problem(name)
    if problem:
        raise InvalidNameError(f"Invalid node name: the name '{name}' {problem}")


def validate_namespace(namespace: str) -> None:
    """Raise an error unless this is an absolute namespace."""
    problem = _namespace_problem(namespace)
    if problem:
        raise InvalidNameError(f"Invalid namespace: the namespace '{namespace}' {problem}")


def _namespace_problem(namespace: str) -> str:
    if not namespace.startswith('/'):
        return 'must begin with a slash'
    if len(namespace) > _MAX_LENGTH:
        return f'is longer than {_MAX_LENGTH} characters'
    if namespace == '/':
        return ''
    if namespace.endswith('/'):
        return 'must not end with a slash'
    problems = (_token_problem(token) for token in namespace[1:].split('/'))
    return next((problem for problem in problems if problem), '')


def _token_problem(token: str) -> str:
    """Return what is wrong with a part of a name; empty if nothing is."""
    if not token:
        return 'has an empty part'
    if len(token) > _MAX_LENGTH:
        return f'is longer than {_MAX_LENGTH} characters'
    if token[0].isdigit():
        return f"has the part '{token}', which begins with a digit"
    if _TOKEN.fullmatch(token):
        return ''
    position = next(i for i, letter in enumerate(token) if not _TOKEN.fullmatch('_' + letter))
    return (
        f"has the character '{token[position]}'; only letters, digits and underscores are allowed"
    )
