# SPDX-License-Identifier: Apache-2.0
"""Human-readable error messages."""

from __future__ import annotations

_TOO_DEEP = (
    '{error}\nThe launch file nests groups or other actions too deep, or a function in it calls '
    'itself for ever.'
)


def error_text(error: BaseException) -> str:
    """
    Format an exception for the user.

    Parameters
    ----------
    error
        The exception; an explanation is added to a `RecursionError`.

    """
    if isinstance(error, RecursionError):
        return _TOO_DEEP.format(error=error)
    return str(error)
