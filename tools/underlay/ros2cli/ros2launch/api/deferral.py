# SPDX-License-Identifier: Apache-2.0
"""
Import asyncio without the modules that a launch does not need.

asyncio imports all that it may ever use; TLS, signature inspection and traceback formatting take
a third of the startup time of a launch. Here these modules are executed when one of their names
is first used, which hardly ever happens in a launch.
"""

from __future__ import annotations

from importlib.machinery import PathFinder
import sys

from ros2cli.deferral import defer, defer_found

WHOLE_MODULES = ('inspect', 'linecache', 'ssl', 'textwrap')
"""Modules that asyncio and logging import, but use only for errors."""


def import_asyncio() -> None:
    """Import asyncio, unless it is imported already, and defer modules that it rarely needs."""
    if 'asyncio' in sys.modules:
        return
    package = PathFinder.find_spec('asyncio')
    if package is None:
        return
    defer(*WHOLE_MODULES)
    tls = defer_found(PathFinder.find_spec('asyncio.sslproto', package.submodule_search_locations))
    import asyncio

    if tls is not None:
        asyncio.sslproto = tls  # type: ignore[attr-defined]  # as importing it would do
