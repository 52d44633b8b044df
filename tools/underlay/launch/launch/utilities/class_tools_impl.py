# SPDX-License-Identifier: Apache-2.0
"""Type checks."""

from __future__ import annotations

from typing import Any


def is_a(entity: Any, of_type: type) -> bool:
    """
    Whether an object is an instance of a class.

    Parameters
    ----------
    entity
        The object.
    of_type
        The class.

    """
    return isinstance(entity, of_type)


def is_a_subclass(entity: Any, of_type: type) -> bool:
    """
    Whether an object is a subclass of a class, or an instance of it.

    Parameters
    ----------
    entity
        The object.
    of_type
        The other class.

    """
    if isinstance(entity, type):
        return issubclass(entity, of_type)
    return isinstance(entity, of_type)
