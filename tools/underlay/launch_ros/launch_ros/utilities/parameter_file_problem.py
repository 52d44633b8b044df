# SPDX-License-Identifier: Apache-2.0
"""Find errors in parameter files, without parsing all of them as YAML."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Optional

from launch_ros.utilities.parameter_file_keys import key_of, PARAMETERS, read_lines


class ParameterFileProblem(NamedTuple):
    """A line number and a description of the problem."""

    line: int
    text: str


def parameter_file_problem(path: str) -> Optional[ParameterFileProblem]:
    """
    Return the first problem of a parameter file in block style; None if there is none.

    Problems are tabs where YAML allows only spaces, and nodes without `ros__parameters`.

    Parameters
    ----------
    path
        The file; no problem is reported if it cannot be read.

    """
    lines = read_lines(path)
    return _tab(lines) or _entry_without_parameters(lines)


def _tab(lines: Sequence[str]) -> Optional[ParameterFileProblem]:
    """Return the first tab that YAML rejects; the YAML parser decides where tabs are valid."""
    if not any('\t' in line[: len(line) - len(line.lstrip())] for line in lines):
        return None
    import yaml

    try:
        yaml.compose('\n'.join(lines), yaml.SafeLoader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        if mark is not None and '\t' in lines[min(mark.line, len(lines) - 1)]:
            return ParameterFileProblem(
                mark.line + 1, 'it is not YAML, which allows only spaces before a name: no tabs'
            )
    return None


def _entry_without_parameters(lines: Sequence[str]) -> Optional[ParameterFileProblem]:
    """Return the first top-level name with content but without `ros__parameters`."""
    starts = [number for number, line in enumerate(lines) if (key_of(line) or ' ')[0] == '']
    for start, end in zip(starts, [*starts[1:], len(lines)]):
        block = lines[start:end]
        below = [key[1] for key in map(key_of, block[1:]) if key is not None]
        text = '\n'.join(block)
        if below and PARAMETERS not in text and '*' not in ''.join(block[1:]):
            key = key_of(lines[start])
            return ParameterFileProblem(start + 1, _missing(key[1] if key else '', below))
    return None


def _missing(name: str, below: Sequence[str]) -> str:
    from launch._did_you_mean import did_you_mean

    similar = next((each for each in below if did_you_mean(each, [PARAMETERS])), None)
    text = f"below '{name}' there is no '{PARAMETERS}'"
    if similar is None:
        return f'{text}, below which the parameters are to be'
    return f"{text}: was it meant by '{similar}'?"
