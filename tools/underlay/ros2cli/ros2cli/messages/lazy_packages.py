# SPDX-License-Identifier: Apache-2.0
"""
Import of a package of interfaces only those that are used.

The `__init__.py` that rosidl generates for the messages of a package imports each of them from a
module of its own. A command needs one or two of them. Here the same lines tell which module has a
name, and that module is imported when the name is first used.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from importlib.machinery import ModuleSpec, PathFinder
import os
import sys
from types import ModuleType
from typing import Any

KINDS = ('msg', 'srv', 'action')


def import_interfaces_when_used() -> None:
    """Let the import system treat packages of interfaces so, from now on."""
    if not any(isinstance(finder, _Finder) for finder in sys.meta_path):
        sys.meta_path.insert(0, _Finder())


class _Finder:
    """Finds `package.msg` and the like, if nothing but imports is in it."""

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return how to load a package of interfaces, None for any other module."""
        _, _, kind = name.rpartition('.')
        if kind not in KINDS or path is None:
            return None
        spec = PathFinder.find_spec(name, path, target)
        if spec is None or os.path.basename(spec.origin or '') != '__init__.py':
            return None
        modules = _modules_of_names(str(spec.origin))
        if modules:
            spec.loader = _Loader(modules)  # type: ignore[assignment]  # it has its methods
        return spec


class _Loader:
    """Makes a package whose names are imported when they are used."""

    def __init__(self, modules: dict[str, str]) -> None:
        """Keep which module has which name."""
        self._modules = modules

    def create_module(self, spec: ModuleSpec) -> None:
        """Leave it to the import system to make the module."""

    def exec_module(self, module: ModuleType) -> None:
        """Give the package its names."""
        module.__dict__['__getattr__'] = _getter(module, self._modules)
        module.__dict__['__dir__'] = lambda: sorted({*module.__dict__, *self._modules})
        module.__dict__['__all__'] = list(self._modules)


def _getter(module: ModuleType, modules: dict[str, str]) -> Callable[[str], Any]:
    def get(name: str) -> Any:
        if name not in modules:
            raise AttributeError(f"module '{module.__name__}' has no attribute '{name}'")
        value = getattr(import_module(modules[name]), name)
        setattr(module, name, value)
        return value

    return get


def _modules_of_names(path: str) -> dict[str, str]:
    """Return which module each name comes from; nothing if a line is no such import."""
    found = {}
    with open(path, encoding='utf-8') as lines:
        for line in lines:
            statement, _, _ = line.partition('#')
            words = statement.split()
            if not words:
                continue
            if len(words) != 4 or (words[0], words[2]) != ('from', 'import'):
                return {}
            found[words[3]] = words[1]
    return found
