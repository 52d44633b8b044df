# SPDX-License-Identifier: Apache-2.0
"""The classes that installed packages offer as entry points, and the names of their entries."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib.metadata import entry_points
from typing import Any

__all__ = [
    'DISPLAYS',
    'PANELS',
    'PANELS_ON_DEMAND',
    'TOOLS',
    'load_plugin',
    'name_of',
    'plugin_names',
]

DISPLAYS = 'rviz_common.displays'
PANELS = 'rviz_common.panels'
TOOLS = 'rviz_common.tools'
PANELS_ON_DEMAND = 'rviz_common.panels_on_demand'
"""Panels that appear automatically when their subject is available."""


def plugin_names(group: str) -> list[str]:
    """
    List the classes that installed packages offer in a group of plugins, sorted.

    Parameters
    ----------
    group
        The group of entry points, such as `DISPLAYS`.

    Returns
    -------
    list[str]
        Names as in .rviz files, such as `rviz_default_plugins/Grid`.

    """
    return sorted(_plugins(group))


def load_plugin(group: str, name: str) -> Any:
    """
    Import the class of a plugin.

    Parameters
    ----------
    group
        The group of entry points, such as `DISPLAYS`.
    name
        The name of the class as in .rviz files, such as `rviz_default_plugins/Grid`.

    Returns
    -------
    Any
        The class.

    Raises
    ------
    LookupError
        No installed package offers it.
    ImportError
        The module of the class cannot be imported.

    """
    try:
        return _plugins(group)[name].load()
    except KeyError:
        raise LookupError(name) from None


def name_of(given: Mapping[str, Any] | None, class_name: str) -> str:
    """
    Return the name of an entry of a .rviz file.

    Parameters
    ----------
    given
        The entry, None for a new one.
    class_name
        Its class, such as `rviz_default_plugins/Grid`, whose last part is the default name.

    """
    return str((given or {}).get('Name') or class_name.partition('/')[2])


@cache
def _plugins(group: str) -> dict[str, Any]:
    return {each.name: each for each in entry_points(group=group)}
