# SPDX-License-Identifier: Apache-2.0
"""
What elements of lists are called.

Messages say it in two ways: with a list of names beside the others, as `name` of a JointState; or
with a text in each element, as `child_frame_id` of transforms.
"""

from __future__ import annotations

from collections.abc import Mapping

from robot_console.plots.field_types import element_type, is_text

__all__ = ['name_field', 'names_fields']

NAME_FIELDS = ('name', 'child_frame_id', 'key', 'id', 'class_id')


def names_fields(fields: Mapping[str, str]) -> list[str]:
    """
    Find the fields of a message that list names for the elements of its other lists.

    Parameters
    ----------
    fields
        The types of the fields of the message, by name.

    Returns
    -------
    list of str
        Lists of texts whose name ends with `name` or `names`, such as `name` of a JointState.

    """
    return [
        name
        for name, kind in fields.items()
        if name.endswith(('name', 'names')) and is_text(element_type(kind) or '')
    ]


def name_field(fields: Mapping[str, str]) -> str | None:
    """
    Find the field of a message that identifies it among others in a list.

    Parameters
    ----------
    fields
        The types of the fields of the message, by name.

    Returns
    -------
    str or None
        Such as `child_frame_id` of a transform; None if there is no such text.

    """
    return next((name for name in NAME_FIELDS if is_text(fields.get(name, ''))), None)
