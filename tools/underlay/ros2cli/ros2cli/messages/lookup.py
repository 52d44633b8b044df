# SPDX-License-Identifier: Apache-2.0
"""Find the Python class of an interface by its name, and hint at misspelt types and fields."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ros_environment.suggestions import did_you_mean

KINDS = {'msg': 'message', 'srv': 'service', 'action': 'action'}
EVENT = '_Event'
EXAMPLES = {
    'msg': 'std_msgs/msg/String',
    'srv': 'std_srvs/srv/Trigger',
    'action': 'tf2_msgs/action/LookupTransform',
}


class UnknownType(Exception):
    """A name does not denote an installed interface."""


class WrongKind(UnknownType):
    """A name denotes the wrong kind of interface, such as a message instead of a service."""


def get_message(name: str) -> Any:
    """
    Import the class of a message.

    Parameters
    ----------
    name
        `package/msg/Type` or `package/Type`, or `package/srv/Type_Event` for the events of a
        service.

    Returns
    -------
    Any
        The class.

    Raises
    ------
    UnknownType
        There is no such message; WrongKind if the name is that of a service or action.

    """
    if '/srv/' in name and name.endswith(EVENT):
        return _get_interface(name.removesuffix(EVENT), 'srv').Event
    return _get_interface(name, 'msg')


def get_passed_type(name: str, kind: str) -> Any:
    """
    Import the class of an interface that the user names.

    Parameters
    ----------
    name
        `package/kind/Type` or `package/Type`.
    kind
        `msg`, `srv` or `action`.

    Returns
    -------
    Any
        The class.

    Raises
    ------
    RuntimeError
        There is no such interface of this kind.

    """
    try:
        return _get_interface(name, kind)
    except UnknownType as error:
        text = f'The passed {KINDS[kind]} type is invalid'
        if isinstance(error, WrongKind) and kind == 'srv':
            text = 'The passed type is not a service'
        raise RuntimeError(f'{text}\n{error}') from error


def type_name(interface: Any) -> str:
    """
    Return the name of an interface, such as `package/msg/Type`.

    Parameters
    ----------
    interface
        Its class.

    """
    package, kind = interface.__module__.split('.')[:2]
    return f'{package}/{kind}/{interface.__name__}'


def _get_interface(name: str, kind: str) -> Any:
    package, folder, short_name = _parts(name, kind)
    if folder != kind:
        error = WrongKind if folder in EXAMPLES else UnknownType
        raise error(_form_text(name, kind))
    try:
        module = import_module(f'{package}.{kind}')
    except ModuleNotFoundError as error:
        raise UnknownType(_no_package_text(package, kind)) from error
    except ImportError as error:  # it exists, and its error names the missing dependency
        raise UnknownType(f"'{package}' cannot be imported: {error}") from error
    interface = getattr(module, short_name, None)
    if not isinstance(interface, type):
        raise UnknownType(_no_type_text(f'{package}/{kind}', short_name, dir(module)))
    return interface


def _parts(name: str, kind: str) -> list[str]:
    parts = name.split('/')
    if len(parts) == 2:
        parts.insert(1, kind)
    if len(parts) != 3 or not all(part.isidentifier() for part in parts):
        raise UnknownType(_form_text(name, kind))
    return parts


def _form_text(name: str, kind: str) -> str:
    return f"'{name}' is not of the form 'package/{kind}/Type', for example '{EXAMPLES[kind]}'"


def _no_package_text(package: str, kind: str) -> str:
    return (
        f"the package '{package}' with its '{kind}' folder cannot be imported: is it "
        'installed, or built and sourced?'
    )


def _no_type_text(folder: str, name: str, names: list[str]) -> str:
    known = [known for known in names if known[:1].isupper()]
    return f"'{folder}' has no type '{name}'. {did_you_mean(name, known)}".rstrip()


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
