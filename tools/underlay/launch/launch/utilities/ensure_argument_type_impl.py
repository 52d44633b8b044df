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
    """Raise a TypeError unless `argument` is an instance of one of `types`."""
    allowed = (types,) if isinstance(types, type) else tuple(types)
    if isinstance(argument, allowed):
        return
    names = ' or '.join(f"'{each.__name__}'" for each in allowed)
    where = f" of '{caller}'" if caller else ''
    raise TypeError(
        f"Expected '{argument_name}'{where} to be {names}, "
        f"but got '{argument!r}' of type '{type(argument)}'"
    )
