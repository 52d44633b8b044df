# SPDX-License-Identifier: Apache-2.0
"""Lazy import of the public names of a package, and further paths to them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from importlib import import_module
import re
import sys
from typing import Any

_WORD_BORDER = re.compile(r'(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])')


def snake_case(name: str) -> str:
    """
    Convert the name of a class to that of its module.

    Parameters
    ----------
    name
        The name in CamelCase; `OnProcessExit` becomes `on_process_exit`.

    """
    return _WORD_BORDER.sub('_', name).lower()


def lazy_exports(
    package: str,
    names: Iterable[str],
    elsewhere: Mapping[str, str] | None = None,
) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """
    Create the `__getattr__` and `__dir__` of a package that imports its names lazily (PEP 562).

    Parameters
    ----------
    package
        The `__name__` of the package.
    names
        Its public names, each defined in the package or in the module of its snake_case name.
    elsewhere
        The modules of names defined elsewhere; an empty string marks a sub-package.

    Returns
    -------
    tuple of callable
        `__getattr__`, which suggests a close name in its AttributeError, and `__dir__`.

    """
    modules = {name: snake_case(name) for name in names}
    modules.update(elsewhere or {})

    def get(name: str) -> Any:
        if name not in modules:
            raise AttributeError(_unknown(package, name, modules))
        if not modules[name]:
            return import_module(f'{package}.{name}')
        value = getattr(import_module(f'{package}.{modules[name]}'), name)
        setattr(sys.modules[package], name, value)
        return value

    return get, lambda: sorted(modules)


def also_found_at(package: str, *modules: str) -> None:
    """
    Let the names of a package be imported from aliases of it as well, as from `os.path`.

    Parameters
    ----------
    package
        The `__name__` of the package, which is being imported.
    *modules
        The names of the modules, which have no files of their own.

    """
    for name in modules:
        sys.modules[f'{package}.{name}'] = sys.modules[package]
        vars(sys.modules[package]).setdefault(name, sys.modules[package])


def _unknown(package: str, name: str, known: Iterable[str]) -> str:
    """Format the error about an unknown name of a package, with a suggestion."""
    text = f"module '{package}' has no attribute '{name}'"
    if name.startswith('_'):
        return text
    from ros_environment.suggestions import closest_name

    close = closest_name(name, known)
    return text + (f". Did you mean: '{close}'?" if close else '')
