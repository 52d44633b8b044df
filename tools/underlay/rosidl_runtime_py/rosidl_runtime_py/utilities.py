# SPDX-License-Identifier: Apache-2.0
"""The Python class of an interface, by its name."""

from __future__ import annotations

from importlib import import_module
from typing import Any

__all__ = ['get_action', 'get_interface', 'get_message', 'get_service']


def get_interface(identifier: str) -> Any:
    """
    Import the class of a message, service or action.

    Parameters
    ----------
    identifier
        Its name, such as `std_msgs/msg/String`.

    Raises
    ------
    ValueError
        The name is not of this form.
    ModuleNotFoundError
        The package is not installed.
    AttributeError
        The package has no such interface.

    """
    parts = identifier.split('/')
    if len(parts) != 3 or not all(part.isidentifier() for part in parts):
        raise ValueError(
            f"Expected the full name of an interface, as 'std_msgs/msg/String', got '{identifier}'"
        )
    package, kind, name = parts
    return getattr(import_module(f'{package}.{kind}'), name)


def get_message(identifier: str) -> Any:
    """
    Import the class of a message.

    Parameters
    ----------
    identifier
        Its name, such as `std_msgs/msg/String`.

    Raises
    ------
    ValueError
        It is not the name of a message.
    ModuleNotFoundError, AttributeError
        As for `get_interface`.

    """
    return _of_kind(identifier, 'msg', 'message')


def get_service(identifier: str) -> Any:
    """
    Import the class of a service.

    Parameters
    ----------
    identifier
        Its name, such as `std_srvs/srv/Trigger`.

    Raises
    ------
    ValueError
        It is not the name of a service.
    ModuleNotFoundError, AttributeError
        As for `get_interface`.

    """
    return _of_kind(identifier, 'srv', 'service')


def get_action(identifier: str) -> Any:
    """
    Import the class of an action.

    Parameters
    ----------
    identifier
        Its name, such as `tf2_msgs/action/LookupTransform`.

    Raises
    ------
    ValueError
        It is not the name of an action.
    ModuleNotFoundError, AttributeError
        As for `get_interface`.

    """
    return _of_kind(identifier, 'action', 'action')


def _of_kind(identifier: str, kind: str, what: str) -> Any:
    if identifier.split('/')[1:2] != [kind]:
        raise ValueError(f"Expected the full name of a {what}, got '{identifier}'")
    return get_interface(identifier)
