# SPDX-License-Identifier: Apache-2.0
"""
Answer a shell which asks how a command line may go on.

argcomplete does the reading and the quoting. The parser is the lazy one of the command line, so
that only the verb that is being completed is imported.
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
        Returns the root parser for the words after `ros2` that are complete.

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
    End this process after some seconds whatever it does, even inside a library.

    The shell waits until all who could answer have ended, so what a launch file starts must not
    be among them.
    """
    with suppress(OSError):
        os.set_inheritable(ANSWER_DESCRIPTOR, False)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    faulthandler.dump_traceback_later(DEADLINE_S, exit=True, file=nowhere)


def _complete(
    *, prefix: str, action: Any, parser: argparse.ArgumentParser, parsed_args: argparse.Namespace
) -> Iterable[str]:
    """Return the words for one argument; those of the table, or none."""
    completer = find_completer(parser.prog, action.dest)
    return () if completer is None else completer(prefix, parsed_args)
