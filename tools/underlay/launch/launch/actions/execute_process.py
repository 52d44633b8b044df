# SPDX-License-Identifier: Apache-2.0
"""The action that runs a command."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Optional, TYPE_CHECKING

from launch.actions.execute_local import ExecuteLocal
from launch.descriptions.executable import Executable, SomeVariables
from launch.substitution import SomeSubstitutionsType

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser

# Attributes with substitutions, and the constructor arguments that they become.
_TEXTS = {
    'cwd': 'cwd',
    'launch-prefix': 'prefix',
    'name': 'name',
    'output': 'output',
}
# Typed attributes that may have substitutions.
_LATER_TYPED = {
    'detached': bool,
    'respawn': bool,
    'sigkill_timeout': float,
    'sigterm_timeout': float,
}
# Typed attributes without substitutions.
_TYPED = {'emulate_tty': bool, 'respawn_delay': float, 'respawn_max_retries': int, 'shell': bool}


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

        Raises
        ------
        ValueError
            The attribute `on_exit` is not `shutdown`.

        """
        _, kwargs = super().parse(entity, parser)
        kwargs.update(_parse_process(entity, parser, frozenset(ignore or ())))
        return cls, kwargs


def _parse_process(entity: Entity, parser: Parser, ignored: frozenset[str]) -> dict[str, Any]:
    """Read the attributes of an element that describes a process, except for the ignored ones."""
    from launch.frontend.attributes import parse_command, parse_pairs, parse_texts

    kwargs = parse_texts(
        entity, parser, {name: kw for name, kw in _TEXTS.items() if name not in ignored}
    )
    for name, data_type in {**_TYPED, **_LATER_TYPED}.items():
        if name not in ignored:
            later = name in _LATER_TYPED
            value = entity.get_attr(name, data_type=data_type, optional=True, can_be_str=later)
            if value is not None:
                kwargs[name] = parser.parse_if_substitutions(value)
    if 'cmd' not in ignored:
        kwargs['cmd'] = parse_command(entity.get_attr('cmd'), parser)
    if 'on_exit' not in ignored:
        kwargs.update(_parse_on_exit(entity))
    if 'env' not in ignored:
        pairs = parse_pairs(entity, parser, 'env')
        kwargs.update({'additional_env': dict(pairs)} if pairs else {})
    return kwargs


def _parse_on_exit(entity: Entity) -> dict[str, Any]:
    reaction = entity.get_attr('on_exit', optional=True)
    if reaction is None:
        return {}
    if reaction != 'shutdown':
        raise ValueError(
            f"Attribute on_exit of Entity {entity.type_name} must be 'shutdown', the only "
            f"reaction that a launch file can name there, but it is '{reaction}'"
        )
    from launch.actions.event_actions import Shutdown

    return {'on_exit': [Shutdown()]}
