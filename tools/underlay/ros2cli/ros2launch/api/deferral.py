# SPDX-License-Identifier: Apache-2.0
"""
Import asyncio without the modules that a launch does not need.

asyncio imports all it may ever use; TLS, the inspection of signatures and what prints
tracebacks take a third of the time in which a launch starts. Here these modules are executed when
one of their names is first used, which in a launch is nearly never.
"""

from __future__ import annotations

from importlib.machinery import PathFinder
import sys

from ros2cli.deferral import defer, defer_found

WHOLE_MODULES = ('inspect', 'linecache', 'ssl', 'textwrap')
"""What asyncio and logging import, and use only where something goes wrong."""


def import_asyncio() -> None:
    """Import asyncio, unless it is there already, and leave for later what can wait."""
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
