# SPDX-License-Identifier: Apache-2.0
"""
Complete what is on the disk: paths, packages, executables, launch files and their arguments.

What only launch files need is imported for them.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from functools import lru_cache
import os
from typing import Any

from ament_index_python.packages import get_packages_with_prefixes, PackageNotFoundError

FILE_SUFFIXES = ('.launch', '.py', '.xml', '.yaml', '.yml')
TRUTHS = ('true', 'false')
Choice = Callable[[str], bool]


def files(prefix: str, args: argparse.Namespace | None = None) -> list[str]:
    """
    List the files and folders that complete a path.

    Parameters
    ----------
    prefix
        The word to complete.
    args : argparse.Namespace | None
        The parsed arguments (unused).

    """
    return _paths(prefix, bool)


def folders(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the folders that complete a path.

    Parameters
    ----------
    prefix
        The word to complete.
    args : argparse.Namespace
        The parsed arguments (unused).

    """
    return _paths(prefix, lambda name: False)


def bags(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the folders and bag files that complete a path.

    Parameters
    ----------
    prefix
        The word to complete.
    args : argparse.Namespace
        The parsed arguments (unused).

    """
    return files_of_kind(prefix, ('.mcap', '.db3'))


def files_of_kind(prefix: str, suffixes: tuple[str, ...]) -> list[str]:
    """
    List the files with certain suffixes, and all folders, that complete a path.

    Parameters
    ----------
    prefix
        The word to complete.
    suffixes
        The file name suffixes, each with its dot.

    Returns
    -------
    list of str
        Paths that start with the word; folders have a trailing slash.

    """
    return _paths(prefix, lambda name: name.endswith(suffixes))


def as_path(word: str) -> str:
    """
    Expand `~` and variables in a word as the shell will.

    Parameters
    ----------
    word
        A word of the command line.

    """
    return os.path.expanduser(os.path.expandvars(word))


def _paths(prefix: str, is_wanted: Choice) -> list[str]:
    """Return the completions of a path; keep its leading part as typed."""
    head, slash, tail = prefix.rpartition(os.sep)
    found = sorted(_names(as_path(head + slash) or os.curdir, tail, is_wanted))
    return [f'{head}{slash}{name}' for name in found]


def _names(folder: str, beginning: str, is_wanted: Choice) -> Iterator[str]:
    """Yield the entries of a folder; dotfiles only if the word starts with a dot."""
    try:
        entries = list(os.scandir(folder))
    except OSError:
        return
    for entry in entries:
        if entry.name.startswith(beginning or '.') == bool(beginning):
            if entry.is_dir():
                yield f'{entry.name}{os.sep}'
            elif is_wanted(entry.name):
                yield entry.name


def packages(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the names of all packages.

    Parameters
    ----------
    prefix, args
        The word to complete and the parsed arguments (both unused).

    """
    return sorted(get_packages_with_prefixes())


def packages_with_executables(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the names of the packages that have executables.

    Parameters
    ----------
    prefix, args
        The word to complete and the parsed arguments (both unused).

    """
    return sorted(
        name
        for name, folder in get_packages_with_prefixes().items()
        if os.path.isdir(os.path.join(folder, 'lib', name))
    )


def executables(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the names of a package's executables.

    Parameters
    ----------
    prefix
        The word to complete (unused).
    args : argparse.Namespace
        The parsed arguments, with the `package_name`.

    """
    from ros2pkg.api import get_executable_paths

    try:
        paths = get_executable_paths(package_name=args.package_name)
    except PackageNotFoundError:
        return []
    return sorted(map(os.path.basename, paths))


def licenses(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the licences whose text is available for a new package.

    Parameters
    ----------
    prefix, args
        The word to complete and the parsed arguments (both unused).

    """
    from ros2pkg.create.package import known_licenses

    return known_licenses()


def packages_or_files(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the packages with launch files, or launch files if the word looks like a path.

    Parameters
    ----------
    prefix
        The word to complete.
    args : argparse.Namespace
        The parsed arguments (unused).

    """
    if os.sep in prefix or prefix.startswith(('.', '~')):
        return files_of_kind(prefix, FILE_SUFFIXES)
    found = get_packages_with_prefixes()
    names = sorted(name for name in found if name.startswith(prefix))
    launchable = [name for name in names if _has_launch_files(found[name], name)]
    return launchable or names or files_of_kind(prefix, FILE_SUFFIXES)


def launch_files_of_package(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the launch files of a package; none if a file stands in place of the package.

    Parameters
    ----------
    prefix
        The word to complete (unused).
    args : argparse.Namespace
        The parsed arguments, with the `package_name`.

    """
    from pathlib import Path

    from ros_environment.installed import launch_files

    folder = get_packages_with_prefixes().get(args.package_name)
    return launch_files(Path(folder, 'share', args.package_name)) if folder else []


def arguments(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the launch arguments that have no value yet, or the values of one, as `name:=value`.

    Parameters
    ----------
    prefix
        The word to complete; with `:=` in it the values are listed.
    args : argparse.Namespace
        The parsed arguments, with `package_name`, `launch_file_name` and `launch_arguments`.

    """
    from ros2launch.api.arguments import SEPARATOR

    target = as_path(args.package_name)
    if args.launch_file_name is None and not os.path.isfile(target):
        return []
    name, separator, value = prefix.partition(SEPARATOR)
    declared = _declared(target, args.launch_file_name)
    if separator:
        known = [text for each in declared if each.name == name for text in _values(each)]
        # Some arguments accept custom paths besides the known choices.
        values = [text for text in known if text.startswith(value)]
        return [f'{name}{separator}{text}' for text in values or files(value)]
    given = {text.partition(SEPARATOR)[0] for text in _given(args)}
    names = dict.fromkeys(each.name for each in declared if each.name not in given)
    return [f'{each}{SEPARATOR}' for each in names]


def _has_launch_files(prefix: str, package: str) -> bool:
    """Whether a package has launch files in the usual folders; fast enough for 100 packages."""
    from ros_environment.installed import LAUNCH_SUFFIXES

    share = os.path.join(prefix, 'share', package)
    return any(
        name.endswith(LAUNCH_SUFFIXES)
        for folder in (share, os.path.join(share, 'launch'))
        for name in _names_in(folder)
    )


def _names_in(folder: str) -> list[str]:
    return os.listdir(folder) if os.path.isdir(folder) else []


@lru_cache(maxsize=1)
def _declared(package_or_path: str, file_name: str | None) -> list[Any]:
    """Load a launch file and return its declared arguments; cached for repeated calls."""
    from ros2launch.api.arguments import find_target
    from ros2launch.api.running import load_launch_file

    path, _ = find_target(package_or_path, file_name, [])
    found: list[Any] = load_launch_file(path).get_launch_arguments()
    return found


def _given(args: argparse.Namespace) -> Iterator[str]:
    yield from (args.launch_file_name or '', *(args.launch_arguments or ()))


def _values(argument: Any) -> list[str]:
    """Return the valid values of an argument, if they are known."""
    if argument.choices:
        return list(argument.choices)
    default = argument.default_value or ()
    texts = [getattr(part, 'text', '') for part in default]
    return list(TRUTHS) if ''.join(texts).lower() in TRUTHS else []
