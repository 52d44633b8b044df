# SPDX-License-Identifier: Apache-2.0
"""Positional arguments of `ros2 launch`: the launch file, and its arguments `name:=value`."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
import os
from typing import Any, NoReturn

_SUFFIXES = ('.launch', '.py', '.xml', '.yaml', '.yml')
SEPARATOR = ':='
SIMILARITY = 0.8
MAGIC = frozenset(
    (
        'emulate_tty',
        'global_params',
        'launch-prefix',
        'launch-prefix-filter',
        'ros_namespace',
        'ros_remaps',
        'sigkill_timeout',
        'sigterm_timeout',
    )
)


def find_target(
    package_or_path: str,
    file_name: str | None,
    arguments: list[str],
) -> tuple[str, list[str]]:
    """
    Find the launch file named by the positional arguments.

    Parameters
    ----------
    package_or_path
        The path of a launch file, which takes precedence if it exists, or the name of a package.
    file_name
        The name of a launch file of the package; after a path the first launch argument, if any.
    arguments : list[str]
        The launch arguments that follow.

    Returns
    -------
    tuple
        The path of the launch file, and all launch arguments.

    Raises
    ------
    RuntimeError
        There is no such file or package, or several files of the package have this name.

    """
    if os.path.isfile(package_or_path):
        first = [file_name] if file_name is not None else []
        return package_or_path, first + arguments
    if os.sep in package_or_path or package_or_path.endswith(_SUFFIXES):
        _refuse_file(package_or_path)
    return _find_in_package(package_or_path, file_name), list(arguments)


def _refuse_file(path: str) -> NoReturn:
    """Raise an error about a missing file."""
    from ros_environment.missing_file import explain_missing_file

    lines = [explain_missing_file('launch file', path)]
    if not os.path.isabs(path) and not os.path.lexists(path):
        lines.append(f"It is looked up from '{os.getcwd()}'.")
    raise RuntimeError('\n'.join(lines))


def _find_in_package(package: str, file_name: str | None) -> str:
    from ros2pkg.api import missing_package_by_name, PackageNotFoundError

    try:
        return get_share_file_path_from_package(package_name=package, file_name=file_name)
    except PackageNotFoundError as error:
        raise RuntimeError(missing_package_by_name(package, str(error))) from error
    except FileNotFoundError as error:
        raise RuntimeError(_with_advice(str(error), package, file_name)) from error
    except MultipleLaunchFilesError as error:
        raise RuntimeError(str(error)) from error


def _with_advice(text: str, package: str, file_name: str | None) -> str:
    from ros2pkg.api import get_share_directory
    from ros_environment.workspace import explain_missing_share_file

    share = get_share_directory(package)
    return f'{text}\n{explain_missing_share_file(package, file_name or "", share)}'.rstrip()


class MultipleLaunchFilesError(Exception):
    """Several files of a package have the same name."""

    def __init__(self, message: str, paths: list[str]) -> None:
        """Initialize with the found paths."""
        super().__init__(message)
        self.paths = paths


def get_share_file_path_from_package(*, package_name: str, file_name: str | None) -> str:
    """
    Find a file anywhere below the share directory of a package.

    Parameters
    ----------
    package_name
        The name of the package.
    file_name
        The name of the file, without folders; None is never found.

    Returns
    -------
    str
        The path of the file.

    Raises
    ------
    PackageNotFoundError
        There is no such package.
    FileNotFoundError
        The package has no such file.
    MultipleLaunchFilesError
        The package has several files of this name.

    """
    from ros2pkg.api import get_share_directory

    share = get_share_directory(package_name)
    paths = [
        os.path.join(root, file_name)
        for root, _, names in os.walk(share)
        if file_name is not None and file_name in names
    ]
    if not paths:
        raise FileNotFoundError(
            f"file '{file_name}' was not found in the share directory of package "
            f"'{package_name}' which is at '{share}'"
        )
    if len(paths) > 1:
        raise MultipleLaunchFilesError(
            f"file '{file_name}' was found more than once in the share directory of package "
            f"'{package_name}': {paths}",
            paths,
        )
    return paths[0]


def parse_launch_arguments(texts: Sequence[str]) -> list[tuple[str, str]]:
    """
    Parse launch arguments of the form `name:=value`.

    Parameters
    ----------
    texts
        The arguments as given on the command line.

    Returns
    -------
    list of tuple
        Name and value of each argument, in the order of the names' first use; the last value of a
        name counts.

    Raises
    ------
    RuntimeError
        An argument is not of this form, or its name or value is empty.

    """
    values: dict[str, str] = {}
    for text in texts:
        name, separator, value = text.partition(SEPARATOR)
        if not (separator and name and value):
            raise RuntimeError(
                f"malformed launch argument '{text}', expected format '<name>:=<value>'"
            )
        values[name] = value
    return list(values.items())


class UnknownArguments:
    """
    Check of the given launch arguments against those that the launch declares or uses.

    It is called with the context after the launch has been visited, before any process starts.

    Parameters
    ----------
    given
        The names of the arguments given; those that launch itself understands are not checked.
    source
        The `LaunchDescriptionSource` of the launch file.

    """

    def __init__(self, given: Iterable[str], source: Any) -> None:
        self._given = [name for name in given if name not in MAGIC]
        self._source = source

    def __call__(self, context: Any) -> None:
        """Raise an error for a misspelt name; warn of other names that were never looked up."""
        unused = [name for name in self._unused(context) if not self._may_be_used(name, context)]
        declared = self._declared(context) if unused else set()
        unknown = [name for name in unused if name not in declared]
        text = misspelt_argument_text(unknown, declared)
        if text:
            raise RuntimeError(text)
        for name in unknown:
            _warn(name)

    def hint(self, context: Any) -> str:
        """
        Find a misspelt argument that may be why a visit has failed.

        Parameters
        ----------
        context
            The context of the launch, with the arguments declared and looked up so far.

        Returns
        -------
        str
            The error message; '' if no argument seems misspelt.

        """
        unused = self._unused(context)
        if not unused:
            return ''
        declared = self._declared(context)
        return misspelt_argument_text((name for name in unused if name not in declared), declared)

    def _unused(self, context: Any) -> list[str]:
        looked_up = context.launch_configurations.looked_up
        return [name for name in self._given if name not in looked_up]

    def _declared(self, context: Any) -> set[str]:
        """Return the names declared so far, and those in entities that were not visited."""
        declared = set(context.launch_configurations.declared)
        description = self._source.try_get_launch_description_without_context()
        if description is not None:
            declared.update(argument.name for argument in description.get_launch_arguments())
        return declared

    def _may_be_used(self, name: str, context: Any) -> bool:
        """Whether an entity that waits for an event looks a name up, or may do so."""
        from launch.preflight import may_look_up

        return bool(may_look_up(name, context))


def misspelt_argument_text(given: Iterable[str], declared: Iterable[str]) -> str:
    """
    Format the error message about the first undeclared argument that is close to a declared one.

    Parameters
    ----------
    given
        The names of the arguments given.
    declared
        The names that launch files declare.

    Returns
    -------
    str
        The message, which suggests the closest name; '' if there is no such argument.

    """
    from ros_environment.suggestions import closest_name

    known = list(declared)
    for name in given:
        close = '' if name in known else closest_name(name, known, SIMILARITY)
        if close:
            return (
                f"the launch file does not declare an argument '{name}'. "
                f"Did you mean '{close}'? Pass --allow-unknown-args if "
                f"'{name}' is meant, or --show-args to see the arguments"
            )
    return ''


def _warn(name: str) -> None:
    from launch.logging import get_logger

    get_logger('launch').warning(
        "no launch file declares the argument '%s', and nothing has looked it up; --show-args "
        'shows the arguments, --allow-unknown-args silences this',
        name,
    )
