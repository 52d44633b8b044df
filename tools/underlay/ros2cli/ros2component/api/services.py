# SPDX-License-Identifier: Apache-2.0
"""The container services, from a package that may not be installed."""

from __future__ import annotations

from typing import Any


def container_services() -> Any:
    """Return the module with the service classes; raise RuntimeError if it is not installed."""
    try:
        from composition_interfaces import srv
    except ImportError as error:
        raise RuntimeError(
            "The package 'composition_interfaces' cannot be imported, and without it no container "
            f'can be asked: {error}. Is it built, and the environment sourced?'
        ) from error
    return srv
