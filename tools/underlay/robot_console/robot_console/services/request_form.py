# SPDX-License-Identifier: Apache-2.0
"""Editing of service requests as YAML."""

from __future__ import annotations

from typing import Any

from ros2cli.messages.lookup import get_passed_type
from ros2cli.messages.outgoing import OutgoingMessage
from ros2cli.messages.plain import IDL_NAMES, Shortening
from ros2cli.messages.text import to_yaml

__all__ = ['fields_text', 'filled', 'response_text', 'service_class', 'template']

SHORT = Shortening(length=500)
LONGEST = 50_000
UNDERSTOOD = (RuntimeError, AssertionError, AttributeError, TypeError)


def service_class(type_name: str) -> Any:
    """
    Import the class of a service type.

    Parameters
    ----------
    type_name
        For example `std_srvs/srv/Trigger`.

    Raises
    ------
    ValueError
        The type is not installed or not a service type.

    """
    try:
        return get_passed_type(type_name, 'srv')
    except RuntimeError as error:
        raise ValueError(str(error)) from error


def template(kind: Any) -> str:
    """
    Format the default request of a service as YAML, for a user to edit.

    Parameters
    ----------
    kind
        The class of the service type.

    Returns
    -------
    str
        The YAML; '' if the request has no fields.

    """
    request = kind.Request()
    return to_yaml(request) if request.get_fields_and_field_types() else ''


def fields_text(kind: Any, part: str = 'Request') -> str:
    """
    List the fields of a request or response with their types, on one line.

    Parameters
    ----------
    kind
        The class of the service type.
    part
        `Request` or `Response`.

    """
    fields = getattr(kind, part).get_fields_and_field_types()
    return ', '.join(f'{name}: {IDL_NAMES.get(each, each)}' for name, each in fields.items())


def filled(kind: Any, text: str, now: Any) -> Any:
    """
    Parse a service request from YAML.

    Parameters
    ----------
    kind
        The class of the service type.
    text
        The YAML that the user has edited.
    now
        The current time, as a `builtin_interfaces/msg/Time`, for fields with an automatic stamp.

    Returns
    -------
    Any
        The request.

    Raises
    ------
    ValueError
        The text does not match the fields.

    """
    try:
        return OutgoingMessage(kind.Request(), text).stamped(now)
    except UNDERSTOOD as error:
        raise ValueError(str(error)) from error


def response_text(response: Any) -> str:
    """
    Format a service response as YAML, truncated if it is long.

    Parameters
    ----------
    response
        The response; without fields, a message is returned instead.

    """
    if not response.get_fields_and_field_types():
        return 'Done. The response has no fields.'
    text = to_yaml(response, SHORT)
    if len(text) <= LONGEST:
        return text
    return f'{text[:LONGEST]}\n... ({len(text) - LONGEST} letters more)'
