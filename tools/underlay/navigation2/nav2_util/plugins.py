# SPDX-License-Identifier: Apache-2.0
"""Find the classes of plugins by their official names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from importlib import import_module
from typing import Any, TYPE_CHECKING

from nav2_util.errors import ConfigurationError
from ros_environment import suggestions

if TYPE_CHECKING:
    from nav2_util.parameters import ParameterServer

__all__ = ['did_you_mean', 'find_plugin', 'plugin_type']


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


def plugin_type(
    parameters: ParameterServer, name: str, what: str, default: str, known: Iterable[str]
) -> str:
    """
    Declare the parameter with the type of a plugin, and read it.

    Parameters
    ----------
    parameters
        The parameters of the server.
    name
        The name of the plugin; the parameter is `name.plugin`.
    what
        The kind of the plugin, such as 'planner'.
    default
        The type if it is not set; '' if it must be set.
    known
        The official names of types, for the error message.

    Raises
    ------
    ConfigurationError
        It is not set, and has no default.

    """
    found = parameters.declare_value(f'{name}.plugin', default, f'The type of the {what}.')
    if not found:
        raise ConfigurationError(
            f"The parameter '{name}.plugin' is not set. It is the type of the {what}: "
            f'one of {", ".join(sorted(known))}.'
        )
    return str(found)


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
