# SPDX-License-Identifier: Apache-2.0
"""Change widgets only where they change, since all that is assigned is sent."""

from __future__ import annotations

from typing import Any

__all__ = ['assign']


def assign(widget: Any, **values: Any) -> None:
    """
    Set properties of a widget, skipping those that have the value already.

    viser sends every assignment to all browsers, changed or not.

    Parameters
    ----------
    widget
        A viser widget.
    **values
        The new values, by the name of the property.

    """
    for name, value in values.items():
        if getattr(widget, name) != value:
            setattr(widget, name, value)
