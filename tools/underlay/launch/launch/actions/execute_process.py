# SPDX-License-Identifier: Apache-2.0
"""The action that runs a command."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Optional, TYPE_CHECKING

from launch.actions.execute_local import ExecuteLocal
from launch.descriptions.executable import Executable, SomeVariables
from launch.some_substitutions_type import SomeSubstitutionsType

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser


class ExecuteProcess(ExecuteLocal):
    """
    Action that runs a command and watches over it.

    Parameters
    ----------
    cmd
        The program and its arguments; each item becomes one argument.
    prefix
        The command prefix, such as `gdb -ex run --args`.
    name
        The label in the log; by default the name of the program.
    cwd
        The working directory of the process.
    env
        The complete environment of the process.
    additional_env
        The variables that are added to its environment.
    **kwargs
        Keyword arguments of `ExecuteLocal`.

    """

    def __init__(
        self,
        *,
        cmd: Iterable[SomeSubstitutionsType],
        prefix: Optional[SomeSubstitutionsType] = None,
        name: Optional[SomeSubstitutionsType] = None,
        cwd: Optional[SomeSubstitutionsType] = None,
        env: Optional[SomeVariables] = None,
        additional_env: Optional[SomeVariables] = None,
        **kwargs: Any,
    ) -> None:
        description = Executable(
            cmd=cmd, prefix=prefix, name=name, cwd=cwd, env=env, additional_env=additional_env
        )
        super().__init__(process_description=description, **kwargs)

    @classmethod
    def parse(
        cls,
        entity: Entity,
        parser: Parser,
        ignore: Optional[Iterable[str]] = None,
    ) -> tuple[Any, dict[str, Any]]:
        """
        Read the attributes and the children of the element `executable`.

        Parameters
        ----------
        entity, parser
            As for `Action.parse`.
        ignore
            The names of attributes that are left to the caller.

        Returns
        -------
        tuple
            The class, and the keyword arguments for its constructor.

        """
        from launch.frontend._attributes import parse_process

        _, kwargs = super().parse(entity, parser)
        kwargs.update(parse_process(entity, parser, frozenset(ignore or ())))
        return cls, kwargs
