# SPDX-License-Identifier: Apache-2.0
"""Find the Python class of an interface by its name."""

from __future__ import annotations

from importlib import import_module
from typing import Any


class UnknownType(Exception):
    """A name stands for no interface that is installed."""


def get_message(name: str) -> Any:
    """Return the class of a message, named `package/msg/Type` or `package/Type`."""
    parts = name.split('/')
    if len(parts) == 2:
        parts.insert(1, 'msg')
    if len(parts) != 3 or parts[1] != 'msg' or not all(part.isidentifier() for part in parts):
        raise UnknownType(
            f"'{name}' is not of the form 'package/msg/Type', for example 'std_msgs/msg/String'"
        )
    package, kind, type_name = parts
    try:
        module = import_module(f'{package}.{kind}')
    except ModuleNotFoundError as error:
        raise UnknownType(_no_package_text(package, kind)) from error
    message = getattr(module, type_name, None)
    if not hasattr(message, 'get_fields_and_field_types'):
        raise UnknownType(_no_type_text(f'{package}/{kind}', type_name, vars(module)))
    return message


def _no_package_text(package: str, kind: str) -> str:
    return (
        f"the package '{package}' with its '{kind}' folder cannot be imported: is it "
        'installed, or built and sourced?'
    )


def _no_type_text(folder: str, name: str, names: dict[str, Any]) -> str:
    from ros2cli.suggest import did_you_mean

    known = [known for known in names if known[:1].isupper()]
    return f"'{folder}' has no type '{name}'. {did_you_mean(name, known)}".rstrip()
