# SPDX-License-Identifier: Apache-2.0
"""Preload the imports of Python nodes once, before their processes are forked."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from importlib import import_module
from importlib.util import find_spec
import os
import re
import sys
from typing import Any, Optional

_NAME = 'liblttng-ust'
_PREFIXES = ('lttng_ust_', 'ust_')  # of the function names, since version 2.13 and before
_SIZE_OF_A_SIGNAL_SET = 128

EARLY_VARIABLES = frozenset(
    ('RCL_ASSERT_RMW_ID_MATCHES', 'RMW_IMPLEMENTATION', 'ROS_PYTHON_CHECK_FIELDS')
)
"""Environment variables that are read when rclpy and messages are imported."""

# Modules and interfaces that every rclpy node uses.
_COMMON = (
    ('rclpy', ()),
    ('rclpy.executors', ()),
    ('rclpy.node', ()),
    ('rcl_interfaces.msg', ('ParameterEvent',)),
    ('rcl_interfaces.srv', ('DescribeParameters', 'GetParameters', 'GetParameterTypes')),
    ('rcl_interfaces.srv', ('ListParameters', 'SetParameters', 'SetParametersAtomically')),
)
# Importing these has no side effects apart from memory use.
_HARMLESS = frozenset(('numpy', 'rclpy', 'yaml'))
# Entry point reference in the console scripts that setuptools installs.
_ENTRY_POINT = re.compile(
    r"""['"]([^'"=]+)(?:==[^'"]*)?['"], *['"]console_scripts['"], *['"]([^'"]+)"""
)
_MOST_MODULES = 300

Import = tuple[str, tuple[str, ...]]
"""A module and the names imported from it."""


class _Tracing:
    """
    Fork handler of the LTTng-UST library that rclpy loads, which has its own threads.

    The library must be notified of each fork, and restarts its threads in the child process;
    without that, the child crashes on exit.
    """

    def __init__(self) -> None:
        """Create a handler; libraries are looked up on `before_fork`."""
        self._after: list[Callable[[Any], None]] = []
        self._signals: Any = None

    def before_fork(self) -> None:
        """Notify the library of an imminent fork."""
        import ctypes

        self._signals = ctypes.create_string_buffer(_SIZE_OF_A_SIGNAL_SET)
        for path in _loaded_paths():
            library = ctypes.PyDLL(path)
            for prefix in _PREFIXES:
                if hasattr(library, f'{prefix}before_fork'):
                    getattr(library, f'{prefix}before_fork')(self._signals)
                    self._after.append(getattr(library, f'{prefix}after_fork_child'))
                    break

    def after_fork(self) -> None:
        """Restart the library in the child process."""
        for function in self._after:
            function(self._signals)


def _loaded_paths() -> list[str]:
    """Return the paths of the LTTng-UST libraries that this process has loaded."""
    with open('/proc/self/maps') as file:
        paths = {line.rstrip('\n').partition('/')[2] for line in file}
    return sorted(f'/{path}' for path in paths if os.path.basename(path).startswith(_NAME))


_tracing = _Tracing()


def preload(scripts: Sequence[str]) -> None:
    """
    Import what Python nodes need: rclpy, numpy, yaml and the type supports of interfaces.

    None of it is initialised, so that processes can be forked afterwards.

    Parameters
    ----------
    scripts
        Paths of the Python programs that will be forked from this process.

    """
    for module, names in (*_COMMON, *imports_of(scripts)):
        package = module.partition('.')[0]
        if package in _HARMLESS:
            _import(module)
        elif _holds_interfaces(package):
            _load_type_supports(_import(module), names)
    sys.modules['rclpy'].get_rmw_implementation_identifier()


def before_fork() -> None:
    """Prepare libraries for a fork of the process."""
    _tracing.before_fork()


def after_fork() -> None:
    """Restore libraries in the child process after a fork."""
    _tracing.after_fork()
    if 'numpy.random' in sys.modules:
        sys.modules['numpy.random'].seed()


def _import(module: str) -> Any:
    """Import a module; None if that fails, as the node itself will report the error."""
    try:
        return import_module(module)
    except ImportError:
        return None


def _holds_interfaces(package: str) -> bool:
    """Whether a package holds generated interfaces (messages, services or actions)."""
    spec = find_spec(package)
    folders = (spec.submodule_search_locations or ()) if spec is not None else ()
    library = f'{package}_s__rosidl_typesupport_c.'
    return any(name.startswith(library) for folder in folders for name in os.listdir(folder))


def _load_type_supports(module: Any, names: Sequence[str]) -> None:
    """Load the type support libraries of interfaces."""
    from rclpy.type_support import check_for_type_support

    for name in names:
        interface = getattr(module, name, None)
        if isinstance(interface, type):
            check_for_type_support(interface)


def imports_of(scripts: Sequence[str]) -> Iterator[Import]:
    """
    Yield the imports of Python scripts from outside the workspace, without running them.

    The sources of modules that are not installed with this Python are searched in turn, up to a
    fixed number. Console scripts that setuptools installed are resolved to their entry points.

    Parameters
    ----------
    scripts
        Paths of Python files; files that cannot be read or parsed yield nothing.

    Yields
    ------
    Import
        A module outside the workspace and the names imported from it.

    """
    waiting = [item for script in scripts for item in _imports_of_script(script)]
    seen: set[Import] = set()
    while waiting and len(seen) < _MOST_MODULES:
        item = waiting.pop()
        if item in seen:
            continue
        seen.add(item)
        path = _workspace_file(item[0])
        if path is None:
            yield item
        else:
            waiting += _imports_in(path)
            waiting += [(f'{item[0]}.{name}', ()) for name in item[1]]


def _imports_of_script(script: str) -> Iterator[Import]:
    from importlib.metadata import distribution, PackageNotFoundError

    yield from _imports_in(script)
    for project, name in _ENTRY_POINT.findall(_text(script)):
        try:
            points = distribution(project).entry_points
        except PackageNotFoundError:
            continue
        for point in points:
            if point.group == 'console_scripts' and point.name == name:
                yield point.value.partition(':')[0].strip(), ()


def _imports_in(path: str) -> Iterator[Import]:
    """Yield the top-level imports of a file."""
    import ast

    try:
        tree = ast.parse(_text(path))
    except (SyntaxError, ValueError):
        return
    for statement in tree.body:
        if isinstance(statement, ast.Import):
            yield from ((alias.name, ()) for alias in statement.names)
        elif isinstance(statement, ast.ImportFrom) and statement.module and not statement.level:
            yield statement.module, tuple(alias.name for alias in statement.names)


def _text(path: str) -> str:
    try:
        with open(path, encoding='utf-8') as file:
            return file.read()
    except (OSError, ValueError):
        return ''


def _workspace_file(module: str) -> Optional[str]:
    """Return the source file of a module outside this Python installation, or None."""
    top, *rest = module.split('.')
    if top in sys.stdlib_module_names:
        return None
    spec = find_spec(top)
    if spec is None or spec.origin is None or _belongs_to_python(spec.origin):
        return None
    base = spec.origin
    if rest:
        folder = os.path.dirname(base)
        base = os.path.join(folder, *rest)
        base = os.path.join(base, '__init__.py') if os.path.isdir(base) else f'{base}.py'
    return base if os.path.isfile(base) else None


def _belongs_to_python(path: str) -> bool:
    return path.startswith((f'{sys.prefix}{os.sep}', f'{sys.base_prefix}{os.sep}'))
