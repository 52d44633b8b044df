# SPDX-License-Identifier: Apache-2.0
"""Find the classes of plugins by their official names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
import difflib
from importlib import import_module
from typing import Any

from nav2_util.errors import ConfigurationError

__all__ = ['did_you_mean', 'find_plugin']


def find_plugin(known: Mapping[str, str], name: str, what: str) -> Any:
    """
    Import the class of a plugin.

    Parameters
    ----------
    known
        The import paths of classes, as `module:Class`, by official names such as
        `nav2_navfn_planner::NavfnPlanner`.
    name
        The official name; older parameter files use `/` instead of `::`.
    what
        The kind of the plugin, such as 'planner'.

    Raises
    ------
    ConfigurationError
        There is no such plugin.

    """
    place = known.get(name.replace('/', '::'))
    if place is None:
        advice = did_you_mean(name.replace('/', '::'), known)
        raise ConfigurationError(
            f"There is no {what} of type '{name}'.{advice} These exist: {', '.join(known)}."
        )
    module, _, attribute = place.partition(':')
    return getattr(import_module(module), attribute)


def did_you_mean(name: str, known: Iterable[str], cutoff: float = 0.5) -> str:
    """
    Suggest the most similar known name, as a sentence after a space, or ''.

    Parameters
    ----------
    name
        The given name; case is ignored.
    known
        The known names.
    cutoff
        The minimum similarity, from 0 to 1, as in difflib.

    """
    lower = {each.lower(): each for each in known}
    close = difflib.get_close_matches(name.lower(), list(lower), 1, cutoff)
    return f" Did you mean '{lower[close[0]]}'?" if close else ''
