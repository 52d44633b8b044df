# SPDX-License-Identifier: Apache-2.0
"""
Answer completion requests from the shell.

argcomplete parses the request and quotes the answer. The parser is the lazy one of the command
line, so that only the verb that is being completed is imported.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
import faulthandler
import os
from typing import Any

from ros2cli.completion.table import find_completer

DEADLINE_S = 4.0
ANSWER_DESCRIPTOR = 8


def answer(create_parser: Callable[[Sequence[str]], argparse.ArgumentParser]) -> None:
    """
    Answer the completion request of a shell, and end the process.

    The request is in the environment (COMP_LINE, COMP_POINT); the answer goes to descriptor 8, as
    argcomplete has it.

    Parameters
    ----------
    create_parser
        Returns the root parser for the complete words after `ros2`.

    """
    _end_before_it_annoys()
    from argcomplete.lexers import split_line
    from ros2cli.completion.finder import Finder

    line = os.environ['COMP_LINE']
    *_, words, _ = split_line(line, int(os.environ.get('COMP_POINT', len(line))))
    Finder()(
        create_parser(words[1:]),
        always_complete_options=False,
        default_completer=_complete,
    )


def _end_before_it_annoys() -> None:
    """
    Set a hard deadline of some seconds for this process, even inside a library.

    The shell waits until every process that holds the answer descriptor has exited, so processes
    started by a launch file must not inherit it.
    """
    with suppress(OSError):
        os.set_inheritable(ANSWER_DESCRIPTOR, False)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    faulthandler.dump_traceback_later(DEADLINE_S, exit=True, file=nowhere)


def _complete(
    *, prefix: str, action: Any, parser: argparse.ArgumentParser, parsed_args: argparse.Namespace
) -> Iterable[str]:
    """Return the completions of an argument from the table, or none."""
    completer = find_completer(parser.prog, action.dest)
    return () if completer is None else completer(prefix, parsed_args)
