# SPDX-License-Identifier: Apache-2.0
"""Check whether the Nav2 messages are available: they are optional, and built by `make setup`."""

from __future__ import annotations

from importlib import import_module
from typing import Any

__all__ = ['MISSING', 'interface', 'is_built']

MISSING = (
    'The message package nav2_msgs is not built. Run `make setup` in the project, source the '
    'workspace again, and start this page again.'
)


def is_built() -> bool:
    """Whether nav2_msgs is available."""
    try:
        interface('msg', 'ParticleCloud')
    except ImportError:
        return False
    return True


def interface(kind: str, name: str) -> Any:
    """
    Get a class of nav2_msgs.

    Parameters
    ----------
    kind
        `msg`, `srv` or `action`.
    name
        The name of the class, such as `NavigateToPose`.

    Raises
    ------
    ImportError
        The package is not built; the text is a full sentence.

    """
    try:
        return getattr(import_module(f'nav2_msgs.{kind}'), name)
    except (ImportError, AttributeError) as error:
        raise ImportError(MISSING) from error
