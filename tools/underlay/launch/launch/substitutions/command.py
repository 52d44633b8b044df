# SPDX-License-Identifier: Apache-2.0
"""What lies outside the launch: the output of a command, the text of a file, and programs."""

from __future__ import annotations

from collections.abc import Sequence
import os
import shlex
from typing import TYPE_CHECKING

from launch.substitution import SomeSubstitutionsType, Substitution, SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    import subprocess

    from launch.launch_context import LaunchContext

_MODES = ('fail', 'ignore', 'warn', 'capture')


class Command(Substitution):
    """
    Substitution of what a command writes to its standard output.

    Parameters
    ----------
    command
        The command line, whose parts are joined as they are and then split as a shell does.
    on_stderr
        The handling of the standard error output: `fail`, `ignore`, `warn` or `capture`, which
        adds it to the text.

    """

    frontend_required = ('command',)
    frontend_optional = ('on_stderr',)

    def __init__(
        self,
        command: SomeSubstitutionsType,
        *,
        on_stderr: SomeSubstitutionsType = 'fail',
    ) -> None:
        self.__command = normalize_to_list_of_substitutions(command)
        self.__on_stderr = normalize_to_list_of_substitutions(on_stderr)

    @property
    def command(self) -> list[Substitution]:
        """Return the command line as a list of substitutions."""
        return self.__command

    @property
    def on_stderr(self) -> list[Substitution]:
        """Return the handling of the standard error output."""
        return self.__on_stderr

    def describe(self) -> str:
        """Return a short human-readable description."""
        return f'Command({" + ".join(sub.describe() for sub in self.__command)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Run the command, without a shell, and return its output.

        Parameters
        ----------
        context
            The launch context, in which the command line is performed.

        Raises
        ------
        SubstitutionFailure
            The command cannot be run, fails, or writes errors in the mode `fail`; or the mode is
            unknown.

        """
        parts = [perform_substitutions(context, [part]) for part in self.__command]
        command = ''.join(parts)
        mode = perform_substitutions(context, self.__on_stderr)
        if context.run.before_start is not None:
            from launch._before_start import note_files_of_command

            note_files_of_command(context, command)
        if mode not in _MODES:
            raise SubstitutionFailure(
                f"invalid on_stderr '{mode}' of the command '{command}': expected one of "
                f'{", ".join(_MODES)}'
            )
        result = _run(parts, merge=mode == 'capture')
        if mode != 'ignore':
            _show_hints(result)
        _judge(parts, mode, result)
        return result.stdout


def _run(parts: Sequence[str], merge: bool) -> subprocess.CompletedProcess[str]:
    import subprocess

    command = ''.join(parts)
    try:
        return subprocess.run(
            shlex.split(command),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT if merge else subprocess.PIPE,
            text=True,
            errors='replace',
        )
    except FileNotFoundError as error:
        raise SubstitutionFailure(f'file not found: {error}{_advice_on_program(parts)}') from error
    except (OSError, ValueError) as error:
        raise SubstitutionFailure(
            f'executed command failed. Command: {command}\nIt cannot be run: {error}'
        ) from error


def _show_hints(result: subprocess.CompletedProcess[str]) -> None:
    """Log the lines `PROGRAM: hint: ...`, which are advice to the user, and remove them."""
    stream = 'stdout' if result.stderr is None else 'stderr'
    lines = getattr(result, stream).splitlines(keepends=True)
    hints = [line for line in lines if line.split(' ', 2)[1:2] == ['hint:']]
    if not hints:
        return
    from launch.logging import get_logger

    for hint in hints:
        get_logger('launch.substitutions.command').warning(hint.rstrip())
    setattr(result, stream, ''.join(line for line in lines if line not in hints))


def _judge(parts: Sequence[str], mode: str, result: subprocess.CompletedProcess[str]) -> None:
    """Raise an error or warn if the result is not acceptable in the mode."""
    command = ''.join(parts)
    if result.returncode != 0:
        said = result.stdout if mode == 'capture' else result.stderr
        raise SubstitutionFailure(
            f'executed command failed. Command: {command}'
            + _captured(said).rstrip()
            + _advice_on_failure(parts, said)
        )
    if result.stderr and mode == 'fail':
        raise SubstitutionFailure(
            f'executed command showed stderr output. Command: {command}' + _captured(result.stderr)
        )
    if result.stderr and mode == 'warn':
        from launch.logging import get_logger

        get_logger('launch.substitutions.command').warning(
            f'executed command showed stderr output. Command: {command}' + _captured(result.stderr)
        )


def _captured(text: str) -> str:
    return f'\nCaptured stderr output: {text}' if text else ''


def _advice_on_failure(parts: Sequence[str], said: str) -> str:
    """Advise on a path that was split at a space, or one that does not exist; '' for neither."""
    return _split_path(parts) or _missing_path(''.join(parts), said)


def _advice_on_program(parts: Sequence[str]) -> str:
    """Advise on a missing space after the name of a program; '' if that is not the reason."""
    import shutil

    first = parts[0].split()
    if len(parts) < 2 or not first or parts[0][-1].isspace() or shutil.which(first[-1]) is None:
        return ''
    return (
        f"\nIs a space missing after '{parts[0]}'? The parts of a command are joined as "
        f"they are: Command(['{parts[0]} ', ...])"
    )


def _split_path(parts: Sequence[str]) -> str:
    """Return advice on a path that was split into several words at a space."""
    words = shlex.split(''.join(parts))
    for part in parts[1:]:
        is_path = os.path.isabs(part) and len(part.split()) > 1
        if is_path and not any(part in word for word in words):
            return (
                f"\nThe path '{part}' contains a space, and was split into several words. "
                f"Quote it: Command(['{parts[0].rstrip()} \"', path, '\"'])"
            )
    return ''


def _missing_path(command: str, said: str) -> str:
    """Return advice on the first path that does not exist."""
    from ros_environment.missing_file import explain_missing_file

    for word in shlex.split(command)[1:]:
        if word.startswith('/') and not os.path.exists(word):
            explanation = explain_missing_file('file', word)
            return '' if explanation in said else f'\n{explanation}'
    return ''


class FileContent(Substitution):
    """
    Substitution of the text in a file.

    Parameters
    ----------
    path
        The path of the file, which is read as UTF-8.

    """

    frontend_required = ('path',)

    def __init__(self, path: SomeSubstitutionsType) -> None:
        self.__path = normalize_to_list_of_substitutions(path)

    @property
    def path(self) -> list[Substitution]:
        """Return the path as a list of substitutions."""
        return self.__path

    def describe(self) -> str:
        """Return a short human-readable description."""
        return f'FileContent({" + ".join(sub.describe() for sub in self.__path)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the contents of the file.

        Parameters
        ----------
        context
            The launch context, in which the path is performed.

        Raises
        ------
        SubstitutionFailure
            The file does not exist, or cannot be read.

        """
        path = perform_substitutions(context, self.__path)
        context.run.note_file(path)
        try:
            with open(path, encoding='utf-8') as file:
                return file.read()
        except FileNotFoundError as error:
            from ros_environment.missing_file import explain_missing_file

            advice = explain_missing_file('file', path)
            raise SubstitutionFailure(f'File not found: {path}\n{advice}') from error
        except (OSError, UnicodeDecodeError) as error:
            raise SubstitutionFailure(f'File cannot be read: {path}: {error}') from error


class FindExecutable(Substitution):
    """
    Substitution of the path of a program that the shell would find.

    Parameters
    ----------
    name
        The name of the program.

    """

    is_constant = True
    frontend_required = ('name',)

    def __init__(self, *, name: SomeSubstitutionsType) -> None:
        self.__name = normalize_to_list_of_substitutions(name)

    @property
    def name(self) -> list[Substitution]:
        """Return the name as a list of substitutions."""
        return self.__name

    def describe(self) -> str:
        """Return a short human-readable description."""
        return f'FindExec({" + ".join(sub.describe() for sub in self.__name)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the path of the program.

        Parameters
        ----------
        context
            The launch context, in which the name is performed.

        Raises
        ------
        SubstitutionFailure
            The program is not on the PATH.

        """
        from launch._before_start import find_program

        name = perform_substitutions(context, self.__name)
        found = find_program(name)
        if found is None:
            raise SubstitutionFailure(
                f"executable '{name}' not found on the PATH; install it, or source the "
                'environment that has it'
            )
        return found
