# SPDX-License-Identifier: Apache-2.0
"""The services of a container, from a package that may not be installed."""

from __future__ import annotations

from typing import Any


def container_services() -> Any:
    """Return the module with the classes of the services; RuntimeError if there is none."""
    try:
        from composition_interfaces import srv
    except ImportError as error:
        raise RuntimeError(
            "The package 'composition_interfaces' cannot be imported, and without it no container "
            f'can be asked: {error}. Is it built, and the environment sourced?'
        ) from error
    return srv
