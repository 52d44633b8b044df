# SPDX-License-Identifier: Apache-2.0
"""Command line interface of xacro."""

from __future__ import annotations

from collections.abc import Mapping
import os
import sys
from typing import Any, Optional

import xacro
from xacro.cli import process_args
from xacro_program.placed_document import placed_documents

_TRACEBACKS = 2


def main(argv: Optional[list[str]] = None) -> int:
    """
    Expand a xacro file from the command line.

    Parameters
    ----------
    argv
        The arguments without the program name; None for those of the process.

    Returns
    -------
    int
        The exit code: 0 on success, 1 for errors in files or output, 2 for invalid arguments.

    Raises
    ------
    SystemExit
        The number of files is not one, or an option is unknown.

    """
    try:
        options, path = process_args(sys.argv[1:] if argv is None else argv)
    except RuntimeError as error:
        print(f'xacro: error: {str(error).strip()}: expected NAME:=VALUE', file=sys.stderr)
        return 2
    arguments = _WatchedArguments(options.mappings)
    try:
        text = _expand(path, options, arguments)
    except Exception as error:
        return _fail(error, path, options)
    if options.verbosity > 0:
        for sentence in arguments.unknown():
            print(f'xacro: hint: {sentence}', file=sys.stderr)
    return _write(text, options.output)


def _expand(path: str, options: Any, arguments: _WatchedArguments) -> str:
    if options.root_dir:
        xacro.root_dir = options.root_dir
    with placed_documents():
        document = xacro.process_file(path, mappings=arguments, verbosity=options.verbosity)
    if options.just_deps:
        return ' '.join(sorted(set(xacro.all_includes)))
    text: str = document.toprettyxml(indent='  ')
    return text


def _fail(error: Exception, path: str, options: Any) -> int:
    """Print an error, with its traceback if requested; return the exit code."""
    from xacro_program.report import report

    print(report(error, path), file=sys.stderr)
    if options.verbosity >= _TRACEBACKS:
        import traceback

        traceback.print_exception(type(error), error, error.__traceback__)
    return 1


def _write(text: str, path: Optional[str]) -> int:
    try:
        _write_output(text, path)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except OSError as error:
        where = path or 'the standard output'
        print(f"xacro: error: cannot write '{where}': {error.strerror}", file=sys.stderr)
        return 1
    return 0


class _WatchedArguments(dict[str, str]):
    """
    Arguments of a xacro file, which record the names that the file declares or uses.

    Parameters
    ----------
    given
        The command line arguments by name.

    """

    def __init__(self, given: Mapping[str, str]) -> None:
        super().__init__(given)
        self._given = list(given)
        self._asked: set[str] = set()

    def __contains__(self, name: object) -> bool:
        self._asked.add(str(name))
        return super().__contains__(name)

    def __getitem__(self, name: str) -> str:
        self._asked.add(name)
        return super().__getitem__(name)

    def unknown(self) -> list[str]:
        """Return a message for each given argument that was never accessed."""
        return [_sentence(name, self._asked) for name in self._given if name not in self._asked]


def _sentence(name: str, known: set[str]) -> str:
    from ros_environment.suggestions import did_you_mean

    hint = did_you_mean(name, known)
    if not hint and known:
        hint = f'The arguments are: {", ".join(sorted(known))}'
    return f"no <xacro:arg> declares '{name}', so it has no effect. {hint}".rstrip()


def _write_output(text: str, path: Optional[str]) -> None:
    """
    Write the output to a file, atomically, or to the standard output.

    Parameters
    ----------
    text
        The output.
    path
        The file, whose directory is created if needed; None for the standard output.

    Raises
    ------
    OSError
        The output cannot be written.

    """
    if path is None:
        sys.stdout.write(text)
        sys.stdout.flush()
    elif os.path.exists(path) and not os.path.isfile(path):
        _write_file(text, path)
    else:
        _replace(text, os.path.realpath(path))


def _replace(text: str, path: str) -> None:
    os.makedirs(os.path.dirname(path), exist_ok=True)
    new = f'{path}.{os.getpid()}.new'
    try:
        _write_file(text, new)
        if os.path.exists(path):
            os.chmod(new, os.stat(path).st_mode)
        os.replace(new, path)
    finally:
        if os.path.exists(new):
            os.unlink(new)


def _write_file(text: str, path: str) -> None:
    with open(path, 'w', encoding='utf-8') as file:
        file.write(text)
