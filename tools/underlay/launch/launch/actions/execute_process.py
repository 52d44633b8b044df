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
    """Runs a command and watches over it."""

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
        """
        Create the action; the other arguments are those of ExecuteLocal.

        :param cmd: the program and its arguments; each item becomes one argument
        :param prefix: what comes before the program, such as `gdb -ex run --args`
        :param name: the label in the log; the name of the program if it is left out
        :param cwd: the folder in which the process is started
        :param env: the whole environment of the process
        :param additional_env: what is added to its environment
        """
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
        """Return the class and its arguments; attributes to `ignore` are left to the caller."""
        from launch.frontend._process_attributes import parse_process

        _, kwargs = super().parse(entity, parser)
        kwargs.update(parse_process(entity, parser, frozenset(ignore or ())))
        return cls, kwargs
