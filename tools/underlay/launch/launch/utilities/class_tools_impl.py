# SPDX-License-Identifier: Apache-2.0
"""Questions about classes."""

from __future__ import annotations

from typing import Any


def is_a(entity: Any, of_type: type) -> bool:
    """Return whether `entity` is an instance of a type."""
    return isinstance(entity, of_type)


def is_a_subclass(entity: Any, of_type: type) -> bool:
    """Return whether `entity` is a class derived from a type, or an instance of it."""
    if isinstance(entity, type):
        return issubclass(entity, of_type)
    return isinstance(entity, of_type)
