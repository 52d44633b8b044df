# SPDX-License-Identifier: Apache-2.0
"""Utilities for joining and classifying namespaces."""

from __future__ import annotations

from typing import Optional


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
