# SPDX-License-Identifier: Apache-2.0
"""Event handlers for launch descriptions under test."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch_testing.event_handlers.stdout_ready_listener import StdoutReadyListener

__all__ = ['StdoutReadyListener']

__getattr__, __dir__ = lazy_exports(__name__, __all__)
