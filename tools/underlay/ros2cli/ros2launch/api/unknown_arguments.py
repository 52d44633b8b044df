# SPDX-License-Identifier: Apache-2.0
"""Detection of launch arguments that no launch file declares."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

SIMILARITY = 0.8
MAGIC = frozenset(
    (
        'emulate_tty',
        'global_params',
        'launch-prefix',
        'launch-prefix-filter',
        'ros_namespace',
        'ros_remaps',
        'sigkill_timeout',
        'sigterm_timeout',
    )
)


class UnknownArguments:
    """
    Check of the given launch arguments against those that the launch declares or uses.

    It is called with the context after the launch has been visited, before any process starts.

    Parameters
    ----------
    given
        The names of the arguments given; those that launch itself understands are not checked.
    source
        The `LaunchDescriptionSource` of the launch file.

    """

    def __init__(self, given: Iterable[str], source: Any) -> None:
        self._given = [name for name in given if name not in MAGIC]
        self._source = source

    def __call__(self, context: Any) -> None:
        """Raise an error for a misspelt name; warn of other names that were never looked up."""
        unused = [name for name in self._unused(context) if not self._may_be_used(name, context)]
        declared = self._declared(context) if unused else set()
        unknown = [name for name in unused if name not in declared]
        text = misspelt_argument_text(unknown, declared)
        if text:
            raise RuntimeError(text)
        for name in unknown:
            _warn(name)

    def hint(self, context: Any) -> str:
        """
        Find a misspelt argument that may be why a visit has failed.

        Parameters
        ----------
        context
            The context of the launch, with the arguments declared and looked up so far.

        Returns
        -------
        str
            The error message; '' if no argument seems misspelt.

        """
        unused = self._unused(context)
        if not unused:
            return ''
        declared = self._declared(context)
        return misspelt_argument_text((name for name in unused if name not in declared), declared)

    def _unused(self, context: Any) -> list[str]:
        looked_up = context.launch_configurations.looked_up
        return [name for name in self._given if name not in looked_up]

    def _declared(self, context: Any) -> set[str]:
        """Return the names declared so far, and those in entities that were not visited."""
        declared = set(context.launch_configurations.declared)
        description = self._source.try_get_launch_description_without_context()
        if description is not None:
            declared.update(argument.name for argument in description.get_launch_arguments())
        return declared

    def _may_be_used(self, name: str, context: Any) -> bool:
        """Whether an entity that waits for an event looks a name up, or may do so."""
        from launch._preflight import may_look_up

        return bool(may_look_up(name, context))


def misspelt_argument_text(given: Iterable[str], declared: Iterable[str]) -> str:
    """
    Format the error message about the first undeclared argument that is close to a declared one.

    Parameters
    ----------
    given
        The names of the arguments given.
    declared
        The names that launch files declare.

    Returns
    -------
    str
        The message, which suggests the closest name; '' if there is no such argument.

    """
    from difflib import get_close_matches

    known = list(declared)
    for name in given:
        close = [] if name in known else get_close_matches(name, known, 1, SIMILARITY)
        if close:
            return (
                f"the launch file does not declare an argument '{name}'. "
                f"Did you mean '{close[0]}'? Pass --allow-unknown-args if "
                f"'{name}' is meant, or --show-args to see the arguments"
            )
    return ''


def _warn(name: str) -> None:
    from launch.logging import get_logger

    get_logger('launch').warning(
        "no launch file declares the argument '%s', and nothing has looked it up; --show-args "
        'shows the arguments, --allow-unknown-args silences this',
        name,
    )
