# SPDX-License-Identifier: Apache-2.0
"""
Deferred import: execute modules when one of their names is first used.

Libraries import all that they may ever use. The parts that a command hardly ever uses take a
third of its startup time.

So does the `__init__.py` that rosidl generates for the messages of a package: it imports each of
them from a module of its own, and a command needs one or two of them. Here the same lines are
parsed to map names to modules, and a module is imported when its name is first used.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from importlib.machinery import ModuleSpec, PathFinder
from importlib.util import module_from_spec
import os
import sys
from threading import RLock
from types import MethodType, ModuleType
from typing import Any

KINDS = ('msg', 'srv', 'action')


def defer(*names: str, **ready: Any) -> None:
    """
    Install top-level modules that are executed on first use; loaded modules stay as they are.

    Parameters
    ----------
    *names
        The modules.
    **ready
        Functions that are imported by name and work without executing the modules.

    """
    for name in names:
        module = defer_found(PathFinder.find_spec(name))
        if module is not None:
            module.__dict__.update(ready)


class _Deferred(ModuleType):
    """Module that is executed on the first attribute access."""

    def __getattr__(self, name: str) -> Any:
        if name == '__path__':  # queried by the import system, to detect a package
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
    """Execute a deferred module, which turns it into an ordinary one; other threads wait."""
    spec = module.__spec__
    _in_execution.append(module)
    try:
        if spec is not None and spec.loader is not None:
            spec.loader.exec_module(module)
        module.__class__ = ModuleType
    finally:
        _in_execution.remove(module)


def defer_found(spec: ModuleSpec | None) -> ModuleType | None:
    """
    Install a module that is executed on first use.

    Parameters
    ----------
    spec
        The module spec; None if there is none.

    Returns
    -------
    ModuleType or None
        The module; None without a spec, or if the module is loaded already.

    """
    if spec is None or spec.name in sys.modules:
        return None
    module = module_from_spec(spec)
    module.__class__ = _Deferred
    sys.modules[spec.name] = module
    return module


def import_rclpy() -> None:
    """
    Import rclpy, unless it is imported already.

    Its C library loads a hundred others. By default Python resolves all their symbols at once
    (RTLD_NOW); here each is bound on first call, as in any C program, and most never are. Most
    of the messages that rclpy imports are never used either.
    """
    if 'rclpy' in sys.modules:
        return
    defer('inspect', ismethod=_is_method)
    defer('linecache', 'pathlib', 'textwrap')
    import_interfaces_when_used()
    flags = sys.getdlopenflags()
    sys.setdlopenflags(os.RTLD_LAZY)
    try:
        import rclpy.impl.implementation_singleton
    finally:
        sys.setdlopenflags(flags)
    assert rclpy


def _is_method(candidate: object) -> bool:
    """Stand in for `inspect.ismethod`, which rclpy imports by its name."""
    return isinstance(candidate, MethodType)


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
