# SPDX-License-Identifier: Apache-2.0
"""Check the type of an argument."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Optional, Union


def ensure_argument_type(
    argument: Any,
    types: Union[type, Iterable[type]],
    argument_name: str,
    caller: Optional[str] = None,
) -> None:
    """
    Check the type of an argument.

    Parameters
    ----------
    argument
        The value of the argument.
    types
        The class, or the classes, of which it must be an instance.
    argument_name
        Its name, for the error.
    caller
        The owner of the argument, for the error.

    Raises
    ------
    TypeError
        The argument has another type.

    """
    allowed = (types,) if isinstance(types, type) else tuple(types)
    if isinstance(argument, allowed):
        return
    names = ' or '.join(f"'{each.__name__}'" for each in allowed)
    where = f" of '{caller}'" if caller else ''
    raise TypeError(
        f"Expected '{argument_name}'{where} to be {names}, "
        f"but got '{argument!r}' of type '{type(argument)}'"
    )
