# SPDX-License-Identifier: Apache-2.0
"""Requests of services as texts that somebody fills."""

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
        Such as `std_srvs/srv/Trigger`.

    Raises
    ------
    ValueError
        The type is not installed, or no service.

    """
    try:
        return get_passed_type(type_name, 'srv')
    except RuntimeError as error:
        raise ValueError(str(error)) from error


def template(kind: Any) -> str:
    """
    Format the default request of a service as YAML, for a person to edit.

    Parameters
    ----------
    kind
        The class of the service.

    Returns
    -------
    str
        The YAML; '' if the request has no fields.

    """
    request = kind.Request()
    return to_yaml(request) if request.get_fields_and_field_types() else ''


def fields_text(kind: Any, part: str = 'Request') -> str:
    """
    List the fields of a request or response with their types, in one line.

    Parameters
    ----------
    kind
        The class of the service.
    part
        `Request` or `Response`.

    """
    fields = getattr(kind, part).get_fields_and_field_types()
    return ', '.join(f'{name}: {IDL_NAMES.get(each, each)}' for name, each in fields.items())


def filled(kind: Any, text: str, now: Any) -> Any:
    """
    Fill a service request from YAML.

    Parameters
    ----------
    kind
        The class of the service.
    text
        The YAML that a person has edited.
    now
        The current time, as a `builtin_interfaces/msg/Time`, for stamps that ask for it.

    Returns
    -------
    Any
        The request.

    Raises
    ------
    ValueError
        The text does not fit the fields.

    """
    try:
        return OutgoingMessage(kind.Request(), text).stamped(now)
    except UNDERSTOOD as error:
        raise ValueError(str(error)) from error


def response_text(response: Any) -> str:
    """
    Format a service response as YAML, shortened if it is long.

    Parameters
    ----------
    response
        The response; one without fields gives a sentence.

    """
    if not response.get_fields_and_field_types():
        return 'Done. The response has no fields.'
    text = to_yaml(response, SHORT)
    if len(text) <= LONGEST:
        return text
    return f'{text[:LONGEST]}\n... ({len(text) - LONGEST} letters more)'
