# SPDX-License-Identifier: Apache-2.0
"""Suggestions for misspelt fields of a message."""

from __future__ import annotations

from ros2cli.suggest import did_you_mean


def field_hint(error: Exception) -> str:
    """
    Return a question that suggests the field probably meant, or ''.

    Parameters
    ----------
    error
        The error of setting or reading a field; only an AttributeError has a hint.

    """
    fields: dict[str, str] = getattr(
        getattr(error, 'obj', None), 'get_fields_and_field_types', dict[str, str]
    )()
    return did_you_mean(getattr(error, 'name', None) or '', fields)
