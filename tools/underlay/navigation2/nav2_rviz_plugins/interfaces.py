# SPDX-License-Identifier: Apache-2.0
"""Whether the message package of Nav2 is there: it is optional, and built by `make setup`."""

from __future__ import annotations

from importlib import import_module
from typing import Any

__all__ = ['MISSING', 'interface', 'is_built']

MISSING = (
    'The message package nav2_msgs is not built. Run `make setup` in the project, source the '
    'workspace again, and start this page anew.'
)


def is_built() -> bool:
    """Whether nav2_msgs can be used."""
    try:
        interface('msg', 'ParticleCloud')
    except ImportError:
        return False
    return True


def interface(kind: str, name: str) -> Any:
    """
    Return a class of nav2_msgs.

    Parameters
    ----------
    kind
        `msg`, `srv` or `action`.
    name
        Of the class, such as `NavigateToPose`.

    Raises
    ------
    ImportError
        with a sentence, if the package is not built.

    """
    try:
        return getattr(import_module(f'nav2_msgs.{kind}'), name)
    except (ImportError, AttributeError) as error:
        raise ImportError(MISSING) from error
