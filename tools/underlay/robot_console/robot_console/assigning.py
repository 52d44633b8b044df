# SPDX-License-Identifier: Apache-2.0
"""Change widgets only where they change, since all that is assigned is sent."""

from __future__ import annotations

from typing import Any

__all__ = ['assign']


def assign(widget: Any, **values: Any) -> None:
    """Give a widget values, but not those that it has already."""
    for name, value in values.items():
        if getattr(widget, name) != value:
            setattr(widget, name, value)
