# SPDX-License-Identifier: Apache-2.0
"""Assignment of changed widget properties only, since viser sends every assignment."""

from __future__ import annotations

from typing import Any

__all__ = ['assign']


def assign(widget: Any, **values: Any) -> None:
    """
    Set properties of a widget, skipping those that already have the value.

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
