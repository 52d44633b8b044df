# SPDX-License-Identifier: Apache-2.0
"""Tags, substitutions and parsers that other packages provide as entry points."""

from __future__ import annotations

from functools import cache
from typing import Any, TYPE_CHECKING

from launch._entry_points import entry_points_of

if TYPE_CHECKING:
    from launch.frontend.parser import Parser

_TAGS = 'launch.frontend.launch_extension'
_PARSERS = 'launch.frontend.parser'


@cache
def load_extensions() -> None:
    """Import the modules that expose tags and substitutions."""
    _load_group(_TAGS, known=())


@cache
def extension_parsers() -> dict[str, type[Parser]]:
    """Return the parsers of other packages by name."""
    from launch.frontend._known_names import PARSERS

    return _load_group(_PARSERS, known=PARSERS)


def _load_group(group: str, known: Any) -> dict[str, Any]:
    """Load all entry points of a group; warn about those that cannot be loaded."""
    loaded = {}
    for point in entry_points_of(group):
        if point.name in known:
            continue
        try:
            loaded[point.name] = point.load()
        except Exception as error:
            _warn(group, point.name, point.value, error)
    return loaded


def _warn(group: str, name: str, value: str, error: Exception) -> None:
    import warnings

    warnings.warn(
        f"the extension '{name}' ({value}) of the group '{group}' cannot be loaded and is left "
        f'out: {type(error).__name__}: {error}',
        stacklevel=2,
    )
