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
    """Return the class of a service, or raise ValueError."""
    try:
        return get_passed_type(type_name, 'srv')
    except RuntimeError as error:
        raise ValueError(str(error)) from error


def template(kind: Any) -> str:
    """Return a request with its defaults, as YAML; '' if it has no fields."""
    request = kind.Request()
    return to_yaml(request) if request.get_fields_and_field_types() else ''


def fields_text(kind: Any, part: str = 'Request') -> str:
    """Return the fields of a request or a response with their types, in one line."""
    fields = getattr(kind, part).get_fields_and_field_types()
    return ', '.join(f'{name}: {IDL_NAMES.get(each, each)}' for name, each in fields.items())


def filled(kind: Any, text: str, now: Any) -> Any:
    """Return the request that a text in YAML stands for, or raise ValueError."""
    try:
        return OutgoingMessage(kind.Request(), text).stamped(now)
    except UNDERSTOOD as error:
        raise ValueError(str(error)) from error


def response_text(response: Any) -> str:
    """Return a response as YAML, shortened."""
    if not response.get_fields_and_field_types():
        return 'Done. The response has no fields.'
    text = to_yaml(response, SHORT)
    if len(text) <= LONGEST:
        return text
    return f'{text[:LONGEST]}\n... ({len(text) - LONGEST} letters more)'
