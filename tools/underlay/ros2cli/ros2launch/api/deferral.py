# SPDX-License-Identifier: Apache-2.0
"""
Import asyncio without the modules that a launch does not need.

asyncio imports all it may ever use; TLS and the inspection of signatures alone take a quarter
of the time in which a launch starts. Here these modules are executed when one of their names
is first used, which in a launch is nearly never.
"""

from __future__ import annotations

from importlib.machinery import ModuleSpec, PathFinder
from importlib.util import module_from_spec
import sys
from threading import RLock
from types import ModuleType
from typing import Any


def import_asyncio() -> None:
    """Import asyncio, unless it is there already, and leave for later what can wait."""
    if 'asyncio' in sys.modules:
        return
    package = PathFinder.find_spec('asyncio')
    if package is None:
        return
    _defer(PathFinder.find_spec('inspect'))
    _defer(PathFinder.find_spec('ssl'))
    tls = _defer(PathFinder.find_spec('asyncio.sslproto', package.submodule_search_locations))
    import asyncio

    if tls is not None:
        asyncio.sslproto = tls  # type: ignore[attr-defined]  # as importing it would do


class _Deferred(ModuleType):
    """A module that is executed when an attribute is asked of it."""

    def __getattr__(self, name: str) -> Any:
        if name == '__path__':  # asked by the import system, to tell a package from a module
            raise AttributeError(name)
        with _lock:
            if type(self) is _Deferred and self not in _in_execution:
                _execute(self)
        if name in self.__dict__:
            return self.__dict__[name]
        raise AttributeError(f"module '{self.__name__}' has no attribute '{name}'")


_lock = RLock()
_in_execution: list[ModuleType] = []


def _execute(module: ModuleType) -> None:
    """Make an ordinary module of a deferred one; other threads wait until that is done."""
    spec = module.__spec__
    _in_execution.append(module)
    try:
        if spec is not None and spec.loader is not None:
            spec.loader.exec_module(module)
        module.__class__ = ModuleType
    finally:
        _in_execution.remove(module)


def _defer(spec: ModuleSpec | None) -> ModuleType | None:
    """Put a module into place that is not executed yet; do nothing if it is loaded."""
    if spec is None or spec.name in sys.modules:
        return None
    module = module_from_spec(spec)
    module.__class__ = _Deferred
    sys.modules[spec.name] = module
    return module
