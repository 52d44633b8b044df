# SPDX-License-Identifier: Apache-2.0
"""Command line interface of xacro."""

from __future__ import annotations

import os
import sys
from typing import Any, Optional

import xacro
from xacro.cli import process_args
from xacro_program.arguments import WatchedArguments
from xacro_program.output import write_output
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
    arguments = WatchedArguments(options.mappings)
    try:
        text = _expand(path, options, arguments)
    except Exception as error:
        return _fail(error, path, options)
    if options.verbosity > 0:
        for sentence in arguments.unknown():
            print(f'xacro: hint: {sentence}', file=sys.stderr)
    return _write(text, options.output)


def _expand(path: str, options: Any, arguments: WatchedArguments) -> str:
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
        write_output(text, path)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except OSError as error:
        where = path or 'the standard output'
        print(f"xacro: error: cannot write '{where}': {error.strerror}", file=sys.stderr)
        return 1
    return 0
