# SPDX-License-Identifier: Apache-2.0
"""The text of an error, for people."""

from __future__ import annotations

_TOO_DEEP = (
    '{error}\nThe launch file nests groups or other actions too deep, or a function in it calls '
    'itself for ever.'
)


def error_text(error: BaseException) -> str:
    """Return the text of an error; one of Python's that says little is explained."""
    if isinstance(error, RecursionError):
        return _TOO_DEEP.format(error=error)
    return str(error)
