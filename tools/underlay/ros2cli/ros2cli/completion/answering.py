# SPDX-License-Identifier: Apache-2.0
"""
Answer completion requests from the shell.

argcomplete parses the request and quotes the answer, except where a shell differs from what it
expects. The parser is the lazy one of the command line, so that only the verb that is being
completed is imported. The completers of a verb follow from the names of its arguments (`dest`), so
that verbs need no completion code. An argument that is not in the table can have a `completer`
attribute, as in argcomplete.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
import faulthandler
from importlib import import_module
import os
import re
from typing import Any

from argcomplete import CompletionFinder
from argcomplete.lexers import split_line

DEADLINE_S = 4.0
ANSWER_DESCRIPTOR = 8
Completer = Callable[[str, argparse.Namespace], Iterable[str]]

OF_COMMAND = {
    ('ros2 interface package', 'package_name'): 'interfaces:packages',
    ('ros2 launch', 'package_name'): 'disk:packages_or_files',
    ('ros2 lifecycle get', 'node_name'): 'graph:lifecycle_nodes',
    ('ros2 lifecycle list', 'node_name'): 'graph:lifecycle_nodes',
    ('ros2 lifecycle set', 'node_name'): 'graph:lifecycle_nodes',
    ('ros2 run', 'package_name'): 'disk:packages_with_executables',
}
OF_ARGUMENT = {
    'action_name': 'graph:actions',
    'action_type': 'interfaces:actions',
    'argv': 'disk:files',
    'bag_path': 'disk:bags',
    'container_node_name': 'graph:containers',
    'dependencies': 'disk:packages',
    'destination_directory': 'disk:folders',
    'exclude_topic_types': 'interfaces:messages',
    'exclude_topics': 'graph:topics',
    'executable_name': 'disk:executables',
    'input': 'disk:bags',
    'launch_arguments': 'disk:arguments',
    'launch_file_name': 'disk:launch_files_of_package',
    'license': 'disk:licenses',
    'message_type': 'interfaces:messages_of_topic',
    'node_name': 'graph:nodes',
    'output': 'disk:files',
    'output_options': 'disk:files',
    'package_name': 'disk:packages',
    'parameter_file': 'disk:files',
    'parameter_name': 'graph:parameters',
    'parameter_names': 'graph:parameters',
    'qos_profile_overrides_path': 'disk:files',
    'service_name': 'graph:services',
    'service_type': 'interfaces:services_of_name',
    'topic_name': 'graph:topics',
    'topic_type': 'interfaces:messages',
    'topic_types': 'interfaces:messages',
    'topics': 'graph:topics',
    'topics_positional': 'graph:topics',
    'transition': 'answering:transitions',
    'type': 'interfaces:interfaces',
    'values': 'interfaces:values',
}
NEVER = {  # these arguments name new objects
    ('ros2 bag record', 'node_name'),
    ('ros2 component load', 'node_name'),
    ('ros2 component standalone', 'container_node_name'),
    ('ros2 component standalone', 'node_name'),
    ('ros2 pkg create', 'node_name'),
    ('ros2 pkg create', 'package_name'),
    ('ros2 topic pub', 'node_name'),
}
TRANSITIONS = ('activate', 'cleanup', 'configure', 'deactivate', 'shutdown')


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
    _set_deadline()
    line = os.environ['COMP_LINE']
    *_, words, _ = split_line(line, int(os.environ.get('COMP_POINT', len(line))))
    Finder()(
        create_parser(words[1:]),
        always_complete_options=False,
        default_completer=_complete,
    )


def _set_deadline() -> None:
    """
    Set a hard deadline of a few seconds for this process, even inside a library.

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


def find_completer(command: str, argument: str) -> Completer | None:
    """
    Find the completer of an argument.

    Parameters
    ----------
    command
        The program name of the parser, such as `ros2 topic echo`.
    argument
        The `dest` of the argument.

    Returns
    -------
    Completer or None
        Called with the word to complete and the parsed arguments; argcomplete drops words that do
        not match.

    """
    if (command, argument) in NEVER:
        return None
    target = OF_COMMAND.get((command, argument)) or OF_ARGUMENT.get(argument)
    if target is None:
        return None
    module, _, name = target.partition(':')
    found: Any = getattr(import_module(f'ros2cli.completion.{module}'), name)
    return found  # type: ignore[no-any-return]


def transitions(prefix: str, args: argparse.Namespace) -> tuple[str, ...]:
    """
    List the lifecycle transitions that users can request.

    Parameters
    ----------
    prefix, args
        The word to complete and the parsed arguments (both unused).

    """
    return TRANSITIONS


class Finder(CompletionFinder):
    """Completion finder that quotes the words as the shell expects."""

    def quote_completions(
        self, completions: list[str], cword_prequote: str, last_wordbreak_pos: int | None
    ) -> list[str]:
        """
        Quote words for bash; zsh does its own quoting in the style of the line.

        Parameters
        ----------
        completions
            The words that complete the line.
        cword_prequote
            The opening quote of the word on the line, or ''.
        last_wordbreak_pos
            Where the shell breaks the word, as argcomplete passes it.

        Returns
        -------
        list of str
            The words as the shell is to receive them.

        """
        is_message = not cword_prequote and all(word.startswith('{') for word in completions)
        if is_message:
            completions = [_between_quotes(word) for word in completions]
        if os.environ.get('_ARGCOMPLETE_SHELL') == 'zsh':
            return [self._for_zsh(word) for word in completions]
        if is_message:
            return completions
        found = super().quote_completions(completions, cword_prequote, last_wordbreak_pos)
        return [_with_variable(word) for word in found]

    def _for_zsh(self, word: str) -> str:
        """Escape colons in a word, because zsh puts one before the description."""
        escaped = word.replace('\\', '\\\\').replace(':', '\\:')
        self._display_completions[escaped] = self._display_completions.get(word, '')
        return escaped


def _between_quotes(word: str) -> str:
    """Quote a whole message as a word that is easy to edit."""
    escaped = re.sub(r'([\\"$`])', r'\\\1', word)
    return f'"{escaped}"'


def _with_variable(word: str) -> str:
    """Unescape the leading `$` of a word such as `$HOME/bags`, so that the shell expands it."""
    return word[1:] if word.startswith('\\$') else word
