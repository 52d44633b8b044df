# SPDX-License-Identifier: Apache-2.0
"""
Commands and verbs by name: rows of static tables, and entry points of other distributions.

Each has a subparser; only the one that is called is imported.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence

from ros_environment.suggestions import did_you_mean

TYPE_CHECKING = False

if TYPE_CHECKING:
    from typing import Any  # noqa: I300


class Entry:
    """
    Row of the static tables of commands and verbs; does not import the class until `create`.

    Parameters
    ----------
    target
        The class of the command or verb, as `module:Class`.
    summary
        The description for the help.
    hidden
        Whether the help omits it.

    """

    __slots__ = ('hidden', 'summary', 'target')

    def __init__(self, target: str, summary: str, hidden: bool = False) -> None:
        self.target = target
        self.summary = summary
        self.hidden = hidden

    def create(self) -> Any:
        """Import the class and return an instance."""
        module, _, name = self.target.partition(':')
        return getattr(__import__(module, fromlist=[name]), name)()


def find_entry(group: str, name: str) -> Entry | None:
    """
    Find the entry point of a command or verb in other installed distributions.

    Parameters
    ----------
    group
        The group of entry points, such as `ros2bag.verb`.
    name
        The name of the command or verb.

    Returns
    -------
    Entry or None
        Its class, without a summary; None if no distribution provides it.

    """
    return entries_of_group(group, name).get(name)


def entries_of_group(group: str, name: str | None = None) -> dict[str, Entry]:
    """
    Read the entry points of a group from all installed distributions, which is slow.

    Parameters
    ----------
    group
        The group of entry points, such as `ros2bag.verb`.
    name
        The only name to look for; None for all.

    Returns
    -------
    dict of str to Entry
        The classes by name, without summaries.

    """
    from importlib.metadata import entry_points

    found = entry_points(group=group) if name is None else entry_points(group=group, name=name)
    return {point.name: Entry(point.value, '') for point in found}


def add_lazy_subparsers(
    parser: argparse.ArgumentParser,
    cli_name: str,
    *,
    entries: Mapping[str, Entry],
    group: str,
    kind: str,
    dest: str,
    argv: Sequence[str] | None,
) -> None:
    """
    Add a subparser for the chosen entry, which is imported and adds its arguments.

    If none is chosen, as for help, there is a subparser per entry, without arguments.

    Parameters
    ----------
    parser
        The parser that gets the subparsers.
    cli_name
        The command line up to here, such as `ros2 bag`.
    entries
        The static table of commands or verbs.
    group
        The group of entry points to search for a name that is not in the table.
    kind
        The name of the entries in the help: `command` or `verb`.
    dest
        The attribute of the parsed arguments that holds the instance of the chosen entry.
    argv
        The arguments after `cli_name`; the first one that is not an option selects the entry.

    Raises
    ------
    SystemExit
        There is no entry of this name.

    """
    name, rest = _split(argv or ())
    entries = _with_extension(entries, group, name)
    metavar = f'Call `{cli_name} <{kind}> -h` for more detailed usage.'
    subparsers = parser.add_subparsers(
        prog=parser.prog,  # argparse would format its usage to determine this
        title='Commands',
        description=_listing(entries),
        metavar=metavar,
    )
    if name is None:
        for entry_name, entry in entries.items():
            subparsers.add_parser(entry_name, description=entry.summary)
    elif name in entries:
        subparser = subparsers.add_parser(name, description=entries[name].summary)
        _add_chosen(subparser, entries[name], f'{cli_name} {name}', dest, rest)
    else:
        parser.error(_unknown_text(metavar, name, entries))


def add_subparsers_on_demand(
    parser: argparse.ArgumentParser,
    cli_name: str,
    dest: str,
    group_name: str,
    hide_extensions: Sequence[str] | None = None,
    required: bool = True,
    argv: Sequence[str] | None = None,
) -> None:
    """
    Add a subparser for each entry point of a group, for commands of other packages.

    Parameters
    ----------
    parser, cli_name, dest, argv
        As for `add_lazy_subparsers`; without `argv` no subparser gets its arguments.
    group_name
        The group of entry points, such as `ros2bag.verb`.
    hide_extensions
        The names that the help omits.
    required
        Accepted for compatibility; it has no effect.

    Raises
    ------
    SystemExit
        There is no entry point of this name.

    """
    hidden = hide_extensions or ()
    entries = {
        name: Entry(entry.target, entry.summary, hidden=name in hidden)
        for name, entry in sorted(entries_of_group(group_name).items())
    }
    add_lazy_subparsers(
        parser, cli_name, entries=entries, group=group_name, kind='verb', dest=dest, argv=argv
    )


def _split(argv: Sequence[str]) -> tuple[str | None, Sequence[str]]:
    """Split at the first argument that is not an option; None if help is requested."""
    for index, word in enumerate(argv):
        if word in ('-h', '--help'):
            break
        if not word.startswith('-'):
            following = index + 1
            return word, argv[following:]
    return None, ()


def _with_extension(
    entries: Mapping[str, Entry],
    group: str,
    name: str | None,
) -> Mapping[str, Entry]:
    if name is None or name in entries:
        return entries
    extension = find_entry(group, name)
    return entries if extension is None else {**entries, name: extension}


def _add_chosen(
    subparser: argparse.ArgumentParser,
    entry: Entry,
    cli_name: str,
    dest: str,
    argv: Sequence[str],
) -> None:
    extension: Any = entry.create()
    subparser.set_defaults(**{dest: extension})
    if not subparser.description:
        from inspect import getdoc

        subparser.description = getdoc(type(extension))
    if _takes_argv(extension.add_arguments):
        extension.add_arguments(subparser, cli_name, argv=argv)
    else:
        extension.add_arguments(subparser, cli_name)


def _takes_argv(add_arguments: Callable[..., None]) -> bool:
    """Whether a function has the keyword-only parameter `argv`; those of verbs do not."""
    return 'argv' in (getattr(add_arguments, '__kwdefaults__', None) or {})


def _listing(entries: Mapping[str, Entry]) -> str:
    shown = {name: entry for name, entry in entries.items() if not entry.hidden}
    width = max((len(name) for name in shown), default=0)
    return '\n'.join(f'{name:<{width}}  {entry.summary}' for name, entry in shown.items())


def _unknown_text(metavar: str, name: str, entries: Mapping[str, Entry]) -> str:
    choices = ', '.join(repr(choice) for choice in entries)
    text = f'argument {metavar}: invalid choice: {name!r} (choose from {choices})'
    return ' '.join(part for part in (text, did_you_mean(name, entries)) if part)
