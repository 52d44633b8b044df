# SPDX-License-Identifier: Apache-2.0
"""The description of a program with its arguments, working directory and environment."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import count
import os
import re
import shlex
from typing import Any, Optional, TYPE_CHECKING

from launch._before_start import find_program
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import perform_substitutions
from launch.utilities.arguments import list_like, mapping_like, optional_text_like, text_like

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity

Variables = list[tuple[list[Substitution], list[Substitution]]]
SomeVariables = Mapping[SomeSubstitutionsType, SomeSubstitutionsType]

_numbers = count(1)
ROS_ARGUMENTS = '--ros-args'  # what follows is for a node; none of it is a program


class Executable:
    """
    Description of an executable; its final values are known when it is prepared.

    Parameters
    ----------
    cmd
        The program and its arguments; each item becomes one argument.
    prefix
        The command prefix, such as `gdb -ex run --args`; without one, the launch configurations
        `launch-prefix` and `launch-prefix-filter` are used.
    name
        The label in the log, without its number; by default the file name of the program.
    cwd
        The working directory of the process; by default that of the launch.
    env
        The complete environment of the process; by default it inherits that of the launch.
    additional_env
        The variables that are added to its environment.
    arguments : Optional[Iterable[SomeSubstitutionsType]]
        Additional arguments, which are appended to those of `cmd`.

    Raises
    ------
    TypeError
        An argument has the wrong type; the error names it.

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
        arguments: Optional[Iterable[SomeSubstitutionsType]] = None,
    ) -> None:
        words = list_like('cmd', cmd, 'words')
        more = list_like('arguments', () if arguments is None else arguments, 'words')
        self.__cmd = [text_like('cmd', word) for word in words]
        self.__cmd += [text_like('arguments', word) for word in more]
        self.__prefix = optional_text_like('prefix', prefix)
        self.__name = optional_text_like('name', name)
        self.__cwd = optional_text_like('cwd', cwd)
        self.__env = None if env is None else _normalize_variables('env', env)
        self.__additional_env = _normalize_variables('additional_env', additional_env or {})
        self.__final_cmd: Optional[list[str]] = None
        self.__final_name: Optional[str] = None
        self.__final_cwd: Optional[str] = None
        self.__final_env: Optional[dict[str, str]] = None

    @property
    def cmd(self) -> list[list[Substitution]]:
        """Return the arguments, each as a list of substitutions."""
        return self.__cmd

    @property
    def prefix(self) -> Optional[list[Substitution]]:
        """Return the prefix as a list of substitutions."""
        return self.__prefix

    @property
    def name(self) -> Optional[list[Substitution]]:
        """Return the name as a list of substitutions."""
        return self.__name

    @property
    def cwd(self) -> Optional[list[Substitution]]:
        """Return the working directory as a list of substitutions."""
        return self.__cwd

    @property
    def env(self) -> Optional[Variables]:
        """Return the complete environment, or None if it is inherited."""
        return self.__env

    @property
    def additional_env(self) -> Variables:
        """Return the variables that are added to the environment."""
        return self.__additional_env

    @property
    def final_cmd(self) -> Optional[list[str]]:
        """Return the arguments, once they are known."""
        return self.__final_cmd

    @property
    def final_name(self) -> Optional[str]:
        """Return the label of the process, once it is known."""
        return self.__final_name

    @property
    def final_cwd(self) -> Optional[str]:
        """Return the working directory, once it is known; None for that of the launch."""
        return self.__final_cwd

    @property
    def final_env(self) -> Optional[dict[str, str]]:
        """Return the environment, once it is known."""
        return self.__final_env

    def prepare(
        self,
        context: LaunchContext,
        action: Optional[LaunchDescriptionEntity] = None,
        *,
        extra_arguments: Iterable[str] = (),
        shell: bool = False,
    ) -> None:
        """
        Determine the final command, label, working directory and environment.

        Parameters
        ----------
        context
            The launch context, in which substitutions are performed.
        action
            The action that runs it, for the error.
        extra_arguments
            Arguments that are appended to those of `cmd`.
        shell
            Whether a shell runs the command line.

        Raises
        ------
        ValueError
            The command is empty.

        """
        command = [perform_substitutions(context, word) for word in self.__cmd]
        if not command:
            raise ValueError(f'the command of {action or self!r} is empty: it needs a program')
        self.__final_cmd = [*self._prefix_words(context, command), *command, *extra_arguments]
        name = (
            perform_substitutions(context, self.__name)
            if self.__name is not None
            else os.path.basename(self.__final_cmd[0])
        )
        self.__final_name = f'{name}-{next(_numbers)}'
        self.__final_cwd = (
            None if self.__cwd is None else perform_substitutions(context, self.__cwd)
        )
        self.__final_env = self._environment(context, shell)

    def _prefix_words(self, context: LaunchContext, command: list[str]) -> list[str]:
        """Return the prefix given here, or else that of the launch if its filter matches."""
        if self.__prefix is not None:
            return shlex.split(perform_substitutions(context, self.__prefix))
        pattern = context.launch_configurations.get('launch-prefix-filter')
        if pattern is not None and not re.match(pattern, os.path.basename(command[0])):
            return []
        return shlex.split(context.launch_configurations.get('launch-prefix', ''))

    def _environment(self, context: LaunchContext, shell: bool) -> dict[str, str]:
        if self.__env is not None:
            environment = _perform_variables(context, self.__env)
        else:
            environment = dict(context.environment)
            if runs_python(self.__final_cmd or [], shell=shell):
                environment.setdefault('PYTHONUNBUFFERED', '1')
        return {**environment, **_perform_variables(context, self.__additional_env)}


def _normalize_variables(keyword: str, variables: Mapping[Any, Any]) -> Variables:
    return [
        (text_like(keyword, name), text_like(f'{keyword}[{name!r}]', value))
        for name, value in mapping_like(keyword, variables).items()
    ]


def _perform_variables(context: LaunchContext, variables: Variables) -> dict[str, str]:
    return {
        perform_substitutions(context, name): perform_substitutions(context, value)
        for name, value in variables
    }


def runs_python(command: Sequence[str], *, shell: bool) -> bool:
    """
    Whether one of the words of a command is a Python interpreter, or a script for one.

    Parameters
    ----------
    command
        The words; what follows `--ros-args` is left out.
    shell
        Whether a shell runs the command, and therefore splits the words at spaces.

    """
    words = ' '.join(command).split() if shell else command
    if ROS_ARGUMENTS in words:
        words = words[: words.index(ROS_ARGUMENTS)]
    return any(_is_python(word) for word in words if word and not word.startswith('-'))


def _is_python(word: str) -> bool:
    if os.path.basename(word).startswith('python'):
        return True
    path = word if '/' in word else find_program(word)
    return path is not None and b'python' in _interpreter(path)


def _interpreter(path: str) -> bytes:
    """Return the shebang of a script, empty for any other file."""
    try:
        if not os.path.isfile(path):
            return b''
        with open(path, 'rb') as file:
            head = file.read(256)
    except (OSError, ValueError):
        return b''
    return head.partition(b'\n')[0] if head.startswith(b'#!') else b''
