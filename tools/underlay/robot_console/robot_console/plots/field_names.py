# SPDX-License-Identifier: Apache-2.0
"""
Names of list elements in messages.

Messages provide them in two ways: as a list of names parallel to the others, such as `name` of a
JointState; or as a string field of each element, such as `child_frame_id` of transforms.
"""

from __future__ import annotations

from collections.abc import Mapping

from robot_console.plots.field_types import element_type, is_text

__all__ = ['name_field', 'names_fields']

NAME_FIELDS = ('name', 'child_frame_id', 'key', 'id', 'class_id')


def names_fields(fields: Mapping[str, str]) -> list[str]:
    """
    Find the fields of a message that contain names for the elements of its other lists.

    Parameters
    ----------
    fields
        The field types of the message, by field name.

    Returns
    -------
    list of str
        Lists of strings whose name ends with `name` or `names`, such as `name` of a JointState.

    """
    return [
        name
        for name, kind in fields.items()
        if name.endswith(('name', 'names')) and is_text(element_type(kind) or '')
    ]


def name_field(fields: Mapping[str, str]) -> str | None:
    """
    Find the field of a message that identifies it among the elements of a list.

    Parameters
    ----------
    fields
        The field types of the message, by field name.

    Returns
    -------
    str or None
        For example `child_frame_id` of a transform; None if there is no such string field.

    """
    return next((name for name in NAME_FIELDS if is_text(fields.get(name, ''))), None)
