# SPDX-License-Identifier: Apache-2.0
"""Put namespaces together."""

from __future__ import annotations

from typing import Optional


def is_root_namespace(namespace: Optional[str]) -> bool:
    """Return whether a namespace is the root."""
    return namespace == '/'


def is_namespace_absolute(namespace: Optional[str]) -> bool:
    """Return whether a namespace begins at the root."""
    return namespace is not None and namespace.startswith('/')


def make_namespace_absolute(namespace: Optional[str]) -> Optional[str]:
    """Return a namespace from the root on; None stays None."""
    if namespace is None or is_namespace_absolute(namespace):
        return namespace
    return f'/{namespace}'


def prefix_namespace(base: Optional[str], namespace: Optional[str]) -> Optional[str]:
    """Return a namespace below another, without a slash at the end; both may be None."""
    if namespace is None or is_namespace_absolute(namespace):
        combined = base if namespace is None else namespace
    elif not base:
        combined = namespace
    else:
        combined = f'{base.rstrip("/")}/{namespace}'
    if combined is None or is_root_namespace(combined):
        return combined
    return combined.rstrip('/') or '/' * combined.startswith('/')
