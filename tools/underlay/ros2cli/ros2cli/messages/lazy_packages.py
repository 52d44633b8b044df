# SPDX-License-Identifier: Apache-2.0
"""
Lazy import of interface packages: only the interfaces that are used are loaded.

The `__init__.py` that rosidl generates for the messages of a package imports each of them from a
module of its own. A command needs one or two of them. Here the same lines are parsed to map names
to modules, and a module is imported when its name is first used.
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
    """Install the import hook for interface packages."""
    if not any(isinstance(finder, _Finder) for finder in sys.meta_path):
        sys.meta_path.insert(0, _Finder())


class _Finder:
    """Meta path finder for `package.msg` and the like that contain nothing but imports."""

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return the spec of an interface package; None for any other module."""
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
    """Loader of a package whose names are imported on first use."""

    def __init__(self, modules: dict[str, str]) -> None:
        """Initialize with the modules by name."""
        self._modules = modules

    def create_module(self, spec: ModuleSpec) -> None:
        """Use the default module creation."""

    def exec_module(self, module: ModuleType) -> None:
        """Add the lazily imported names to the package."""
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
    """Return the module of each name; nothing if any line is not such an import."""
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
