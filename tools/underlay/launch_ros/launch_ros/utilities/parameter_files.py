# SPDX-License-Identifier: Apache-2.0
"""Write temporary parameter files: from parameters, or from files with substitutions."""

from __future__ import annotations

from collections.abc import Mapping
import math
import os
from typing import Any

from launch.launch_context import LaunchContext
from launch.logging import get_logger
from ros_environment.temporary_files import is_temporary_file, write_temporary_file


def is_parameter_file(path: str) -> bool:
    """
    Whether a parameter file exists; if not, warnings with advice are logged.

    Parameters
    ----------
    path
        The file.

    """
    if os.path.isfile(path):
        return True
    from ros_environment.missing_file import explain_missing_file

    logger = get_logger('launch_ros.actions.node')
    logger.warning('Parameter file path is not a file: %s', path)
    advice = explain_missing_file('file', path)
    logger.warning('The node gets no parameters from it, because %s', advice)
    return False


def write_parameter_file(node_name: str, parameters: Mapping[str, Any]) -> str:
    """
    Write parameters to a temporary parameter file and return its path.

    Parameters
    ----------
    node_name
        The fully qualified name of the target nodes, or `/**` for all nodes.
    parameters : Mapping[str, Any]
        Plain values by parameter name.

    """
    return write_text(_parameter_file_text(node_name, parameters))


def write_text(text: str) -> str:
    """
    Write a temporary file and return its path; it is removed when the launch ends.

    Parameters
    ----------
    text
        The content.

    """
    return write_temporary_file('launch_params_', text)


def is_written_here(path: str) -> bool:
    """
    Whether a file is a temporary file of the launch.

    Parameters
    ----------
    path
        The path, exactly as returned when the file was written.

    """
    return is_temporary_file(path)


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
    from launch.failures import CallSite, note_line
    from launch.frontend.parse_substitution import InvalidSubstitutionError, parse_with_positions

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
            f"'{path}', with its substitutions performed: {error}"
        ) from error


def flow_text(value: Any) -> str:
    """
    Format a scalar or a list as single-line YAML; strings are always quoted.

    Parameters
    ----------
    value
        A bool, int, float, str or bytes, or a list of those.

    """
    if isinstance(value, bool):
        return 'true' if value else 'false'
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return _float_text(value)
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, bytes):
        import base64

        return f"!!binary '{base64.b64encode(value).decode()}'"
    return f'[{", ".join(flow_text(item) for item in value)}]'


def _parameter_file_text(node_name: str, parameters: Mapping[str, Any]) -> str:
    """
    Format parameters as the text of a parameter file.

    Parameters
    ----------
    node_name
        The fully qualified name of the target nodes, or `/**` for all nodes.
    parameters : Mapping[str, Any]
        Plain values by parameter name.

    """
    lines = [f'{_quoted(node_name)}:', '  ros__parameters:']
    lines += [f'    {_quoted(name)}: {flow_text(parameters[name])}' for name in sorted(parameters)]
    return '\n'.join(lines) + '\n'


def _float_text(value: float) -> str:
    if math.isnan(value):
        return '.nan'
    if math.isinf(value):
        return '.inf' if value > 0 else '-.inf'
    mantissa, exponent_mark, exponent = repr(value).partition('e')
    point = '' if '.' in mantissa else '.0'
    sign = '+' if exponent_mark and exponent[0].isdigit() else ''
    return f'{mantissa}{point}{exponent_mark}{sign}{exponent}'


def _quoted(text: str) -> str:
    """Quote a string, with escapes if it has special characters."""
    if text.isprintable():
        return "'" + text.replace("'", "''") + "'"
    import json

    return (
        json.dumps(text, ensure_ascii=False)
        .replace('\x7f', '\\x7f')
        .replace('\x85', '\\x85')
        .replace('\u2028', '\\u2028')
        .replace('\u2029', '\\u2029')
    )
