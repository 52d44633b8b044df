# SPDX-License-Identifier: Apache-2.0
"""Perform the substitutions in parameter files."""

from __future__ import annotations

from launch._call_site import CallSite
from launch._failure_place import note_line
from launch.launch_context import LaunchContext
from launch_ros.utilities.parameter_files import write_text


def substitute_parameter_file(context: LaunchContext, path: str) -> str:
    """
    Write a temporary copy of a parameter file with its substitutions performed.

    Parameters
    ----------
    context
        The launch context used to perform substitutions.
    path
        The file, which contains substitutions such as `$(var name)`.

    Returns
    -------
    str
        The path of the copy.

    Raises
    ------
    InvalidSubstitutionError
        A substitution is malformed or unknown.
    ValueError
        The copy is not valid YAML.

    """
    with open(path, encoding='utf-8') as file:
        text = _substituted(context, file.read(), path)
    _check_yaml(text, path)
    return write_text(text)


def _substituted(context: LaunchContext, text: str, path: str) -> str:
    from launch.frontend.invalid_substitution_error import InvalidSubstitutionError
    from launch.frontend.parse_substitution import parse_with_positions

    try:
        parts = list(parse_with_positions(text))
    except InvalidSubstitutionError as error:
        note_line(error, CallSite(path, error.line))
        raise
    result = ''
    for part, position in parts:
        try:
            result += context.perform_substitution(part)
        except Exception as error:
            note_line(error, CallSite(path, text.count('\n', 0, position) + 1))
            raise
    return result


def _check_yaml(text: str, path: str) -> None:
    import yaml

    try:
        yaml.load(text, Loader=getattr(yaml, 'CSafeLoader', yaml.SafeLoader))  # noqa: S506
    except yaml.YAMLError as error:
        raise ValueError(
            'The substituted parameter file is not a valid yaml file\n'
            f"'{path}', with what its substitutions have become: {error}"
        ) from error
