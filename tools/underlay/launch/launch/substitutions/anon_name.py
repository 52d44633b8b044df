# SPDX-License-Identifier: Apache-2.0
"""A unique name."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

_FORBIDDEN = str.maketrans('.-:', '___')


class AnonName(Substitution):
    """
    Substitution of a name made unique; the same name always gives the same result.

    Parameters
    ----------
    name
        The name.

    """

    frontend_required = ('name',)

    def __init__(self, name: SomeSubstitutionsType) -> None:
        self.__name = normalize_to_list_of_substitutions(name)

    @property
    def name(self) -> list[Substitution]:
        """Return the name as a list of substitutions."""
        return self.__name

    def describe(self) -> str:
        """Return a short human-readable description."""
        return f'AnonName({" + ".join(sub.describe() for sub in self.__name)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the unique name, which is stored in the launch configuration `anonNAME`.

        Parameters
        ----------
        context
            The launch context, in which the name is performed.

        """
        name = perform_substitutions(context, self.__name)
        remembered: str = context.launch_configurations.setdefault(
            'anon' + name, unique_name(name)
        )
        return remembered


def unique_name(name: str) -> str:
    """
    Make a name unique: append the host name, the process id and a random number.

    Parameters
    ----------
    name
        The name.

    Returns
    -------
    str
        The unique name, in which `.`, `-` and `:` are replaced by `_`.

    """
    number = int.from_bytes(os.urandom(4), 'little')
    return f'{name}_{os.uname().nodename}_{os.getpid()}_{number}'.translate(_FORBIDDEN)
