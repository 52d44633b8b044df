# SPDX-License-Identifier: Apache-2.0
"""Find the classes of plugins by their official names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from importlib import import_module
from typing import Any

from nav2_util.errors import ConfigurationError
from ros_environment import suggestions

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
    question = suggestions.did_you_mean(name, known, cutoff, ignore_case=True)
    return f' {question}' if question else ''
