# SPDX-License-Identifier: Apache-2.0
"""A widget for each kind of property."""

from __future__ import annotations

import math
from typing import Any

from rviz_common.properties import Choice, ColorOf, Flag, Number, Property, Vector, Whole
from viser import GuiApi

__all__ = ['add_widget']


def add_widget(gui: GuiApi, of: Property, value: Any) -> Any:
    """
    Add the widget for a kind of property.

    Parameters
    ----------
    gui
        Where to add it.
    of
        The property, whose type determines the kind of widget.
    value
        Its value.

    Returns
    -------
    Any
        The handle that viser has for the widget.

    """
    label, hint = of.path.rpartition('/')[2], of.description or None
    if isinstance(of, Flag):
        return gui.add_checkbox(label, value, hint=hint)
    if isinstance(of, Choice):
        return gui.add_dropdown(label, of.choices, initial_value=value, hint=hint)
    if isinstance(of, ColorOf):
        return gui.add_rgb(label, value, hint=hint)
    if isinstance(of, Vector):
        return gui.add_vector3(label, value, step=0.01, hint=hint)
    if isinstance(of, Number):
        return _add_number(gui, of, value, label, hint)
    return gui.add_text(label, str(value), hint=hint)


def _add_number(gui: GuiApi, of: Number, value: float, label: str, hint: str | None) -> Any:
    return gui.add_number(
        label,
        value,
        min=_limit(of.minimum),
        max=_limit(of.maximum),
        step=1 if isinstance(of, Whole) else 0.01,
        hint=hint,
    )


def _limit(limit: float) -> float | None:
    return limit if math.isfinite(limit) else None
